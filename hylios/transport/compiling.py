"""Compilation of the kernels, kept between processes.

numba's cache notices a change in the file of a compiled function, not in the functions that it
calls from other files. But it does keep apart functions that are closures over different values:
each kernel here is one over a digest of all sources of this package.

Arrays are not counted by reference here (numba's `_nrt`): no kernel makes or keeps one, and
counting, by locked instructions wherever one is passed on, took a third of the time. Nor are
divisions checked (`error_model`): what could be 0 is tested where it is divided by.
"""

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

from numba import njit

_OPTIONS: dict[str, Any] = {"_nrt": False, "forceinline": True, "error_model": "numpy"}


def _digest_of_sources() -> str:
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def kernel(make: Callable[[str], Callable]) -> Callable:
    """Compile what `make` returns, given the digest over which it must close.

    It runs without the interpreter's lock. Where no folder can be written it is compiled anew in
    every process.
    """
    function = make(_digest_of_sources())
    try:
        return njit(nogil=True, cache=True, **_OPTIONS)(function)
    except RuntimeError:
        return njit(nogil=True, **_OPTIONS)(function)


def part(function: Callable) -> Callable:
    """Compile a function that kernels call."""
    return njit(**_OPTIONS)(function)
