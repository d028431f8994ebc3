"""How a table lies in the channels and attributes of an EXR file (`docs/table_format.md`)."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hylios.errors import InputError
from hylios.table.axes import Axes, require_axes
from hylios.table.planes import MEANINGS, component_names, require_values
from hylios.table.schema import (
    FORMAT,
    described_axes,
    parsed,
    require_interpolation,
    require_planes,
    require_provenance,
)
from hylios.table.skin_table import SkinTable

HEADER_ATTRIBUTE = "skinTanTable"
CHECKSUM_ATTRIBUTE = "skinTanTableChecksum"
HALF, FLOAT = np.dtype("<f2"), np.dtype("<f4")


@dataclass(frozen=True)
class StoredTable:
    """A table as its file holds it.

    Attributes
    ----------
    channels : mapping of names to (rows, columns) arrays of 16 or 32 bit floats
        The top row first.
    header : str
        JSON text.
    checksum : str
        SHA-256 of the header and all channels, in hexadecimal.
    """

    channels: Mapping[str, np.ndarray]
    header: str
    checksum: str


def to_stored(table: SkinTable, *, half: bool = False) -> StoredTable:
    """A table as its file holds it, with floats of 32 bits, or of 16 where they will do.

    Raises
    ------
    InputError
        If the table is not one that could be read again.
    """
    require_planes(tuple(table.planes))
    require_interpolation(table.interpolation)
    require_axes(table.axes)
    require_provenance(table.provenance)
    planes, channels = {}, {}
    for name, values in table.planes.items():
        if name not in MEANINGS:
            raise InputError(f"there is no plane {name!r}; there are {', '.join(MEANINGS)}.")
        meaning, components = MEANINGS[name], component_names(name, table.provenance)
        if values.shape != (*table.axes.shape, len(components)):
            raise InputError(
                f"the plane {name} has shape {values.shape}; its axes and components give "
                f"{(*table.axes.shape, len(components))}."
            )
        planes[name] = {
            "components": list(components),
            "unit": meaning.unit,
            "says": meaning.says,
        }
        dtype = HALF if half and meaning.fits_half else FLOAT
        for component, numbers in zip(components, np.moveaxis(values, -1, 0), strict=True):
            channels[f"{name}.{component}"] = _pixels(name, numbers, dtype)
        require_values(name, values)
    header = json.dumps(_header(table, planes), allow_nan=False)
    return StoredTable(channels, header, checksum(header, channels))


def from_stored(stored: StoredTable) -> SkinTable:
    """The table in what a file holds; planes of a meaning that is not known here are left out.

    Raises
    ------
    InputError
        If the checksum does not fit, the header is not of the schema, or the pixels are not what
        it describes.
    """
    if checksum(stored.header, stored.channels) != stored.checksum:
        raise InputError("the table does not match its checksum.")
    header = parsed(stored.header)
    planes = {}
    for name, components in header.components.items():
        columns = [_values(stored, f"{name}.{one}", header.axes) for one in components]
        planes[name] = np.stack(columns, axis=-1)
        require_values(name, planes[name])
    return SkinTable(
        axes=header.axes,
        planes=planes,
        provenance=header.provenance,
        interpolation=header.interpolation,
    )


def _header(table: SkinTable, planes: dict[str, Any]) -> dict[str, Any]:
    version, axes = described_axes(table.axes)
    return {
        "format": FORMAT,
        "format_version": version,
        "interpolation": table.interpolation,
        "axes": axes,
        "planes": planes,
        "provenance": table.provenance,
    }


def _pixels(plane: str, numbers: np.ndarray, dtype: np.dtype) -> np.ndarray:
    """A component over the knots as pixels: the first axis along rows, the second down fastest."""
    with np.errstate(over="ignore"):
        pixels = np.ascontiguousarray(numbers.T.reshape(-1, len(numbers)), dtype=dtype)
    if not np.all(np.isfinite(pixels)):
        raise InputError(
            f"the plane {plane} has a number that is not finite or above {np.finfo(dtype).max:g}."
        )
    return pixels


def _values(stored: StoredTable, name: str, axes: Axes) -> np.ndarray:
    """The way back from `_pixels`."""
    if name not in stored.channels:
        raise InputError(f"the table has no channel {name}, which its header names.")
    pixels = stored.channels[name]
    shape = (int(np.prod(axes.shape[1:])), axes.shape[0])
    if pixels.shape != shape:
        raise InputError(
            f"the table's channel {name} has shape {pixels.shape}; its header describes {shape}."
        )
    if not np.all(np.isfinite(pixels)):
        raise InputError(f"the table's channel {name} has a number that is not finite.")
    return pixels.astype(float).reshape(axes.shape[::-1]).T


def checksum(header: str, channels: Mapping[str, np.ndarray]) -> str:
    """SHA-256 of a header and all channels, in hexadecimal."""
    digest = hashlib.sha256(header.encode())
    for name in sorted(channels):
        pixels = channels[name]
        rows, columns = pixels.shape
        pixel_type = "half" if pixels.dtype == HALF else "float"
        digest.update(f"\n{name} {pixel_type} {rows} {columns}\n".encode())
        digest.update(np.ascontiguousarray(pixels).tobytes())
    return digest.hexdigest()
