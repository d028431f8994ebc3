"""Damage done to a table's file: by chance, and by someone who knows the format."""

import json
import re
import struct
import zlib

import numpy as np

HEADER = b"skinTanTable\0string\0"
BOMB = zlib.compress(bytes(10_000_000), 9)
SIZES = (0, 1, -1, 2, 255, 4096, 2**16, 2**24, 2**31 - 1, -(2**31))


def mutated(data: bytes, other: bytes, random: np.random.Generator) -> bytes:
    """The bytes of a table's file damaged in one to three ways; `other` is another table's."""
    damaged = bytearray(data)
    for _ in range(random.integers(1, 4)):
        kind = random.integers(len(KINDS) + 1)
        if kind == len(KINDS):
            damaged = spliced(damaged, other, _first_difference(data, other), random)
        else:
            damaged = KINDS[kind](damaged, random)
    return bytes(damaged)


def flipped_bits(data: bytearray, random) -> bytearray:
    for _ in range(random.integers(1, 9)):
        data[_place(data, random)] ^= 1 << random.integers(8)
    return data


def overwritten(data: bytearray, random) -> bytearray:
    """A run of bytes becomes zeros, ones or noise."""
    start, length = _place(data, random), int(random.integers(1, 65))
    noise = random.integers(0, 256, length, dtype=np.uint8).tobytes()
    run = (bytes(length), b"\xff" * length, noise)[random.integers(3)]
    data[start : start + length] = run[: len(data) - start]
    return data


def cut(data: bytearray, random) -> bytearray:
    return data[: max(1, _place(data, random))]


def lengthened(data: bytearray, random) -> bytearray:
    return data + random.integers(0, 256, random.integers(1, 5000), dtype=np.uint8).tobytes()


def inserted(data: bytearray, random) -> bytearray:
    place = _place(data, random)
    return data[:place] + bytes(int(random.integers(1, 100))) + data[place:]


def removed(data: bytearray, random) -> bytearray:
    start, length = _place(data, random), int(random.integers(1, 100))
    left = data[:start] + data[start + length :]
    return left or data


def swapped(data: bytearray, random) -> bytearray:
    """Two runs of bytes change places."""
    length = int(random.integers(1, 500))
    first, second = sorted(_place(data, random) for _ in range(2))
    length = min(length, second - first, len(data) - second)
    one, two = data[first : first + length], data[second : second + length]
    data[first : first + length], data[second : second + length] = two, one
    return data


def spliced(data: bytearray, other: bytes, least: int, random) -> bytearray:
    """Its beginning, and another table from there on; what both begin with would be that table."""
    place = int(random.integers(least + 1, len(other)))
    return data[:place] + bytearray(other[place:])


def attribute_of_another_size(data: bytearray, random) -> bytearray:
    names = (b"channels\0chlist\0", b"compression\0compression\0", b"dataWindow\0box2i\0", HEADER)
    place = _after(data, names[random.integers(len(names))])
    return _put(data, place, "<i", _choice(SIZES, random)) if place else data


def other_window(data: bytearray, random) -> bytearray:
    place = _after(data, b"dataWindow\0box2i\0")
    corner = 4 + 4 * int(random.integers(4))
    return _put(data, place + corner, "<i", _choice(SIZES, random)) if place else data


def other_channels(data: bytearray, random) -> bytearray:
    """A channel's pixel type, spacing or name."""
    channels = [match.end() for match in re.finditer(rb"\.[RGB]\0", bytes(data))]
    if not channels:
        return data
    place = channels[random.integers(len(channels))] + (0, 8, 12, -2)[random.integers(4)]
    return _put(data, place, "<B", int(random.integers(4)))


def other_compression(data: bytearray, random) -> bytearray:
    place = _after(data, b"compression\0compression\0")
    return _put(data, place + 4, "<B", int(random.integers(11))) if place else data


def other_version(data: bytearray, random) -> bytearray:
    return _put(data, 4, "<I", 2 | 1 << int(random.integers(32)))


