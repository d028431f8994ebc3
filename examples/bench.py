"""What this machine does: light, tanning and a small table, timed on this run.

python -m examples.bench
"""

import os
import statistics
import time
from collections.abc import Callable

import numpy as np

from hylios.skin import skin
from hylios.specimen import SPECIMENS
from hylios.tanning import PIGMENTATIONS, Exposures, simulate
from hylios.transport.simulate import spectrum
from lut_builder.build import PRESETS, build

REPEATS = 5
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
    """Seconds of each of some runs, after one that is not counted."""
    work()
    seconds = []
    for _ in range(repeats):
        start = clock()
        work()
        seconds.append(clock() - start)
    return seconds


def report(what: str, figures: list[float], unit: str) -> None:
    """One line: median, least and most."""
    print(
        f"{what:<58} {statistics.median(figures):>10.4g} {unit}"
        f"  ({min(figures):.4g} to {max(figures):.4g}, {len(figures)} runs)"
    )


def main() -> None:
    """Measure and print."""
    print(f"{os.cpu_count()} cores; median, least and most of {REPEATS} runs")
    for name in ("S3", "S4"):
        for as_printed, rays in RAYS.items():
            way = "as printed" if as_printed else "exact equivalents"

            def light(name=name, as_printed=as_printed, rays=rays):
                spectrum(SPECIMENS[name], VISIBLE, rays=rays, threads=1, as_printed=as_printed)

            seconds = timed(light, clock=time.process_time)
            rates = [VISIBLE.size * rays / each for each in seconds]
            report(f"light, {name}, 400 to 700 nm, one core, {way}", rates, "rays/s")
    print(f"{'  the thesis, per core':<58} {THESIS_RAYS_PER_SECOND:>10.4g} rays/s")

    def year(histories):
        doses = np.linspace(0.0, 30.0, histories)[:, None]
        exposures = Exposures([0], doses)
        return simulate(exposures, PIGMENTATIONS["low"], mmd=2.89, med=1.7, hours=8760)

    report("tanning, a year in hours, one history", timed(lambda: year(1)), "s")
    report("tanning, a year in hours, 1000 histories", timed(lambda: year(1000), 1), "s")
    small = PRESETS["small"]
    report(
        f"table, preset small, {small.states} states, all cores",
        timed(lambda: build(skin(SPECIMENS["S3"]), small), 1),
        "s",
    )


if __name__ == "__main__":
    main()
