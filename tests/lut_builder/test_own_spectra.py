"""Tables with a spectrum of the user's own: it is given again for a check, no path is followed."""

from dataclasses import replace

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.skin import Skin
from hylios.skin.specimen import SPECIMENS
from hylios.spectra import published_spectra
from hylios.table import from_stored, to_stored
from hylios.tissue import Model
from lut_builder.assemble import build
from lut_builder.check import check
from lut_builder.cli import main
from lut_builder.settings import Settings

COLOURS = Settings(knots=(2,), colour_wavelengths=4, bands=(), profile_error=0.0)
SKIN = Skin.of(SPECIMENS["S3"])


def own(factor: float, source: str = "water.csv"):
    """Water that absorbs so many times what it does."""
    water = published_spectra()["water"]
    return {"water": replace(water, values=factor * water.values, source=source)}


@pytest.fixture(scope="module")
def table():
    return from_stored(to_stored(build(SKIN, COLOURS, model=Model(own(2.0)))))


def test_the_header_says_which_spectra_are_own_and_their_digests(table):
    assert table.provenance["own_figures"] == {"water": "water.csv"}
    assert len(table.provenance["own_spectra_sha256"]["water"]) == 64
    assert "own_spectra_sha256" not in build(SKIN, COLOURS).provenance


def test_a_table_is_checked_with_the_spectra_that_it_was_made_with(table):
    result = check(table, count=2, seed=1, spectra=own(2.0, "moved.csv"))
    assert result.differences.shape == (2,)


@pytest.mark.parametrize(
    ("spectra", "sentence"),
    [
        ({}, "a spectrum of its maker's own for water, which is needed to check it."),
        (own(2.001), "the spectrum of water is not the one that the table was made with"),
        (
            {**own(2.0), "keratin": replace(published_spectra()["keratin"], source="k.csv")},
            "the table was made with the published spectrum of keratin.",
        ),
    ],
)
def test_other_spectra_are_refused(table, spectra, sentence):
    with pytest.raises(InputError, match=sentence):
        check(table, count=1, seed=1, spectra=spectra)


def test_a_path_in_a_table_is_not_followed(table, tmp_path):
    """Not even to a spectrum that would do."""
    path = tmp_path / "water.csv"
    path.write_text("250,0\n2500,0\n")
    told = {**table.provenance, "own_figures": {"water": str(path)}}
    del told["own_spectra_sha256"]
    with pytest.raises(InputError, match="which is needed to check it"):
        check(replace(table, provenance=told), count=1, seed=1)
    # The first tables with own spectra have no digest to compare.
    result = check(replace(table, provenance=told), count=1, seed=1, spectra=own(2.0))
    assert np.isfinite(result.differences).all()


def test_odd_names_of_files_are_written_so_that_they_print(capsys):
    source = "\x1b]0;owned\x07 \udc80.csv"
    told = build(SKIN, COLOURS, model=Model(own(2.0, source))).provenance["own_figures"]
    assert told == {"water": r"\x1b]0;owned\x07 \udc80.csv"}


def test_through_the_shell(tmp_path, capsys):
    path, spectrum = tmp_path / "t.exr", tmp_path / "keratin.csv"
    spectrum.write_text("250,0\n2500,0\n")
    quick = f"--knots 2 --wavelengths 4 --bands visible --no-profile -o {path}"
    assert main(f"build --own-spectrum keratin={spectrum} {quick}".split()) == 0
    told = ["check", str(path), "--states", "1"]
    capsys.readouterr()
    assert main(told) == 2
    said = capsys.readouterr().err
    assert said.endswith("needed to check it; give --own-spectrum keratin=FILE.\n")
    moved = spectrum.rename(tmp_path / "moved.csv")
    assert main([*told, "--own-spectrum", f"keratin={moved}"]) == 0
    moved.write_text("250,0\n2500,1\n")
    assert main([*told, "--own-spectrum", f"keratin={moved}"]) == 2
    assert "its numbers differ" in capsys.readouterr().err
