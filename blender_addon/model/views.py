"""Skin as a camera for the ultraviolet or the infrared shows it, as an image over its states."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError
from hylios.pseudo_colour import TINTS
from hylios.table import MinimalDoses, SkinTable
from hylios.tissue.liquids import LIQUIDS

from .layer import let_through
from .look import NORMAL_ANGLE, roughness_of
from .look_grid import COLOUR, grid_of, over_states

PLANE = "band_reflectance"


@dataclass(frozen=True)
class View:
    """A view of skin in one band outside the visible.

    Attributes
    ----------
    nm : float
        Wavelength of the band.
    tint : tuple of float
        Linear Rec.709 of skin that reflects all light.
    nearest : int
        Channel of the visible that lies nearest. Tables tell for it alone how far light travels.
    """

    nm: float
    tint: tuple[float, float, float]
    nearest: int


VISIBLE = "VISIBLE"
VIEWS = {
    "NM365": View(365.0, TINTS["uv"], 2),
    "NM1100": View(1100.0, TINTS["ir"], 0),
    "NM1650": View(1650.0, TINTS["ir"], 0),
}
"""Views by identifier, other than the visible."""


@dataclass(frozen=True, eq=False)
class BandLook:
    """A skin in a view.

    Attributes
    ----------
    colour : (rows, columns, 3) array
        Tinted reflectance of the light that has been inside the skin, seen at 8 degrees, over
        coordinates as `Look.colour`: the total less what the shader reflects at the surface.
    melanin, blood, thickness : pairs of float
        As those of `Look`.
    """

    colour: NDArray[np.float32]
    melanin: tuple[float, float]
    blood: tuple[float, float]
    thickness: tuple[float, float]


def band_look(
    table: SkinTable, minimal: MinimalDoses, view: View, kinetics: str = "thesis"
) -> BandLook:
    """A table's skin in a view, along the states of a kinetics.

    Raises
    ------
    InputError
        If the table lacks the band, or does not say how its skin makes melanin.
    """
    grid = grid_of(table, minimal, kinetics)
    planes = grid.planes(table, [name for name in (PLANE, COLOUR) if name in table.planes])
    if COLOUR in planes:  # mixed as the skin's usual look is
        grid = grid.bulging(planes[COLOUR])
    bands = grid.thin_and_thick(planes[PLANE]) if PLANE in planes else np.empty(0)
    return BandLook(
        colour=over_states(inside_in_view(table, bands, view)),
        melanin=grid.melanin,
        blood=grid.blood,
        thickness=grid.thickness,
    )


def inside_in_view(
    table: SkinTable, reflectance: NDArray[np.float64], view: View
) -> NDArray[np.float64]:
    """Tinted light (..., 3) out of a table's skin in a view: less what the surface reflects.

    Parameters
    ----------
    reflectance : (..., bands) array
        In all bands of the table, the surface's part too.

    Raises
    ------
    InputError
        If the table lacks the band.
    """
    bands = [float(nm) for nm in table.provenance.get("bands_nm", []) if PLANE in table.planes]
    if view.nm not in bands:
        listed = ", ".join(f"{nm:g}" for nm in bands) or "none"
        raise InputError(f"the table has no band at {view.nm:g} nm; its bands: {listed}")
    surface = 1.0 - float(let_through(roughness_of(table), NORMAL_ANGLE))
    inside = np.maximum(reflectance[..., bands.index(view.nm)] - surface, 0.0)
    return np.asarray(inside[..., None] * np.array(view.tint), float)


def left_by_film(liquid: str, view: View) -> float:
    """Share of light that is left after the way through a film on the skin, to it and back.

    Parameters
    ----------
    liquid : str
        A name of `hylios.tissue.liquids.LIQUIDS`, or empty for none.
    """
    return float(LIQUIDS[liquid].twice_through([view.nm])[0]) if liquid else 1.0
