"""Times tables on this machine and measures their errors: the rows of `make bench` about tables."""

import argparse
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from examples.bench_lines import ranged, report
from hylios.adding.spectrum import spectrum as solved
from hylios.lab.colour import rec709_weights
from hylios.skin import Skin
from hylios.skin.phototypes import phototype
from hylios.table import SkinTable, read_table
from hylios.transport.simulate import spectrum as walked
from lut_builder.assemble import build
from lut_builder.check import FINE, check
from lut_builder.request import ANGLE
from lut_builder.settings import Settings

CORES = 2
REPEATS = 3
SKIN, DARKEST = "III", "VI"
"""The skin that is measured; presets for the darkest too, which takes longest."""

FINE_NODES = 40

SPECTRA = Settings((8, 2, 2, 2), colour_wavelengths=0, bands=tuple(FINE), profile_error=0.0)
"""64 states at 61 wavelengths."""

WALKED_STATES, WALKED_STEP, WALKED_RAYS = 4, 4, 200_000
PRINTED_RAYS = 500
ERROR = 1e-3
"""RMSE at which solver and random walk are compared."""

PEER = Settings((14, 6, 8, 7), bands=(), profile_error=0.0)
"""As many cells as the nearest public peer's table has, 4704: here states with three channels."""

PEER_CHECKED = 200

PRESET_LIMITS = {"preview": (4.0, 0.5, 1.5), "standard": (20.0, 0.08, 0.25), "reference": (1200.0,)}
"""Seconds, and mean and largest CIEDE2000, at most."""

STANDARD_KILOBYTES = 300.0


@dataclass(frozen=True)
class Spent:
    """Seconds of runs by the clock, and of the processor."""

    clock: list[float]
    processor: list[float]


def spent(work, repeats: int) -> tuple[Spent, object]:
    """Time of `repeats` runs of some work, and the last one's result."""
    clock, processor, result = [], [], None
    for _ in range(repeats):
        starts = time.perf_counter(), time.process_time()
        result = work()
        clock.append(time.perf_counter() - starts[0])
        processor.append(time.process_time() - starts[1])
    return Spent(clock, processor), result


def report_spectra(skin: Skin) -> None:
    """64 states x 61 wavelengths: time, error against a random walk, and the latter's time."""
    taken, table = spent(lambda: build(skin, SPECTRA, threads=CORES), REPEATS)
    report(
        "64 states x 61 wavelengths, solver, 2 cores",
        f"{ranged(taken.clock)} s",
        "30 s or less",
        np.median(taken.clock) <= 30.0,
    )
    error, uncertain = solver_error(skin, table)
    report(
        "  RMSE against the random walk, its noise taken off",
        f"{error:.2g} (at most {uncertain:.2g} with 95 %)",
        f"{ERROR:g} at most",
        error <= ERROR,
    )
    reflectance = table.planes["band_reflectance"]
    rays = float(np.mean(reflectance * (1.0 - reflectance))) / ERROR**2
    passes = [printed_seconds(skin, table, number) for number in range(REPEATS)]
    seconds = [by_spectrum * rays * reflectance.size for by_spectrum in passes]
    ratio = np.median(seconds) / np.median(taken.processor)
    print(
        f"  as printed, the walk needs {rays:.3g} rays a wavelength for that RMSE: "
        f"{ranged(seconds)} s of one core (extrapolated from {PRINTED_RAYS} rays)"
    )
    report("  ratio of core-seconds", f"{ratio:.3g}", "400 or more", ratio >= 400.0)


def solver_error(skin: Skin, table: SkinTable) -> tuple[float, float]:
    """RMSE of a table's bands against random walks at some knots, and its upper bound (95 %).

    The walk's variance is taken off the mean square.
    """
    states = table.axes.knot_states().reshape(-1, 5)
    by_table = table.planes["band_reflectance"].reshape(len(states), -1)[:, ::WALKED_STEP]
    excess = []
    for place in np.linspace(0, len(states) - 1, WALKED_STATES).astype(int):
        specimen = skin.at(states[place])
        spectrum = walked(
            specimen, FINE[::WALKED_STEP], angle=ANGLE, rays=WALKED_RAYS, threads=CORES
        )
        excess.append((by_table[place] - spectrum.total) ** 2 - spectrum.standard_error**2)
    squares = np.concatenate(excess)
    mean, error = squares.mean(), squares.std(ddof=1) / np.sqrt(squares.size)
    return float(np.sqrt(max(mean, 0.0))), float(np.sqrt(max(mean + 1.645 * error, 0.0)))


