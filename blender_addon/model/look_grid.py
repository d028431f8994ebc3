"""Where the images of a look lie in a skin's table: over melanin, two thicknesses, and blood.

A shader looks colour up in thin and in thick skin, and mixes the two. In dark skin colour changes
most while skin is only a little thicker, so that the share of thick skin may rise faster at first.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hylios.table import LOOK_AXES, LookAxes, SkinTable
from hylios.table.provenance import MinimalDoses
from hylios.tanning.spread import Spread, spread_of, usual_thickness

from .response import melanin_of

COLUMNS, BLOOD_ROWS = 80, 10
"""Columns of melanin, and rows of blood for one thickness."""

MORE_MELANIN = 0.05
"""How much higher u is in a table without an axis of melanin than tans of its kinetics reach."""

MOST_THICKNESS = 0.25
"""Largest v in a table without an axis of thickness."""

LEAST_SPAN = 0.1
"""Least v to take for the thickness that skin reaches with so much melanin."""

SEEN = (0.0, 0.4, 0.9)
"""Thicknesses that are looked up, of 1 that skin reaches with so much melanin."""

MOST_BULGE = 0.8
"""Largest `Grid.bulge`: with more than 1 the share of thick skin would fall again."""

COLOUR = "subsurface_colour"


@dataclass(frozen=True, eq=False)
class Grid:
    """Where the images of a look lie in a table.

    Attributes
    ----------
    spread : Spread
        Of the skin's kinetics.
    roots : (columns,) array
        Square roots of the relative melanin.
    reached, usual : (columns,) arrays
        v that skin reaches with so much melanin, and that it usually has.
    thickness, blood : pairs of float
        v of thin and thick skin; b at the first and the last row.
    bulge : float
        How much faster the share of thick skin rises at first: x being how far v lies from thin to
        thick, the share is x + bulge x (1 - x).
    """

    spread: Spread
    roots: NDArray[np.float64]
    reached: NDArray[np.float64]
    usual: NDArray[np.float64]
    thickness: tuple[float, float]
    blood: tuple[float, float]
    bulge: float = 0.0

    @property
    def melanin(self) -> tuple[float, float]:
        """Square root of the relative melanin at the first and last column."""
        return float(self.roots[0]), float(self.roots[-1])

    @property
    def seen(self) -> NDArray[np.float64]:
        """v (M, 3) of the thicknesses that are looked up."""
        thin, thick = self.thickness
        as_thick = np.clip(self.reached, min(thin + LEAST_SPAN, thick), thick)
        return thin + np.multiply.outer(as_thick - thin, SEEN)

    def share(self, thickness: NDArray[np.float64]) -> NDArray[np.float64]:
        """Share of thick skin at v."""
        thin, thick = self.thickness
        x = (thickness - thin) / (thick - thin)
        return x + self.bulge * x * (1.0 - x)

    def planes(self, table: SkinTable, names: list[str]) -> dict[str, NDArray[np.float64]]:
        """Planes (M, 3, B, components) over melanin, the thicknesses of `seen`, and blood.

        Skin with little melanin gets only so thick: in thicker skin melanin is spread as in that.
        """
        u, v = 2.0 * np.log(self.roots), self.seen
        b = np.linspace(*self.blood, BLOOD_ROWS if self.blood[1] > self.blood[0] else 1)
        states = self.spread.states(u[:, None], np.minimum(v, self.reached[:, None]))
        states[..., 3] = np.exp(v)
        return table.lookup(states, names, np.exp(b))

    def thin_and_thick(self, values: NDArray) -> NDArray[np.float64]:
        """Numbers (M, 2, B, C) of thin and thick skin, from those (M, 3, B, C) of `planes`.

        What lies between the two misses all three by equally much; without sun it meets the first.
        """
        thin = self.thickness[0]
        tanned = np.clip(2.0 * (self.reached - thin) / LEAST_SPAN - 1.0, 0.0, 1.0)
        share = self.share(self.seen)[:, :, None, None]
        first, second, third = np.moveaxis(values, 1, 0)
        part = share[:, 1] / share[:, 2]
        off = second - first - part * (third - first)
        half = 0.5 * tanned[:, None, None] * off
        first, third = first + half, third + half
        return np.maximum(np.stack([first, first + (third - first) / share[:, 2]], axis=1), 0.0)

    def shown(self, values: NDArray) -> NDArray[np.float64]:
        """Numbers (M, 3, B, C) that a shader mixes of those of thin and thick skin."""
        share = np.clip(self.share(self.seen), 0.0, 1.0)[:, :, None, None]
        return values[:, :1] + share * (values[:, 1:] - values[:, :1])

    def usually(self, values: NDArray) -> NDArray[np.float64]:
        """Numbers (..., M, B, C) of skin of its usual thickness, from those (..., M, 3, B, C)."""
        low, high = self.seen[:, 0], self.seen[:, 2]
        part = SEEN[2] * np.clip((self.usual - low) / (high - low), 0.0, 1.0)
        weights = np.stack([np.interp(part, SEEN, one) for one in np.eye(len(SEEN))], axis=1)
        return np.einsum("...mkbc,mk->...mbc", values, weights)

    def bulging(self, colour: NDArray) -> "Grid":
        """The grid with the bulge that tans' colours (M, 3, B, 3) with the least blood ask for."""
        if self.thickness[0] != 0.0:
            return self
        u = 2.0 * np.log(self.roots)
        tans = (u > -1e-9) & (u <= float(self.spread.most.max()) + 1e-9)
        first, second, third = np.moveaxis(colour[tans, :, 0], 1, 0)
        x, far = (self.seen[tans, number, None] / self.thickness[1] for number in (1, 2))
        straight = (second - first) * far - (third - first) * x
        more = (second - first) * far * (1.0 - far) - (third - first) * x * (1.0 - x)
        weights = 1.0 / (np.maximum(first, 1e-4) * far) ** 2
        over = (weights * more**2).sum()
        bulge = -(weights * straight * more).sum() / over if over > 0.0 else 0.0
        return replace(self, bulge=float(np.clip(bulge, -MOST_BULGE, MOST_BULGE)))


