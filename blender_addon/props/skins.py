"""The skins on offer, as items of an enumeration."""

import zlib
from collections.abc import Iterable, Sequence
from pathlib import Path

import bpy

from hylios.errors import InputError

from ..model.catalogue import FILE, SHIPPED, TYPES, ShippedTable, shipped_path, stamp

SKIN_LABELS = {
    "I": "Type I, very light",
    "II": "Type II, light",
    "III": "Type III, intermediate",
    "IV": "Type IV, tan",
    "V": "Type V, brown",
    "VI": "Type VI, dark",
    "S1": "Light, pale (S1)",
    "S2": "Light, ruddy (S2)",
    "S3": "Light (S3)",
    "S4": "Dark (S4)",
}
USUAL_SKINS = ("III", "S3")
"""A new object has the first of them that is shipped."""


def skin_items(tables: Iterable[ShippedTable]) -> tuple[tuple[str, str, str, int], ...]:
    """Items of the enumeration: shipped skins, then the user's own file.

    A skin's number follows from its name, so that files stay right when more skins are shipped.
    """
    shipped = tuple(
        (
            table.name,
            SKIN_LABELS.get(table.name, f"Skin ({table.name})"),
            _description(table),
            zlib.crc32(table.name.encode()) & 0x7FFFFFFF,
        )
        for table in tables
    )
    return (*shipped, (FILE, "Table File", "A skin table of your own, in an EXR file", 0))


def _description(table: ShippedTable) -> str:
    if table.problem:
        return f"This skin cannot be used, install the add-on anew: {table.problem}"
    if table.name in TYPES:
        return f"Fitzpatrick skin type {table.name}, fitted to measured people"
    return f"Skin {table.name} of the thesis" if table.name in SKIN_LABELS else f"Skin {table.name}"


def usual_skin(names: Sequence[str]) -> str:
    """The skin of a new object, out of those on offer."""
    return next((name for name in USUAL_SKINS if name in names), names[0])


def table_file(skin: str, table_path: str) -> Path:
    """Path of a skin's table; `table_path` counts for skin FILE alone.

    Raises
    ------
    InputError
        If none is set, if its file is not there, or if this add-on lacks the skin.
    """
    if skin != FILE:
        return shipped_path(skin)
    if not table_path:
        raise InputError("No table is set: choose the path of a skin table (an EXR file).")
    path = Path(bpy.path.abspath(table_path))
    stamp(path)
    return path


SKIN_ITEMS = skin_items(SHIPPED)
USUAL_SKIN = usual_skin([*(table.name for table in SHIPPED if not table.problem), FILE])
