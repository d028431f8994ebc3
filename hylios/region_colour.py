"""What of a region's colour a skin's table cannot tell, by the light model. numpy only.

A table knows melanin and blood. It puts more melanin where the skin's tan does, ends somewhere, and
has no axis for the tissue below or the corneum.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hylios.adding import spectra
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.skin.regions import Region
from hylios.skin.specimen import Specimen
from hylios.table.axes import LOOK_AXES, LookAxes
from hylios.tanning.spread import Spread, spread_of

WAVELENGTHS = 8
ANGLE = 8.0

LEAST_MELANIN = 1e-9
"""Relative melanin of which the logarithm is taken where there is none."""

HELD = 0.01
"""How near the logarithm of melanin in a table is to that of a region which the table holds."""

TANS = (0.0, 0.4, 0.8)
"""Parts of the deepest tan's u at which colours are compared; the skin is half as thick as it gets
with so much melanin."""


def colour_factor(
    skin: Skin, axes: LookAxes, region: Region, weight: float = 1.0
) -> NDArray[np.float64]:
    """Colour (3,) of a region over what a skin's table has at the region's melanin and blood.

    Both are by the light model, and it is the geometric mean over some tans of the skin (`TANS`),
    over those with whose melanin the table does not end.
    Linear Rec.709 under D65, of light that has been inside the skin.

    Over the six types and their tans a table's colours times this are off the region solved by
    itself by CIEDE2000 .41 or less in the mean of every region, by either kinetics. Freckles of
    type VI are worst, by 1.9: where more melanin lies is a guess, here in proportion to the skin's,
    in the table as in a tan.

    Parameters
    ----------
    skin : Skin
        Its kinetics says where tables are looked up for more melanin.
    axes : LookAxes
        Of the skin's table.
    weight : float
        Of the region, as `Region.of` takes it.

    Raises
    ------
    InputError
        If the skin cannot be solved (`hylios.adding.solve`).
    """
    solved, held = compared(skin, axes, region, weight)
    colours = subsurface_colours([*solved, *map(skin.at, held)])
    own, in_table = colours[: len(held)], colours[len(held) :]
    wanted = np.log(np.maximum(region.of_state(_tans(skin)[0], 0.0, weight)[0], LEAST_MELANIN))
    is_held = np.abs(wanted - np.log(held[:, :3].sum(axis=1))) < HELD
    logarithms = np.log(own / in_table)
    return np.exp(np.mean(logarithms[is_held] if is_held.any() else logarithms, axis=0))


def compared(
    skin: Skin, axes: LookAxes, region: Region, weight: float = 1.0
) -> tuple[list[Specimen], NDArray[np.float64]]:
    """A region in some tans, as specimens, and the states (N, 5) where a table shows it.

    Parameters and errors as in `colour_factor`.
    """
    knots = dict(zip(LOOK_AXES, axes.knots, strict=True))
    u, v, sheet = _tans(skin)
    own = sheet.states(region.own_tan(u, weight), v)
    melanin, blood = region.of_state(u, 0.0, weight)
    there = _within(np.log(np.maximum(melanin, LEAST_MELANIN)), knots["melanin"])
    reached = np.interp(there, sheet.least, sheet.thicknesses)
    states = sheet.states(there, np.minimum(v, reached), _within(blood, knots["blood"]))
    states[:, 3] = np.exp(v)
    return [region.of(skin.at(state), weight) for state in own], states


def _tans(skin: Skin) -> tuple[NDArray[np.float64], NDArray[np.float64], Spread]:
    """u and v of the tans that are compared, and the sheet of the skin's kinetics."""
    sheet = spread_of(skin.melanin_kinetics, mmd=skin.mmd, med=skin.med)
    u = np.array(TANS) * float(sheet.most.max())
    return u, 0.5 * np.interp(u, sheet.least, sheet.thicknesses), sheet


def _within(values: NDArray[np.float64], knots: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.clip(values, knots[0], knots[-1])


def subsurface_colours(specimens: Sequence[Specimen]) -> NDArray[np.float64]:
    """Linear Rec.709 (N, 3) of light that has been inside skin, seen at 8 degrees."""
    few = skin_quadrature(WAVELENGTHS)
    return spectra(specimens, few.wavelengths, angle=ANGLE).subsurface @ few.weights.T
