"""How regions of skin differ from the skin around them: melanin, blood, and how they tan.

A region of weight w (its strength times its mask) has the melanin exp(u (1 + (t - 1) min(w, 1)))
f^w, where u is the tan around it as a logarithm, f the region's `melanin` and t its `tan`; without
melanin (f = 0) it is exp(u) (1 - w). Blood is changed by its factor to the power w. Regions that
lie over each other multiply. In spots w is the strength, more in some and less in others; by the
mask there are fewer of them.
"""

import functools
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

MOST_STRENGTH = 2.0


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
class Kind:
    """A kind of region.

    Attributes
    ----------
    melanin, blood : float
        Over those around it, without sun, at strength 1.
    tan : float
        Logarithm of the melanin that sun adds, over that around it.
    marks : str
        Of the three numbers and of the spots, one letter for each: A of a publication, F fitted to
        spectra, E an estimate, - no change.
    spots : Spots or None
        Of kinds that need no mask.
    """

    melanin: float
    blood: float
    tan: float
    marks: str
    spots: Spots | None = None

    @property
    def is_estimate(self) -> bool:
        """Whether one of its numbers is."""
        return "E" in self.marks

    def of_state(
        self, u: ArrayLike, b: ArrayLike, weight: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Melanin over that of untanned skin, and logarithm of blood, of a region of a weight."""
        u, b, weight = (np.asarray(values, float) for values in (u, b, weight))
        blood = b + weight * np.log(self.blood)
        if self.melanin == 0.0:
            return np.asarray(np.exp(u) * np.maximum(1.0 - weight, 0.0), float), blood
        exponent = 1.0 + (self.tan - 1.0) * np.minimum(weight, 1.0)
        return np.exp(u * exponent) * self.melanin**weight, blood


@functools.cache
def kinds() -> dict[str, Kind]:
    """Kinds of region by name, from `regions.csv`."""
    text = Path(__file__).with_name("regions.csv").read_text(encoding="utf-8")
    titles, *lines = [
        line.split(",") for line in text.splitlines() if not line.startswith("#") and line
    ]
    rows = [dict(zip(titles, line, strict=True)) for line in lines]
    return {row["kind"]: _kind(row) for row in rows}


def _kind(row: dict[str, str]) -> Kind:
    marks = "".join(row[f"{name}_mark"] for name in ("melanin", "blood", "tan", "spots"))
    spots = None
    if row["least_mm"]:
        names = ("least_mm", "largest_mm", "edge_mm", "apart_mm", "held")
        spots = Spots(*(float(row[name]) for name in names))
    return Kind(float(row["melanin"]), float(row["blood"]), float(row["tan"]), marks, spots)
