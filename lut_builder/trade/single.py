"""Single measurements of time and error; `measurement` puts points together from them.

Seconds are those of the processor, of one core.
"""

import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from hylios.adding import spectra
from hylios.lab.colour import difference, lab, rec709_weights
from hylios.near_far import edge_spread, model_edge_spread, near_share_and_far_width
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.skin.skin import MOST_BLOOD
from hylios.transport.shared_profiles import LEAST_LIGHT, skin_profiles
from hylios.transport.simulate import DISTANCE_EDGES
from hylios.transport.simulate import spectrum as walked
from lut_builder.assemble import assembled, requested
from lut_builder.exr_writer import write_table
from lut_builder.near_far_fit import DISTANCES
from lut_builder.reachable import reachable_states, untanned_state
from lut_builder.request import ANGLE, ANGLES, STATES_TOGETHER, WATER, computed, pieces
from lut_builder.settings import Settings

UNSEEN = np.array([401.7, 433.1, 468.3, 507.9, 541.7, 583.3, 611.9, 653.1])
"""Wavelengths in nm that no table uses, so that nothing of them is kept from before."""

REGIONS_NM = (700.0, 1400.0)
"""Where the spectrum is divided for piecewise components (D.1)."""


@dataclass(frozen=True)
class Cost:
    """Seconds of the solver: of a reflectance, and how much more of the first at a wavelength."""

    later: float
    first: float

    def seconds(self, states: int, wavelengths: int) -> float:
        """Seconds of a table's colours and bands."""
        return wavelengths * (self.first + states * self.later)


@dataclass(frozen=True)
class Run:
    """Profiles of a table that were walked.

    Attributes
    ----------
    error : float
        That was aimed at.
    shared, serial : float
        Seconds that cores share, and that one spends on the fit.
    spreads : (N, 3, X) array
        Edge spreads at `DISTANCES`, by what the table tells of states between its knots.
    """

    error: float
    shared: float
    serial: float
    spreads: np.ndarray


@dataclass(frozen=True)
class FineProfiles:
    """Profiles of N states against which those of tables are measured, for three channels each.

    Attributes
    ----------
    spreads : (N, 3, X) array
        Edge spreads at `DISTANCES`, by the near share and far width fitted to the walked ones.
    light : (N, 3) array
        Of the channel, linear Rec.709, that leaves after having been inside.
    misfits : (N, 3) array
        Largest difference between them and the walked ones: no table that holds near shares and
        far widths can do better.
    """

    spreads: np.ndarray
    light: np.ndarray
    misfits: np.ndarray


