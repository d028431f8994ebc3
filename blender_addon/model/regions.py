"""Regions of skin for nodes: what differs in an object's skin, and spots that come by themselves.

How regions differ is `hylios.skin.regions`'s. In spots the weight is the strength, more in some and
less in others; by the mask there are fewer of them.
"""

import functools
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from hylios.errors import InputError
from hylios.packaged import texts_of
from hylios.region_colour import colour_factor
from hylios.skin.biology import Biology
from hylios.skin.regions import Region, region
from hylios.table import skin_of
from hylios.table.axes import LookAxes
from hylios.table.provenance import own_spectra

from . import catalogue
from .settings import TanSettings

MOST_STRENGTH = 2.0

USUAL_MELANIN = 0.03
"""Share of the epidermis, of light skin: what is taken of a table that does not tell it."""

STRENGTH_STEP = 0.25
"""Strengths at which colours are solved: it takes 40 ms, too long for every move of a slider."""

LEAST_CHANGE = 0.003
"""Change of a colour's red, green and blue that is left out."""


@dataclass(frozen=True)
class Spots:
    """Spots that come by themselves: balls in space, of which the skin cuts discs.

    Attributes
    ----------
    least, largest : float
        Diameters of the balls in mm, most of them small; seen are discs of them.
    edge : float
        Width of the soft edge within them, in mm.
    apart : float
        Distance between places that may hold one, in mm.
    held : float
        Share of the places that hold one, at strength 1.
    """

    least: float
    largest: float
    edge: float
    apart: float
    held: float

    def share_of_area(self, strength: float) -> float:
        """Share of the skin that spots cover: that of space (Delesse), if none cut another."""
        ratio = self.largest / self.least - 1.0
        # Mean of (1 + ratio x^2)^3, x even between 0 and 1.
        cube = 1.0 + ratio + 0.6 * ratio**2 + ratio**3 / 7.0
        volume = np.pi / 6.0 * self.least**3 * cube
        return float(min(self.held * strength, 1.0) * volume / self.apart**3)


@dataclass(frozen=True)
class Shown:
    """A kind of region in a skin.

    Attributes
    ----------
    region : Region
    colour : 3 floats
        Linear Rec.709 at weight 1 over what the skin's table has at its melanin and blood.
    """

    region: Region
    colour: tuple[float, float, float]


def shown(settings: TanSettings, kind: str, strength: float) -> Shown:
    """A kind of region in the skin of settings, for weights up to about a strength.

    Parameters
    ----------
    kind : str
        One of `hylios.skin.regions.REGIONS`.

    Raises
    ------
    InputError
        If the table cannot be used, or the skin cannot be solved.
    """
    stamp = catalogue.stamp(settings.table)
    how = settings.biology, settings.kinetics
    steps = max(round(strength / STRENGTH_STEP), 1)
    return _shown(settings.table, stamp, how, kind, steps * STRENGTH_STEP)


@functools.lru_cache(maxsize=64)
def _shown(
    path: Path, stamp: tuple[int, int], how: tuple[Biology, str], kind: str, strength: float
) -> Shown:
    table = catalogue.table(path)
    try:
        skin = skin_of(table.provenance)
    except InputError:  # an early table: it does not tell its skin
        return Shown(region(kind, USUAL_MELANIN), (1.0, 1.0, 1.0))
    biology, kinetics = how
    changed = replace(skin, specimen=biology.of(skin.specimen), kinetics=kinetics)
    own = region(kind, changed.specimen.pigmentation)
    if not isinstance(table.axes, LookAxes) or own_spectra(table.provenance):
        return Shown(own, (1.0, 1.0, 1.0))
    factor = colour_factor(changed, table.axes, own, strength)
    if np.abs(factor - 1.0).max() < LEAST_CHANGE:
        return Shown(own, (1.0, 1.0, 1.0))
    red, green, blue = (float(round(it, 4)) for it in factor ** (1.0 / strength))
    return Shown(own, (red, green, blue))


@functools.cache
def spots() -> dict[str, Spots]:
    """Spots of the kinds of region that need no mask."""
    return {row["kind"]: Spots(*(float(row[name]) for name in _NUMBERS)) for row in _rows()}


@functools.cache
def is_estimate(kind: str) -> bool:
    """Whether one of a kind's numbers is."""
    marks = {row["kind"]: row["mark"] for row in _rows()}
    return region(kind, USUAL_MELANIN).is_estimate or marks.get(kind) == "E"


_NUMBERS = ("least_mm", "largest_mm", "edge_mm", "apart_mm", "held")


def _rows() -> list[dict[str, str]]:
    return list(texts_of(__package__ or "", "spots.csv"))
