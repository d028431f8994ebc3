"""How a table lies in the channels and attributes of an EXR file (`docs/table_format.md`)."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hylios.errors import InputError
from hylios.table.axes import AXIS_UNIT, STATE_NAMES, StateAxes, require_axes
from hylios.table.interpolation import INTERPOLATIONS
from hylios.table.planes import MEANINGS, component_names
from hylios.table.table import SkinTable

FORMAT = "skin tan table"
FORMAT_VERSION = 3
HEADER_ATTRIBUTE = "skinTanTable"
CHECKSUM_ATTRIBUTE = "skinTanTableChecksum"
HALF, FLOAT = np.dtype("<f2"), np.dtype("<f4")
LONGEST_HEADER = 1_000_000


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
    _require_planes(tuple(table.planes))
    _require_interpolation(table.interpolation)
    require_axes(table.axes)
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
    try:
        header = json.dumps(_header(table, planes), allow_nan=False)
    except ValueError as error:
        raise InputError("the table's provenance has a number that is not finite.") from error
    return StoredTable(channels, header, _checksum(header, channels))


def from_stored(stored: StoredTable) -> SkinTable:
    """The table in what a file holds; planes of a meaning that is not known here are left out.

    Raises
    ------
    InputError
        If the checksum or the header's description does not fit, or if no table can be like it.
    """
    if _checksum(stored.header, stored.channels) != stored.checksum:
        raise InputError("the table does not match its checksum.")
    header = _parsed(stored.header)
    try:
        components = {
            name: tuple(map(str, described["components"]))
            for name, described in header["planes"].items()
            if name in MEANINGS
        }
        axes = StateAxes(
            untanned=_numbers(header["axes"]["untanned"]),
            basis=_numbers([axis["direction"] for axis in header["axes"]["list"]]).T,
            knots=tuple(_numbers(axis["knots"]) for axis in header["axes"]["list"]),
        )
        provenance, interpolation = header["provenance"], header["interpolation"]
    except (AttributeError, KeyError, OverflowError, TypeError, ValueError) as error:
        raise InputError(f"the table's header is incomplete: {str(error)[:80]!r}.") from error
    require_axes(axes)
    _require_planes(tuple(components))
    _require_interpolation(interpolation)
    if not isinstance(provenance, dict):
        raise InputError("the table does not say what made it.")
    for name, found in components.items():
        if found != component_names(name, provenance):
            raise InputError(f"the table's plane {name} has the components {', '.join(found)}.")
    return SkinTable(
        axes=axes,
        planes={
            name: np.stack([_values(stored, f"{name}.{each}", axes) for each in own], axis=-1)
            for name, own in components.items()
        },
        provenance=provenance,
        interpolation=interpolation,
    )


def _header(table: SkinTable, planes: dict[str, Any]) -> dict[str, Any]:
    directions = zip(table.axes.basis.T, table.axes.knots, strict=True)
    return {
        "format": FORMAT,
        "format_version": FORMAT_VERSION,
        "interpolation": table.interpolation,
        "axes": {
            "state": list(STATE_NAMES),
            "untanned": table.axes.untanned.tolist(),
            "list": [
                {
                    "name": f"principal axis {number}",
                    "unit": AXIS_UNIT,
                    "direction": direction.tolist(),
                    "knots": knots.tolist(),
                }
                for number, (direction, knots) in enumerate(directions, start=1)
            ],
        },
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


def _values(stored: StoredTable, name: str, axes: StateAxes) -> np.ndarray:
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


def _checksum(header: str, channels: Mapping[str, np.ndarray]) -> str:
    digest = hashlib.sha256(header.encode())
    for name in sorted(channels):
        pixels = channels[name]
        rows, columns = pixels.shape
        pixel_type = "half" if pixels.dtype == HALF else "float"
        digest.update(f"\n{name} {pixel_type} {rows} {columns}\n".encode())
        digest.update(np.ascontiguousarray(pixels).tobytes())
    return digest.hexdigest()


def _require_interpolation(name: Any) -> None:
    if name not in INTERPOLATIONS:
        raise InputError(
            f"the table's interpolation is {str(name)[:20]!r}; allowed are "
            f"{', '.join(INTERPOLATIONS)}."
        )


def _require_planes(names: tuple[str, ...]) -> None:
    if not names:
        raise InputError("the table has no plane that has a meaning.")


def _parsed(text: str) -> dict[str, Any]:
    if len(text) > LONGEST_HEADER:
        raise InputError(
            f"the table's header has {len(text)} characters; allowed are {LONGEST_HEADER}."
        )
    try:
        header = json.loads(text, parse_float=_finite, parse_constant=_finite)
    except (RecursionError, ValueError) as error:
        raise InputError(f"the table's header is not JSON: {str(error)[:80]}.") from error
    if not isinstance(header, dict) or header.get("format") != FORMAT:
        raise InputError(f"the file is not a {FORMAT}.")
    version = header.get("format_version")
    if version != FORMAT_VERSION:
        raise InputError(
            f"the table has format version {str(version)[:20]}; this program reads "
            f"{FORMAT_VERSION}."
        )
    return header


def _finite(text: str) -> float:
    number = float(text)
    if not np.isfinite(number):
        raise ValueError(f"{text[:20]} is no finite number")
    return number


def _numbers(listed: Any) -> np.ndarray:
    return np.array(listed, dtype=float)
