"""Spectra from their first principal components, whole (D.1) or region by region."""

from collections.abc import Callable, Mapping

import numpy as np

from examples.figures.light import RANGE

PIECES = {"UV-visible": (250.0, 700.0), "IR-A": (700.0, 1400.0), "IR-B": (1400.0, 2500.0)}
"""Regions of the piecewise analysis in nm; where two meet belongs to the first."""


def reconstructed(spectra: np.ndarray, components: int) -> np.ndarray:
    """Spectra (S, W) from their first principal components (D.1).

    As the thesis has it: no mean is subtracted, the components are the right singular vectors
    of the spectra, the coefficients their product with the spectra.
    """
    _, _, rows = np.linalg.svd(spectra, full_matrices=False)
    basis = rows[:components].T
    return spectra @ basis @ basis.T


def piecewise(spectra: np.ndarray, components: int) -> np.ndarray:
    """Spectra (S, W) from so many components of each region (D.1)."""
    return np.hstack([reconstructed(spectra[:, piece], components) for piece in pieces()])


def pieces() -> list[np.ndarray]:
    """Which wavelengths of `RANGE` belong to each region, (W,) bool."""
    lasts = [last for _, last in PIECES.values()]
    return [
        (RANGE > first) & (RANGE <= last)
        for first, last in zip([-np.inf, *lasts[:-1]], lasts, strict=True)
    ]


def errors(spectra: np.ndarray, again: np.ndarray) -> np.ndarray:
    """RMSE of each spectrum, (S,)."""
    return np.sqrt(np.mean((spectra - again) ** 2, axis=1))


METHODS: Mapping[str, Callable[[np.ndarray, int], np.ndarray]] = {
    "PCA": reconstructed,
    "PPCA": piecewise,
}