def printed_seconds(skin: Skin, table: SkinTable, number: int) -> float:
    """Seconds of one core for a ray as the thesis prints it, at a knot."""
    states = table.axes.knot_states().reshape(-1, 5)
    state = states[(number * len(states)) // REPEATS]
    specimen = skin.at(state)

    def light() -> None:
        walked(specimen, FINE, angle=ANGLE, rays=PRINTED_RAYS, threads=1, as_printed=True)

    light()
    taken, _ = spent(light, 1)
    return taken.processor[0] / (PRINTED_RAYS * FINE.size)


def report_peer(skin: Skin) -> None:
    """A table of the peer's size: 4704 states' colours, albedo against a converged solution."""
    taken, table = spent(lambda: build(skin, PEER, threads=CORES), 1)
    report(
        "4704 states' colours, 2 cores",
        f"{ranged(taken.clock)} s",
        "300 s or less",
        taken.clock[0] <= 300.0,
    )
    errors = 100.0 * albedo_errors(skin, table)
    median, most = np.median(errors), np.percentile(errors, 95.0)
    report(
        f"  albedo, {PEER_CHECKED} of them, relative error",
        f"median {median:.2g} %, 95th percentile {most:.2g} %",
        ".1 % and .5 % at most",
        bool(median <= 0.1 and most <= 0.5),
    )


def albedo_errors(skin: Skin, table: SkinTable) -> np.ndarray:
    """Relative error (N, 3) of channels of the albedo at some knots."""
    states = table.axes.knot_states().reshape(-1, 5)
    albedo = table.planes["subsurface_colour"].reshape(-1, 3)
    weights = rec709_weights(FINE)
    errors = []
    for place in np.random.default_rng(1).choice(len(states), PEER_CHECKED, replace=False):
        specimen = skin.at(states[place])
        direct = weights @ solved(specimen, FINE, angle=ANGLE, nodes=FINE_NODES).subsurface
        errors.append(np.abs(albedo[place] / direct - 1.0))
    return np.array(errors)


def report_presets(skin: str) -> None:
    """Presets as the shell builds them, against direct solutions at 200 states."""
    for name, (seconds, *limits) in PRESET_LIMITS.items():
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"{name}.exr"
            arguments = ["--skin", skin, "--preset", name, "--threads", str(CORES)]
            command = [sys.executable, "-m", "lut_builder.cli", "build", *arguments]
            command += ["--force", "-o", str(path)]

            def build_table(command=command) -> None:
                subprocess.run(command, check=True, capture_output=True)

            taken, _ = spent(build_table, REPEATS if name == "preview" else 1)
            kilobytes = path.stat().st_size / 1000.0
            table = read_table(path)
        report(
            f"table, preset {name}, skin {skin}, program and all",
            f"{ranged(taken.clock)} s",
            f"{seconds:g} s or less",
            np.median(taken.clock) <= seconds,
        )
        apart = check(table, count=200, seed=1).differences
        errors = f"mean {apart.mean():.3f}, largest {apart.max():.3f}"
        if limits:
            report(
                "  CIEDE2000 at 200 reachable states that are no knots",
                errors,
                f"{limits[0]:g} and {limits[1]:g} at most",
                bool(apart.mean() <= limits[0] and apart.max() <= limits[1]),
            )
        else:
            print(f"  CIEDE2000 at 200 reachable states that are no knots: {errors}")
        if name == "standard":
            limit = STANDARD_KILOBYTES
            report("  file", f"{kilobytes:.0f} KB", f"under {limit:g} KB", kilobytes < limit)


def main() -> None:
    """Measure and print."""
    skin = phototype(SKIN).skin
    print(f"tables of skin {SKIN}; median (least to most) of {REPEATS} runs, or one")
    report_spectra(skin)
    report_peer(skin)
    for skin in (SKIN, DARKEST):
        report_presets(skin)


if __name__ == "__main__":
    argparse.ArgumentParser("python -m examples.bench_tables", description=__doc__).parse_args()
    main()
