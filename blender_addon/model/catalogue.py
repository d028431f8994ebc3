"""Skin tables: those that come with the add-on, and any file of the user's."""

import functools
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hylios.errors import InputError
from hylios.table import SkinTable, read_table

FOLDER = Path(__file__).parent.parent / "tables"
TYPES = ("I", "II", "III", "IV", "V", "VI")
"""Skin types, in the order in which they are offered, before all other skins."""

FILE = "FILE"
"""Stands for a table in a file of the user's own."""


@dataclass(frozen=True)
class ShippedTable:
    """A table in the add-on's own folder.

    Attributes
    ----------
    name : str
        The skin type or specimen, such as III or S3.
    path : Path
    problem : str
        Why it cannot be used, in a sentence; empty where it can.
    """

    name: str
    path: Path
    problem: str = ""


def shipped_tables(folder: Path = FOLDER) -> tuple[ShippedTable, ...]:
    """The tables in a folder, types first; one that cannot be used does not hide the others."""
    paths = sorted(folder.glob("*.exr"), key=lambda path: in_order(path.stem))
    return tuple(map(_shipped, paths))


def _shipped(path: Path) -> ShippedTable:
    try:
        provenance(path)
    except InputError as error:
        return ShippedTable(path.stem, path, problem=str(error))
    return ShippedTable(path.stem, path)


def in_order(name: str) -> tuple[int, str]:
    """Key that sorts skins by name as they are offered: types I to VI, then the others."""
    return (TYPES.index(name) if name in TYPES else len(TYPES), name)


def shipped_path(name: str) -> Path:
    """Path of the table of a shipped skin.

    Raises
    ------
    InputError
        If this add-on has no such skin.
    """
    for table in SHIPPED:
        if table.name == name:
            return table.path
    names = ", ".join(table.name for table in SHIPPED) or "none"
    raise InputError(f"Skin is {name!r}; this add-on comes with {names}.")


def table(path: Path) -> SkinTable:
    """The table in a file; read again only when the file has changed, even where it is no table.

    Raises
    ------
    InputError
        If the file cannot be read or is not a table.
    """
    return _or_raise(_table(path, *stamp(path)))


def provenance(path: Path) -> dict[str, Any]:
    """What made a table; as cheap as `table`, with the same errors."""
    return _or_raise(_provenance(path, *stamp(path)))


@dataclass(frozen=True)
class _Failure:
    """Why a file could not be read: an exception would not be remembered by a cache."""

    sentence: str


def _or_raise(result):
    if isinstance(result, _Failure):
        raise InputError(result.sentence)
    return result


def stamp(path: Path) -> tuple[int, int]:
    """Numbers that change with a file's contents."""
    try:
        status = path.stat()
    except (OSError, ValueError) as error:  # a name may hold what no file's can
        why = getattr(error, "strerror", None) or error
        raise InputError(f"the table {path} cannot be read: {why}.") from error
    return status.st_mtime_ns, status.st_size


@functools.lru_cache(maxsize=4)
def _table(path: Path, modified: int, size: int) -> SkinTable | _Failure:
    try:
        return read_table(path)
    except InputError as error:
        return _Failure(str(error))


@functools.lru_cache(maxsize=64)
def _provenance(path: Path, modified: int, size: int) -> dict[str, Any] | _Failure:
    read = _table(path, modified, size)
    return read if isinstance(read, _Failure) else dict(read.provenance)


SHIPPED = shipped_tables()
