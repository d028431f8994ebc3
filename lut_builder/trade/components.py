"""Principal components of spectra, over the whole spectrum or region by region (appendix D)."""

from collections.abc import Sequence

import numpy as np

REGIONS_NM = (700.0, 1400.0)
"""Where the spectrum is divided for piecewise components (D.1)."""


def regions(wavelengths: np.ndarray) -> list[np.ndarray]:
    """Which wavelengths belong to each of the piecewise analysis's regions, bool."""
    number = np.searchsorted(REGIONS_NM, wavelengths)
    return [number == region for region in range(len(REGIONS_NM) + 1)]


def component_errors(
    spectra: np.ndarray, others: np.ndarray, parts: Sequence[np.ndarray], components: int
) -> np.ndarray:
    """RMSE (N,) of `others` (N, W) from so many principal components of `spectra` (M, W).

    As in appendix D no mean is subtracted, and each of the `parts`, bool arrays (W,), has
    components of its own; unlike there, spectra are kept that the components were not made from.
    """
    again = np.empty_like(others)
    for part in parts:
        rows = np.linalg.svd(spectra[:, part], full_matrices=False)[2][:components]
        again[:, part] = others[:, part] @ rows.T @ rows
    return np.sqrt(np.mean((others - again) ** 2, axis=1))
