"""The digest of all that may change a result: sources, libraries, Python and the processor."""

import hashlib
import importlib.metadata
import platform
import sys
from functools import cache
from pathlib import Path

import hylios

LIBRARIES = ("colour-science", "numba", "numpy", "scipy")
"""Libraries whose versions may change the last digits of a result."""

SOURCES = {".py", ".csv", ".toml"}
"""Suffixes of the project's files that decide a result."""


@cache
def software_digest() -> str:
    """Digest of this project's sources and spectra, of Python, the libraries and the processor.

    Two machines on which it is the same give the same results, but for a processor of another
    generation, where a library may choose other instructions for its last digit.
    """
    digest = hashlib.sha256()
    for package in (Path(hylios.__file__).parent, Path(__file__).parent.parent):
        for path in sorted(package.rglob("*")):
            if path.suffix in SOURCES:
                digest.update(path.relative_to(package.parent).as_posix().encode())
                digest.update(hashlib.sha256(path.read_bytes()).digest())
    versions = [importlib.metadata.version(library) for library in LIBRARIES]
    digest.update(repr((versions, sys.version_info[:2], platform.machine())).encode())
    return digest.hexdigest()
