"""The gallery: one small run, from the add-on to its sheets."""

import subprocess
import sys

import OpenImageIO as oiio  # noqa: N813
import pytest

PLACES = ("face", "shoulder", "hand")


@pytest.mark.slow
def test_a_sheet_for_every_place_shows_skin(tmp_path):
    command = [sys.executable, "-m", "examples.gallery", "--size", "40", "--samples", "1"]
    run = subprocess.run(
        [*command, "--skins", "III", "--out", tmp_path], capture_output=True, text=True
    )
    if "needs its body" in run.stderr:
        pytest.skip(run.stderr)
    assert run.returncode == 0, run.stderr
    for place in PLACES:
        picture = oiio.ImageBuf(str(tmp_path / f"{place}.png")).get_pixels(oiio.FLOAT)
        red, _, blue = (picture[..., channel] for channel in range(3))
        assert (red > blue + 0.1).mean() > 0.05  # paper and backdrop are grey, skin is not
