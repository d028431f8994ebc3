"""How much of a Principled BSDF's base shows through its gloss in Cycles."""

import functools
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

INDEX = 1.5526
"""Index of refraction of the skin's surface, for which `layer.csv` was measured."""


def let_through(roughness: float, angles: float | Sequence[float]) -> NDArray[np.float64]:
    """The factor between base and light from below, at angles of view in degrees.

    Parameters
    ----------
    roughness : float
        Of the shader; beyond what was measured the nearest counts.
    """
    roughnesses, measured, factors = _measured()
    at_roughness = [np.interp(roughness, roughnesses, column) for column in factors.T]
    return np.asarray(np.interp(angles, measured, at_roughness))


@functools.cache
def _measured() -> tuple[NDArray, NDArray, NDArray]:
    """Roughnesses, angles, and factors (roughnesses, angles), measured by examples/truth."""
    text = Path(__file__).with_name("layer.csv").read_text(encoding="utf-8")
    titles, *lines = [line for line in text.splitlines() if not line.startswith("#")]
    angles = np.array(titles.split(",")[1:], dtype=float)
    numbers = np.array([line.split(",") for line in lines], dtype=float)
    return numbers[:, 0], angles, numbers[:, 1:]
