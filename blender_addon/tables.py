"""Skin tables: those that come with the add-on, and any file of the user's."""

import functools
from dataclasses import dataclass
from pathlib import Path

import bpy

from hylios.errors import InputError
from hylios.table import read_table

FOLDER = Path(__file__).parent / "tables"
TYPES = ("I", "II", "III", "IV", "V", "VI")
"""Skin types, in the order in which they are offered, before all other skins."""


@dataclass(frozen=True)
class MinimalDoses:
    """Doses in SED from which skin tans (`mmd`) and burns (`med`)."""

    mmd: float
    med: float


@dataclass(frozen=True)
class ShippedTable:
    """A table in the add-on's own folder.

    Attributes
    ----------
    name : str
        The skin type or specimen, such as III or S3.
    pigmentation : str
        Its constitutive pigmentation: low, intermediate or high.
    path : Path
    """

    name: str
    pigmentation: str
    path: Path


def shipped_tables() -> tuple[ShippedTable, ...]:
    """The tables in the add-on's folder, types first; none where it was not built with any."""
    return tuple(
        ShippedTable(path.stem, provenance(path).get("pigmentation", ""), path)
        for path in sorted(FOLDER.glob("*.exr"), key=lambda path: in_order(path.stem))
    )


def in_order(name: str) -> tuple[int, str]:
    """Key that sorts skins by name as they are offered: types I to VI, then the others."""
    return (TYPES.index(name) if name in TYPES else len(TYPES), name)


def table_path(skin: str, chosen: str) -> Path:
    """Path of the table of a shipped skin by name, or of the chosen file where skin is FILE.

    Raises
    ------
    InputError
        If no file is chosen, or if this add-on has no such skin.
    """
    if skin == "FILE":
        if not chosen:
            raise InputError("No table is chosen: set the path of a skin table (an EXR file).")
        return Path(bpy.path.abspath(chosen))
    for table in SHIPPED:
        if table.name == skin:
            return table.path
    names = ", ".join(table.name for table in SHIPPED) or "none"
    raise InputError(f"Skin is {skin!r}; this add-on comes with {names}.")


def provenance(path: Path) -> dict:
    """What made a table; read again only when the file has changed.

    Raises
    ------
    InputError
        If the file cannot be read or is not a table.
    """
    try:
        modified = path.stat().st_mtime_ns
    except OSError as error:
        raise InputError(f"the table {path} cannot be read: {error.strerror}.") from error
    return _provenance(path, modified)


@functools.lru_cache(maxsize=16)
def _provenance(path: Path, modified: int) -> dict:
    return read_table(path).provenance


def minimal_doses(described: dict) -> MinimalDoses:
    """Minimal doses of a table's skin from its provenance.

    Raises
    ------
    InputError
        If the provenance has none.
    """
    try:
        return MinimalDoses(mmd=float(described["mmd_sed"]), med=float(described["med_sed"]))
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"the table has no usable minimal dose: {error!r}.") from error


SHIPPED = shipped_tables()
