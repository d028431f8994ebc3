"""Writing and reading a `SkinTable` as an EXR file with OpenImageIO (layout: `hylios.table`)."""

from pathlib import Path

import numpy as np
import OpenImageIO as oiio  # noqa: N813 (its own documentation calls it so)

from hylios.errors import InputError
from hylios.files import written_beside
from hylios.table import HEADER_ATTRIBUTE, SkinTable, from_pixels, header_text, to_pixels


def write_table(path: Path, table: SkinTable) -> None:
    """Write a table beside its target and move it there, so that no half file is ever seen.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    pixels, header = to_pixels(table)
    specification = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], 3, oiio.FLOAT)
    specification.attribute("compression", "zip")
    specification.attribute("Software", table.provenance.get("software", "lut_builder"))
    specification.attribute(HEADER_ATTRIBUTE, header)
    # Else the hour of writing goes into the file, and equal tables are unequal files.
    specification.attribute("DateTime", "")
    with written_beside(path) as beside:
        output = oiio.ImageOutput.create(str(beside))
        if output is None:
            raise InputError(f"the table {path} cannot be written: {oiio.geterror()}.")
        written = output.open(str(beside), specification) and output.write_image(pixels)
        if not (output.close() and written):
            raise InputError(f"the table {path} cannot be written: {output.geterror()}.")
        _require_written(path, beside, header)


def read_table(path: Path) -> SkinTable:
    """Read a table.

    Raises
    ------
    InputError
        If the file cannot be read or is not a table.
    """
    header = header_text(path)
    image = oiio.ImageBuf(str(path))
    pixels = image.get_pixels(oiio.FLOAT)
    if image.has_error or pixels is None:
        raise InputError(f"the table {path} cannot be read: {image.geterror()}.")
    return from_pixels(np.asarray(pixels), header)


def _require_written(path: Path, beside: Path, header: str) -> None:
    """Raise InputError unless the file reads back: a full disk goes unnoticed otherwise."""
    try:
        kept = header_text(beside) == header and read_table(beside) is not None
    except InputError:
        kept = False
    if not kept:
        raise InputError(f"the table {path} cannot be written: it does not read back.")
