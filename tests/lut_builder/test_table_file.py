"""The file of a table: what OpenImageIO writes is read, and no damaged file is taken as right."""

import re
import struct
import time
import tracemalloc
import zlib
from pathlib import Path

import numpy as np
import OpenImageIO as oiio  # noqa: N813
import pytest
from mutations import HEADER, mutated

from hylios.errors import InputError
from hylios.table import MEANINGS, SkinTable, StateAxes, exr_reader, read_table
from lut_builder.exr_writer import write_table

DOCUMENT = Path(__file__).parents[2] / "docs" / "table_format.md"
SHIPPED = sorted((Path(__file__).parents[2] / "blender_addon" / "tables").glob("*.exr"))
STORAGES = ("zip float", "zip half", "zips float", "none half")


def made(seed: int) -> SkinTable:
    """A table of noise with all planes, 6 x 3 x 7 states: two blocks of lines."""
    random = np.random.default_rng(seed)
    axes = StateAxes(
        untanned=np.array([0.5, 0.3, 0.2, 1.0]),
        basis=np.linalg.qr(random.normal(size=(4, 3)))[0],
        knots=tuple(np.sort(random.normal(size=count)) for count in (6, 3, 7)),
    )
    counts = {name: len(meaning.components) or 2 for name, meaning in MEANINGS.items()}
    planes = {
        # Of 11 bits: a half holds them as they are.
        name: np.round(random.random((*axes.shape, count)) * 1024) / 1024
        for name, count in counts.items()
    }
    return SkinTable(axes, planes, {"bands_nm": [365, 1100], "seed": seed, "rays": [1.5, None]})


def written(path: Path, table: SkinTable, storage: str) -> bytes:
    """Bytes of the table's file, as the builder writes it or of another compression."""
    compression, pixel_type = storage.split()
    write_table(path, table, half=pixel_type == "half")
    if compression != "zip":
        image = oiio.ImageBuf(str(path))
        image.read(force=True)
        image.specmod().attribute("compression", compression)
        assert image.write(str(path)), image.geterror()
    return path.read_bytes()


def same(table: SkinTable, other: SkinTable) -> bool:
    return (
        table.provenance == other.provenance
        and table.interpolation == other.interpolation
        and list(table.planes) == list(other.planes)
        and all(np.array_equal(table.planes[name], other.planes[name]) for name in table.planes)
        and np.array_equal(table.axes.untanned, other.axes.untanned)
        and np.array_equal(table.axes.basis, other.axes.basis)
        and len(table.axes.knots) == len(other.axes.knots)
        and all(map(np.array_equal, table.axes.knots, other.axes.knots))
    )


@pytest.mark.parametrize("storage", STORAGES)
def test_what_is_written_is_read(tmp_path, storage):
    path = tmp_path / "t.exr"
    written(path, made(1), storage)
    assert same(read_table(path), made(1))


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_channels_are_those_that_openimageio_reads(path):
    """Bit for bit, by names: OpenImageIO's own order of channels is another."""
    image = oiio.ImageBuf(str(path))
    expected = np.asarray(image.get_pixels(oiio.FLOAT))
    read = exr_reader.parse(path.read_bytes()).channels
    assert set(read) == set(image.spec().channelnames)
    for number, name in enumerate(image.spec().channelnames):
        assert np.array_equal(read[name], expected[..., number])


@pytest.mark.parametrize("half", [False, True])
def test_equal_tables_are_equal_files(tmp_path, half):
    for name in ("a.exr", "b.exr"):
        write_table(tmp_path / name, made(1), half=half)
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()


def outcomes(path: Path, storage: str, count: int) -> dict[str, int]:
    """How many of `count` mutated files gave the table and how many were refused."""
    table = made(1)
    data, other = written(path, table, storage), written(path, made(2), storage)
    counts = {"table": 0, "refused": 0}
    for number in range(count):
        random = np.random.default_rng((STORAGES.index(storage), number))
        path.write_bytes(mutated(data, other, random))
        began = time.process_time()
        try:
            assert same(read_table(path), table), f"{storage}, number {number}: a wrong table"
            counts["table"] += 1
        except InputError as refusal:
            assert "\n" not in str(refusal), f"{storage}, number {number}: {refusal}"
            counts["refused"] += 1
        assert time.process_time() - began < 2.0, f"{storage}, number {number}: too long"
    return counts


