"""What light under the skin does to a tan line, and what leaving that out costs."""

from dataclasses import dataclass

import numpy as np

from examples.simplifications.skins import DAYS, tan
from hylios.lab import colour
from hylios.quadrature import Quadrature
from hylios.skin.specimen import Specimen
from hylios.transport.simulate import DISTANCE_EDGES, Progress, Spectrum, spectrum

FURTHEST = 15.0
STEP = 0.05
"""Distance in mm between the places where light is computed."""

JUST_VISIBLE = 1.0
"""CIEDE2000."""

DARKEST_DAY = 10


@dataclass(frozen=True)
class Edge:
    """A straight line between a skin untanned and tanned.

    Attributes
    ----------
    places : (N,) ascending array
        mm from the line, the tanned skin at positive ones.
    sharp, true : (N, 3) arrays
        Colour there, linear Rec.709, without and with light that crosses the line inside.
    """

    places: np.ndarray
    sharp: np.ndarray
    true: np.ndarray

    @property
    def cost(self) -> np.ndarray:
        """CIEDE2000 (N,) of leaving out the light that crosses."""
        return colour.difference(self.sharp, self.true)

    def mean_within(self, distance: float) -> float:
        """Mean cost up to a distance in mm on either side."""
        return float(self.cost[np.abs(self.places) <= distance].mean())

    @property
    def visible_to(self) -> float:
        """Distance in mm beyond which the cost is below `JUST_VISIBLE` on either side."""
        seen = np.abs(self.places)[self.cost >= JUST_VISIBLE]
        return float(seen.max()) if seen.size else 0.0


def tan_line(
    specimen: Specimen,
    wavelengths: Quadrature,
    rays: int,
    progress: Progress | None = None,
) -> Edge:
    """The line between untanned skin and the same on the darkest day of a tan, by random walk.

    Light that comes in at one place leaves at another as the skin where it came in has it: the
    profile is that of the skin on its own side, all around. (Truly it leaves through the other
    skin, and half of a tan is in the way out: the line is sharper than this.)
    """
    days = tan(specimen)
    sides = [
        spectrum(
            days[DAYS.index(day)],
            wavelengths.wavelengths,
            angle=0.0,
            rays=rays,
            progress=progress,
        )
        for day in (0, DARKEST_DAY)
    ]
    return edge(sides[0], sides[1], wavelengths.weights)


def edge(untanned: Spectrum, tanned: Spectrum, weights: np.ndarray) -> Edge:
    """The line between two skins, from spectra that count exit distances."""
    steps = round(FURTHEST / STEP)
    places = STEP * (np.arange(-steps, steps) + 0.5)
    beyond = [crossing(spectrum, np.abs(places)) for spectrum in (untanned, tanned)]
    on_tanned = (places > 0.0)[:, None]
    own = np.where(on_tanned, tanned.total, untanned.total)
    lost = np.where(on_tanned, beyond[1], beyond[0])
    gained = np.where(on_tanned, beyond[0], beyond[1])
    return Edge(places, own @ weights.T, (own - lost + gained) @ weights.T)


def crossing(light: Spectrum, distances: np.ndarray) -> np.ndarray:
    """Reflectance (N, W) at places that is due to light from beyond a line at distances (N,) in mm.

    Of a ring of radius r around the place, the part beyond the line is arccos(distance / r) / pi.
    """
    ends = DISTANCE_EDGES[1:]
    radii = np.concatenate([[0.5 * ends[0]], np.sqrt(ends[:-1] * ends[1:]), [ends[-1]]])
    part = np.arccos(np.minimum(distances[:, None] / radii, 1.0)) / np.pi
    return part @ (light.exit_counts.T / light.rays)
