"""Bytes of an OpenEXR file, for an image that a .blend carries: Blender packs float images as they
are, 12 bytes a texel. PXR24 keeps 24 bits of a number and packs differences of neighbours, so that
smooth tables take a third.

Source: OpenEXR's file layout, and its source ImfPxr24Compressor.cpp.
"""

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

MAGIC, VERSION = b"\x76\x2f\x31\x01", 2
PXR24, LINES_PER_BLOCK = 5, 16
FLOAT = 2
NAMES = b"RGBA"


def encoded(values: NDArray) -> bytes:
    """A file of `rounded` numbers (rows, columns, 3 or 4), the first row at the bottom."""
    rows, columns, channels = values.shape
    # Lines from the top; a line has its channels one after the other, in the order of the alphabet.
    lines = _upper_24_bits(values[::-1, :, ::-1].swapaxes(1, 2))
    blocks = [
        struct.pack("<2i", first, len(packed)) + packed
        for first in range(0, rows, LINES_PER_BLOCK)
        for packed in [_packed(lines[first : first + LINES_PER_BLOCK])]
    ]
    header = _header(columns, rows, NAMES[:channels])
    start = len(header) + 8 * len(blocks)
    places = start + np.cumsum([0, *map(len, blocks[:-1])])
    return header + places.astype("<u8").tobytes() + b"".join(blocks)


def rounded(values: NDArray) -> NDArray[np.float32]:
    """Numbers to 16 binary digits: the error is 1.6e-5 of them at most."""
    return (_upper_24_bits(values) << 8).view(np.float32)


def _upper_24_bits(values: NDArray) -> NDArray[np.uint32]:
    bits = np.ascontiguousarray(values, "<f4").view(np.uint32)
    magnitude = bits & 0x7FFFFFFF
    upper = (bits & 0x80000000) >> 8 | (magnitude + (magnitude & 0x80)) >> 8
    return upper.astype(np.uint32, copy=False)


def _packed(lines: NDArray[np.uint32]) -> bytes:
    """A block of lines (lines, channels, columns)."""
    differences = np.diff(lines, axis=-1, prepend=np.uint32(0))
    planes = [(differences >> shift).astype(np.uint8) for shift in (16, 8, 0)]
    packed = zlib.compress(np.stack(planes, axis=2).tobytes())
    raw = (lines << 8).astype("<u4").tobytes()
    # A reader takes a block that is not smaller for the numbers themselves.
    return packed if len(packed) < len(raw) else raw


def _header(columns: int, rows: int, names: bytes) -> bytes:
    window = struct.pack("<4i", 0, 0, columns - 1, rows - 1)
    channels = b"".join(
        bytes([name, 0]) + struct.pack("<4i", FLOAT, 0, 1, 1) for name in reversed(names)
    )
    attributes = (
        ("channels", "chlist", channels + b"\0"),
        ("compression", "compression", bytes([PXR24])),
        ("dataWindow", "box2i", window),
        ("displayWindow", "box2i", window),
        ("lineOrder", "lineOrder", b"\0"),
        ("pixelAspectRatio", "float", struct.pack("<f", 1.0)),
        ("screenWindowCenter", "v2f", struct.pack("<2f", 0.0, 0.0)),
        ("screenWindowWidth", "float", struct.pack("<f", 1.0)),
    )
    told = (
        f"{name}\0{kind}\0".encode() + struct.pack("<i", len(value)) + value
        for name, kind, value in attributes
    )
    return MAGIC + struct.pack("<I", VERSION) + b"".join(told) + b"\0"
