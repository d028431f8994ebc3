"""Shares and days to states, and the schedule file there and back."""

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.history import (
    LAST_DAY_LIMIT,
    SHARES,
    history_of_shares,
    read_schedule,
    require_last_day,
    schedule_text,
)
from hylios.skin import Skin
from hylios.skin.specimen import SPECIMENS
from hylios.tanning import Exposures

SKIN = Skin.of(SPECIMENS["S3"], "intermediate", 2.89, 1.7)
SUN = Exposures([0, 30], [12.0, 7.5], [10.0, 6.0])
DOSES = {"mmd": SKIN.mmd, "med": SKIN.med}


def test_a_share_is_the_tan_of_that_part_of_the_doses():
    hours = [0.0, 36.5, 240.0]
    history = history_of_shares(SUN, SKIN.dynamics, hours=hours, shares=[0.0, 0.3, 1.0], **DOSES)
    assert history.states.shape == (3, 3, 4) and history.image.shape == (3, 3, 4)
    assert np.array_equal(history.states[0], np.tile(SKIN.untanned_state, (3, 1)))
    part = Exposures([0, 30], [3.6, 2.25], [3.0, 1.8])
    assert history.states[1] == pytest.approx(SKIN.states(part, hours), rel=1e-12)
    assert np.array_equal(history.states[2], SKIN.states(SUN, hours))
    assert np.array_equal(history.image[2, 1], history.states[1, 2])


def test_shares_are_even_and_as_many_as_images_have_columns():
    history = history_of_shares(SUN, SKIN.dynamics, hours=[24.0], **DOSES)
    assert np.array_equal(history.shares, np.linspace(0.0, 1.0, SHARES))


def test_a_schedule_comes_back_to_the_last_bit(tmp_path):
    sun = Exposures([55, 0], [0.1 + 0.2, 1e-7], [1 / 3, 4.0])
    path = tmp_path / "sun.csv"
    told = {"scene": "Bo\ndy", "skin": "S3\n0,1e9,1e9\x1b[2J\ud800", "days": 30.0}
    path.write_text(schedule_text(sun, **told, **DOSES), encoding="utf-8")
    again = read_schedule(path)
    for name in ("hours", "doses", "thickening_doses"):
        assert np.array_equal(getattr(again, name), getattr(sun, name))
    head = path.read_text(encoding="utf-8").splitlines()
    assert head[0] == "# sun of Bo dy, for a table of what it leads to alone; with the same skin:"
    assert head[2:6] == [
        "# skin: S3 0,1e9,1e9 [2J",
        "# MMD in SED: 2.89",
        "# MED in SED: 1.7",
        "# days: 30",
    ]


def test_a_schedule_without_sun_and_one_from_a_spreadsheet(tmp_path):
    path = tmp_path / "sun.csv"
    path.write_text(schedule_text(Exposures(), scene="", skin="", days=1.0, **DOSES))
    assert read_schedule(path).hours.size == 0
    path.write_bytes(
        "\ufeffhour;melanogenesis_sed;thickening_sed;note\r\n0;6,5;5,5;noon\r\n;;;\r\n".encode()
    )
    read = read_schedule(path)
    assert (read.hours.tolist(), read.doses.tolist()) == ([0], [6.5])
    assert read.thickening_doses.tolist() == [5.5]


@pytest.mark.parametrize(
    ("rows", "sentence"),
    [
        ("0,6,5,4,5\n", "line 2"),  # decimal commas between commas
        ("0,6\n", "line 2"),
        ("0,6,5\n30,-1,0\n", "melanogenesis_sed of -1 in line 3; allowed is 0 to 1e\\+12"),
        ("-1,6,5\n", "hour of -1 in line 2; allowed is 0 to 878400"),
        ("0.5,6,5\n", "has an hour of 0.5 in line 2; allowed are whole hours"),
        ("0,6,nan\n", "thickening_sed in line 2 is nan"),
    ],
)
def test_a_schedule_that_cannot_be_used(tmp_path, rows, sentence):
    path = tmp_path / "sun.csv"
    path.write_text("hour,melanogenesis_sed,thickening_sed\n" + rows)
    with pytest.raises(InputError, match=sentence):
        read_schedule(path)


def test_a_schedule_without_a_column_is_named(tmp_path):
    path = tmp_path / "sun.csv"
    path.write_text("hour,melanogenesis_sed\n0,6\n")
    with pytest.raises(InputError, match="sun.csv cannot be read.*thickening_sed"):
        read_schedule(path)


@pytest.mark.parametrize("day", [-1.0, 366.1, float("nan"), float("inf")])
def test_days_out_of_range(day):
    with pytest.raises(InputError, match=f"days of the scene is {day:.4g}; allowed is 0 to 366"):
        require_last_day(day)
    assert require_last_day(LAST_DAY_LIMIT) == 366.0


def test_a_part_of_an_hour_names_file_and_line(tmp_path):
    path = tmp_path / "doses.csv"
    path.write_text("Hour,melanogenesis_sed,thickening_sed\n0,1,2\n24.5,1,2\n")
    with pytest.raises(InputError, match="doses.csv has an hour of 24.5 in line 3; allowed are"):
        read_schedule(path)
