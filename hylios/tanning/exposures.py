"""Doses of ultraviolet light, and when they fall."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, as_numbers

LONGEST_HOURS = 24 * 366 * 100
LARGEST_DOSE = 1e12  # SED; far beyond any, and its sums stay finite


@dataclass(frozen=True, init=False)
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

    hours: NDArray[np.int_]
    doses: NDArray[np.float64]
    thickening_doses: NDArray[np.float64]

    # Written out: what is given may be a list, what is kept is an array.
    def __init__(
        self,
        hours: ArrayLike = (),
        doses: ArrayLike = (),
        thickening_doses: ArrayLike | None = None,
    ) -> None:
        whole = _whole_hours(hours)
        melanogenesis = _checked_doses(doses, whole.size)
        thickening = melanogenesis
        if thickening_doses is not None:
            thickening = _checked_doses(thickening_doses, whole.size)
        if thickening.shape != melanogenesis.shape:
            raise InputError(
                f"thickening doses have shape {thickening.shape}; expected {melanogenesis.shape}."
            )
        object.__setattr__(self, "hours", whole)
        object.__setattr__(self, "doses", melanogenesis)
        object.__setattr__(self, "thickening_doses", thickening)


def require_exposures(exposures: Exposures) -> Exposures:
    """The exposures, if they are some and not doses or hours alone.

    Raises
    ------
    InputError
        If they are anything else.
    """
    if not isinstance(exposures, Exposures):
        raise InputError(
            f"exposures are {str(exposures)[:60]!r}; expected Exposures(hours, doses), such as "
            "Exposures([0], [30]) for 30 SED at hour 0."
        )
    return exposures


def _whole_hours(given: ArrayLike) -> NDArray[np.int_]:
    hours = as_numbers("hours of exposure", given)
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
    return hours.astype(int)


def _checked_doses(given: ArrayLike, exposures: int) -> NDArray[np.float64]:
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
