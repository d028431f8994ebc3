"""The gallery: regions of the face, and one small run from the add-on to its sheets."""

import subprocess
import sys
import zipfile

import numpy as np
import OpenImageIO as oiio  # noqa: N813
import pytest

from examples.demo.body import BodyUnavailableError
from examples.gallery import face

SHEETS = ("week", "face", "shoulder", "hand")


def wheel_of(path, moved):
    """A wheel whose expressions all move the same vertices."""
    with zipfile.ZipFile(path, "w") as archive:
        for units in face.REGIONS.values():
            for unit in units:
                archive.writestr(f"{face.EXPRESSIONS}/{unit}.target", f"# by hand\n{moved}")
    return path


def test_a_region_lies_where_its_expressions_move_the_body(tmp_path):
    wheel = wheel_of(tmp_path / "moved.whl", "1 0 0.02 0\n2 0 1 0\n7 3 0 0\n")
    for share in face.shares(wheel, 4).values():
        np.testing.assert_allclose(share, [0.0, 0.0, 1.0, 0.0])


def test_a_wheel_without_a_face_is_one_sentence(tmp_path):
    with pytest.raises(BodyUnavailableError, match="does not hold the face"):
        face.shares(wheel_of(tmp_path / "empty.whl", ""), 4)
    with pytest.raises(BodyUnavailableError, match="does not hold the face"):
        face.shares(tmp_path / "none.whl", 4)


@pytest.mark.slow
def test_a_sheet_for_every_place_shows_skin(tmp_path):
    command = [sys.executable, "-m", "examples.gallery", "--size", "40", "--samples", "1"]
    run = subprocess.run(
        [*command, "--skins", "III", "--out", tmp_path], capture_output=True, text=True
    )
    if "needs its body" in run.stderr:
        pytest.skip(run.stderr)
    assert run.returncode == 0, run.stderr
    for name in SHEETS:
        picture = oiio.ImageBuf(str(tmp_path / f"{name}.png")).get_pixels(oiio.FLOAT)
        red, _, blue = (picture[..., channel] for channel in range(3))
        assert (red > blue + 0.1).mean() > 0.05  # paper and backdrop are grey, skin is not
