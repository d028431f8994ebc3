"""Reading of OpenEXR files in plain Python: single part, scan lines, none or ZIP compression.

After the file layout in OpenEXR's own documentation. Nothing in a file is believed before it is
checked: the size that it states is compared with its length before any memory is taken.
"""

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from hylios.errors import InputError

MAGIC = b"\x76\x2f\x31\x01"
VERSION = 2
LONG_NAMES = 0x400
LINES_PER_BLOCK = {0: 1, 2: 1, 3: 16}
"""Lines in a block, by OpenEXR's number of the compression: none, ZIPS (single lines), ZIP."""

PIXEL_TYPES = {1: np.dtype("<f2"), 2: np.dtype("<f4")}
LARGEST_PICTURE = 64 * 2**20
"""Most bytes of all pixels."""

LARGEST_DEFLATION = 1032
"""Most bytes that deflate gives from one byte of a file."""


@dataclass(frozen=True)
class Picture:
    """What an EXR file holds.

    Attributes
    ----------
    attributes : dict
        Bytes of each attribute of the header, by name.
    channels : dict
        Pixels (rows, columns) by name, the top row first, float16 or float32.
    """

    attributes: dict[str, bytes]
    channels: dict[str, np.ndarray]


def parse(data: bytes) -> Picture:
    """The attributes and channels in the bytes of an EXR file.

    Raises
    ------
    InputError
        If they are no EXR file, one cut short or damaged, or one of a kind not read here.
    """
    if data[:4] != MAGIC:
        raise InputError("it is not an OpenEXR file.")
    try:
        (version,) = struct.unpack_from("<I", data, 4)
        if version & ~LONG_NAMES != VERSION:
            raise InputError("it is not an OpenEXR file of one part with scan lines.")
        attributes, end = _attributes(data)
        return Picture(attributes, _channels(data, attributes, end))
    except InputError:
        raise
    except (IndexError, KeyError, OverflowError, ValueError, struct.error, zlib.error) as error:
        raise InputError("it is cut short or damaged.") from error


def _attributes(data: bytes) -> tuple[dict[str, bytes], int]:
    """Attributes of the header by name, and where the header ends."""
    attributes, position = {}, 8
    while data[position]:
        end_of_name = data.index(b"\0", position)
        end_of_type = data.index(b"\0", end_of_name + 1)
        (size,) = struct.unpack_from("<i", data, end_of_type + 1)
        start = end_of_type + 5
        if not 0 <= size <= len(data) - start:
            raise ValueError("an attribute beyond the end")
        name = data[position:end_of_name].decode("latin-1")
        attributes[name] = data[start : start + size]
        position = start + size
    return attributes, position + 1


def _channels(data: bytes, attributes: dict[str, bytes], start: int) -> dict[str, np.ndarray]:
    """Pixels by channel; `start` is where the list of the blocks' places begins."""
    kinds = dict(_channel_kinds(attributes["channels"]))
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    columns, rows = right - left + 1, bottom - top + 1
    row_bytes = columns * sum(kind.itemsize for kind in kinds.values())
    most = min(LARGEST_PICTURE, LARGEST_DEFLATION * len(data))
    if columns < 1 or rows < 1 or not 0 < row_bytes * rows <= most:
        raise ValueError("a picture of impossible size")
    compression = attributes["compression"][0]
    if compression not in LINES_PER_BLOCK:
        raise InputError("its compression is not ZIP, ZIPS or none.")
    lines = LINES_PER_BLOCK[compression]
    places = struct.unpack_from(f"<{-(-rows // lines)}Q", data, start)
    pixels = np.zeros((rows, row_bytes), dtype=np.uint8)
    for first, place in zip(range(0, rows, lines), places, strict=True):
        block = pixels[first : first + lines]
        packed = _block(data, place, top + first)
        # A block that deflate would not make smaller is stored as it is.
        whole = compression == 0 or len(packed) == block.size
        raw = packed if whole else _inflated(packed, block.size)
        block[:] = np.frombuffer(raw, dtype=np.uint8).reshape(block.shape)
    return dict(_parted(pixels, kinds, columns))


def _block(data: bytes, place: int, line: int) -> bytes:
    """What a block holds that is to begin with a line."""
    first, size = struct.unpack_from("<2i", data, place)
    if first != line or not 0 <= size <= len(data) - place - 8:
        raise ValueError("a block out of its place")
    return data[place + 8 : place + 8 + size]


def _channel_kinds(listed: bytes) -> Iterator[tuple[str, np.dtype]]:
    """Name and pixel type of each channel, in the order of the file."""
    position, names = 0, set()
    while listed[position]:
        end = listed.index(b"\0", position)
        name = listed[position:end].decode("latin-1")
        kind, _, across, down = struct.unpack_from("<iIii", listed, end + 1)
        if name in names or (across, down) != (1, 1):
            raise ValueError("a channel twice or of fewer pixels")
        if kind not in PIXEL_TYPES:
            raise InputError(f"its channel {name!r} is not of floats.")
        names.add(name)
        yield name, PIXEL_TYPES[kind]
        position = end + 17


def _inflated(packed: bytes, size: int) -> bytes:
    """Bytes of a block's pixels.

    OpenEXR puts all even bytes before the odd ones and has deflate pack differences of neighbours.
    """
    inflate = zlib.decompressobj()
    # One byte more shows a block that is too large, and a bomb goes no further.
    inflated = inflate.decompress(packed, size + 1)
    if len(inflated) != size or not inflate.eof:
        raise ValueError("a block of another size")
    differences = np.frombuffer(inflated, dtype=np.uint8).copy()
    differences[1:] -= 128
    values = np.cumsum(differences, dtype=np.uint8)
    pixels = np.empty_like(values)
    half = (size + 1) // 2
    pixels[0::2], pixels[1::2] = values[:half], values[half:]
    return pixels.tobytes()


def _parted(
    pixels: np.ndarray, kinds: dict[str, np.dtype], columns: int
) -> Iterator[tuple[str, np.ndarray]]:
    """Channels from the bytes of rows, in which they lie one after the other."""
    start = 0
    for name, kind in kinds.items():
        end = start + columns * kind.itemsize
        yield name, np.ascontiguousarray(pixels[:, start:end]).view(kind)
        start = end
