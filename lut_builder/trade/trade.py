"""Time against error of tables, over all that can be traded.

Colour and profile are separate work with separate errors, so each is measured by itself, over the
settings that matter to it, and a table's point is put together from the two. Errors are against a
fine solution at reachable states that are no knots.

What is not measured for each combination: another number of the solver's directions moves a
reflectance by what hardly depends on the state, so that shift is measured at the states looked up
and added there (on the coarsest tables that misses the largest error by 2 %); a profile that would
take too long follows from the same table's less accurate ones (`completed`).
"""

import platform
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from hylios.lab.colour import difference
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.table import INTERPOLATIONS
from hylios.table.interpolation import interpolate
from lut_builder.axes import choose_axes
from lut_builder.check import FINE
from lut_builder.settings import BANDS_NM, MOST_PROFILE_ERROR, NODES, Settings
from lut_builder.trade.measure import (
    Cost,
    FineProfiles,
    Run,
    between_knots,
    colours,
    component_errors,
    fine_profiles,
    half_against_full,
    lightness_lost,
    profile_runs,
    reflectances,
    regions,
    share_errors,
    solver_cost,
    start_seconds,
    walk,
)
from lut_builder.trade.pareto import Point, front

BROAD = np.arange(250.0, 2501.0, 25.0)
"""Wavelengths in nm of the spectra that principal components are to keep."""

COMPONENTS = (1, 2, 3, 4, 8)

BASE_WAVELENGTHS, BASE_INTERPOLATION = 8, "pchip"
"""Of the colours where something else is varied."""

SECONDS_EACH = 1.5e-3
"""Of one reflectance with the usual number of directions, for the time left alone."""


@dataclass(frozen=True)
class Extent:
    """What is tried, and how finely the truth is known.

    Attributes
    ----------
    states, profile_states, broad_states, walked_states : int
        Numbers of reachable states between the knots: for colours, profiles, principal
        components and random walks.
    knots, wavelengths, nodes, profile_errors, profile_wavelengths : tuples
        Values of `Settings`; profile errors descend.
    rays : tuple of int
        Of random walks, for each wavelength.
    fine_nodes, fine_profile_wavelengths : int
    fine_profile_error : float
        Of what errors are measured against.
    longest : float
        Seconds of a profile, about, beyond which it is not walked.
    file_knots : tuple of int
        Of a table that is written with numbers of 32 and of 16 bits.
    repeats : int
        Of what is short.
    """

    states: int = 200
    profile_states: int = 24
    broad_states: int = 60
    walked_states: int = 3
    knots: tuple[tuple[int, ...], ...] = (
        (5,),
        (9,),
        (7, 2),
        (9, 3),
        (7, 3, 2),
        (11, 3, 2),
        (9, 3, 3, 2),
        (11, 3, 3, 2),
        (13, 4, 4, 2),
    )
    wavelengths: tuple[int, ...] = (4, 6, 8, 12, 16)
    nodes: tuple[int, ...] = (10, 14, 18, NODES, 30)
    profile_errors: tuple[float, ...] = (0.05, 0.02, 0.01, 0.006, 0.004, 0.003, 0.002)
    profile_wavelengths: tuple[int, ...] = (4, 8)
    rays: tuple[int, ...] = (1_000, 10_000, 100_000)
    fine_nodes: int = 36
    fine_profile_wavelengths: int = 12
    fine_profile_error: float = 0.002
    longest: float = 12.0
    file_knots: tuple[int, ...] = (11, 3, 3, 2)
    repeats: int = 3


FULL = Extent()
QUICK = Extent(
    states=12,
    profile_states=4,
    broad_states=12,
    walked_states=1,
    knots=((3,), (5, 2)),
    wavelengths=(4, 8),
    nodes=(14, NODES),
    profile_errors=(0.1, 0.05),
    profile_wavelengths=(4,),
    rays=(1_000,),
    fine_nodes=30,
    fine_profile_wavelengths=6,
    fine_profile_error=0.02,
    longest=10.0,
    file_knots=(5, 2),
    repeats=1,
)
"""To see that it works; what it says of a table is worth little."""

Row = dict[str, Any]
"""One setting of one thing that is traded, with `COLUMNS`; empty where one says nothing."""

COLUMNS = ("traded", "setting", "seconds", "mean", "largest", "unit", "note")


@dataclass(frozen=True)
class Trade:
    """What was measured.

    Attributes
    ----------
    points : list of Point
        All tables.
    parts : list of Row
        What each thing that can be traded does by itself.
    """

    points: list[Point]
    parts: list[Row]

    @property
    def front(self) -> list[Point]:
        """The tables that no other beats in time and error."""
        return front(self.points)


