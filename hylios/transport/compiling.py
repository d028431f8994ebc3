"""Compilation of the kernels, kept between processes (`hylios.transport.kernel_cache`).

numba's cache notices a change in the file of a compiled function, not in the functions that it
calls from other files. But it keeps closures over different values apart. So a kernel is a closure
over a digest of all sources in this folder and in the kernel's own.

Arrays are not counted by reference here (numba's `_nrt`): no kernel makes or keeps one, and
counting, by locked instructions wherever one is passed on, took a third of the time. Nor are
divisions checked (`error_model`): what could be 0 is tested where it is divided by.
"""

import hashlib
import inspect
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from numba import njit

from hylios.transport.kernel_cache import KernelCache

_OPTIONS: dict[str, Any] = {"_nrt": False, "forceinline": True, "error_model": "numpy"}


@cache
def digest_of_sources(folder: Path) -> str:
    """Digest of all Python files in this folder and in another."""
    digest = hashlib.sha256()
    for path in sorted({*Path(__file__).parent.glob("*.py"), *folder.glob("*.py")}):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def kernel(make: Callable[[str], Callable]) -> Callable:
    """Compile what `make` returns, given the digest over which it must close.

    It runs without the interpreter's lock. Where no folder can be written it is compiled anew in
    every process.
    """
    function = make(digest_of_sources(Path(inspect.getfile(make)).parent))
    compiled: Any = njit(nogil=True, **_OPTIONS)(function)
    try:
        compiled._cache = KernelCache(function)
    except RuntimeError:
        pass
    return compiled


def part(function: Callable) -> Callable:
    """Compile a function that kernels call."""
    return njit(**_OPTIONS)(function)
