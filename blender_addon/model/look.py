"""What a skin looks like over its coordinates, as images that a shader samples.

Coordinates are logarithms of ratios to the skin without sun: u of the whole melanin, v of the
thickness, b of the blood. How melanin is spread over the layers follows from u and v, as in the
skin's own kinetics (`hylios.tanning.spread`). A look knows no time, so all places and objects of
one skin share it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError
from hylios.table import LOOK_AXES, LookAxes, SkinTable
from hylios.table.provenance import MinimalDoses
from hylios.tanning.spread import Spread, spread_of

from .layer import let_through, through_gloss
from .response import melanin_of

COLUMNS, BLOOD_ROWS = 80, 10
"""Columns of melanin, and rows of blood for one thickness."""

MORE_MELANIN = 0.05
"""How much higher u is in a table without an axis of melanin than tans of its kinetics reach."""

MOST_THICKNESS = 0.25
"""Largest v in a table without an axis of thickness."""

COLOUR, WIDTH, NEAR, FAR = "subsurface_colour", "profile_width", "near_share", "far_width"

LEAST_SPAN = 0.1
"""Least v to take for the thickness that skin reaches with so much melanin."""

SEEN, USUAL = (0.0, 0.4, 0.8), 0.15
"""Thicknesses that are looked up, of 1 that skin reaches with so much melanin, and the one of what
is told of one thickness alone."""

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
    most_tan : float
        Largest u of tans of the skin's kinetics.
    level : float
        The shader's base colour over `colour`, seen at 8 degrees.
    near_weight : float
        Weight, at most 1, of the shader that shows the near light: a skin's usual near share.
    through : 4 floats
        What the surface lets through by angle of view, as `layer.through_gloss` has it.
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
    most_tan: float
    level: float
    near_weight: float
    through: tuple[float, float, float, float]
    roughness: float
    has_profile: bool


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
    thin, thick = grid.thickness
    usual = np.clip((USUAL * grid.reached - thin) / (thick - thin), 0.0, 1.0)
    colour = planes[COLOUR]
    roughness = roughness_of(table)
    bend, bow = _by_angle(planes, roughness)
    near, far = _near_and_far(planes)
    level = 1.0 / float(let_through(roughness, NORMAL_ANGLE))
    return Look(
        colour=over_states(colour),
        bend=_image_between(bend, usual),
        bow=_image_between(bow, usual),
        near=_image_between(near, usual),
        far=_image_between(far, usual),
        melanin=grid.melanin,
        blood=grid.blood,
        thickness=grid.thickness,
        most_tan=float(grid.spread.most.max()),
        level=level,
        near_weight=_near_weight(level * colour, near),
        through=through_gloss(roughness),
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


@dataclass(frozen=True, eq=False)
class Grid:
    """Where the images of a look lie in a table.

    Attributes
    ----------
    spread : Spread
        Of the skin's kinetics.
    roots : (columns,) array
        Square roots of the relative melanin.
    reached : (columns,) array
        v that skin reaches with so much melanin.
    thickness, blood : pairs of float
        v of thin and thick skin; b at the first and the last row.
    """

    spread: Spread
    roots: NDArray[np.float64]
    reached: NDArray[np.float64]
    thickness: tuple[float, float]
    blood: tuple[float, float]

    @property
    def melanin(self) -> tuple[float, float]:
        """Square root of the relative melanin at the first and last column."""
        return float(self.roots[0]), float(self.roots[-1])

    def planes(self, table: SkinTable, names: list[str]) -> dict[str, NDArray[np.float64]]:
        """Planes (M, 2, B, components) over melanin, the thinnest and the thickest skin, and blood.

        What lies straight between the two misses skin of three thicknesses (`SEEN`) by equally
        much. Skin with little melanin gets only so thick: in thicker skin melanin is spread as in
        that.
        """
        thin, thick = self.thickness
        u = 2.0 * np.log(self.roots)
        b = np.linspace(*self.blood, BLOOD_ROWS if self.blood[1] > self.blood[0] else 1)
        as_thick = np.clip(self.reached, min(thin + LEAST_SPAN, thick), thick)
        v = thin + np.multiply.outer(as_thick - thin, SEEN)
        states = self.spread.states(u[:, None], np.minimum(v, self.reached[:, None]))
        states[..., 3] = np.exp(v)
        planes = table.lookup(states, names, np.exp(b))
        further = (thick - thin) / (v[:, 2] - thin)
        tanned = np.clip(2.0 * (self.reached - thin) / LEAST_SPAN - 1.0, 0.0, 1.0)
        return {name: _straight(values, further, tanned) for name, values in planes.items()}


def _straight(values: NDArray, further: NDArray, tanned: NDArray) -> NDArray[np.float64]:
    """Numbers (M, 2, B, C) of thin and thick skin, from those (M, 3, B, C) of three thicknesses.

    `further` (M,) is how many times as far from the first as the third the thickest skin is. Where
    `tanned` (M,) is 0, as without sun, the first is met.
    """
    further, tanned = further[:, None, None], tanned[:, None, None]
    first, second, third = np.moveaxis(values, 1, 0)
    half = 0.25 * tanned * (2.0 * second - first - third)
    first, third = first + half, third + half
    return np.maximum(np.stack([first, first + further * (third - first)], axis=1), 0.0)


def grid_of(table: SkinTable, minimal: MinimalDoses, kinetics: str = "thesis") -> Grid:
    """The grid of a table along the states of a kinetics.

    Raises
    ------
    InputError
        If the table does not say how its skin makes melanin.
    """
    spread = spread_of(melanin_of(table, kinetics), mmd=minimal.mmd, med=minimal.med)
    melanin, thickness, blood = _ranges(table, spread)
    roots = _roots(*np.exp(np.divide(melanin, 2.0)))
    reached = np.interp(2.0 * np.log(roots), spread.least, spread.thicknesses)
    return Grid(spread, roots, reached, thickness, blood)


def _roots(low: float, high: float) -> NDArray[np.float64]:
    """Even square roots of melanin, 1 among them, so that untanned skin is exact."""
    step = (high - low) / (COLUMNS - 1)
    if low < 1.0 < high:
        step = (1.0 - low) / np.ceil((1.0 - low) / step)
    roots = low + step * np.arange(int(np.ceil((high - low) / step - 1e-9)) + 1)
    return np.asarray(roots, dtype=float)


def _wanted(table: SkinTable) -> list[str]:
    widths = (NEAR, FAR) if FAR in table.planes else (WIDTH,)
    names = (COLOUR, *map(_at, OBLIQUE), *widths)
    return [name for name in names if name in table.planes]


def _at(angle: int) -> str:
    return f"{COLOUR}_{angle}"


def _ranges(table: SkinTable, spread: Spread) -> tuple[tuple[float, float], ...]:
    """Lowest and highest u, v and b to show of a table."""
    if not isinstance(table.axes, LookAxes):
        most = float(spread.most.max()) + MORE_MELANIN
        return (0.0, most), (0.0, MOST_THICKNESS), (0.0, 0.0)
    knots = dict(zip(LOOK_AXES, table.axes.knots, strict=True))
    melanin, thickness, blood = (
        (float(knots[name][0]), float(knots[name][-1]))
        for name in ("melanin", "thickness", "blood")
    )
    if melanin[0] == melanin[1]:
        melanin = (melanin[0] - 0.5, melanin[1] + 0.5)
    if thickness[0] == thickness[1]:
        thickness = (thickness[0], thickness[1] + MOST_THICKNESS)
    return melanin, thickness, blood


def roughness_of(table: SkinTable) -> float:
    """A shader's roughness for the slopes of a skin's surface, of which the table tells."""
    parameters = table.provenance.get("specimen_parameters", {})
    ratio = parameters.get("surface_fold_aspect_ratio")
    return USUAL_ROUGHNESS if ratio is None else min(float(np.sqrt(ratio)), 1.0)


def _by_angle(planes, roughness: float) -> tuple[NDArray, NDArray]:
    """`bend` and `bow`, fitted to the colours at other angles; 0 where the table has none."""
    colour = planes[COLOUR]
    angles = [angle for angle in OBLIQUE if _at(angle) in planes]
    if len(angles) < 2:
        return np.zeros_like(colour), np.zeros_like(colour)
    lit = np.maximum(colour, 1e-4)
    bases = np.stack([planes[_at(angle)] for angle in angles]) / lit
    bases /= let_through(roughness, angles)[:, None, None, None, None]
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


def over_states(values: NDArray) -> NDArray[np.float32]:
    """Two halves of numbers over melanin, two thicknesses and blood (M, 2, B, 3)."""
    thin, thick = values[:, 0], values[:, 1, ::-1]
    return np.concatenate([thin, thick], axis=1).swapaxes(0, 1).astype(np.float32)


def _image_between(values: NDArray, part: NDArray) -> NDArray[np.float32]:
    """One image of such numbers, at parts (M,) of the way from thin to thick skin."""
    between = values[:, 0] + part[:, None, None] * (values[:, 1] - values[:, 0])
    return between.swapaxes(0, 1).astype(np.float32)
