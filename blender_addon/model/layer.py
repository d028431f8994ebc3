"""How much of a Principled BSDF's base shows through its gloss in Cycles."""

import functools
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

INDEX = 1.5526
"""Index of refraction of the skin's surface, for which `layer.csv` was measured."""

STRAIGHT = 20.0
"""Angle of view in degrees below which the factor does not change."""


def let_through(roughness: float, angles: float | Sequence[float] | NDArray) -> NDArray[np.float64]:
    """The factor between base and light from below, at angles of view in degrees.

    Parameters
    ----------
    roughness : float
        Of the shader; beyond what was measured the nearest counts.
    """
    roughnesses, measured, factors = _measured()
    at_roughness = [np.interp(roughness, roughnesses, column) for column in factors.T]
    return np.asarray(np.interp(angles, measured, at_roughness))


def through_gloss(roughness: float) -> tuple[float, float, float, float]:
    """`let_through` as a polynomial of x = 1 - cos(angle of view), to .0003 up to 70 degrees.

    Returns
    -------
    coefficients of x to the powers 0, 2, 3 and 4
    """
    angles = _measured()[1]
    factors = let_through(roughness, angles)
    straight = float(factors[angles < STRAIGHT].mean())
    oblique = angles >= STRAIGHT
    x = 1.0 - np.cos(np.radians(angles[oblique]))
    terms = np.stack([x**2, x**3, x**4], axis=1)
    first, second, third = np.linalg.lstsq(terms, factors[oblique] - straight, rcond=None)[0]
    return straight, float(first), float(second), float(third)


@functools.cache
def _measured() -> tuple[NDArray, NDArray, NDArray]:
    """Roughnesses, angles, and factors (roughnesses, angles), measured by examples/truth."""
    text = Path(__file__).with_name("layer.csv").read_text(encoding="utf-8")
    titles, *lines = [line for line in text.splitlines() if not line.startswith("#")]
    angles = np.array(titles.split(",")[1:], dtype=float)
    numbers = np.array([line.split(",") for line in lines], dtype=float)
    return numbers[:, 0], angles, numbers[:, 1:]