def other_blocks(data: bytearray, random) -> bytearray:
    """Where a block lies, which line it says it begins with, or how long it says it is."""
    table, blocks = _blocks(data)
    if not blocks:
        return data
    number = int(random.integers(len(blocks)))
    if random.random() < 0.4:
        places = (0, 8, len(data) - 4, len(data), 2**32, 2**63, 2**64 - 1, blocks[0])
        return _put(data, table + 8 * number, "<Q", _choice(places, random))
    field = 4 * int(random.integers(2))
    return _put(data, blocks[number] + field, "<i", _choice(SIZES, random))


def bomb(data: bytearray, random) -> bytearray:
    """A block of 10 MB of zeros in 10 KB, its length honestly said."""
    table, blocks = _blocks(data)
    if not blocks:
        return data
    data = _put(data, table, "<Q", len(data))
    return data + data[blocks[0] : blocks[0] + 4] + struct.pack("<i", len(BOMB)) + BOMB


def other_json(data: bytearray, random) -> bytearray:
    """The header's text edited, and its length said honestly."""
    place = _after(data, HEADER)
    if not place:
        return data
    (size,) = struct.unpack_from("<i", data, place)
    text = bytes(data[place + 4 : place + 4 + size]).decode("latin-1")
    edited = _edited(text, random).encode("latin-1", errors="replace")
    return data[:place] + struct.pack("<i", len(edited)) + edited + data[place + 4 + size :]


def _edited(text: str, random) -> str:
    numbers = [match.span() for match in re.finditer(r"-?\d+\.?\d*", text)]
    if not numbers:
        return "{}"
    start, end = numbers[random.integers(len(numbers))]
    put = ("NaN", "Infinity", "1e999", "-1e300", "9" * 5000, "[" * 5000, "null", '"x"', "0", "{}")
    if random.random() < 0.8:
        return text[:start] + _choice(put, random) + text[end:]
    try:
        header = json.loads(text)
        header.pop(_choice(list(header), random))
        return json.dumps(header)
    except (AttributeError, IndexError, RecursionError, ValueError):
        return "[" * 100_000


KINDS = (
    flipped_bits,
    overwritten,
    cut,
    lengthened,
    inserted,
    removed,
    swapped,
    attribute_of_another_size,
    other_window,
    other_channels,
    other_compression,
    other_version,
    other_blocks,
    bomb,
    other_json,
)


def _first_difference(one: bytes, other: bytes) -> int:
    pairs = zip(one, other, strict=False)
    return next(place for place, pair in enumerate(pairs) if pair[0] != pair[1])


def _place(data: bytearray, random) -> int:
    return int(random.integers(len(data)))


def _choice(among, random):
    return among[random.integers(len(among))]


def _after(data: bytearray, name: bytes) -> int:
    """Where an attribute's size is, or 0."""
    place = data.find(name)
    return 0 if place < 0 else place + len(name)


def _put(data: bytearray, place: int, form: str, value: int) -> bytearray:
    end = place + struct.calcsize(form)
    if end <= len(data):
        data[place:end] = struct.pack(form, value)
    return data


def _blocks(data: bytearray) -> tuple[int, list[int]]:
    """Where the list of the blocks' places begins, and the places of those within the file."""
    place = _after(data, HEADER)
    checksum = _after(data, b"skinTanTableChecksum\0string\0")
    if not place or not checksum or place + 4 > len(data) or checksum + 4 > len(data):
        return 0, []
    (size,) = struct.unpack_from("<i", data, max(place, checksum))
    table = max(place, checksum) + 4 + size + 1
    if not 0 < table <= len(data) - 8:
        return 0, []
    (first,) = struct.unpack_from("<Q", data, table)
    count = min((first - table) // 8, (len(data) - table) // 8, 1000)
    if count < 1:
        return 0, []
    places = struct.unpack_from(f"<{count}Q", data, table)
    return table, [block for block in places if block + 8 <= len(data)]
