"""Measured skin that the figures are set beside: people from a file, a BRDF as fitted lobes."""

import sys

import numpy as np
import pytest

from examples.figures import __main__ as program
from examples.figures.measured_brdf import forehead
from examples.figures.measured_people import read_people
from hylios.errors import InputError

GOOD = """# a comment, with commas
# another

wavelength_nm,s1,s3
250,0.05,0.07
1000,0.5,0.3
2500,0.03,0.05
"""


def written(folder, text):
    path = folder / "people.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_people_are_read_past_the_comments(tmp_path):
    people = read_people(written(tmp_path, GOOD))
    assert people.names == ("s1", "s3")
    assert people.wavelengths.tolist() == [250.0, 1000.0, 2500.0]
    assert people.reflectance.tolist() == [[0.05, 0.5, 0.03], [0.07, 0.3, 0.05]]


def test_people_between_wavelengths_and_their_band(tmp_path):
    people = read_people(written(tmp_path, GOOD))
    assert people.at(np.array([625.0])) == pytest.approx(np.array([[0.275], [0.185]]))
    assert people.band(np.array([1000.0])) == pytest.approx(np.array([[0.32], [0.4], [0.48]]))


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        (("wavelength_nm", "nm"), "is no table of people"),
        (("0.5,0.3", "0.5"), "cannot be read"),
        (("0.5,0.3", "0.5,dark"), "cannot be read"),
        (("0.5,0.3", "0.5,nan"), "are no full table of finite numbers"),
        (("0.5,0.3", "1.5,0.3"), "has a reflectance of 1.5; allowed is 0 to 1"),
        (("1000,", "2600,"), "ascending"),
        (("2500,", "2400,"), "from 250 to 2400 nm; needed are 250 to 2500 nm"),
        ((GOOD, ""), "cannot be read"),
        ((GOOD, "wavelength_nm,s1\n"), "are no full table"),
        ((GOOD, "wavelength_nm\n250\n2500\n"), "is no table of people"),
    ],
)
def test_what_is_no_table_of_people_is_refused(tmp_path, changed, message):
    with pytest.raises(InputError, match=message):
        read_people(written(tmp_path, GOOD.replace(*changed)))


def test_a_missing_file_of_people_ends_in_a_sentence(tmp_path, monkeypatch, capsys):
    missing = tmp_path / "none.csv"
    monkeypatch.setattr(sys, "argv", ["figures", "6.6", "--people", str(missing)])
    assert program.main() == 2
    assert capsys.readouterr().err.startswith(f"error: the people in {missing} cannot be read: ")


ANGLES = np.linspace(0.0, 89.0, 90)


def test_the_forehead_looks_alike_from_both_ends():
    """Reciprocity: light and eye may be exchanged."""
    for first, second in ((10.0, 70.0), (60.0, 0.0)):
        for azimuth in (0.0, 50.0, 180.0):
            turn = np.array([azimuth])
            there = forehead(first, np.array([second]), turn)
            back = forehead(second, np.array([first]), turn)
            assert there == pytest.approx(back, rel=1e-12)


def test_the_forehead_from_straight_above():
    """At normal incidence only C_z^n cos^n is left of a lobe, and the first has C_z < 0."""
    expected = np.mean(
        np.array([0.428425, 0.301341, 0.331054]) / np.pi
        + np.array([0.380123, 0.410559, 0.437367]) ** [3.685044, 4.266495, 4.539742]
        + np.array([0.857998, 0.703913, 0.573625]) ** [64.208486, 63.919687, 43.809866]
    )
    assert forehead(0.0, np.array([0.0]), np.array([0.0])) == pytest.approx([expected])
    turned = forehead(0.0, ANGLES, np.full(90, 117.0))
    assert turned == pytest.approx(forehead(0.0, ANGLES, np.zeros(90)))
    assert np.all(np.diff(turned) <= 0.0)


@pytest.mark.parametrize("incidence", [0.0, 30.0, 60.0])
def test_the_forehead_reflects_as_much_as_light_skin(incidence):
    """Between a quarter and a half of the visible light, by quadrature."""
    node, weight = np.polynomial.legendre.leggauss(60)
    squared = 0.5 * (1.0 + node)  # sin^2, in which the projected solid angle is even
    polar = np.degrees(np.arcsin(np.sqrt(squared)))
    turns = np.arange(0.5, 180.0)
    brdf = np.mean([forehead(incidence, polar, np.full(60, turn)) for turn in turns], axis=0)
    assert 0.25 < np.pi * brdf @ (0.5 * weight) < 0.5
