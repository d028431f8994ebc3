"""Units of work that cost nothing, and a command that makes a file of them, for the tests."""

import argparse
import os
import sys
import time
from pathlib import Path

import numpy as np

from hylios.commands.shell import run
from hylios.errors import InputError
from lut_builder.commands.resumable import resumable
from lut_builder.jobs.cluster import on_cluster
from lut_builder.jobs.local import in_processes, in_threads
from lut_builder.jobs.run import run_units
from lut_builder.jobs.software import software_digest
from lut_builder.jobs.units import Unit


def walk(seed, length, pause=0.0, load=b""):
    """A random walk, its length and its ends; the product depends on the threads of BLAS."""
    time.sleep(pause)
    steps = np.random.default_rng(seed).normal(size=(length, 3))
    return {"product": steps.T @ steps, "ends": steps.sum(axis=0), "length": np.array(length)}


def fail(error):
    raise {"InputError": InputError, "ZeroDivisionError": ZeroDivisionError}[error]("it is 7.")


def die():
    os.kill(os.getpid(), 9)


def walks(count, pause=0.0):
    return [
        Unit(f"walk-{seed}", walk, (seed, 50 + 7 * seed, pause), size=50.0 + 7 * seed)
        for seed in range(count)
    ]


def local_runner(processes):
    return in_threads(1) if processes == 1 else in_processes(processes)


def make(arguments):
    with resumable(arguments, ".bin") as work:
        local = local_runner(arguments.processes)
        runner = on_cluster(arguments.dask) if arguments.dask else local
        units = walks(arguments.count, arguments.pause)
        results = run_units(units, work.folder, software_digest(), runner, "walks")
        arrays = [array for unit in results.values() for array in unit.values()]
        work.result.write_bytes(b"".join(array.tobytes() for array in arrays))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("output", type=Path)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--pause", type=float, default=0.0)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--dask")
    parser.add_argument("--resume", action="store_true")
    parser.add_argument("--force", action="store_true")
    return run(make, parser.parse_args())


def command(*arguments):
    """Shell command that runs `main`; units have to be of a module that others can import."""
    return [sys.executable, "-c", "import toy_work; exit(toy_work.main())", *map(str, arguments)]
