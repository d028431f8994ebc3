"""The single measurements that the points of a front are put together from."""

from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np

from hylios.adding.solver import NODES
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from lut_builder.reachable import choose_axes
from lut_builder.settings import MOST_PROFILE_ERROR, Settings
from lut_builder.trade.extent import (
    BASE_WAVELENGTHS,
    BROAD,
    SECONDS_EACH,
    Extent,
    fine_wavelengths,
    table_wavelengths,
)
from lut_builder.trade.profiles import fine_profiles, profile_runs
from lut_builder.trade.solving import reflectances, solver_cost, walk
from lut_builder.trade.whole_tables import half_against_full, start_seconds

Step = tuple[float, Callable[[], Any]]
"""Seconds that it takes, about, and the work."""


def planned(skin: Skin, extent: Extent, states: np.ndarray, seed: int) -> dict[Any, Step]:
    """All measurements by name, each with about the seconds that it takes, and the work."""
    few = table_wavelengths(extent)

    def light(some: np.ndarray, wavelengths: np.ndarray, nodes: int) -> Step:
        size = len(some) * wavelengths.size * SECONDS_EACH * (nodes / NODES) ** 2
        return size, lambda: reflectances(skin, some, wavelengths, nodes)

    steps: dict[Any, Step] = {
        "start": (6.0, lambda: start_seconds(True, extent.repeats)),
        "start without profile": (4.0, lambda: start_seconds(False, extent.repeats)),
        "fine": light(states, fine_wavelengths(), extent.fine_nodes),
        "broad": light(states[: extent.broad_states], BROAD, NODES),
    }
    for nodes in extent.nodes:
        steps["cost", nodes] = 0.5, lambda n=nodes: solver_cost(skin, n, extent.repeats)
    for nodes in {*extent.nodes, NODES}:
        steps["nodes", nodes] = light(states, few, nodes)
    for knots in extent.knots:
        knot_states = choose_axes(skin, knots).knot_states().reshape(-1, 5)
        steps["knots", knots] = light(knot_states, few, NODES)
    base = skin_quadrature(BASE_WAVELENGTHS).wavelengths
    some = states[: extent.walked_states]
    for rays in extent.rays:
        size = 1.0 + rays * len(some) * base.size * 5e-6
        steps["walk", rays] = size, lambda n=rays: walk(skin, some, base, n, seed)
    seen = states[: extent.profile_states]
    fine = extent.fine_profile_wavelengths, extent.fine_profile_error
    steps["profile fine"] = (
        fine[0] * (0.2 + 1e-6 * len(seen) / fine[1] ** 2 / 4.0),
        lambda: fine_profiles(skin, seen, *fine, seed),
    )
    knots = extent.file_knots
    for number, count in product(extent.design_states, extent.profile_wavelengths):
        table = Settings(knots, 4, (), extent.profile_errors[0], count, number, nodes=10)
        steps["profile", number, count] = (
            2.0 + 2.0 * extent.longest * min(1.0, number / 40.0),
            lambda made=table: profile_runs(
                skin, made, extent.profile_errors, seen, extent.longest, seed
            ),
        )
    written = Settings(extent.file_knots, profile_error=MOST_PROFILE_ERROR)
    steps["half"] = 6.0, lambda: half_against_full(skin, written, states, seed)
    return steps
