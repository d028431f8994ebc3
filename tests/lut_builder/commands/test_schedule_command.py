"""`lut-builder build --schedule`: a table for one scene."""

import numpy as np
import pytest

import hylios
from hylios.history import read_schedule
from hylios.skin import Skin, whole_thickening
from hylios.table import read_table
from lut_builder.cli import main
from lut_builder.reachable import by_kinetics

SKIN = Skin.of(hylios.specimen("S3"))


def test_a_schedule_through_the_shell(tmp_path, capsys):
    """By either kinetics, and as red as the doses make the skin unless that is left out."""
    path, sun = tmp_path / "t.exr", tmp_path / "sun.csv"
    sun.write_text("# a day at the beach\nhour,melanogenesis_sed,thickening_sed\n0,6,5\n30,4,3\n")
    read = read_schedule(sun)
    assert read.hours.tolist() == [0, 30]
    assert (read.doses.tolist(), read.thickening_doses.tolist()) == ([6.0, 4.0], [5.0, 3.0])
    quick = "--knots 12,3,3,2 --wavelengths 4 --bands visible --no-profile"
    command = f"build --specimen S3 --schedule {sun} --days 10 {quick} -o {path}"
    for option, sentence in (("--days 10", "--days is 10"), ("--no-redness", "--no-redness is")):
        assert main(f"build {option} -o {path}".split()) == 2
        assert f"{sentence} " in (error := capsys.readouterr().err)
        assert "without a --schedule; allowed is both" in error
    reddened = hylios.erythema(SKIN)
    states = whole_thickening(
        [one.states(read, np.arange(241), erythema=reddened) for one in by_kinetics(SKIN)]
    )
    for option, blood in (("", states[..., 4].max()), (" --no-redness --force", 1.0)):
        assert main((command + option).split()) == 0
        said = capsys.readouterr().out
        table = read_table(path)
        count = table.provenance["states_computed"]
        assert f"for the scene: {count}, for any sun: 216; {1 - count / 216:.0%} saved" in said
        assert count < 100 and table.provenance["states_for_any_sun"] == 216
        assert np.exp(table.axes.knots[3][-1]) == pytest.approx(blood, rel=0.01)
        assert table.holds(states).all() == (blood > 1.0)


def test_a_scene_that_reaches_farther_than_other_suns_saves_nothing(tmp_path, capsys):
    """Sun every day of 60, where the table for any sun takes up to 11 exposures for its limits."""
    sun = tmp_path / "sun.csv"
    days = [f"{24 * day + 12},13.7,13.7" for day in range(60)]
    sun.write_text("\n".join(["hour,melanogenesis_sed,thickening_sed", *days]))
    quick = "--knots 3,3 --wavelengths 4 --bands visible --no-profile"
    command = f"build --skin VI --schedule {sun} {quick} -o {tmp_path / 't.exr'}"
    assert main(command.split()) == 0
    assert "states for the scene: 9, for any sun: 9; none saved" in capsys.readouterr().out


def test_a_schedule_without_a_dose_is_one_state(tmp_path, capsys):
    path, sun = tmp_path / "t.exr", tmp_path / "sun.csv"
    sun.write_text("hour,melanogenesis_sed,thickening_sed\n0,0,0\n1441,9,9\n")
    quick = "--knots 5,2 --wavelengths 4 --bands visible --no-profile"
    command = f"build --skin III --schedule {sun} {quick} -o {path}"
    assert main(command.split()) == 0
    said = capsys.readouterr()
    assert "states for the scene: 1, for any sun: 10; 90% saved" in said.out
    late = "note: doses after day 60, the last of the scene, do not count: hour 1441\n"
    assert late in said.err
    assert read_table(path).axes.shape == (1, 1, 1, 1)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "it is empty"),
        ("hour,melanogenesis_sed\n0,1\n", "has no column thickening_sed"),
        (
            "hour,melanogenesis_sed,thickening_sed\n0,x,1\n",
            "melanogenesis_sed in line 2 is 'x'; expected",
        ),
        ("hour,melanogenesis_sed,thickening_sed\n0,1\n", "line 2 has 2 cells and the header has 3"),
        (
            "hour,melanogenesis_sed,thickening_sed\n-1,1,1\n",
            "hour of -1 in line 2; allowed is 0 to",
        ),
        ("hour,melanogenesis_sed,thickening_sed\n0,nan,1\n", "melanogenesis_sed in line 2 is nan"),
        ("hour,melanogenesis_sed,thickening_sed\n", "has no dose; a schedule needs at least one"),
        ("\x00\n", "cannot be read: it is empty"),
    ],
)
def test_a_schedule_that_is_none_is_one_sentence(tmp_path, capsys, text, sentence):
    sun = tmp_path / "sun.csv"
    sun.write_text(text)
    assert main(["build", "--schedule", str(sun), "-o", str(tmp_path / "t.exr")]) == 2
    error = capsys.readouterr().err
    assert sentence in error and error.count("\n") == 1


def test_a_schedule_s_days_are_limited(tmp_path, capsys):
    sun = tmp_path / "sun.csv"
    sun.write_text("hour,melanogenesis_sed,thickening_sed\n0,1,1\n")
    command = f"build --schedule {sun} --days 367 -o {tmp_path}/t.exr"
    assert main(command.split()) == 2
    assert "days of the scene is 367; allowed is 0 to 366." in capsys.readouterr().err
