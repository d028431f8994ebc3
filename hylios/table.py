"""Look-up table of a skin's appearance over its tanning states.

What a table holds and how it lies in an EXR file, shared by the table builder, which writes it
with OpenImageIO, and by the add-on, which reads the pixels with Blender's own image loader.
numpy only.

The file is one float EXR with the channels R, G, B. Its pixels are the entries of `PLANES`, one
plane below the other from the top; within a plane a row holds the knots of the first axis, and
rows run over the knots of the remaining axes, the second axis fastest. The attribute
`skinTanTable` of its header holds everything else as JSON.
"""

import hashlib
import json
import struct
from collections.abc import Mapping
from dataclasses import MISSING, asdict, dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from hylios.errors import InputError
from hylios.tanning import PIGMENTATIONS, MelaninDynamics

FORMAT = "skin tan table"
FORMAT_VERSION = 1
HEADER_ATTRIBUTE = "skinTanTable"
PLANES = ("subsurface_colour", "total_colour", "band_reflectance", "profile_width")
"""What each plane of a table holds, three numbers to a state.

subsurface_colour
    Linear Rec.709 under D65 of light that has been inside the skin: the albedo of a shader.
total_colour
    The same with the light that the surface reflects: the colour a measurement sees.
band_reflectance
    Total reflectance at the three wavelengths `bands_nm` of the header.
profile_width
    Width d in mm of Burley's diffusion profile in the red, green and blue channel.
"""
STATE_NAMES = ("basale", "spinosum", "granulosum", "thickness")