@pytest.mark.parametrize("storage", STORAGES)
def test_a_damaged_file_is_the_table_or_refused(tmp_path, storage):
    counts = outcomes(tmp_path / "t.exr", storage, 250)
    assert counts["table"] > 2 and counts["refused"] > 125


@pytest.mark.slow
@pytest.mark.parametrize("storage", STORAGES)
def test_ten_thousand_damaged_files_are_the_table_or_refused(tmp_path, storage):
    counts = outcomes(tmp_path / "t.exr", storage, 2500)
    assert sum(counts.values()) == 2500


@pytest.mark.slow
def test_any_one_byte_changed_is_the_table_or_refused(tmp_path):
    path = tmp_path / "t.exr"
    table = made(1)
    data = written(path, table, "zip half")
    for place in range(len(data)):
        path.write_bytes(data[:place] + bytes([data[place] ^ 0x41]) + data[place + 1 :])
        try:
            assert same(read_table(path), table), f"byte {place}: a wrong table"
        except InputError:
            continue


def grown_window(data: bytes) -> bytes:
    """A picture of 2^31 lines."""
    start = data.index(b"dataWindow\0box2i\0") + len(b"dataWindow\0box2i\0") + 4
    return data[:start] + struct.pack("<4i", 0, 0, 5, 2**31 - 1) + data[start + 16 :]


def bombed(data: bytes) -> bytes:
    """The first block says that it holds 50 MB of zeros."""
    packed = zlib.compress(bytes(50_000_000), 9)
    start = data.index(b"\x78", data.index(b"skinTanTableChecksum") + 100) - 8
    block = data[start : start + 4] + struct.pack("<i", len(packed)) + packed
    table = data[start - 16 : start]
    assert struct.unpack("<2Q", table)[0] == start, "not the first block"
    return data[: start - 16] + struct.pack("<Q", len(data)) + data[start - 8 :] + block


def deep(data: bytes) -> bytes:
    """A header of a million brackets."""
    start = data.index(HEADER) + len(HEADER)
    (size,) = struct.unpack_from("<i", data, start)
    text = b"[" * 1_000_000
    return data[:start] + struct.pack("<i", len(text)) + text + data[start + 4 + size :]


@pytest.mark.parametrize("harmful", [grown_window, bombed, deep])
def test_harmful_files_take_no_memory(tmp_path, harmful):
    path = tmp_path / "t.exr"
    path.write_bytes(harmful(written(path, made(1), "zip float")))
    size = path.stat().st_size
    tracemalloc.start()
    with pytest.raises(InputError):
        read_table(path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 8 * size + 1_000_000


def test_a_file_too_large_for_a_table_is_refused(tmp_path):
    path = tmp_path / "t.exr"
    with path.open("wb") as file:
        file.truncate(2**40)
    with pytest.raises(InputError, match="has more than 67108864 bytes"):
        read_table(path)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda spec: spec.attribute("compression", "piz"), "compression is not ZIP"),
        (lambda spec: spec.set_format(oiio.UINT32), "is not of floats"),
        (
            lambda spec: [setattr(spec, side, 8) for side in ("tile_width", "tile_height")],
            "not an OpenEXR file of one part with scan lines",
        ),
        (lambda spec: None, "an OpenEXR file but not a skin tan table"),
    ],
)
def test_other_pictures_are_refused_by_what_they_are(tmp_path, change, sentence):
    path = tmp_path / "picture.exr"
    specification = oiio.ImageSpec(16, 16, 3, oiio.FLOAT)
    change(specification)
    picture = oiio.ImageBuf(specification)
    output = oiio.ImageOutput.create(str(path))
    assert output.open(str(path), specification)
    assert picture.copy(oiio.FLOAT).write(output)
    output.close()
    with pytest.raises(InputError, match=sentence):
        read_table(path)


def test_the_document_lists_the_planes_as_they_are():
    rows = re.findall(r"^\| `(\w+)` \| (.*?) \| (.*?) \| (.*?) \|$", DOCUMENT.read_text(), re.M)
    assert [name for name, *_ in rows] == list(MEANINGS)
    for name, components, unit, says in rows:
        meaning = MEANINGS[name]
        listed = ", ".join(meaning.components) or "one per band"
        assert (components, unit) == (listed, meaning.unit)
        assert says.startswith(meaning.says), name
