"""Units of work that cost nothing, and a command that makes a file of them, for the tests."""

import argparse
import os
import sys
import time
from pathlib import Path

import numpy as np

from hylios.commands.shell import run
from hylios.errors import InputError
from lut_builder.jobs.cluster import on_cluster
from lut_builder.jobs.work import Unit, done, in_processes, in_threads, software_digest, unfinished


def walk(seed, length, pause=0.0):
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


def make(asked):
    with unfinished(asked.target, (".bin",), resume=asked.resume, force=asked.force) as folder:
        runner = on_cluster(asked.dask) if asked.dask else local_runner(asked.processes)
        found = done(walks(asked.count, asked.pause), folder, software_digest(), runner, "walks")
        content = b"".join(array.tobytes() for each in found.values() for array in each.values())
        (folder / asked.target.name).write_bytes(content)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("target", type=Path)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--pause", type=float, default=0.0)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--dask")
    parser.add_argument("--resume", action="store_true")
    parser.add_argument("--force", action="store_true")
    asked = parser.parse_args()
    return run(make, asked)


def command(*arguments):
    """Shell command that runs `main`; units have to be of a module that others can import."""
    return [sys.executable, "-c", "import toy_work; exit(toy_work.main())", *map(str, arguments)]
