"""Doses of ultraviolet light, and when they fall."""

from dataclasses import dataclass, field

import numpy as np

from hylios.errors import InputError, as_numbers

LONGEST_HOURS = 24 * 366 * 100
LARGEST_DOSE = 1e12  # SED; far beyond any, and its sums stay finite


@dataclass(frozen=True)
class Exposures:
    """Doses of ultraviolet light.

    Attributes
    ----------
    hours : (E,) int array
        Hour of each dose, 0 to a century, in any order.
    doses : (..., E) float array
        Dose in SED of each exposure. Leading axes are separate histories, such as places on a
        body that different shares of the light reach.
    thickening_doses : (..., E) float array, optional
        Dose in SED as it counts for the thickness, where the light's spectrum has it differ
        (`hylios.sun`); the same as `doses` by default.

    Raises
    ------
    InputError
        If an hour or a dose is out of range or not a number, or the shapes do not agree.

    Examples
    --------
    6 SED on each of three days, on bare skin and under cloth that lets a tenth through:

    >>> import hylios
    >>> exposures = hylios.Exposures([0, 24, 48], [[6, 6, 6], [0.6, 0.6, 0.6]])
    >>> hylios.skin_type("II").states(exposures, times=[240, 480]).shape
    (2, 2, 4)
    """

    hours: np.ndarray = field(default_factory=lambda: np.zeros(0, int))
    doses: np.ndarray = field(default_factory=lambda: np.zeros(0))
    thickening_doses: np.ndarray = None  # type: ignore[assignment]  # filled in below

    def __post_init__(self):
        hours = as_numbers("hours of exposure", self.hours)
        if hours.ndim != 1:
            raise InputError(f"hours of exposure have shape {hours.shape}; expected one row.")
        outside = hours[~((hours >= 0) & (hours <= LONGEST_HOURS))]
        if outside.size:
            raise InputError(
                f"an hour of exposure is {outside[0]:.10g}; allowed is 0 to {LONGEST_HOURS}."
            )
        between = hours[hours != np.floor(hours)]
        if between.size:
            raise InputError(f"an hour of exposure is {between[0]:.10g}; allowed are whole hours.")
        doses = _checked_doses(self.doses, hours.size)
        thickening = self.thickening_doses
        thickening = doses if thickening is None else _checked_doses(thickening, hours.size)
        if thickening.shape != doses.shape:
            raise InputError(
                f"thickening doses have shape {thickening.shape}; expected {doses.shape}."
            )
        object.__setattr__(self, "hours", hours.astype(int))
        object.__setattr__(self, "doses", doses)
        object.__setattr__(self, "thickening_doses", thickening)


def _checked_doses(given: np.ndarray, exposures: int) -> np.ndarray:
    doses = as_numbers("doses", given)
    if doses.ndim < 1 or doses.shape[-1] != exposures:
        raise InputError(
            f"doses have shape {doses.shape}; the last axis must match the {exposures} hours."
        )
    if not np.all((doses >= 0) & (doses <= LARGEST_DOSE)):
        raise InputError(
            f"a dose is negative, not finite or too large; allowed is 0 to {LARGEST_DOSE:g} SED."
        )
    return doses
