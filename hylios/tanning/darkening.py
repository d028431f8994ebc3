"""Immediate darkening: melanin that is there turns darker in UVA, for minutes, hours and days.

The thesis has none. The change has the shape of melanin's own absorption (Rosen et al., Photochem.
Photobiol. 51, 583, 1990), so it is a passing factor on the melanin of every layer. numpy only.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, as_numbers, require_range
from hylios.tanning.exposures import LARGEST_DOSE, LONGEST_HOURS


@dataclass(frozen=True)
class ImmediateDarkening:
    """How melanin darkens in UVA.

    Two parts share one pool of melanin that can darken: one that is seen at once and gone within
    minutes, and one that stays until new melanin takes its place. Each rises with the dose as a
    first-order reaction, and saturates.

    Attributes
    ----------
    threshold, persistent_threshold : float
        UVA in J/cm^2 with which either is just seen: 1 and 11 (PMID 31206816, broadband UVA).
    fading : float
        Hours in which the first fades to 1/e: 1.4 minutes (the same).
    persistent_fading : float
        Hours in which the second does. ESTIMATE: it passes into the delayed tan (PMID 458186).
    just_seen : float
        Natural logarithm of the factor at a threshold: L* is .5 to 1.1 lower in types II to VI,
        .3 in type I; measured is .8 (PMID 31206816).
    most : float
        Most darkening in multiples of `just_seen`. ESTIMATE

    Raises
    ------
    InputError
        If a number is out of range.

    Examples
    --------
    Two hours of noon, an hour after them and a day after:

    >>> from hylios.tanning import ImmediateDarkening
    >>> factor = ImmediateDarkening().factor([0, 1], [20, 20], times=[3, 26])
    >>> print(" and ".join(f"{one:.2f}" for one in factor))
    1.22 and 1.13
    """

    threshold: float = 1.0
    persistent_threshold: float = 11.0
    fading: float = 1.4 / 60.0
    persistent_fading: float = 36.0
    just_seen: float = 0.075
    most: float = 5.0

    def __post_init__(self):
        require_range("threshold of darkening", self.threshold, 1e-6, 1e6, "J/cm^2")
        require_range(
            "threshold of persistent darkening", self.persistent_threshold, 1e-6, 1e6, "J/cm^2"
        )
        for name in ("fading", "persistent_fading"):
            require_range(f"{name} of darkening", getattr(self, name), 1e-6, 1e6, "hours")
        require_range("just_seen", self.just_seen, 0.0, 1.0)
        require_range("most darkening", self.most, 1.001, 1e3)

    def factor(
        self, hours: ArrayLike, uva: ArrayLike, times: ArrayLike, durations: ArrayLike = 1.0
    ) -> NDArray[np.float64]:
        """Factor (..., T) on melanin at some times.

        Parameters
        ----------
        hours : (E,) array
            When exposures begin. `Doses.hours` are the whole hours in which they lie: of a part of
            one give its own beginning here, and its duration.
        uva : (..., E) array
            J/cm^2 of UVA in each (`Doses.uva` of the sun or of a spectrum). Leading axes are
            separate histories.
        times : (T,) array
            Hours, whole or not.
        durations : (E,) array or float
            Hours that exposures last, evenly.

        Raises
        ------
        InputError
            If there is no UVA, the shapes do not fit or a number is out of range.
        """
        if uva is None:
            raise InputError(
                "doses of UVA are None; needed are those of the sun or of a spectrum, since doses "
                "in SED or by UV index do not say how much UVA is in them."
            )
        begun, told = as_numbers("hours of exposure", hours), as_numbers("times", times)
        doses, lasting = as_numbers("doses of UVA", uva), as_numbers("durations", durations)
        fits = begun.ndim == told.ndim == 1 and lasting.shape in {(), begun.shape}
        if not fits or doses.ndim < 1 or doses.shape[-1] != begun.size:
            raise InputError(
                f"doses of UVA have shape {doses.shape} at {begun.size} hours; expected one row of "
                "hours, of durations and of times, and as many doses as hours."
            )
        for name, numbers, least, most in (
            ("hour of exposure", begun, 0.0, LONGEST_HOURS),
            ("time", told, 0.0, LONGEST_HOURS),
            ("duration", lasting, 1e-6, LONGEST_HOURS),
            ("dose of UVA", doses, 0.0, LARGEST_DOSE),
        ):
            outside = numbers[~((numbers >= least) & (numbers <= most))]
            if outside.size:
                require_range(name, float(outside.flat[0]), least, most)
        since = told[:, None] - begun
        seen = doses @ _left(since, lasting, self.fading).T / self.threshold
        slowly = doses @ _left(since, lasting, self.persistent_fading).T
        seen += slowly / self.persistent_threshold
        darkened = self.most * -np.expm1(seen * np.log1p(-1.0 / self.most))
        return np.exp(self.just_seen * darkened)


def _left(since: np.ndarray, lasting: np.ndarray, fading: float) -> np.ndarray:
    """What is left of light, so many hours after it began; it lasts, and is even."""
    passed = np.clip(since, 0.0, lasting)
    kept = fading * -np.expm1(-passed / fading) / lasting
    return kept * np.exp(-np.maximum(since - lasting, 0.0) / fading)
