"""What melanin darkens at once in UVA, at places with shares of the doses."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.sun.doses import Doses
from hylios.tanning import ImmediateDarkening


@dataclass(frozen=True, eq=False)
class Uva:
    """UVA on bare skin, under every mask.

    Attributes
    ----------
    hours : (E,) array
    doses : (E, M) array
        J/cm^2.
    """

    hours: NDArray[np.float64]
    doses: NDArray[np.float64]

    @classmethod
    def of(cls, received: Sequence[Doses]) -> "Uva | None":
        """Of doses by mask; None where none is of light of known spectrum."""
        of_spectra = [(mask, own) for mask, own in enumerate(received) if own.uva is not None]
        if not of_spectra:
            return None
        hours = np.concatenate([own.hours for _, own in of_spectra])
        doses = np.zeros((hours.size, len(received)))
        last = 0
        for mask, own in of_spectra:
            doses[last : last + own.hours.size, mask] = own.uva
            last += own.hours.size
        return cls(hours, doses)

    def logarithms(self, shares: ArrayLike, hours: NDArray[np.int_]) -> NDArray[np.float32]:
        """Of the factor on the melanin of places at hours (T, S).

        Parameters
        ----------
        shares : (S,) or (S, M) array
            0 to 1.
        hours : (T,) array
        """
        parts = np.asarray(shares, float)
        parts = parts[:, None] if parts.ndim == 1 else parts
        factor = ImmediateDarkening().factor(self.hours, parts @ self.doses.T, hours)
        return np.log(factor).T.astype(np.float32)