@dataclass(frozen=True)
class StateAxes:
    """Coordinates of tanning states.

    A state is (melanin of basale, spinosum, granulosum, thickness), as `TanningHistory.states`
    has it. Its coordinates are the logarithm of its ratio to the untanned state, projected on
    the orthonormal columns of `basis`; the untanned skin lies at 0.

    Attributes
    ----------
    untanned : (4,) array
    basis : (4, K) array
    knots : K ascending arrays, each with at least one knot
    """

    untanned: np.ndarray
    basis: np.ndarray
    knots: tuple[np.ndarray, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of knots on each axis."""
        return tuple(len(axis) for axis in self.knots)

    def coordinates(self, states: np.ndarray) -> np.ndarray:
        """Coordinates (..., K) of states (..., 4).

        Raises
        ------
        InputError
            If a state has a number that is not above 0.
        """
        if not np.all((states > 0) & np.isfinite(states)):
            raise InputError("a tanning state has a number that is not above 0 and finite.")
        return np.log(states / self.untanned) @ self.basis

    def states(self, coordinates: np.ndarray) -> np.ndarray:
        """States (..., 4) at coordinates (..., K)."""
        return self.untanned * np.exp(coordinates @ self.basis.T)

    def knot_states(self) -> np.ndarray:
        """States at all knots, shape (*shape, 4)."""
        return self.states(np.stack(np.meshgrid(*self.knots, indexing="ij"), axis=-1))


@dataclass(frozen=True)
class SkinTable:
    """A skin's appearance at the knots of its tanning states.

    Attributes
    ----------
    axes : StateAxes
    values : (*axes.shape, len(PLANES), 3) array
    provenance : dict
        What made the table: specimen, pigmentation, wavelengths, rays, seed, errors, version.
    """

    axes: StateAxes
    values: np.ndarray
    provenance: dict

    def lookup(self, states: np.ndarray) -> np.ndarray:
        """Appearance (..., len(PLANES), 3) of tanning states (..., 4).

        Multilinear between the knots; beyond the outermost knots their value is held.
        """
        coordinates = self.axes.coordinates(states)
        result = np.zeros((*states.shape[:-1], *self.values.shape[-2:]))
        lows, weights = zip(
            *(_cell(axis, coordinates[..., k]) for k, axis in enumerate(self.axes.knots)),
            strict=True,
        )
        for corner in np.ndindex(*(2,) * len(lows)):
            index = tuple(
                np.minimum(low + step, len(axis) - 1)
                for low, step, axis in zip(lows, corner, self.axes.knots, strict=True)
            )
            weight = np.ones(states.shape[:-1])
            for step, fraction in zip(corner, weights, strict=True):
                weight = weight * (fraction if step else 1.0 - fraction)
            result += weight[..., None, None] * self.values[index]
        return result

    def plane(self, name: str, states: np.ndarray) -> np.ndarray:
        """One of `PLANES` at tanning states (..., 4), shape (..., 3)."""
        return self.lookup(states)[..., PLANES.index(name), :]


def _cell(knots: np.ndarray, position: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Index of the knot below each position, and how far it is to the next one, 0 to 1."""
    if len(knots) == 1:
        return np.zeros(position.shape, int), np.zeros(position.shape)
    low = np.clip(np.searchsorted(knots, position, side="right") - 1, 0, len(knots) - 2)
    fraction = (position - knots[low]) / (knots[low + 1] - knots[low])
    return low, np.clip(fraction, 0.0, 1.0)


def described_dynamics(dynamics: MelaninDynamics) -> dict[str, float | list[float]]:
    """Melanin dynamics as a table's provenance holds them, `melanin_dynamics`."""
    return {
        name: list(value) if isinstance(value, tuple) else value
        for name, value in asdict(dynamics).items()
    }


def melanin_dynamics(provenance: Mapping[str, Any]) -> MelaninDynamics:
    """How a table's skin makes melanin, from its provenance.

    The numbers in `melanin_dynamics`; a table that has none, as the first ones, says the name of
    a set of table 6.4 in `pigmentation`.

    Raises
    ------
    InputError
        If neither can be used.
    """
    if "melanin_dynamics" in provenance:
        return _dynamics_of(provenance["melanin_dynamics"])
    name = provenance.get("pigmentation")
    if not isinstance(name, str) or name not in PIGMENTATIONS:
        allowed = ", ".join(PIGMENTATIONS)
        raise InputError(f"the table's pigmentation is {name!r}; allowed are {allowed}.")
    return PIGMENTATIONS[name]


def _dynamics_of(described: Any) -> MelaninDynamics:
    rates = {each.name: each.default is MISSING for each in fields(MelaninDynamics)}
    if not isinstance(described, dict) or set(described) != set(rates):
        raise InputError(f"the table's melanin dynamics need the rates {', '.join(rates)}.")
    held = {}
    for name, per_layer in rates.items():
        numbers = described[name] if per_layer else [described[name]]
        count = 3 if per_layer else 1
        if not isinstance(numbers, list) or list(map(_is_number, numbers)) != [True] * count:
            expected = "3 numbers" if per_layer else "a number"
            raise InputError(
                f"the table's {name} is {str(described[name])[:40]}; expected {expected}."
            )
        values = [float(each) for each in numbers]
        held[name] = tuple(values) if per_layer else values[0]
    return MelaninDynamics(**held)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e300


def to_pixels(table: SkinTable) -> tuple[np.ndarray, str]:
    """Pixels (rows, columns, 3) from the top row on, float32, and the header's JSON text."""
    values = np.moveaxis(table.values, -2, 0)
    reversed_axes = values.transpose(0, *range(len(table.axes.shape), 0, -1), values.ndim - 1)
    pixels = np.ascontiguousarray(
        reversed_axes.reshape(-1, table.axes.shape[0], 3), dtype=np.float32
    )
    header = {
        "format": FORMAT,
        "format_version": FORMAT_VERSION,
        "planes": list(PLANES),
        "axes": {
            "state": list(STATE_NAMES),
            "unit": "natural logarithm of the ratio to the untanned state",
            "untanned": table.axes.untanned.tolist(),
            "basis": table.axes.basis.tolist(),
            "knots": [axis.tolist() for axis in table.axes.knots],
        },
        "provenance": table.provenance,
    }
    return pixels, json.dumps({**header, "checksum": _checksum(header, pixels)})


def from_pixels(pixels: np.ndarray, header_text: str) -> SkinTable:
    """The table in pixels (rows, columns, 3) from the top row on and its header's JSON text.

    Raises
    ------
    InputError
        If the header is not a table's, is of another version, or does not fit the pixels.
    """
    header = _parsed(header_text)
    try:
        described = header["axes"]
        axes = StateAxes(
            untanned=np.array(described["untanned"], dtype=float),
            basis=np.array(described["basis"], dtype=float),
            knots=tuple(np.array(axis, dtype=float) for axis in described["knots"]),
        )
        planes, provenance = header["planes"], header["provenance"]
        checksum = header.pop("checksum")
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"the table's header is incomplete: {error!r}.") from error
    _check_axes(axes)
    if planes != list(PLANES):
        raise InputError(f"the table's planes are {planes}; expected {list(PLANES)}.")
    pixels = np.ascontiguousarray(pixels, dtype=np.float32)
    rows = len(PLANES) * int(np.prod(axes.shape[1:]))
    if pixels.shape != (rows, axes.shape[0], 3):
        raise InputError(
            f"the table's image has shape {pixels.shape}; its header describes "
            f"{(rows, axes.shape[0], 3)}."
        )
    if _checksum(header, pixels) != checksum:
        raise InputError("the table does not match the checksum in its header.")
    stacked = pixels.astype(float).reshape(len(PLANES), *axes.shape[:0:-1], axes.shape[0], 3)
    values = stacked.transpose(*range(len(axes.shape), 0, -1), 0, stacked.ndim - 1)
    return SkinTable(axes=axes, values=np.ascontiguousarray(values), provenance=provenance)


