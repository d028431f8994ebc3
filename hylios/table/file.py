"""Reading a table's file."""

import os

from hylios.errors import InputError, shown
from hylios.files import as_path, regular_bytes
from hylios.table.exr_reader import Picture, parse
from hylios.table.schema import FORMAT
from hylios.table.skin_table import SkinTable
from hylios.table.stored import CHECKSUM_ATTRIBUTE, HEADER_ATTRIBUTE, StoredTable, from_stored

LARGEST_FILE = 64 * 2**20
"""Most bytes of a file; the largest tables have a hundredth of that."""


def read_table(path: str | os.PathLike[str]) -> SkinTable:
    """Read a table's EXR file.

    Raises
    ------
    InputError
        If the file cannot be read, is no table, or is cut short or damaged in any way.

    Examples
    --------
    >>> import hylios
    >>> table = hylios.read_table("skin.exr")  # doctest: +SKIP
    """
    path = as_path(path)
    data = regular_bytes(path, LARGEST_FILE)
    try:
        return from_stored(_stored(parse(data)))
    except InputError as error:
        raise InputError(f"the table {shown(path)} cannot be used: {error}") from error


def _stored(picture: Picture) -> StoredTable:
    if HEADER_ATTRIBUTE not in picture.attributes:
        raise InputError(f"it is an OpenEXR file but not a {FORMAT}.")
    text, checksum = (
        picture.attributes.get(name, b"").decode("utf-8", errors="replace")
        for name in (HEADER_ATTRIBUTE, CHECKSUM_ATTRIBUTE)
    )
    return StoredTable(picture.channels, text, checksum)
