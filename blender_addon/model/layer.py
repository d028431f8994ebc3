"""A Principled BSDF's gloss on skin: what it lets through, and how it comes to the model's.

Cycles lets facets of a rough surface shadow each other, the light model does not, so that its
surface reflects more at an angle. A factor on the gloss by the angle of view makes up for it: under
even light the gloss reflects as much as the model's surface then. `gloss.csv` has the factor,
`layer.csv` the light that goes through a gloss with it.
"""

import functools
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hylios.table.interpolation import interpolate

INDEX = 1.5526
"""Index of refraction of the skin's surface, for which both files were measured."""


def let_through(roughness: float, angles: float | Sequence[float] | NDArray) -> NDArray[np.float64]:
    """The factor between base and light from below, at angles of view in degrees.

    Parameters
    ----------
    roughness : float
        Of the shader; beyond what was measured the nearest counts, as for angles.
    """
    return _at(roughness, 1.0 - np.cos(np.radians(angles)), "layer.csv")


def gloss_row(roughness: float, count: int) -> NDArray[np.float64]:
    """What a shader reads of the gloss by the angle of view, (count, 4).

    Places are even in x = 1 - cos(angle), from 0 to 1. The first three numbers are `let_through`,
    the last one is the shader's Specular Tint.
    """
    x = np.linspace(0.0, 1.0, count)
    through, tint = (_at(roughness, x, name) for name in ("layer.csv", "gloss.csv"))
    return np.stack([through, through, through, tint], axis=1)


def _at(roughness: float, x: NDArray | float, name: str) -> NDArray[np.float64]:
    roughnesses, angles, factors = _measured(name)
    at_roughness = [np.interp(roughness, roughnesses, column) for column in factors.T]
    places = 1.0 - np.cos(np.radians(angles))
    values = interpolate(
        "pchip", (places,), np.array(at_roughness)[:, None], np.reshape(x, (-1, 1))
    )
    return values.reshape(np.shape(x))


@functools.cache
def _measured(name: str) -> tuple[NDArray, NDArray, NDArray]:
    """Roughnesses, angles, and factors (roughnesses, angles), measured by examples/truth."""
    text = Path(__file__).with_name(name).read_text(encoding="utf-8")
    titles, *lines = [line for line in text.splitlines() if not line.startswith("#")]
    angles = np.array(titles.split(",")[1:], dtype=float)
    numbers = np.array([line.split(",") for line in lines], dtype=float)
    return numbers[:, 0], angles, numbers[:, 1:]
