"""`hylios swatch --days`: the colours of a tan in a row."""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.image import imread

import hylios
from hylios.adding import colours, spectra
from hylios.commands.cli import main
from hylios.lab.colour import srgb
from hylios.lab.pictures import LABEL_HEIGHT, labelled, swatches
from hylios.quadrature import skin_quadrature


def row(tmp_path, capsys, arguments):
    target = tmp_path / "row.png"
    assert main(f"swatch {arguments} --force -o {target}".split()) == 0
    printed = capsys.readouterr()
    table = list(csv.DictReader(io.StringIO(printed.out)))
    pixels = np.round(255.0 * imread(target)[..., :3]).astype(int)
    return table, pixels, printed.err


def test_a_row_is_the_skin_on_its_days(tmp_path, capsys):
    table, pixels, notes = row(
        tmp_path,
        capsys,
        "--days 0,.5,4,60 --skin II --dose 0:11 --erythema --kinetics measured --size 40",
    )
    skin = replace(hylios.skin_type("II", kinetics="measured"), thickening="epidermis")
    states = skin.states(
        hylios.Exposures([0], [11.0]), [0, 12, 96, 1440], erythema=hylios.erythema(skin)
    )
    expected = np.round(255.0 * srgb(colours(skin, states).total)).astype(int)
    assert [line["day"] for line in table] == ["0", "0.5", "4", "60"]
    assert [line["srgb"] for line in table] == [
        "#{:02x}{:02x}{:02x}".format(*colour) for colour in expected
    ]
    assert pixels.shape == (40 + LABEL_HEIGHT, 160, 3)
    assert np.all(pixels[:40, ::40] == expected) and np.all(pixels[:40, 39::40] == expected)
    assert pixels[40:].min() < 100 and pixels[-1].min() == 255
    assert "redness is an estimate" in notes and "the measured kinetics is fitted" in notes


def test_a_row_of_a_region_is_the_region_in_its_own_tan(tmp_path, capsys):
    """A mole keeps its melanin and thickens with the skin around it; a freckle tans by more."""
    sun = "--days 0,10 --skin II --dose 0:11 --size 4"
    around, freckle, mole = (
        row(tmp_path, capsys, f"{sun} {region}")[0]
        for region in ("", "--region freckles", "--region moles")
    )
    reds = [[int(line["srgb"][1:3], 16) for line in seen] for seen in (around, freckle, mole)]
    fallen = [before - after for before, after in reds]
    assert abs(fallen[2]) <= 2 < 5 < fallen[0] < fallen[1]

    skin = hylios.skin_type("II")
    state = skin.states(hylios.Exposures([0], [11.0]), [240])[0]
    grown = state[:3].sum() ** 1.5 * 1.5
    specimen = skin.at([*(state[:3] / state[:3].sum() * grown), state[3]])
    few = skin_quadrature(8)
    light = spectra([specimen], few.wavelengths, angle=8.0).total @ few.weights.T
    seen = np.round(255.0 * srgb(light))[0].astype(int)
    told = [int(freckle[1]["srgb"][first : first + 2], 16) for first in (1, 3, 5)]
    assert np.abs(seen - told).max() <= 1


def test_by_the_thesis_nothing_reddens_or_is_marked(tmp_path, capsys):
    table, _, notes = row(tmp_path, capsys, "--days 0:20:10 --dose 0:30 --size 4")
    assert [line["day"] for line in table] == ["0", "10", "20"]
    red = [int(line["srgb"][1:3], 16) for line in table]
    assert red[1] < red[2] < red[0]
    assert "redness" not in notes and "kinetics" not in notes


def test_labels_that_have_no_room_are_left_out():
    """In each of the other columns there is nothing but white."""
    plain = swatches(np.full((40, 3), 0.5), 10)
    band = labelled(plain, [str(day) for day in range(40)])[10:]
    inked = np.flatnonzero(band.min(axis=(0, 2)) < 255)
    groups = np.split(inked, np.flatnonzero(np.diff(inked) > 12) + 1)
    assert len(groups) == 8 and band.shape == (LABEL_HEIGHT, 400, 3)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("--days 0:60", "days are '0:60'; expected FIRST:LAST:STEP"),
        ("--days 0,nan", "day is nan; allowed is 0 to"),
        ("--days=-1:3:1", "day is -1; allowed is 0 to"),
        ("--days 0:2000:1", "in days, at most 1000"),
        ("--days 0:900:1 --size 48", "allowed are 32768, which is a size of 36"),
        ("--days 0:9:1 --size 0", "size is 0"),
        ("--days 0:9:1 --band ir", "band is ir; allowed with --days is visible"),
        ("--days 0:9:1 --angle 95", "angle is 95 degrees"),
        ("--days 0:9:1 --dose 0", "a dose is '0'"),
        ("a.csv --days 0:9:1", "give only one"),
        ("--skin II --dose 0:11", "--dose is given without --days"),
        ("--erythema", "--erythema is given without --days"),
        ("--kinetics measured", "--kinetics is given without --days"),
        ("--uv-index 0:5:2", "--uv-index is given without --days"),
    ],
)
def test_bad_input_is_one_sentence_and_status_2(tmp_path, capsys, arguments, sentence):
    target = tmp_path / "row.png"
    assert main(f"swatch {arguments} -o {target}".split()) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err and printed.err.count("\n") == 1 and printed.out == ""
    assert not target.exists()