def _parsed(header_text: str) -> dict:
    try:
        header = json.loads(header_text)
    except json.JSONDecodeError as error:
        raise InputError(f"the table's header is not JSON: {error}.") from error
    if not isinstance(header, dict) or header.get("format") != FORMAT:
        raise InputError(f"the file is not a {FORMAT}.")
    version = header.get("format_version")
    if version != FORMAT_VERSION:
        raise InputError(
            f"the table has format version {version}; this program reads {FORMAT_VERSION}."
        )
    return header


def _check_axes(axes: StateAxes) -> None:
    ascending = all(
        axis.ndim == 1 and axis.size and np.all(np.diff(axis) > 0) and np.all(np.isfinite(axis))
        for axis in axes.knots
    )
    fits = axes.untanned.shape == (4,) and axes.basis.shape == (4, len(axes.knots))
    finite = np.all(np.isfinite(axes.basis)) and np.all(axes.untanned > 0)
    if not (axes.knots and ascending and fits and finite):
        raise InputError("the table's axes are not four positive numbers, a basis and knots.")


def _checksum(header: dict, pixels: np.ndarray) -> str:
    digest = hashlib.sha256(json.dumps(header, sort_keys=True).encode())
    digest.update(pixels.astype("<f4").tobytes())
    return digest.hexdigest()


def header_text(path: Path) -> str:
    """The JSON text in the header of a table's EXR file, read without any image library.

    Also makes sure that the file is whole: Blender 5.0 crashes on one that was cut short.

    Raises
    ------
    InputError
        If the file cannot be read, is no EXR, is cut short, or has no such attribute.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"the table {path} cannot be read: {error.strerror}.") from error
    if data[:4] != b"\x76\x2f\x31\x01":
        raise InputError(f"{path} is not an OpenEXR file.")
    try:
        attributes, end = _exr_attributes(data)
        whole = _blocks_lie_inside(data, end)
    except (IndexError, ValueError, struct.error) as error:
        raise InputError(f"the table {path} is cut short or damaged.") from error
    if not whole:
        raise InputError(f"the table {path} is cut short or damaged.")
    if HEADER_ATTRIBUTE not in attributes:
        raise InputError(f"{path} is an OpenEXR file but not a {FORMAT}.")
    return attributes[HEADER_ATTRIBUTE].decode("utf-8", errors="replace")


def _exr_attributes(data: bytes) -> tuple[dict[str, bytes], int]:
    """Attributes of an EXR file's header by name, and where the header ends."""
    attributes, position = {}, 8
    while data[position]:
        end_of_name = data.index(b"\0", position)
        end_of_type = data.index(b"\0", end_of_name + 1)
        (size,) = struct.unpack_from("<i", data, end_of_type + 1)
        start = end_of_type + 5
        if size < 0:
            raise ValueError("an attribute of negative size")
        name = data[position:end_of_name].decode("latin-1")
        attributes[name] = data[start : start + size]
        position = start + size
    return attributes, position + 1


def _blocks_lie_inside(data: bytes, start: int) -> bool:
    """Whether all blocks of scan lines in an EXR file's list of offsets lie within the file."""
    (first,) = struct.unpack_from("<Q", data, start)
    offsets = struct.unpack_from(f"<{(first - start) // 8}Q", data, start)
    sizes = [struct.unpack_from("<i", data, offset + 4)[0] for offset in offsets]
    return all(
        size >= 0 and offset + 8 + size <= len(data)
        for offset, size in zip(offsets, sizes, strict=True)
    )
