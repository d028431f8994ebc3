"""Times light transport, tanning, tables and the add-on on this machine: `make bench`."""

import argparse
import itertools
import multiprocessing
import os
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from importlib.util import find_spec

import numpy as np

from blender_addon.model.catalogue import shipped_path
from blender_addon.model.look import look
from examples import bench_history, bench_tables
from examples.bench_lines import milliseconds, report_at_most
from hylios.adding.redness import erythema
from hylios.changed_table import changed_table
from hylios.skin import whole_thickening
from hylios.skin.biology import Biology
from hylios.skin.phototypes import phototype
from hylios.skin.specimen import SPECIMENS
from hylios.table import minimal_doses, read_table
from hylios.tanning import PIGMENTATIONS, Exposures, states_at
from hylios.transport.simulate import spectrum

REPEATS = 5
REDNESS_REPEATS, REDNESS_LIMIT = 40, 2.0
"""Years of redness, and milliseconds at most of the processor that it adds to one."""

RAYS = {False: 20_000, True: 1000}
"""Per wavelength, of light as the thesis prints it (True) and in exact equivalents."""

VISIBLE = np.arange(400.0, 701.0, 5.0)
THESIS_RAYS_PER_SECOND = VISIBLE.size * 1e5 / 30.0 / 12.0
"""61 wavelengths of 1e5 rays in about 30 s on 12 cores (section 6.1.4)."""


def timed(
    work: Callable[[], object],
    repeats: int = REPEATS,
    clock: Callable[[], float] = time.perf_counter,
) -> list[float]:
    """Seconds of `repeats` runs, after one that is not counted."""
    work()
    seconds = []
    for _ in range(repeats):
        start = clock()
        work()
        seconds.append(clock() - start)
    return seconds


def report(what: str, runs: list[float], unit: str) -> None:
    """Print a line: median, least and most of some runs."""
    print(
        f"{what:<58} {statistics.median(runs):>10.4g} {unit}"
        f"  ({min(runs):.4g} to {max(runs):.4g}, {len(runs)} runs)"
    )


def a_year(doses: np.ndarray) -> np.ndarray:
    """States (..., 366, 4) on each day of a year in steps of an hour, of doses (..., 52) a week."""
    return states_at(
        Exposures(168 * np.arange(52), doses),
        PIGMENTATIONS["low"],
        times=24.0 * np.arange(366),
        mmd=2.89,
        med=1.7,
    )


def many_years(histories: int) -> tuple[float, float, bool]:
    """Seconds, most memory of this process in MiB, and whether histories equal those made alone."""
    doses = np.random.default_rng(1).uniform(0.0, 30.0, (histories, 52))
    started = time.perf_counter()
    states = a_year(doses)
    seconds = time.perf_counter() - started
    mebibytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    sample = range(0, histories, max(histories // 100, 1))
    return seconds, mebibytes, all(np.array_equal(states[i], a_year(doses[i])) for i in sample)


def report_tanning() -> None:
    """A year of one skin, and of ten thousand in a process of their own."""
    year_of_doses = np.random.default_rng(1).uniform(0.0, 30.0, 52)
    milliseconds = [1e3 * seconds for seconds in timed(lambda: a_year(year_of_doses), 20)]
    report("tanning, a year in hours, one history", milliseconds, "ms")
    runs = []
    for _ in range(3):
        with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as process:
            runs.append(process.submit(many_years, 10_000).result())
    seconds, mebibytes, equal = zip(*runs, strict=True)
    report("tanning, a year in hours, 10,000 histories", list(seconds), "s")
    report("  memory of that process at most", list(mebibytes), "MiB")
    same = "yes" if all(equal) else "NO"
    print(f"  a hundred of them equal to the last bit those made alone: {same}")


def report_redness() -> None:
    """What redness, and a skin all of which thickens with it, add to a year told by the hour."""
    skin = phototype("II").skin
    doses = np.random.default_rng(1).uniform(0.3 * skin.med, 2.0 * skin.med, 365)
    exposures, reddening = Exposures(12 + 24 * np.arange(365), doses), erythema(skin)

    def a_year_of_hours(run: int) -> None:
        told = skin.history(exposures, 24 * 365, erythema=reddening if run % 2 else None)
        if run % 2:
            whole_thickening(told.states)

    spent = np.array(milliseconds(a_year_of_hours, 2 * REDNESS_REPEATS)).reshape(-1, 2)
    added = (spent[:, 1] - spent[:, 0])[1:]
    report_at_most("redness, added to a year of daily sun", added.tolist(), "ms", REDNESS_LIMIT)


def report_biology() -> None:
    """Processor time of a slider of biology: the changed table while it is dragged, and at rest."""
    table = read_table(shipped_path("III"))
    minimal = minimal_doses(table.provenance)
    for way, rough in (("dragged", True), ("at rest", False)):
        blood = itertools.count(1.1, 0.01)
        seconds = timed(
            lambda rough=rough, blood=blood: look(
                changed_table(table, Biology(blood=next(blood)), rough=rough), minimal
            ),
            clock=time.process_time,
        )
        report(f"biology {way}, the look", [1e3 * one for one in seconds], "ms")


def main() -> None:
    """Measure and print."""
    print(f"{os.cpu_count()} cores; median, least and most of {REPEATS} runs")
    for name in ("S3", "S4"):
        for as_printed, rays in RAYS.items():
            way = "as printed" if as_printed else "exact equivalents"

            def light(name=name, as_printed=as_printed, rays=rays):
                spectrum(SPECIMENS[name], VISIBLE, rays=rays, threads=1, as_printed=as_printed)

            seconds = timed(light, clock=time.process_time)
            rates = [VISIBLE.size * rays / passed for passed in seconds]
            report(f"light, {name}, 400 to 700 nm, one core, {way}", rates, "rays/s")
    print(f"{'  the thesis, per core':<58} {THESIS_RAYS_PER_SECOND:>10.4g} rays/s")

    report_tanning()
    report_redness()
    report_biology()
    bench_history.main()
    bench_tables.main()
    report_blender()


def report_blender() -> None:
    """The add-on's times, in a process of its own, as Blender brings its own libraries."""
    if find_spec("bpy") is None:
        print("no Blender here: nothing is said of the add-on")
        return
    subprocess.run([sys.executable, "-m", "examples.bench_blender"], check=True)


if __name__ == "__main__":
    argparse.ArgumentParser("python -m examples.bench", description=__doc__).parse_args()
    main()
