"""What an artist has set on one object, as plain values."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from hylios.errors import InputError, require_range, require_whole
from hylios.history import LAST_DAY_LIMIT
from hylios.skin.biology import RANGES, Biology
from hylios.table.provenance import MinimalDoses, minimal_doses

LEAST_MINIMAL_DOSE, LARGEST_MINIMAL_DOSE = 0.1, 1000.0
"""Range of minimal doses in SED: the largest is a hundred times that of the darkest skin."""

DOSE_LIMIT, MULTIPLE_LIMIT = 1000.0, 100.0
"""Largest dose of one exposure, in SED and in minimal tanning doses."""

DURATION_LIMIT, FACTOR_LIMIT = 48.0, 1000.0
"""Most hours under a UV index, and largest SPF, of one exposure."""

USUAL_GROUND, AIR, WATER = "USUAL", "AIR", "WATER"
"""Ground of which nothing is said; what the sun goes through before it meets the skin."""

USUAL_DATE, USUAL_HOURS = (7, 15), (11.0, 15.0)
"""Month and day, and hours of the day, of sun for which none are given."""

LEAST_SCALE, LARGEST_SCALE = 1e-4, 1e4
"""Range of how many times life-size a model is."""

FRAME_LIMIT = 1048574
"""Last frame of Blender's timeline; the first is minus this."""


UNCHANGED = Biology()
BIOLOGY_RANGES = RANGES


@dataclass(frozen=True)
class Exposure:
    """One time in the sun, as `SkinTanExposure` holds it.

    Attributes
    ----------
    day : float
        When it begins, in days from the start of the tan; of unit SUN, only the whole day counts.
    unit : str
        SED, MMD, UV_INDEX or SUN: which of the following count.
    dose : float
        Of unit SED, in SED.
    multiple : float
        Of unit MMD, in minimal melanogenesis doses.
    uv_index, duration : float
        Of unit UV_INDEX; the duration in hours.
    latitude, month, day_of_month, from_hour, to_hour
        Of unit SUN: degrees north, a date and two hours of local solar time.
    sunscreen : bool
        Whether `spf` and `sunscreen_amount`, mg/cm^2, count.
    altitude, cloud, ground, through, depth
        Of unit SUN: m over the sea, percent of the sky, names of `GROUNDS` and of `PANES`, WATER or
        AIR, and m of water.
    """

    day: float
    unit: str
    dose: float
    multiple: float
    uv_index: float
    duration: float
    latitude: float
    month: int
    day_of_month: int
    from_hour: float
    to_hour: float
    sunscreen: bool
    spf: float
    sunscreen_amount: float
    altitude: float = 0.0
    cloud: float = 0.0
    ground: str = USUAL_GROUND
    through: str = AIR
    depth: float = 1.0

    @classmethod
    def of(cls, source: Any) -> "Exposure":
        """The values of anything with attributes of these names."""
        return cls(**{field.name: getattr(source, field.name) for field in fields(cls)})


def own_minimal_doses(mmd: float, med: float) -> MinimalDoses:
    """Minimal doses that are set by hand, in SED.

    Raises
    ------
    InputError
        If one is out of range.
    """
    for name, value in (("minimal tanning dose", mmd), ("minimal burn dose", med)):
        require_range(name, value, LEAST_MINIMAL_DOSE, LARGEST_MINIMAL_DOSE, "SED")
    return MinimalDoses(mmd=mmd, med=med)


@dataclass(frozen=True)
class TanSettings:
    """All that decides how an object tans.

    Attributes
    ----------
    table : Path
        Of the skin's table.
    own_doses : MinimalDoses or None
        Those set by hand; without them the table's count.
    exposures : tuple of Exposure
    first_day, last_day : float
        Days of the first and the last frame.
    biology : Biology
        What differs in the skin from that of the table.
    kinetics : str
        One of `hylios.tanning.KINETICS`.
    redness : bool
        Whether the skin reddens after the sun.
    peeling : bool
        Whether burnt skin peels.
    darkening : bool
        Whether melanin darkens at once in UVA.

    Raises
    ------
    InputError
        If the days are out of range or order.
    """

    table: Path
    own_doses: MinimalDoses | None
    exposures: tuple[Exposure, ...]
    first_day: float
    last_day: float
    biology: Biology = UNCHANGED
    kinetics: str = "thesis"
    redness: bool = False
    peeling: bool = False
    darkening: bool = False

    def __post_init__(self):
        check_days(self.first_day, self.last_day)

    def minimal_doses(self, provenance: Mapping[str, Any]) -> MinimalDoses:
        """Minimal doses set by hand, else those of the table.

        Raises
        ------
        InputError
            If the table's are to be used and it has none that can be used.
        """
        return self.own_doses or minimal_doses(provenance)


def check_days(first_day: float, last_day: float) -> None:
    """Raise InputError unless the days are in range and the last comes after the first."""
    require_range("first day", first_day, 0.0, LAST_DAY_LIMIT)
    require_range("last day", last_day, 0.0, LAST_DAY_LIMIT)
    if not last_day > first_day:
        raise InputError(
            f"last day is {last_day:g}; allowed is more than the first day, {first_day:g}, "
            f"to {LAST_DAY_LIMIT:g}."
        )


def check_frames(first_frame: int, last_frame: int) -> None:
    """Raise InputError unless Blender has the frames and the last comes after the first."""
    require_whole("first frame", first_frame, -FRAME_LIMIT, FRAME_LIMIT)
    require_whole("last frame", last_frame, -FRAME_LIMIT, FRAME_LIMIT)
    if not last_frame > first_frame:
        raise InputError(
            f"last frame is {last_frame}; allowed is more than the first frame, {first_frame}, "
            f"to {FRAME_LIMIT}."
        )
