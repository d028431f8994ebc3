"""Writing a table: whole or not at all, wherever it goes."""

import json
import os
import subprocess
import sys

import numpy as np
import OpenImageIO as oiio  # noqa: N813
import pytest

from hylios.errors import InputError
from hylios.table import HEADER_ATTRIBUTE, read_table
from lut_builder.exr_writer import write_table


def test_a_file_holds_the_table_and_says_what_it_is(small, tmp_path):
    path = tmp_path / "skin.exr"
    write_table(path, small)
    again = read_table(path)
    for name, values in small.planes.items():
        assert np.array_equal(again.planes[name], values.astype(np.float32))
    assert again.provenance == small.provenance
    assert b"capDate\0string\0\x13" not in path.read_bytes()
    image = oiio.ImageInput.open(str(path))
    described = json.loads(image.spec().getattribute(HEADER_ATTRIBUTE))["provenance"]
    for key in ("specimen", "settings", "solver", "seed", "software", "absorptance", "bands_nm"):
        assert key in described
    assert any("ESTIMATE" in line for line in described["estimated_figures"])
    assert os.listdir(tmp_path) == ["skin.exr"]


def test_what_is_no_table_is_refused(small, tmp_path):
    with pytest.raises(InputError, match="cannot be read: No such file"):
        read_table(tmp_path / "none.exr")
    text = tmp_path / "text.exr"
    text.write_text("not an image")
    with pytest.raises(InputError, match="it is not an OpenEXR file"):
        read_table(text)
    picture = tmp_path / "picture.exr"
    oiio.ImageBuf(oiio.ImageSpec(4, 4, 3, oiio.FLOAT)).write(str(picture))
    with pytest.raises(InputError, match="not a skin tan table"):
        read_table(picture)
    write_table(text, small)
    cut = text.read_bytes()
    for size in (6, 40, 300, len(cut) // 2, len(cut) - 20):
        text.write_bytes(cut[:size])
        with pytest.raises(InputError):
            read_table(text)


def test_a_table_that_cannot_be_written_leaves_nothing(small, tmp_path):
    with pytest.raises(InputError, match="cannot be written"):
        write_table(tmp_path / "no" / "skin.exr", small)
    folder = tmp_path / "skin.exr"
    folder.mkdir()
    with pytest.raises(InputError, match="cannot be written"):
        write_table(folder, small)
    assert os.listdir(tmp_path) == ["skin.exr"]


def test_a_full_disk_leaves_the_former_table(small, tmp_path):
    """A limit on the size of files stands in for the disk."""
    path = tmp_path / "t.exr"
    write_table(path, small)
    before = path.read_bytes()
    code = (
        "import resource, signal, sys; from pathlib import Path\n"
        "from hylios.errors import InputError\n"
        "from hylios.table import read_table\n"
        "from lut_builder.exr_writer import write_table\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        f"path = Path({str(path)!r}); table = read_table(path)\n"
        f"resource.setrlimit(resource.RLIMIT_FSIZE, ({len(before) - 100},) * 2)\n"
        "try: write_table(path, table)\n"
        "except InputError as error: sys.exit(str(error))"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "cannot be written" in ended.stderr
    assert ended.stderr.count("\n") == 1
    assert path.read_bytes() == before
    assert os.listdir(tmp_path) == ["t.exr"]
