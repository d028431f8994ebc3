"""What the figures of tans share: skins, dose schedules, and the colour of a tanning state.

The thesis only plots its dose schedules. What is printed nowhere is ASSUMED here; the pictures and
the report say so.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hylios.adding import spectrum
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.skin.specimen import SPECIMENS, Specimen, parameters
from hylios.tanning import Exposures, TanningHistory

Schedule = Sequence[tuple[float, float]]
"""Doses as (day, SED)."""

WEEK, WITHIN_WEEK = 7.0, (0.0, 3.0)
"""Days of a week and those of its exposures. ASSUMED: ten in five weeks are two a week."""

MILLER_DOSES = {"42 SED": (10, 42.0), "29 SED": (8, 29.0), "19 SED": (8, 19.0)}
"""Number and sum in SED of the doses of each schedule.

From the abstract of Miller et al. 2008 (British Journal of Dermatology 159, 921): 4200 J/m^2 as 10
exposures in 5 weeks, 2900 as 8 in 4 weeks, 1900 in 4 weeks, one to three exposures a week. That
these are the three of figure 6.23, that the last are 8, and single doses are ASSUMED: the paper
behind reference 121 could not be established nor its figures be had.
"""


def days_of(count: int) -> np.ndarray:
    """Days of so many exposures, two a week, the first on day 0."""
    return np.array([WEEK * (n // 2) + WITHIN_WEEK[n % 2] for n in range(count)])


def evenly(count: int, total: float) -> Schedule:
    """A schedule of so many equal doses."""
    return [(float(day), total / count) for day in days_of(count)]


def rising(count: int, total: float, first: float) -> Schedule:
    """A schedule of so many doses that rise by equal steps from the first."""
    doses = np.linspace(first, 2.0 * total / count - first, count)
    return [(float(day), float(dose)) for day, dose in zip(days_of(count), doses, strict=True)]


SCHEDULES = {name: evenly(*doses) for name, doses in MILLER_DOSES.items()}
"""The three schedules of figure 6.23. ASSUMED: equal doses."""


def between() -> Specimen:
    """A specimen whose every number is the geometric mean of S3's and S4's."""
    light, dark = SPECIMENS["S3"], SPECIMENS["S4"]
    mean = {
        parameter.name: float(
            np.sqrt(getattr(light, parameter.name) * getattr(dark, parameter.name))
        )
        for parameter in parameters()
    }
    return replace(light, name="between S3 and S4", **mean)


MILLER_SKIN = Skin.of(SPECIMENS["S3"], "low", mmd=2.89, med=1.7)
"""Minimal doses as section 6.2.2 prints them. ASSUMED: S3 stands for the low level."""

SKINS = {
    "low": Skin.of(SPECIMENS["S3"], "low"),
    "intermediate": Skin.of(between(), "intermediate"),
    "high": Skin.of(SPECIMENS["S4"], "high"),
}
"""S3, S4 and one between, for the intermediate set. ASSUMED: the thesis names no such specimen."""

COLOUR_WAVELENGTHS = 8
"""Number of wavelengths of a colour: within .03 in L* of a spectrum every 10 nm."""


def exposures_of(schedule: Schedule) -> Exposures:
    """The doses of a schedule, to the hour."""
    hours = np.array([round(24 * day) for day, _ in schedule])
    return Exposures(hours, np.array([dose for _, dose in schedule]))


def history(skin: Skin, schedule: Schedule, days: float) -> TanningHistory:
    """The skin's state after a schedule, every hour up to a day."""
    return skin.history(exposures_of(schedule), round(24 * days))


def rise(states: TanningHistory) -> float:
    """Largest increase of all melanin, relative to the start."""
    return float(states.total.max() - 1.0)


def single_doses(skin: Skin, doses: Sequence[float], days: float) -> TanningHistory:
    """States after one dose on day 0, over doses (D,) in SED; shapes (D, T, ...)."""
    exposures = Exposures(np.array([0]), np.array(doses, dtype=float)[:, None])
    return skin.history(exposures, round(24 * days))


def colour(skin: Skin, state: np.ndarray) -> np.ndarray:
    """Linear Rec.709 (3,) under D65 of the skin in a tanning state (4,), at 8 degrees."""
    quadrature = skin_quadrature(COLOUR_WAVELENGTHS)
    light = spectrum(skin.at(state), quadrature.wavelengths)
    return quadrature.weights @ light.total