@dataclass(frozen=True)
class ColourError:
    """Of colours and bands of a table at states between its knots, as in `Point`."""

    mean: float
    largest: float
    bands: float


@dataclass(frozen=True)
class ProfileError:
    """Of profiles of a table at states between its knots, and their time, as in `Point`."""

    error: float
    shared: float
    serial: float
    rms: float
    largest: float
    lightness: float
    walked: bool = True


Step = tuple[float, Callable[[], Any]]
"""Seconds that it takes, about, and the work."""


def measure(
    skin: Skin,
    extent: Extent = FULL,
    *,
    seed: int = 1,
    begin: Callable[[float], Callable[[float], object]] | None = None,
) -> Trade:
    """Measure all that `extent` names, for a skin, on one core.

    Parameters
    ----------
    begin : callable, optional
        Told the seconds of all; what it returns is told those of each step as it ends.
    """
    states = between_knots(skin, extent.states, seed)
    steps = _steps(skin, extent, states, seed)
    progress = begin(sum(size for size, _ in steps.values())) if begin else None
    found: dict[Any, Any] = {}
    for name, (size, work) in steps.items():
        found[name] = work()
        if progress:
            progress(size)
    colour = _colour_errors(skin, extent, states, found)
    fine: FineProfiles = found["profile fine"]
    profile = {}
    for count in extent.profile_wavelengths:
        runs = {knots: found["profile", knots, count] for knots in extent.knots}
        noise = noise_share(list(runs.values()), fine.widths)
        for knots, each in runs.items():
            profile[knots, count] = completed(each, fine, extent.profile_errors, noise)
    return Trade(
        points=_points(extent, found, colour, profile),
        parts=[
            *_colour_parts(extent, found, colour),
            *_solver_parts(extent, found),
            *_profile_parts(profile, fine.misfits),
            *_file_parts(*found["half"]),
            *_component_parts(found["broad"]),
        ],
    )


def notes(skins: Sequence[Skin], extent: Extent) -> list[str]:
    """Of which machine, day and skins a measurement is."""
    names = "; ".join(f"{each.specimen.name}, pigmentation {each.pigmentation}" for each in skins)
    several = ": of each table the slowest and least accurate" if len(skins) > 1 else ""
    return [
        f"lut-builder trade, {date.today().isoformat()}: seconds are of this machine's processor",
        f"machine: {_processor()}, Python {platform.python_version()}, numpy {np.__version__}",
        f"skin: {names}{several}",
        f"errors: at {extent.states} reachable states that are no knots, "
        f"{extent.profile_states} of them for profiles; tables have {len(BANDS_NM)} single bands",
    ]


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return named[0] if named else platform.processor() or platform.machine()


def _steps(skin: Skin, extent: Extent, states: np.ndarray, seed: int) -> dict[Any, Step]:
    """All measurements by name."""
    few = _wavelengths(extent)

    def light(some: np.ndarray, wavelengths: np.ndarray, nodes: int) -> Step:
        size = len(some) * wavelengths.size * SECONDS_EACH * (nodes / NODES) ** 2
        return size, lambda: reflectances(skin, some, wavelengths, nodes)

    steps: dict[Any, Step] = {
        "start": (6.0, lambda: start_seconds(True, extent.repeats)),
        "start without profile": (4.0, lambda: start_seconds(False, extent.repeats)),
        "fine": light(states, _fine_wavelengths(), extent.fine_nodes),
        "broad": light(states[: extent.broad_states], BROAD, NODES),
    }
    for nodes in extent.nodes:
        steps["cost", nodes] = 0.5, lambda n=nodes: solver_cost(skin, n, extent.repeats)
    for nodes in {*extent.nodes, NODES}:
        steps["nodes", nodes] = light(states, few, nodes)
    for knots in extent.knots:
        knot_states = choose_axes(skin, knots).knot_states().reshape(-1, 4)
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
    for knots, count in product(extent.knots, extent.profile_wavelengths):
        table = Settings(knots, 4, (), extent.profile_errors[0], count, nodes=10)
        steps["profile", knots, count] = (
            2.0 + 2.0 * extent.longest * min(1.0, table.states / 400.0),
            lambda made=table: profile_runs(
                skin, made, extent.profile_errors, seen, extent.longest, seed
            ),
        )
    written = Settings(extent.file_knots, profile_error=MOST_PROFILE_ERROR)
    steps["half"] = 6.0, lambda: half_against_full(skin, written, states, seed)
    return steps


def _wavelengths(extent: Extent) -> np.ndarray:
    """All wavelengths in nm that a table's colours or bands may use."""
    used = [skin_quadrature(count).wavelengths for count in (*extent.wavelengths, BASE_WAVELENGTHS)]
    return np.unique(np.concatenate([*used, BANDS_NM]))


