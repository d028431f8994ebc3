"""Water, oil or sunscreen on the skin, as numbers for a shader: gloss, and a change of colour.

A film's face reflects light as a Principled BSDF's coat, and beneath it the skin's surface reflects
hardly any, for the liquid's index is near its own. Light that has been inside has a colour that
follows from the one without a film (`film.csv`), at all angles of view.
"""

import functools
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hylios.adding.surface import fresnel
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
    more_through : float
        Share by which film and skin let more light through than dry skin's gloss, straight on; at
        70 degrees it is .03 more.
    start, slope : tuples of 3 float
        A shader's base colour under the film, over that without one, is 1 + start + slope times
        the colour of the light that has been inside skin without a film, in each channel.
    """

    liquid: str
    index: float
    roughness: float
    relief: float
    more_through: float
    start: tuple[float, float, float]
    slope: tuple[float, float, float]


def film_of(liquid: str, roughness: float) -> Film:
    """A film of one of `hylios.tissue.liquids.LIQUIDS` on skin with a shader's roughness."""
    index, thickness = LIQUIDS[liquid].index, LIQUIDS[liquid].thickness
    start, slope = _fits()[liquid]
    ratio = _dry_over_wet(index, roughness)
    return Film(
        liquid=liquid,
        index=index,
        roughness=ROUGHNESS[liquid],
        relief=max(0.0, 1.0 - thickness / DEEP_MILLIMETRES),
        more_through=1.0 / ratio - 1.0,
        start=_channels(ratio * start - 1.0),
        slope=_channels(ratio * slope),
    )


def _channels(values: NDArray[np.float64]) -> tuple[float, float, float]:
    red, green, blue = values.tolist()
    return red, green, blue


def _dry_over_wet(index: float, roughness: float) -> float:
    """What dry skin's gloss lets through, over what film and skin do, straight on."""
    face, _ = fresnel(np.cos(np.radians(NORMAL_ANGLE)), 1.0, index)
    beneath, _ = fresnel(1.0, index, INDEX)
    through = (1.0 - face) * (1.0 - beneath)
    return float(let_through(roughness, NORMAL_ANGLE) / through)


@functools.cache
def _fits() -> dict[str, NDArray[np.float64]]:
    """Start and slope (2, 3) of the colour by liquid, fitted by examples/truth/film_fit.py."""
    text = Path(__file__).with_name("film.csv").read_text(encoding="utf-8")
    _, *lines = [line.split(",") for line in text.splitlines() if not line.startswith("#")]
    return {name: np.array(numbers, dtype=float).reshape(2, 3) for name, *numbers in lines}
