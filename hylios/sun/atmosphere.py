"""How much of the ultraviolet comes down through clear air: scattering of all orders, by layers.

The air is cut into plane layers, in which molecules and aerosol scatter and ozone absorbs. They are
added up as skin's layers are (`hylios.adding.scattering`, the discrete ordinates of Stamnes et al.
1988). Polarisation is left out.

Where the ozone lies: Krueger and Minzner, J. Geophys. Res. 81, 4477 (1976), the profile of the US
standard atmosphere. Where the air lies: that atmosphere's barometric formula. Aerosol thins out
with a scale height of 2 km, an ESTIMATE, and has an asymmetry of .65, as Bird and Riordan have it.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial.legendre import legval, legvander

from hylios.adding.directions import Directions, integrals
from hylios.adding.scattering import (
    ORDER,
    Medium,
    henyey_greenstein_moments,
    medium,
    rayleigh_moments,
    response,
    stacked,
)
from hylios.threads import one_thread

NODES = 10
"""Directions up and down: erythemal light is within 2e-4 of what many more give, the sun up to 80
degrees from the zenith."""

EDGES = 50.0, 30.0, 20.0, 10.0, 2.0
"""Heights in km between layers, from above."""

OZONE_KM = np.arange(0.0, 51.0, 2.0)
OZONE = np.array(
    [10.2, 6.8, 5.8, 5.7, 6.5, 11.3, 20.2, 23.5, 29.5, 40.4, 47.7, 48.6, 45.4]
    + [40.3, 32.4, 25.2, 20.3, 15.8, 12.2, 8.73, 6.07, 3.98, 2.74, 1.69, 1.03, 0.664]
)
"""Molecules of ozone by height, 1e11/cm^3."""

AEROSOL_KM = 2.0
ASYMMETRY = 0.65


def air_above(kilometres: float) -> float:
    """Share of the air over the sea's level that lies over a height of -.5 to 50 km."""
    if kilometres >= EDGES[0]:
        return 0.0
    if kilometres <= 11.0:
        return (1.0 - 0.0225577 * kilometres) ** 5.25588
    return 0.22336 * float(np.exp(-(kilometres - 11.0) / 6.3))


def ozone_above(kilometres: float) -> float:
    """Share of the ozone over the sea's level that lies over a height; 1 below the sea's."""
    heights = np.unique(np.append(OZONE_KM, np.clip(kilometres, 0.0, EDGES[0])))
    between = np.interp(heights, OZONE_KM, OZONE)
    columns = 0.5 * (between[1:] + between[:-1]) * np.diff(heights)
    return float(columns[heights[:-1] >= kilometres].sum() / columns.sum())


def aerosol_above(kilometres: float) -> float:
    """Share of the aerosol over the sea's level that lies over a height."""
    return float(np.exp(-kilometres / AEROSOL_KM))


@dataclass(frozen=True)
class Depths:
    """Vertical optical depths (W,) over the level of the sea, and the aerosol's scattering."""

    molecules: np.ndarray
    ozone: np.ndarray
    aerosol: np.ndarray
    scattered: np.ndarray

    def above(self, kilometres: float) -> "Depths":
        """Those over a height."""
        aerosol = aerosol_above(kilometres)
        return Depths(
            air_above(kilometres) * self.molecules,
            ozone_above(kilometres) * self.ozone,
            aerosol * self.aerosol,
            aerosol * self.scattered,
        )


@dataclass(frozen=True)
class Passage:
    """Light through the air over black ground.

    Attributes
    ----------
    series : (M, W) array
        Logarithm of the share of light from above that comes down, times the cosine, by Legendre
        polynomials of twice the cosine less 1: a constant where nothing scatters.
    returned : (W,) array
        Share of diffuse light from below that comes back down.
    """

    series: np.ndarray
    returned: np.ndarray

    def at(self, cosine: np.ndarray) -> np.ndarray:
        """Share that comes down of light at cosines (..., W) from the zenith."""
        return np.exp(legval(2.0 * cosine - 1.0, self.series, tensor=False) / cosine)


def passage(depths: Depths, kilometres: float) -> Passage:
    """Light through the air over a height of -.5 to 9 km."""
    count = depths.molecules.size
    through = stacked([_medium()], np.zeros(count, dtype=int))
    cosine, weight = _directions()
    unit = np.eye(NODES)
    down, back = unit[None], np.zeros((1, NODES, NODES))
    edges = [*(edge for edge in EDGES if edge > kilometres), kilometres]
    with one_thread():
        for upper, lower in zip(edges[:-1], edges[1:], strict=True):
            layer, over = depths.above(lower), depths.above(upper)
            molecules, scattered = (
                layer.molecules - over.molecules,
                layer.scattered - over.scattered,
            )
            extinction = molecules + layer.ozone - over.ozone + layer.aerosol - over.aerosol
            kept = [molecules, scattered]
            reflected, passed = response(through, np.ones(count), extinction, kept)
            inside = np.linalg.solve(unit - reflected @ back, passed)
            down, back = down @ inside, reflected + passed @ back @ inside
    own = depths.above(kilometres)
    straight = np.exp(-(own.molecules + own.ozone + own.aerosol)[:, None] / cosine)
    # no less than comes straight down, where rounding is more than all that scatters
    transmitted = np.maximum(down.sum(axis=2), np.maximum(straight, 1e-300))
    values = (cosine * np.log(transmitted)).T
    series = np.linalg.solve(legvander(2.0 * cosine - 1.0, NODES - 1), values)
    return Passage(series, back.sum(axis=2) @ (2.0 * cosine * weight))


@cache
def _directions() -> tuple[np.ndarray, np.ndarray]:
    """Cosines and weights (M,) of the directions."""
    return Directions(np.array([0.0, 1.0]), (NODES,)).cosines(1)


@cache
def _medium() -> Medium:
    made = Directions(np.array([0.0, 1.0]), (NODES,))
    scatterers = [rayleigh_moments(), henyey_greenstein_moments(ASYMMETRY)]
    return medium(integrals(made, 1, ORDER), scatterers)
