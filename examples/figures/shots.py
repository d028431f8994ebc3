"""What the renders after figures 6.24 to 6.29 show: skins, schedules, days. Needs no Blender."""

from collections.abc import Mapping
from dataclasses import dataclass

from blender_addon.model.views import VISIBLE
from examples.figures import tans
from examples.figures.tans import MILLER_SKIN, Schedule
from hylios.skin import Skin
from hylios.skin.specimen import SPECIMENS, Specimen

SCHEDULES = tuple(tuple(tans.SCHEDULES[name]) for name in ("19 SED", "29 SED", "42 SED"))
"""Schedules of the upper, middle and lower patch: those of figure 6.23."""

BEACH: Schedule = ((0.0, 30.0),)
"""Figures 6.27 to 6.29."""

MMD, MED = MILLER_SKIN.mmd, MILLER_SKIN.med

SENSITIVITY = {"low": 1.0, "intermediate": 1.4, "high": 2.4}
"""By what figure 6.26 scales the doses. ASSUMED to be each skin's minimal doses over the low
set's: equation 3.2 would give 1.5 and 3.2 times its own for S3."""

STRONG = {"basale_extra_production": 0.0858}
"""What differs from the low set in figure 6.27."""


def skins() -> dict[str, Skin]:
    """The skins of the renders; tables have their names."""
    s3, s4 = SPECIMENS["S3"], SPECIMENS["S4"]
    return {
        "low": MILLER_SKIN,
        "intermediate": _less_sensitive(tans.between(), "intermediate"),
        "high": _less_sensitive(s4, "high"),
        "strong": Skin.of(s3, "low", MMD, MED, tanning=STRONG),
        "beach": Skin.of(s3, "intermediate", MMD, MED),
    }


def _less_sensitive(specimen: Specimen, pigmentation: str) -> Skin:
    factor = SENSITIVITY[pigmentation]
    return Skin.of(specimen, pigmentation, factor * MMD, factor * MED)


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
    view : str
        The add-on's, by its identifier (`blender_addon.model.views`).
    """

    name: str
    stage: str
    table: str
    schedules: tuple[Schedule, ...]
    day: float
    window: Window = WHOLE
    percent: int = 48
    gloss: bool = False
    view: str = VISIBLE


DONE = "done "
"""How the line begins that Blender's process prints for each picture."""

CLOSE_DAYS = (4, 8, 12, 16, 20, 31)
FIRST_AND_LAST = (0, 45)
AIRPORT_DAYS = (0, 4, 15)
FACE_DAYS = (0, 15)
DAILY = tuple(range(1, 31))
MAIN_DAYS = (1, 10, 20, 30)
LAST_DAY = 46.0
UV = "NM365"


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
        Shot(f"6.28 {light} day {day}", "face", "low", (BEACH,), day, gloss=day == 0, view=view)
        for light, view in (("visible", VISIBLE), ("UV", UV))
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
    schedules = tuple(scaled(schedule, factor) for schedule in SCHEDULES)
    return Shot(f"{figure} {skin_name}", "patches", skin_name, schedules, 20.0)


def named(wanted: Mapping[str, object]) -> list[Shot]:
    """The shots whose names are wanted, in the order of `shots`."""
    return [shot for shot in shots() if shot.name in wanted]