def grid_of(table: SkinTable, minimal: MinimalDoses, kinetics: str = "thesis") -> Grid:
    """The grid of a table along the states of a kinetics.

    Raises
    ------
    InputError
        If the table does not say how its skin makes melanin.
    """
    dynamics = melanin_of(table, kinetics)
    spread = spread_of(dynamics, mmd=minimal.mmd, med=minimal.med)
    melanin, thickness, blood = _ranges(table, spread)
    roots = _roots(*np.exp(np.divide(melanin, 2.0)))
    u = 2.0 * np.log(roots)
    usual = np.interp(u, *usual_thickness(dynamics, mmd=minimal.mmd, med=minimal.med))
    reached = np.interp(u, spread.least, spread.thicknesses)
    return Grid(spread, roots, reached, usual, thickness, blood)


def _roots(low: float, high: float) -> NDArray[np.float64]:
    """Even square roots of melanin, 1 among them, so that untanned skin is exact."""
    step = (high - low) / (COLUMNS - 1)
    if low < 1.0 < high:
        step = (1.0 - low) / np.ceil((1.0 - low) / step)
    roots = low + step * np.arange(int(np.ceil((high - low) / step - 1e-9)) + 1)
    return np.asarray(roots, dtype=float)


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


def over_states(values: NDArray) -> NDArray[np.float32]:
    """Two halves of numbers over melanin, two thicknesses and blood (M, 2, B, 3)."""
    thin, thick = values[:, 0], values[:, 1, ::-1]
    return np.concatenate([thin, thick], axis=1).swapaxes(0, 1).astype(np.float32)
