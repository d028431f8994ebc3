"""What a skin looks like over its coordinates, as images that a shader samples.

Coordinates are logarithms of ratios to the skin without sun: u of the whole melanin, v of the
thickness, b of the blood. How melanin is spread over the layers follows from u and v, as in the
skin's own kinetics (`hylios.tanning.spread`). A look knows no time, so all places and objects of
one skin share it.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError
from hylios.table import SkinTable
from hylios.table.provenance import MinimalDoses

from .layer import gloss_row, let_through
from .look_grid import COLOUR, Grid, grid_of, over_states

WIDTH, NEAR, FAR = "profile_width", "near_share", "far_width"

NORMAL_ANGLE = 8.0
"""Angle of view of the table's colour, in degrees."""

OBLIQUE = {45: 3.0, 60: 1.0, 70: 1.0}
"""Other angles of a table's colours, and how much they weigh."""

USUAL_ROUGHNESS = 0.45
MOST_BASE = 0.98
"""Largest base colour of a shader: with more than 1 it would make light."""


@dataclass(frozen=True, eq=False)
class Look:
    """Appearance of a skin over its coordinates.

    Images are (rows, columns, 3) float32 arrays. Columns are even in the square root of the
    melanin, rows in b from the bottom. That of the colour has twice as many: the lower half is that
    of the thinnest skin, the upper half that of the thickest, upside down. The other images change
    little with the thickness: they are of skin half as thick as it gets with so much melanin.

    Attributes
    ----------
    colour : image
        Linear Rec.709 albedo of the light that has been inside the skin, seen at 8 degrees.
    bend, bow : images
        How the shader's base colour over `colour` changes with the angle of view: by
        bend x + bow x^2, x being how much less the angle's cosine is than that of 8 degrees.
    near : image
        Share of that light that leaves where it entered.
    far : image
        Width in mm of Burley's profile of the rest.
    melanin, blood, thickness : pairs of float
        Square root of the relative melanin at the first and last column; b at the first and the
        last row; v of thin and thick skin.
    bulge : float
        How the share of thick skin follows v, as `Grid.bulge` has it.
    most_tan : float
        Largest u of tans of the skin's kinetics.
    level : float
        The shader's base colour over `colour`, seen at 8 degrees.
    near_weight : float
        Weight, at most 1, of the shader that shows the near light: a skin's usual near share.
    roughness : float
        Of the surface, as a shader has it.
    has_profile : bool
        Whether light scatters below the surface.
    """

    colour: NDArray[np.float32]
    bend: NDArray[np.float32]
    bow: NDArray[np.float32]
    near: NDArray[np.float32]
    far: NDArray[np.float32]
    melanin: tuple[float, float]
    blood: tuple[float, float]
    thickness: tuple[float, float]
    bulge: float
    most_tan: float
    level: float
    near_weight: float
    roughness: float
    has_profile: bool

    @property
    def colours(self) -> NDArray[np.float32]:
        """`colour` as a shader samples it: the upper half tells by how much thick skin differs."""
        thin, thick = np.split(self.colour, 2)
        return np.concatenate([thin, thick - thin[::-1]])

    @property
    def light(self) -> NDArray[np.float32]:
        """What of light has no colour, in one image (rows, columns, 4): `bend`, `bow`, `near` and
        `far` above each other, and the row `layer.gloss_row`. Only that has a fourth number."""
        blocks = np.concatenate([self.bend, self.bow, self.near, self.far], axis=0)
        blocks = np.pad(blocks, ((0, 0), (0, 0), (0, 1)), constant_values=1.0)
        row = gloss_row(self.roughness, self.bend.shape[1])
        return np.concatenate([blocks, row[None]], axis=0).astype(np.float32)


