"""Tables for other light and eyes than daylight and the standard observer."""

import numpy as np
import pytest

from hylios.adding.spectrum import spectrum
from hylios.errors import InputError
from hylios.lab.colour import difference
from hylios.lab.illuminants import rec709_weights_under
from hylios.skin.phototypes import phototype
from hylios.table import from_stored, read_table, to_stored
from lut_builder.assemble import build
from lut_builder.check import FINE, check
from lut_builder.cli import main
from lut_builder.lighting import Lighting, lighting, lighting_of
from lut_builder.settings import Settings

SKIN = phototype("III").skin
COLOURS = Settings(knots=(3, 2, 2, 2), colour_wavelengths=8, bands=(), profile_error=0.0)


def test_a_table_for_a_lamp_has_the_colours_under_it():
    table = from_stored(to_stored(build(SKIN, COLOURS, lighting=lighting("a"))))
    assert table.provenance["colour"] == "linear Rec.709, a, CIE 1931 2 degree"
    state = SKIN.untanned_state
    whole = spectrum(SKIN.at(state), FINE)
    direct = rec709_weights_under(FINE, "A") @ whole.total
    assert difference(table.plane("total_colour", state), direct) < 0.15
    assert difference(lighting().fine_weights(FINE) @ whole.total, direct) > 1.0


def test_check_compares_under_the_table_s_light():
    table = build(SKIN, COLOURS, lighting=lighting("FL2", "CIE 1964 10 degree"))
    wrong = build(SKIN, COLOURS)
    wrong.provenance.update(illuminant="FL2")
    honest, dishonest = (check(one, count=4, seed=1).differences for one in (table, wrong))
    assert honest.mean() < dishonest.mean()


def test_a_lamp_s_own_spectrum_is_read_and_kept(tmp_path):
    file, path = tmp_path / "lamp.csv", tmp_path / "t.exr"
    file.write_text("wavelength_nm,power\n380,1\n560,100\n780,160\n")
    quick = "--knots 1 --wavelengths 6 --bands visible --no-profile"
    assert main(f"build --illuminant {file} {quick} -o {path}".split()) == 0
    told = read_table(path).provenance
    assert told["illuminant"] == "lamp.csv"
    again = lighting_of(told)
    assert np.array_equal(again.weights(6), lighting(str(file)).weights(6))
    assert not np.allclose(again.weights(6), Lighting().weights(6))


def test_a_lamp_with_lines_gets_more_wavelengths_unless_their_number_is_given(tmp_path):
    path = tmp_path / "t.exr"
    quick = "--preset preview --knots 1 --bands visible --no-profile --force"
    for given, count in (("", 7), ("--wavelengths 5", 5)):
        assert main(f"build --illuminant FL11 {given} {quick} -o {path}".split()) == 0
        assert read_table(path).provenance["settings"]["colour_wavelengths"] == count


def test_light_or_eyes_that_are_none_are_one_sentence(tmp_path, capsys):
    with pytest.raises(InputError, match="illuminant is 'sun'; allowed are A, B, C"):
        lighting("sun")
    out = ["-o", str(tmp_path / "t.exr")]
    assert main(["build", "--observer", "cat", *out]) == 2
    assert "observer is 'cat'; allowed are CIE 1931 2 degree" in capsys.readouterr().err
    assert main(["build", "--illuminant", str(tmp_path / "none.csv"), *out]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert Lighting(observer="CIE 1931 2 degree").is_standard
    assert lighting("d65", "cie 1931 2 DEGREE").is_standard
