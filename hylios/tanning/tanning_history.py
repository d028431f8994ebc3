"""The state of a tanning skin over time, as a simulation gives it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class TanningHistory:
    """State of the skin over time.

    Attributes
    ----------
    hours : (T,) array
    melanin : (..., T, 3) float array
        Melanin of basale, spinosum, granulosum relative to the total at hour 0.
    thickness : (..., T) float array
        Thickness of the skin relative to hour 0 (5.29).
    blood : (..., T) float array or None
        Blood of the dermis relative to hour 0, where redness was simulated.

    Examples
    --------
    >>> import hylios
    >>> history = hylios.skin_type("IV").history(hylios.Exposures([0], [30]), hours=720)
    >>> print(f"darkest on day {history.hours[history.total.argmax()] / 24:.0f}")
    darkest on day 11
    """

    hours: NDArray[np.floating]
    melanin: NDArray[np.float64]
    thickness: NDArray[np.float64]
    blood: NDArray[np.float64] | None = None

    @classmethod
    def of(cls, hours: NDArray[np.floating], states: NDArray[np.float64]) -> "TanningHistory":
        """From states (..., T, 4), or (..., T, 5) with the blood, at hours (T,)."""
        blood = states[..., 4] if states.shape[-1] > 4 else None
        return cls(hours, states[..., :3], states[..., 3], blood)

    @property
    def total(self) -> NDArray[np.float64]:
        """Melanin of all layers relative to hour 0, shape (..., T) (5.14)."""
        return self.melanin.sum(axis=-1)

    @property
    def states(self) -> NDArray[np.float64]:
        """Melanin of the three layers, thickness and any blood side by side (..., T, 4 or 5)."""
        others = [self.thickness] if self.blood is None else [self.thickness, self.blood]
        return np.concatenate([self.melanin, *(other[..., None] for other in others)], axis=-1)
