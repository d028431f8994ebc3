"""Time and error of one setting changed by itself, as rows of a table."""

from itertools import product
from typing import Any

import numpy as np

from hylios.adding.solver import NODES
from hylios.lab.colour import difference
from hylios.quadrature import skin_quadrature
from hylios.table import INTERPOLATIONS
from lut_builder.check import FINE
from lut_builder.trade.components import component_errors, regions
from lut_builder.trade.extent import (
    BASE_WAVELENGTHS,
    BROAD,
    COMPONENTS,
    Extent,
    fine_wavelengths,
    table_wavelengths,
)
from lut_builder.trade.solving import Cost, colours
from lut_builder.trade.table_errors import ColourError, ProfileError

Row = dict[str, Any]
"""One setting of one thing that is traded, with `COLUMNS`; empty where one says nothing."""

COLUMNS = ("traded", "setting", "seconds", "mean", "largest", "unit", "note")


def _row(
    traded: str,
    setting: object,
    seconds: float | None,
    mean: float,
    largest: float,
    unit: str,
    note: str = "",
) -> Row:
    told = "" if seconds is None else f"{seconds:.4g}"
    numbers = told, f"{mean:.4g}", f"{largest:.4g}"
    return dict(zip(COLUMNS, (traded, setting, *numbers, unit, note), strict=True))


def _ends(values: np.ndarray) -> tuple[float, float]:
    """Mean and largest."""
    return float(np.mean(values)), float(np.max(values))


def colour_parts(
    extent: Extent, measured: dict[Any, Any], colour: dict[Any, ColourError]
) -> list[Row]:
    """Colours by knots and interpolation, and by wavelengths, all else as usual."""
    cost: Cost = measured["cost", NODES]
    rows = []
    for kind, knots in product(INTERPOLATIONS, extent.knots):
        seen = colour[knots, kind, BASE_WAVELENGTHS, NODES]
        seconds = cost.seconds(int(np.prod(knots)), BASE_WAVELENGTHS)
        name, note = " ".join(map(str, knots)), f"bands {seen.bands:.2g} RMSE"
        rows.append(
            _row(f"knots, {kind}", name, seconds, seen.mean, seen.largest, "CIEDE2000", note)
        )
    few, grid = table_wavelengths(extent), fine_wavelengths()
    fine = measured["fine"]
    direct = colours(fine[:, np.isin(grid, FINE)], FINE)
    for count in extent.wavelengths:
        rule = skin_quadrature(count)
        seen = measured["nodes", NODES][:, np.isin(few, rule.wavelengths)] @ rule.weights.T
        apart = _ends(difference(seen, direct))
        rows.append(_row("wavelengths", count, cost.later * count, *apart, "CIEDE2000"))
    return rows


def solver_parts(extent: Extent, measured: dict[Any, Any]) -> list[Row]:
    """The two solvers at single states, by nodes and by rays, against the fine solution."""
    few, grid = table_wavelengths(extent), fine_wavelengths()
    rule = skin_quadrature(BASE_WAVELENGTHS)
    fine = measured["fine"][:, np.isin(grid, rule.wavelengths)]
    own = np.isin(few, rule.wavelengths)
    ways = [
        *(
            ("nodes", nodes, measured["cost", nodes].later, measured["nodes", nodes][:, own])
            for nodes in extent.nodes
        ),
        *(("rays", rays, *measured["walk", rays]) for rays in extent.rays),
    ]
    rows = []
    for traded, setting, seconds, seen in ways:
        truth = fine[: len(seen)]
        apart = _ends(difference(seen @ rule.weights.T, truth @ rule.weights.T))
        rmse = _ends(np.sqrt(np.mean((seen - truth) ** 2, axis=1)))
        rows.append(_row(f"{traded}, spectrum", setting, seconds, *rmse, "RMSE"))
        rows.append(_row(f"{traded}, colour", setting, seconds, *apart, "CIEDE2000"))
    return rows


def profile_parts(profile: dict[Any, list[ProfileError]], misfits: np.ndarray) -> list[Row]:
    """Profiles by states, wavelengths and error aimed at, and what their shape misses."""
    unit = "share of light"
    rows = [
        _row(
            f"profile, {number} states, {count} wavelengths",
            error.error,
            error.shared + error.serial,
            error.rms,
            error.largest,
            unit,
            "" if error.walked else "extrapolated",
        )
        for (number, count), errors in profile.items()
        for error in errors
    ]
    note = "near share and far width of the walked profile itself: no setting mends it"
    return [*rows, _row("profile shape", "", None, *_ends(misfits), unit, note)]


def file_parts(apart: np.ndarray, sizes: dict[str, int]) -> list[Row]:
    """Numbers of 32 and of 16 bits."""
    errors = {"float": (0.0, 0.0), "half": _ends(apart)}
    return [
        _row("number", name, None, *errors[name], "CIEDE2000", f"{size} bytes")
        for name, size in sizes.items()
    ]


def component_parts(spectra: np.ndarray) -> list[Row]:
    """Principal components of half of the spectra keep the other half (appendix D)."""
    rows = []
    for name, parts in (("PCA", [np.full(BROAD.size, True)]), ("PPCA", regions(BROAD))):
        for count in COMPONENTS:
            errors = _ends(component_errors(spectra[::2], spectra[1::2], parts, count))
            note = f"{count * len(parts)} numbers a state"
            rows.append(_row(f"components, {name}", count, None, *errors, "RMSE", note))
    return rows