def _fine_wavelengths() -> np.ndarray:
    return np.union1d(FINE, BANDS_NM)


def _colour_errors(
    skin: Skin, extent: Extent, states: np.ndarray, found: dict[Any, Any]
) -> dict[Any, ColourError]:
    """Errors of colours by (knots, interpolation, wavelengths, nodes)."""
    few, grid = _wavelengths(extent), _fine_wavelengths()
    fine = found["fine"]
    direct = colours(fine[:, np.isin(grid, FINE)], FINE)
    bands = np.isin(few, BANDS_NM)
    direct_bands = fine[:, np.isin(grid, BANDS_NM)]
    errors = {}
    for knots, kind in product(extent.knots, INTERPOLATIONS):
        axes = choose_axes(skin, knots)
        positions = axes.coordinates(states)

        def seen(values: np.ndarray, axes=axes, positions=positions, kind=kind) -> np.ndarray:
            return interpolate(kind, axes.knots, values.reshape(*axes.shape, -1), positions)

        known = found["knots", knots]
        seen_bands = seen(known[:, bands])
        for count in extent.wavelengths:
            rule = skin_quadrature(count)
            own = np.isin(few, rule.wavelengths)
            seen_colours = seen(known[:, own] @ rule.weights.T)
            for nodes in extent.nodes:
                shift = found["nodes", nodes] - found["nodes", NODES]
                apart = difference(seen_colours + shift[:, own] @ rule.weights.T, direct)
                errors[knots, kind, count, nodes] = ColourError(
                    mean=float(apart.mean()),
                    largest=float(apart.max()),
                    bands=_rms(seen_bands + shift[:, bands] - direct_bands),
                )
    return errors


def noise_share(runs: Sequence[Sequence[Run]], fine: np.ndarray) -> float:
    """Mean squared error of tables' profiles over that of a wavelength's, of noise alone.

    The median over tables, of what each one's squared error falls by with the error asked for.
    """
    falls = []
    for some in runs:
        squares = [_rms(share_errors(run.widths, fine)) ** 2 for run in some]
        asked = [run.error**2 for run in some]
        falls.append((squares[0] - squares[-1]) / (asked[0] - asked[-1]))
    return max(float(np.median(falls)), 0.0)


def completed(
    runs: Sequence[Run], fine: FineProfiles, errors: Sequence[float], noise: float
) -> list[ProfileError]:
    """Error and time of a table's profiles for each error asked for.

    Those that were not walked follow from the most accurate run: its mean squared error falls by
    what `noise_share` says, though no further than to that of noise alone, and its largest errors
    by as much; seconds are its own, times the number of paths. All are too large rather than too
    small.

    Parameters
    ----------
    fine : FineProfiles
        Of the states at which the runs' widths are.
    errors : sequence of float
        Descending; those of the runs come first.
    """
    known = [_profile_error(run, fine) for run in runs]
    last = known[-1]
    for error in errors[len(known) :]:
        fallen = last.rms**2 - noise * (last.error**2 - error**2)
        rms = max(np.sqrt(max(fallen, 0.0)), last.rms * error / last.error)
        known.append(
            ProfileError(
                error,
                last.shared * (last.error / error) ** 2,
                last.serial,
                float(rms),
                float(last.largest * rms / last.rms),
                float(last.lightness * rms / last.rms),
                walked=False,
            )
        )
    return known


def _profile_error(run: Run, fine: FineProfiles) -> ProfileError:
    shares = share_errors(run.widths, fine.widths)
    seen = lightness_lost(fine.light, shares)
    return ProfileError(
        run.error, run.shared, run.serial, _rms(shares), float(shares.max()), float(seen.max())
    )


def _points(
    extent: Extent,
    found: dict[Any, Any],
    colour: dict[Any, ColourError],
    profile: dict[Any, list[ProfileError]],
) -> list[Point]:
    """All tables, with each profile and without."""
    points = []
    for (knots, kind, count, nodes), seen in colour.items():
        cost: Cost = found["cost", nodes]
        solved = cost.seconds(int(np.prod(knots)), count + len(BANDS_NM))

        def point(profiled: ProfileError | None, few: int = 8, **made) -> Point:
            start = found["start" if profiled else "start without profile"]
            return Point(
                Settings(
                    profile_error=profiled.error if profiled else 0.0,
                    profile_wavelengths=few,
                    **made,
                ),
                shared_seconds=solved + (profiled.shared if profiled else 0.0),  # noqa: B023
                serial_seconds=profiled.serial if profiled else 0.0,
                start_seconds=start,
                delta_e_mean=seen.mean,  # noqa: B023
                delta_e_largest=seen.largest,  # noqa: B023
                band_rmse=seen.bands,  # noqa: B023
                profile_rms=profiled.rms if profiled else 0.0,
                profile_largest=profiled.largest if profiled else 0.0,
                profile_lightness=profiled.lightness if profiled else 0.0,
            )

        made = {
            "knots": knots,
            "interpolation": kind,
            "colour_wavelengths": count,
            "nodes": nodes,
        }
        points.append(point(None, **made))
        for few in extent.profile_wavelengths:
            points += [point(each, few, **made) for each in profile[knots, few]]
    return points


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