def look(table: SkinTable, minimal: MinimalDoses, kinetics: str = "thesis") -> Look:
    """Images of a table along the states of its kinetics.

    Parameters
    ----------
    minimal : MinimalDoses
        Of the skin.
    kinetics : str
        One of `hylios.tanning.KINETICS`.

    Raises
    ------
    InputError
        If the table has no colour for a shader, or does not say how its skin makes melanin.
    """
    if COLOUR not in table.planes:
        raise InputError(
            f"the table has no plane {COLOUR}, which the skin's material needs; it has "
            f"{', '.join(table.planes)}."
        )
    grid = grid_of(table, minimal, kinetics)
    planes = grid.planes(table, _wanted(table))
    grid = grid.bulging(planes[COLOUR])
    colour = grid.thin_and_thick(planes[COLOUR])
    roughness = roughness_of(table)
    bend, bow = _by_angle(grid, planes, grid.shown(colour), roughness)
    near, far = (grid.usually(own) for own in _near_and_far(planes))
    level = 1.0 / float(let_through(roughness, NORMAL_ANGLE))
    return Look(
        colour=over_states(colour),
        bend=_image(bend),
        bow=_image(bow),
        near=_image(near),
        far=_image(far),
        melanin=grid.melanin,
        blood=grid.blood,
        thickness=grid.thickness,
        bulge=grid.bulge,
        most_tan=float(grid.spread.most.max()),
        level=level,
        near_weight=_near_weight(level * colour, near[:, None]),
        roughness=roughness,
        has_profile=FAR in planes or WIDTH in planes,
    )


def untanned_colour(look: Look) -> NDArray[np.float64]:
    """Linear Rec.709 colour (3,) of a look's skin without sun."""
    rows, columns, _ = look.colour.shape
    low, high = look.blood
    row = -low / (high - low) * (rows // 2 - 1) if high > low else 0.0
    roots = np.linspace(*look.melanin, columns)
    below, part = int(row), row - int(row)
    above = min(below + 1, rows // 2 - 1)
    line = look.colour[below] * (1.0 - part) + look.colour[above] * part
    return np.array([np.interp(1.0, roots, line[:, channel]) for channel in range(3)])


def _wanted(table: SkinTable) -> list[str]:
    widths = (NEAR, FAR) if FAR in table.planes else (WIDTH,)
    names = (COLOUR, *map(_at, OBLIQUE), *widths)
    return [name for name in names if name in table.planes]


def _at(angle: int) -> str:
    return f"{COLOUR}_{angle}"


def roughness_of(table: SkinTable) -> float:
    """A shader's roughness for the slopes of a skin's surface, of which the table tells."""
    parameters = table.provenance.get("specimen_parameters", {})
    ratio = parameters.get("surface_fold_aspect_ratio")
    return USUAL_ROUGHNESS if ratio is None else min(float(np.sqrt(ratio)), 1.0)


def _by_angle(
    grid: Grid, planes: Mapping[str, NDArray], shown: NDArray, roughness: float
) -> tuple[NDArray, NDArray]:
    """`bend` and `bow` (M, B, 3), fitted to the colours at other angles over what is shown at 8.

    0 where the table has none.
    """
    angles = [angle for angle in OBLIQUE if _at(angle) in planes]
    if len(angles) < 2:
        return np.zeros_like(shown[:, 0]), np.zeros_like(shown[:, 0])
    bases = np.stack([planes[_at(angle)] for angle in angles]) / np.maximum(shown, 1e-4)
    bases = grid.usually(bases) / let_through(roughness, angles)[:, None, None, None]
    bases -= 1.0 / let_through(roughness, NORMAL_ANGLE)
    x = np.cos(np.radians(NORMAL_ANGLE)) - np.cos(np.radians(angles))
    weights = np.sqrt([OBLIQUE[angle] for angle in angles])
    solve = np.linalg.pinv(weights[:, None] * np.stack([x, x * x], axis=1)) * weights
    bend, bow = np.einsum("ka,a...->k...", solve, bases)
    return bend, bow


def _near_and_far(planes) -> tuple[NDArray, NDArray]:
    if FAR in planes:
        return planes[NEAR], planes[FAR]
    nothing = np.zeros_like(planes[COLOUR])
    return nothing, planes.get(WIDTH, nothing)


def _near_weight(base: NDArray, near: NDArray) -> float:
    """The weight with which neither of the two shaders needs a base colour above 1.

    Where the channels differ too much for that, the far one's may be.
    """
    low = (base * near).max() / MOST_BASE
    high = 1.0 - (base * (1.0 - near)).max() / MOST_BASE
    if low == 0.0:
        return 0.0
    return float(np.clip(near.mean(), low, max(low, high)))


def _image(values: NDArray) -> NDArray[np.float32]:
    """An image of numbers over melanin and blood (M, B, 3)."""
    return values.swapaxes(0, 1).astype(np.float32)
