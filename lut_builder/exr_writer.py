"""Writing a `SkinTable` as an EXR file with OpenImageIO (layout: `docs/table_format.md`)."""

import tempfile
from pathlib import Path

import numpy as np
import OpenImageIO as oiio  # noqa: N813 (its own documentation calls it so)

from hylios.errors import InputError
from hylios.files import written_beside
from hylios.table import (
    CHECKSUM_ATTRIBUTE,
    HEADER_ATTRIBUTE,
    SkinTable,
    StoredTable,
    read_table,
    to_stored,
)


def write_table(path: Path, table: SkinTable, *, half: bool = False) -> None:
    """Write a table beside its target and move it there, so that no half file is ever seen.

    Parameters
    ----------
    half : bool
        Whether to store numbers of 16 bits, but in planes of counts, in place of 32.

    Raises
    ------
    InputError
        If the table is none that could be read again, or the file cannot be written.
    """
    stored = to_stored(table, half=half)
    channels = list(stored.channels.values())
    specification = _specification(stored, table.provenance.get("software", "lut_builder"))
    pixels = np.stack(channels, axis=-1, dtype=np.float32)
    try:
        content = _encoded(specification, pixels)
    except OSError as error:
        raise InputError(f"the table {path} cannot be written: {error}.") from error
    with written_beside(path) as beside:
        beside.write_bytes(content)
        _require_written(path, beside, stored, half)


def _encoded(specification: oiio.ImageSpec, pixels: np.ndarray) -> bytes:
    """The bytes of a file, by way of one whose name OpenImageIO takes: a path may be no UTF-8."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "table.exr"
        output = oiio.ImageOutput.create(str(file))
        if output is None:
            raise OSError(oiio.geterror())
        written = output.open(str(file), specification) and output.write_image(pixels)
        if not (output.close() and written):
            raise OSError(output.geterror())
        return file.read_bytes()


def _specification(stored: StoredTable, software: str) -> oiio.ImageSpec:
    channels = list(stored.channels.values())
    rows, columns = channels[0].shape
    specification = oiio.ImageSpec(columns, rows, len(channels), oiio.FLOAT)
    specification.channelnames = tuple(stored.channels)
    specification.channelformats = tuple(
        oiio.TypeHalf if pixels.dtype == np.float16 else oiio.TypeFloat for pixels in channels
    )
    specification.attribute("compression", "zip")
    specification.attribute("Software", software)
    specification.attribute(HEADER_ATTRIBUTE, stored.header)
    specification.attribute(CHECKSUM_ATTRIBUTE, stored.checksum)
    # Else the hour of writing goes into the file, and equal tables are unequal files.
    specification.attribute("DateTime", "")
    return specification


def _require_written(path: Path, beside: Path, stored: StoredTable, half: bool) -> None:
    """Raise InputError unless the file reads back: a full disk goes unnoticed otherwise."""
    try:
        kept = to_stored(read_table(beside), half=half).checksum == stored.checksum
    except InputError:
        kept = False
    if not kept:
        raise InputError(f"the table {path} cannot be written: it does not read back.")