def _colour_parts(
    extent: Extent, found: dict[Any, Any], colour: dict[Any, ColourError]
) -> list[Row]:
    """Colours by knots and interpolation, and by wavelengths, all else as usual."""
    cost: Cost = found["cost", NODES]
    rows = []
    for kind, knots in product(INTERPOLATIONS, extent.knots):
        seen = colour[knots, kind, BASE_WAVELENGTHS, NODES]
        seconds = cost.seconds(int(np.prod(knots)), BASE_WAVELENGTHS)
        name, note = " ".join(map(str, knots)), f"bands {seen.bands:.2g} RMSE"
        rows.append(
            _row(f"knots, {kind}", name, seconds, seen.mean, seen.largest, "CIEDE2000", note)
        )
    few, grid = _wavelengths(extent), _fine_wavelengths()
    fine = found["fine"]
    direct = colours(fine[:, np.isin(grid, FINE)], FINE)
    for count in extent.wavelengths:
        rule = skin_quadrature(count)
        seen = found["nodes", NODES][:, np.isin(few, rule.wavelengths)] @ rule.weights.T
        apart = _ends(difference(seen, direct))
        rows.append(_row("wavelengths", count, cost.each * count, *apart, "CIEDE2000"))
    return rows


def _solver_parts(extent: Extent, found: dict[Any, Any]) -> list[Row]:
    """The two solvers at single states, by nodes and by rays, against the fine solution."""
    few, grid = _wavelengths(extent), _fine_wavelengths()
    rule = skin_quadrature(BASE_WAVELENGTHS)
    fine = found["fine"][:, np.isin(grid, rule.wavelengths)]
    own = np.isin(few, rule.wavelengths)
    ways = [
        *(
            ("nodes", each, found["cost", each].each, found["nodes", each][:, own])
            for each in extent.nodes
        ),
        *(("rays", each, *found["walk", each]) for each in extent.rays),
    ]
    rows = []
    for traded, setting, seconds, seen in ways:
        truth = fine[: len(seen)]
        apart = _ends(difference(seen @ rule.weights.T, truth @ rule.weights.T))
        rmse = _ends(np.sqrt(np.mean((seen - truth) ** 2, axis=1)))
        rows.append(_row(f"{traded}, spectrum", setting, seconds, *rmse, "RMSE"))
        rows.append(_row(f"{traded}, colour", setting, seconds, *apart, "CIEDE2000"))
    return rows


def _profile_parts(profile: dict[Any, list[ProfileError]], misfits: np.ndarray) -> list[Row]:
    """Profiles by knots, wavelengths and error asked for, and what their shape misses."""
    unit = "share of light"
    rows = [
        _row(
            f"profile, {' '.join(map(str, knots))}, {count} wavelengths",
            each.error,
            each.shared + each.serial,
            each.rms,
            each.largest,
            unit,
            "" if each.walked else "extrapolated",
        )
        for (knots, count), errors in profile.items()
        for each in errors
    ]
    note = "Burley's profile against the walked one: no setting mends it"
    return [*rows, _row("profile shape", "", None, *_ends(misfits), unit, note)]


def _file_parts(apart: np.ndarray, sizes: dict[str, int]) -> list[Row]:
    """Numbers of 32 and of 16 bits."""
    errors = {"float": (0.0, 0.0), "half": _ends(apart)}
    return [
        _row("number", name, None, *errors[name], "CIEDE2000", f"{size} bytes")
        for name, size in sizes.items()
    ]


def _component_parts(spectra: np.ndarray) -> list[Row]:
    """Principal components of half of the spectra keep the other half (appendix D)."""
    rows = []
    for name, parts in (("PCA", [np.full(BROAD.size, True)]), ("PPCA", regions(BROAD))):
        for count in COMPONENTS:
            errors = _ends(component_errors(spectra[::2], spectra[1::2], parts, count))
            note = f"{count * len(parts)} numbers a state"
            rows.append(_row(f"components, {name}", count, None, *errors, "RMSE", note))
    return rows


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
