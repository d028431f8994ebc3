"""Threads: how many, work shared among them, and linear algebra kept to one.

The matrices of the light model are so small that OpenBLAS's threads only wait for each other, for
ten times the work's own time and more while other programs are busy. `one_thread` is the one
guard against that. It needs no package, because Blender's Python brings none for this.
"""

import ctypes
import os
import sys
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from threading import Lock
from typing import Any

import numpy as np

from hylios.errors import require_whole


def thread_count(threads: int | None) -> int:
    """Number of threads: as many as given, all cores for None or 0.

    Raises
    ------
    InputError
        If there are to be fewer than 0 or more than 1024.
    """
    return require_whole("number of threads", threads or os.cpu_count() or 1, 1, 1024)


def in_threads(function: Callable, tasks: Iterator, threads: int) -> Iterator:
    """Results as they end, with a few tasks waiting; on any exception the waiting ones are dropped.

    Kernels release the interpreter's lock, so threads run at once.
    """
    with ThreadPoolExecutor(max_workers=threads) as pool:
        running: set[Future] = set()
        try:
            for task in tasks:
                running.add(pool.submit(function, task))
                if len(running) >= 2 * threads:
                    ended, running = wait(running, return_when="FIRST_COMPLETED")
                    yield from (future.result() for future in ended)
            while running:
                ended, running = wait(running, return_when="FIRST_COMPLETED")
                yield from (future.result() for future in ended)
        finally:
            for future in running:
                future.cancel()


def in_order(function: Callable, tasks: Iterable, threads: int | None) -> Iterator:
    """Results of tasks in their order, whichever ends first, so that sums are the same."""
    waiting, due = {}, 0
    numbered = in_threads(
        lambda task: (task[0], function(task[1])), iter(enumerate(tasks)), thread_count(threads)
    )
    for number, result in numbered:
        waiting[number] = result
        while due in waiting:
            yield waiting.pop(due)
            due += 1


NAMES = ("openblas_{}_num_threads64_", "scipy_openblas_{}_num_threads64_")
NAMES += tuple(name.removesuffix("64_") for name in NAMES)
"""Of the functions that get and set the number, in the builds that numpy and scipy come with."""

MODULES = (
    "linalg/_umath_linalg*.*",
    "_fblas*.*",
    "../numpy.libs/*openblas*.dll",
    "../../scipy.libs/*openblas*.dll",
)
"""From the folders of numpy and scipy.linalg: modules that lead to the libraries that they need,
and these themselves, for Windows."""

Library = tuple[Callable[[], int], Callable[[int], Any]]
"""Functions that get and set the number of threads of one OpenBLAS."""


class _Users:
    """How many are within `one_thread`, and to what to return when the last one leaves."""

    def __init__(self) -> None:
        self.lock, self.count = Lock(), 0
        self.before: list[tuple[Library, int]] = []


_users = _Users()  # the number of threads is the process's


@contextmanager
def one_thread() -> Iterator[None]:
    """Have OpenBLAS work in one thread, in this process, until the last of all users has left.

    numpy's, and scipy's where it has been loaded. Where they come with anything else nothing
    happens.
    """
    libraries = loaded_libraries()
    with _users.lock:
        if _users.count == 0:
            _users.before = [(library, library[0]()) for library in libraries]
            _set([(library, 1) for library, threads in _users.before if threads > 1])
        _users.count += 1
    try:
        yield
    finally:
        with _users.lock:
            _users.count -= 1
            if _users.count == 0:
                _set([(library, threads) for library, threads in _users.before if threads > 1])


def _set(threads: list[tuple[Library, int]]) -> None:
    for (_, set_to), count in threads:
        set_to(count)


def loaded_libraries() -> tuple[Library, ...]:
    """OpenBLAS of numpy and of scipy, as far as loaded; empty where there is none."""
    linalg = sys.modules.get("scipy.linalg")
    folders = [Path(np.__file__).parent, *map(Path, getattr(linalg, "__path__", ())[:1])]
    return tuple(library for folder in folders if (library := _library(folder)))


@cache
def _library(folder: Path) -> Library | None:
    for pattern in MODULES:
        for path in folder.glob(pattern):
            try:
                library = ctypes.CDLL(str(path))
            except OSError:
                continue
            for name in NAMES:
                get = getattr(library, name.format("get"), None)
                if get is not None:
                    return get, getattr(library, name.format("set"))
    return None
