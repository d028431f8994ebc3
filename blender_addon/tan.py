"""A tan over time and share of the dose, as arrays for a shader to sample. numpy only."""

from dataclasses import dataclass

import numpy as np

from hylios.errors import InputError, require_range
from hylios.table import PLANES, SkinTable, melanin_dynamics
from hylios.tanning import Exposures, simulate

LAST_DAY_LIMIT = 366.0
# The response jumps where the dose passes the MMD and then climbs in steps; with this many knots
# a jump is spread over 0.2 % of the share, and 99 % of all places are within 0.6 % of the melanin.
COLUMNS = 512
HOURS_PER_ROW = 6.0
ROWS_LIMIT = 1024


@dataclass(frozen=True)
class Exposure:
    """A dose in SED at a time in days, 0 or later."""

    day: float
    dose: float


@dataclass(frozen=True)
class Tan:
    """Appearance of skin over time and over the share of the dose that reached it.

    Attributes
    ----------
    colour : (rows, columns, 3) float32 array
        Linear Rec.709 albedo of the light that has been inside the skin.
    profile_width : (rows, columns, 3) float32 array
        Width d in mm of Burley's diffusion profile in red, green and blue.
    first_day, last_day : float
        Times of the first and last row; the rows between are evenly spaced. Columns are evenly
        spaced over shares from 0 to 1.
    """

    colour: np.ndarray
    profile_width: np.ndarray
    first_day: float
    last_day: float


def tan(
    table: SkinTable,
    exposures: list[Exposure],
    *,
    mmd: float,
    med: float,
    first_day: float,
    last_day: float,
) -> Tan:
    """Simulate a schedule of exposures of a skin from day 0 and look its appearance up.

    Parameters
    ----------
    mmd, med : float
        Minimal melanogenesis and erythema dose in SED.
    first_day, last_day : float
        Range of days to return, within 0 to LAST_DAY_LIMIT. An exposure after the last has no
        effect.

    Raises
    ------
    InputError
        If a day or dose is out of range, or if the table does not say how its skin makes melanin.
    """
    check_days(first_day, last_day)
    hours = int(np.ceil(24.0 * last_day))
    share = np.linspace(0.0, 1.0, COLUMNS)
    history = simulate(
        Exposures(
            hours=np.array([hour_of(exposure.day) for exposure in exposures], dtype=int),
            doses=share[:, None] * np.array([exposure.dose for exposure in exposures], dtype=float),
        ),
        melanin_dynamics(table.provenance),
        mmd=mmd,
        med=med,
        hours=hours,
    )
    rows = min(ROWS_LIMIT, int(np.ceil(24.0 * (last_day - first_day) / HOURS_PER_ROW)) + 1)
    states = _at_hours(history.states, 24.0 * np.linspace(first_day, last_day, rows))
    appearance = table.lookup(states).astype(np.float32)
    return Tan(
        colour=appearance[..., PLANES.index("subsurface_colour"), :],
        profile_width=appearance[..., PLANES.index("profile_width"), :],
        first_day=first_day,
        last_day=last_day,
    )


def check_days(first_day: float, last_day: float) -> None:
    """Raise InputError unless the days are in range and the last comes after the first."""
    require_range("first day", first_day, 0.0, LAST_DAY_LIMIT)
    require_range("last day", last_day, 0.0, LAST_DAY_LIMIT)
    if not last_day > first_day:
        raise InputError(
            f"last day is {last_day:g}; allowed is more than the first day, {first_day:g}, "
            f"to {LAST_DAY_LIMIT:g}."
        )


def hour_of(day: float) -> int:
    """The hour of the tanning model in which an exposure at a time in days takes place.

    Raises
    ------
    InputError
        If the day is out of range.
    """
    require_range("day of an exposure", day, 0.0, LAST_DAY_LIMIT)
    return int(np.floor(24.0 * day + 0.5))


def _at_hours(states: np.ndarray, hours: np.ndarray) -> np.ndarray:
    """States (rows, columns, 4) at the given hours, from hourly ones (columns, hours, 4)."""
    low = np.minimum(hours.astype(int), states.shape[1] - 2)
    fraction = (hours - low)[:, None, None]
    hourly = np.moveaxis(states, 1, 0)
    return hourly[low] * (1.0 - fraction) + hourly[low + 1] * fraction