def between_knots(skin: Skin, count: int, seed: int) -> np.ndarray:
    """Tanned states (N, 5) of schedules other than those that chose the axes, of any blood."""
    states = reachable_states(skin, 100, seed)
    tanned = np.abs(np.log(states / untanned_state(skin))).max(axis=1) > 1e-3
    random = np.random.default_rng(seed)
    tans = random.choice(states[tanned], count, replace=False)
    return np.column_stack([tans, np.exp(random.uniform(0.0, np.log(MOST_BLOOD), count))])


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds and result."""
    start = time.process_time()
    result = work()
    return time.process_time() - start, result


def reflectances(skin: Skin, states: np.ndarray, wavelengths: np.ndarray, nodes: int) -> np.ndarray:
    """Total reflectance (N, W) of states by the solver, as pieces of a table compute it."""
    parts = []
    for first in range(0, len(states), STATES_TOGETHER):
        some = [skin.at(state) for state in states[first:][:STATES_TOGETHER]]
        # with a film beside: its directions are the table's
        light = spectra(some, wavelengths, angle=ANGLE, nodes=nodes, film=(None, WATER))
        parts.append(light.total[0])
    return np.concatenate(parts)


def table_light(skin: Skin, states: np.ndarray, wavelengths: np.ndarray, nodes: int) -> None:
    """Solve as a table needs it: at all its angles, and wet."""
    specimens = [skin.at(state) for state in states]
    spectra(specimens, wavelengths, angle=ANGLES, nodes=nodes, film=(None, WATER))


def solver_cost(skin: Skin, nodes: int, repeats: int) -> Cost:
    """What a state costs at a wavelength with so many nodes.

    Of some runs the fastest counts: other work can only slow one down.
    """
    states = reachable_states(skin, 1, 1)[:: 240 // STATES_TOGETHER][:STATES_TOGETHER]
    firsts, later = [], []
    for repeat in range(repeats):
        unseen = UNSEEN + 0.1 * repeat
        first, _ = timed(lambda at=unseen: table_light(skin, states[:1], at, nodes))
        rest, _ = timed(lambda at=unseen: table_light(skin, states, at, nodes))
        firsts.append(first / UNSEEN.size)
        later.append(rest / UNSEEN.size / len(states))
    return Cost(min(later), max(min(firsts) - min(later), 0.0))


def start_seconds(has_profile: bool, repeats: int) -> float:
    """Seconds of a table of one state in a process of its own; of some the fastest."""
    with tempfile.TemporaryDirectory() as folder:
        arguments = ["build", "--preset", "preview", "--knots", "1", "--wavelengths", "4"]
        arguments += ["--bands", "visible", "--force", "-o", str(Path(folder) / "start.exr")]
        arguments += [] if has_profile else ["--no-profile"]
        seconds = []
        for _ in range(repeats):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run(
                [sys.executable, "-m", "lut_builder.cli", *arguments],
                check=True,
                capture_output=True,
            )
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(seconds)


def walk(
    skin: Skin, states: np.ndarray, wavelengths: np.ndarray, rays: int, seed: int
) -> tuple[float, np.ndarray]:
    """Seconds of a reflectance by random walk, and total reflectances (N, W)."""

    def light(state: np.ndarray) -> np.ndarray:
        specimen = skin.at(state)
        return walked(specimen, wavelengths, angle=ANGLE, rays=rays, seed=seed, threads=1).total

    light(states[0])  # compiles or loads the kernels
    seconds, reflectance = timed(lambda: np.array([light(state) for state in states]))
    return seconds / reflectance.size, reflectance


def fine_profiles(
    skin: Skin, states: np.ndarray, wavelengths: int, error: float, seed: int
) -> FineProfiles:
    """Profiles of states from so many wavelengths, with a standard error."""
    few = skin_quadrature(wavelengths)
    specimens = [skin.at(state) for state in states]
    # Another seed than the tables': errors are to be independent.
    profiles = skin_profiles(
        specimens, few.wavelengths, error=error, angle=ANGLE, seed=seed + 1, threads=1
    )
    channels = np.einsum(
        "cw,wsb->scb", few.weights, np.array([profile.light for profile in profiles])
    )
    light = np.maximum(channels.sum(axis=2), LEAST_LIGHT)
    spreads = model_edge_spread(DISTANCES, *near_share_and_far_width(DISTANCE_EDGES, channels))
    misfits = share_errors(spreads, edge_spread(DISTANCE_EDGES, channels, DISTANCES))
    return FineProfiles(spreads, light, misfits)


def share_errors(spreads: np.ndarray, fine: np.ndarray) -> np.ndarray:
    """Largest difference of edge spreads (..., X) and (..., X) over the distance, (...)."""
    return np.abs(spreads - fine).max(axis=-1)


def lightness_lost(light: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """How much the CIE 1976 lightness of a light falls where a share of it is missing.

    So much an error of the profile's share within a distance can do at a place that light reaches
    from one side only. Elsewhere it does less, in even light nothing.

    Parameters
    ----------
    light, shares : (...) arrays
    """
    greys = np.stack([light, light * (1.0 - shares)])[..., None] * np.ones(3)
    before, after = lab(greys)[..., 0]
    return before - after


def profile_runs(
    skin: Skin,
    settings: Settings,
    errors: Sequence[float],
    states: np.ndarray,
    longest: float,
    seed: int,
) -> list[Run]:
    """Tables with profiles of ever smaller error, until one would take longer than `longest`."""
    runs: list[Run] = []
    for error in errors:
        if len(runs) > 1 and _expected(runs, error) > longest:
            break
        request = requested(skin, replace(settings, profile_error=error), seed=seed)
        shared, results = 0.0, {}
        for piece in pieces(request):
            seconds, results[piece.name] = timed(
                lambda of=request, piece=piece: computed(of, piece)
            )
            shared += seconds if piece.kind == "profile" else 0.0
        serial, table = timed(lambda of=request, by=results: assembled(of, by))
        told = table.lookup(states, ("near_share", "far_width"))
        spreads = model_edge_spread(DISTANCES, told["near_share"], told["far_width"])
        runs.append(Run(error, shared, serial, spreads))
    return runs


def _expected(runs: list[Run], error: float) -> float:
    """Seconds of the same profiles with another error, by what the last run had more than before.

    Seconds grow with the number of paths, which goes with the inverse square of the error.
    """
    before, last = runs[-2:]
    grown = max(last.shared - before.shared, 0.0)
    share = (error**-2 - last.error**-2) / (last.error**-2 - before.error**-2)
    return last.serial + last.shared + grown * share


def half_against_full(
    skin: Skin, settings: Settings, states: np.ndarray, seed: int
) -> tuple[np.ndarray, dict[str, int]]:
    """CIEDE2000 (N,) that numbers of 16 bits make, and bytes of the file by kind of number."""
    request = requested(skin, settings, seed=seed)
    table = assembled(request, {piece.name: computed(request, piece) for piece in pieces(request)})
    rounded = {
        name: values.astype(np.float16).astype(float)
        for name, values in table.planes.items()
        if name == "total_colour"
    }
    apart = difference(
        replace(table, planes=rounded).plane("total_colour", states),
        table.plane("total_colour", states),
    )
    sizes = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in ("float", "half"):
            path = Path(folder) / f"{name}.exr"
            write_table(path, table, half=name == "half")
            sizes[name] = os.path.getsize(path)
    return apart, sizes


def regions(wavelengths: np.ndarray) -> list[np.ndarray]:
    """Which wavelengths belong to each of the piecewise analysis's regions, bool."""
    number = np.searchsorted(REGIONS_NM, wavelengths)
    return [number == region for region in range(len(REGIONS_NM) + 1)]


def component_errors(
    spectra: np.ndarray, others: np.ndarray, parts: Sequence[np.ndarray], components: int
) -> np.ndarray:
    """RMSE (N,) of `others` (N, W) from so many principal components of `spectra` (M, W).

    As in appendix D no mean is subtracted, and each of the `parts`, bool arrays (W,), has
    components of its own; unlike there, spectra are kept that the components were not made from.
    """
    again = np.empty_like(others)
    for part in parts:
        rows = np.linalg.svd(spectra[:, part], full_matrices=False)[2][:components]
        again[:, part] = others[:, part] @ rows.T @ rows
    return np.sqrt(np.mean((others - again) ** 2, axis=1))


def colours(reflectance: np.ndarray, wavelengths: np.ndarray) -> np.ndarray:
    """Linear Rec.709 (N, 3) of reflectance (N, W) every 5 nm from 400 to 700 nm."""
    return reflectance @ rec709_weights(wavelengths).T
