"""What the renders after figures 6.24 to 6.29 show: skins, schedules, days. Needs no Blender."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from hylios.specimen import EPIDERMIS, SPECIMENS, Specimen
from hylios.tanning import PIGMENTATIONS
from lut_builder.states import Skin, skin

Schedule = tuple[tuple[float, float], ...]
"""Exposures as (day, SED)."""


def twice_a_week(count: int, total: float) -> Schedule:
    """So many equal doses of a total in SED, the first on day 0."""
    return tuple((7.0 * (n // 2) + 3.0 * (n % 2), total / count) for n in range(count))


SCHEDULES = (twice_a_week(8, 19.0), twice_a_week(8, 29.0), twice_a_week(10, 42.0))
"""Of the upper, middle and lower patch: figure 6.23 only plots Miller et al.'s doses. Numbers and
totals are from the abstract of Miller et al. 2008 (British Journal of Dermatology 159, 921); that
it means these, their times and that doses are equal is ASSUMED."""

BEACH: Schedule = ((0.0, 30.0),)
"""Figures 6.27 to 6.29."""

MMD, MED = 2.89, 1.7
"""In SED, of the low set's specimen (section 6.2.2)."""

SENSITIVITY = {"low": 1.0, "intermediate": 1.4, "high": 2.4}
"""By what figure 6.26 scales the doses. ASSUMED to be each skin's minimal doses over the low
set's: equation 3.2 would give 1.5 and 3.2 times its own for S3."""

STRONG = "low, high tanning ability"
STRONG_PRODUCTION = 0.0858
"""Extra production of the stratum basale in figure 6.27."""

INTERMEDIATE_MELANIN = 3.0
"""Times S3's."""


def skins() -> dict[str, Skin]:
    """The skins of the renders; tables have their names."""
    s3, s4 = SPECIMENS["S3"], SPECIMENS["S4"]
    return {
        "low": skin(s3, "low", MMD, MED),
        "intermediate": _less_sensitive(between(), "intermediate"),
        "high": _less_sensitive(s4, "high"),
        "strong": strong_skin(),
        "beach": skin(s3, "intermediate", MMD, MED),
    }


def between() -> Specimen:
    """S3 with more melanin in every layer and form, so that L* is halfway to S4's.

    ASSUMED: the thesis names no specimen for the intermediate set.
    """
    s3 = SPECIMENS["S3"]
    forms = ("melanosomes", "colloidal_melanin")
    names = [f"{layer}_{form}" for layer in EPIDERMIS for form in forms]
    more = {name: INTERMEDIATE_MELANIN * getattr(s3, name) for name in names}
    return replace(s3, name="between S3 and S4", **more)


def _less_sensitive(specimen: Specimen, pigmentation: str) -> Skin:
    factor = SENSITIVITY[pigmentation]
    return skin(specimen, pigmentation, factor * MMD, factor * MED)


def strong_skin() -> Skin:
    """S3 with the low set and a high tanning ability (figure 6.27)."""
    low = PIGMENTATIONS["low"]
    more = (STRONG_PRODUCTION, *low.extra_production[1:])
    # Tables name their set; this one is known by a name of its own.
    PIGMENTATIONS.setdefault(STRONG, replace(low, extra_production=more))
    return skin(SPECIMENS["S3"], STRONG, MMD, MED)


def scaled(schedule: Schedule, factor: float) -> Schedule:
    """The schedule with every dose times a factor."""
    return tuple((day, factor * dose) for day, dose in schedule)


Window = tuple[float, float, float, float]
WHOLE: Window = (0.0, 1.0, 0.0, 1.0)
PATCHES: Window = (0.20, 0.52, 0.24, 0.76)
"""Left, right, bottom, top of the close-ups of figure 6.24, as shares of the whole picture."""


@dataclass(frozen=True)
class Shot:
    """One picture.

    Attributes
    ----------
    name : str
    stage : str
        Subject, camera and light: patches, sunscreen, face or swimmer (`scenes.stages`).
    table : str
        File of the skin's table, without its ending.
    schedules : tuple of Schedule
        One for each part of the subject that has its own.
    day : float
    window : Window
        Part of the stage's picture.
    percent : int
        Of the stage's size.
    gloss : bool
        Whether the sunscreen still lies on what it covers.
    """

    name: str
    stage: str
    table: str
    schedules: tuple[Schedule, ...]
    day: float
    window: Window = WHOLE
    percent: int = 48
    gloss: bool = False


DONE = "done "
"""How the line begins that Blender's process prints for each picture."""

CLOSE_DAYS = (4, 8, 12, 16, 20, 31)
FIRST_AND_LAST = (0, 45)
AIRPORT_DAYS = (0, 4, 15)
FACE_DAYS = (0, 15)
DAILY = tuple(range(1, 31))
MAIN_DAYS = (1, 10, 20, 30)
LAST_DAY = 46.0
UV = "low 365 nm"


def shots() -> list[Shot]:
    """All pictures, those of one stage and tan one after the other."""
    wide = [
        Shot(f"6.24 day {day}", "patches", "low", SCHEDULES, day, percent=52)
        for day in FIRST_AND_LAST
    ]
    close = [
        Shot(f"6.24 day {day}", "patches", "low", SCHEDULES, day, PATCHES, 100)
        for day in CLOSE_DAYS
    ]
    plain = [patches("6.25", name, 1.0) for name in SENSITIVITY]
    matched = [patches("6.26", name, factor) for name, factor in SENSITIVITY.items()]
    back = [
        Shot(f"6.27 day {day}", "sunscreen", "strong", (BEACH,), day, gloss=day == 0)
        for day in AIRPORT_DAYS
    ]
    face = [
        Shot(f"6.28 {light} day {day}", "face", table, (BEACH,), day, gloss=day == 0)
        for light, table in (("visible", "low"), ("UV", UV))
        for day in FACE_DAYS
    ]
    main = [Shot(f"6.29 day {day}", "swimmer", "beach", (BEACH,), day) for day in MAIN_DAYS]
    daily = [
        Shot(f"6.29 small, day {day}", "swimmer", "beach", (BEACH,), day, percent=25)
        for day in DAILY
    ]
    return [*wide, *close, *plain, *matched, *back, *face, *main, *daily]


def patches(figure: str, skin_name: str, factor: float) -> Shot:
    """Day 20 of the patches on a skin, with doses times a factor."""
    schedules = tuple(scaled(each, factor) for each in SCHEDULES)
    return Shot(f"{figure} {skin_name}", "patches", skin_name, schedules, 20.0)


def named(wanted: Mapping[str, object]) -> list[Shot]:
    """The shots whose names are wanted, in the order of `shots`."""
    return [shot for shot in shots() if shot.name in wanted]
