"""Water, oil or sunscreen on the skin, as numbers for a shader: gloss, and a change of colour.

A film's face reflects light as a Principled BSDF's coat, and beneath it the skin's surface reflects
hardly any, for the liquid's index is near its own. Light that has been inside has a colour that
follows from the one without a film (`film.csv`), at all angles of view.
"""

import functools
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hylios.tissue.liquids import LIQUIDS

from .layer import INDEX, let_through
from .look import NORMAL_ANGLE

ROUGHNESS = {"water": 0.05, "oil": 0.12, "sunscreen": 0.2}
"""Of a film's face as a shader has it, by eye; the light model's is flat."""

DEEP_MILLIMETRES = 0.1
"""Depth of pores and fine lines, which a film fills from below."""


@dataclass(frozen=True)
class Film:
    """A film for a shader.

    Attributes
    ----------
    liquid : str
        Its name.
    index : float
        Of refraction.
    roughness : float
        Of its face.
    relief : float
        Of its face, as a share of the skin's.
    start, slope : tuples of 3 float
        A shader's base colour under the film, over that without one, is 1 + start + slope times
        the colour of the light that has been inside skin without a film, in each channel.
    """

    liquid: str
    index: float
    roughness: float
    relief: float
    start: tuple[float, float, float]
    slope: tuple[float, float, float]


def film_of(liquid: str, roughness: float) -> Film:
    """A film of one of `hylios.tissue.liquids.LIQUIDS` on skin with a shader's roughness."""
    index, thickness = LIQUIDS[liquid].index, LIQUIDS[liquid].thickness
    start, slope = _fits()[liquid]
    # As much as the gloss without a film keeps from the base, over what film and skin keep.
    through = (1.0 - _reflected(1.0, index)) * (1.0 - _reflected(index, INDEX))
    ratio = float(let_through(roughness, NORMAL_ANGLE)) / through
    return Film(
        liquid=liquid,
        index=index,
        roughness=ROUGHNESS[liquid],
        relief=max(0.0, 1.0 - thickness / DEEP_MILLIMETRES),
        start=tuple((ratio * start - 1.0).tolist()),
        slope=tuple((ratio * slope).tolist()),
    )


def _reflected(index: float, beyond: float) -> float:
    """Share of light that a flat face reflects straight back."""
    return ((index - beyond) / (index + beyond)) ** 2


@functools.cache
def _fits() -> dict[str, np.ndarray]:
    """Start and slope (2, 3) of the colour by liquid, fitted by examples/truth/film_fit.py."""
    text = Path(__file__).with_name("film.csv").read_text(encoding="utf-8")
    _, *lines = [line.split(",") for line in text.splitlines() if not line.startswith("#")]
    return {name: np.array(numbers, dtype=float).reshape(2, 3) for name, *numbers in lines}
