"""The document of the measurements."""

import datetime
import platform
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from examples.simplifications.edge import DARKEST_DAY, JUST_VISIBLE, Edge
from examples.simplifications.measures import EVEN, RAYS, Row
from examples.simplifications.skins import DAYS, DOSE
from hylios import colour
from hylios.profile import burley_width
from hylios.quadrature import skin_quadrature
from hylios.specimen import SPECIMENS
from hylios.transport.simulate import DISTANCE_EDGES, Spectrum
from lut_builder.build import BANDS_NM


@dataclass(frozen=True)
class Findings:
    """Everything that the document reports.

    Attributes
    ----------
    wavelengths, rays, model : lists of Row
    lines : list of Edge
        Of S1 to S4.
    profiles : list of Spectrum
        Of S1 to S4 at `EVEN`.
    walked : float
        CIEDE2000 between the two solvers, with `walked_rays` per wavelength.
    bands : (3,) array
        Time of a ray at `BANDS_NM`, relative to the visible.
    render : float, optional
        Time of rendering with subsurface relative to that without.
    seconds : float
        Processor time of it all.
    """

    wavelengths: Sequence[Row]
    rays: Sequence[Row]
    model: Sequence[Row]
    lines: Sequence[Edge]
    profiles: Sequence[Spectrum]
    walked: float
    walked_rays: int
    bands: np.ndarray
    render: float | None
    seconds: float


def markdown(found: Findings) -> str:
    """The document as Markdown."""
    return "todo"


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table, the first column to the left, numbers to the right."""
    lines = [heads, ["---", *["---:"] * (len(heads) - 1)], *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def cost(differences: np.ndarray) -> str:
    """Mean and largest CIEDE2000."""
    return f"{small(differences.mean())} ({small(differences.max())})"


def small(number: float) -> str:
    """Two significant digits, but no more than three places."""
    return f"{number:.3f}" if number < 0.1 else f"{number:.2f}"


def times(number: float | None) -> str:
    """A relative time."""
    return "" if number is None else f"{number:.2f}" if number < 10 else f"{number:.0f}"


def main_table(rows: Sequence[Row]) -> str:
    """Rows as a table."""
    heads = ("simplification", "S1 to S4", "tans", "noise", "walk", "walk, same noise", "solver")
    return table(
        heads,
        [
            [
                row.what,
                cost(row.specimens),
                cost(row.tans),
                "" if row.noise is None else small(row.noise),
                times(row.walk),
                times(row.walk_same_noise),
                times(row.solver),
            ]
            for row in rows
        ],
    )
