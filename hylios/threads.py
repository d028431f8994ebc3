"""Keeping linear algebra to one thread, without a package for it.

The matrices of `hylios.adding` are so small that OpenBLAS's threads only wait for each other, for
ten times the work's own time and more while other programs are busy. Blender sets no limit, nor
does it hold `threadpoolctl`.
"""

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from threading import Lock

import numpy as np

NAMES = ("openblas_{}_num_threads64_", "scipy_openblas_{}_num_threads64_")
NAMES += tuple(name.removesuffix("64_") for name in NAMES)
"""Of the functions that get and set the number, in the builds that numpy comes with."""


class _Users:
    """How many are within `one_thread`, and the threads to return to when the last one leaves."""

    def __init__(self) -> None:
        self.lock, self.count, self.threads = Lock(), 0, 1


_users = _Users()  # the number of threads is the process's


@contextmanager
def one_thread() -> Iterator[None]:
    """Have OpenBLAS work in one thread, in this process, until the last of all users has left.

    Where numpy comes with anything else nothing happens.
    """
    found = controls()
    if found is None:
        yield
        return
    get, set_to = found
    with _users.lock:
        if _users.count == 0:
            _users.threads = get()
            if _users.threads > 1:
                set_to(1)
        _users.count += 1
    try:
        yield
    finally:
        with _users.lock:
            _users.count -= 1
            if _users.count == 0 and _users.threads > 1:
                set_to(_users.threads)


@cache
def controls():
    """Functions that get and set the number of threads of numpy's OpenBLAS, None without one."""
    folder = Path(np.__file__).parent
    # a module leads to the libraries it needs, but on Windows
    libraries = [
        *folder.glob("linalg/_umath_linalg*.*"),
        *folder.glob("../numpy.libs/*openblas*.dll"),
    ]
    for path in libraries:
        try:
            library = ctypes.CDLL(str(path))
        except OSError:
            continue
        for name in NAMES:
            try:
                return getattr(library, name.format("get")), getattr(library, name.format("set"))
            except AttributeError:
                continue
    return None
