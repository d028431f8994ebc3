"""Doses from weather files through the shell, and from there to `hylios tan`."""

import csv
import io
import sys
from types import SimpleNamespace

import pytest

from hylios.commands.cli import main

EPW = """\
LOCATION,Denver Intl Ap,CO,USA,TMY3,725650,39.83,-104.65,-7.0,1650.0
DATA PERIODS,1,1,Data,Sunday, 6/21, 6/22
"""
UVI = """\
time,uv_index
2026-06-21 10:00,5
2026-06-21 12:00,7
2026-06-22 12:00,8
2026-06-22 13:00,8
"""


@pytest.fixture
def epw(tmp_path):
    """Two days of which the first is clear and the second overcast."""
    path = tmp_path / "denver.epw"
    rows = (
        f"1999,6,{day},{hour},60,A7,0,0,60,83400,0,0,250,9999,0,0,0,0,0,0,200,3,{cover},3\n"
        for day, cover in ((21, 0), (22, 10))
        for hour in range(1, 25)
    )
    path.write_text(EPW + "".join(rows))
    return path


@pytest.fixture
def uvi(tmp_path):
    path = tmp_path / "sky.csv"
    path.write_text(UVI)
    return path


def run(arguments, capsys):
    assert main(arguments.split()) == 0
    return capsys.readouterr().out


def rows(text):
    return {
        int(row["hour"]): float(row["erythemal_sed"]) for row in csv.DictReader(io.StringIO(text))
    }


def test_all_hours_of_a_file_and_those_of_a_day(epw, capsys):
    whole = rows(run(f"dose --weather {epw}", capsys))
    assert list(whole) == list(range(48))
    assert whole[36] == pytest.approx(0.31 * whole[12], rel=5e-3)
    some = rows(run(f"dose --weather {epw} --sun 2026-06-21:11-13 --sun 2026-06-22:12-13", capsys))
    assert list(some) == [11, 12, 36]
    assert some[12] == pytest.approx(whole[12], rel=1e-3)
    clear = rows(
        run(
            "dose --sun 2026-06-21:12-13 --latitude 39.83 --longitude=-104.65 --utc-offset=-7 "
            "--altitude 1650",
            capsys,
        )
    )
    assert some[12] == pytest.approx(clear[12], rel=1e-9)
    snow = rows(run(f"dose --weather {epw} --sun 2026-06-21:12-13 --ground snow", capsys))
    assert snow[12] > 1.3 * some[12]


def test_a_forecast_of_the_uv_index(uvi, capsys):
    whole = rows(run(f"dose --weather {uvi}", capsys))
    assert whole == pytest.approx({10: 0.9 * 5.5, 11: 0.9 * 6.5, 36: 7.2})
    some = rows(run(f"dose --weather {uvi} --sun 2026-06-22:12:30-13 --upf 2", capsys))
    assert some == pytest.approx({36: 1.8})
    early = rows(run(f"dose --weather {uvi} --start 2026-06-20 --spf 10", capsys))
    assert list(early) == [34, 35, 60]


def test_what_dose_prints_goes_into_tan(epw, tmp_path, capsys, monkeypatch):
    """By a file and by a pipe, as the weather itself."""
    printed = run(f"dose --weather {epw}", capsys)
    own = run(f"tan --weather {epw} --hours 200 --step 24", capsys)
    schedule = tmp_path / "doses.csv"
    schedule.write_text(printed)
    assert run(f"tan --schedule {schedule} --hours 200 --step 24", capsys) == own
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(printed.encode())))
    assert run("tan --schedule - --hours 200 --step 24", capsys) == own
    assert float(own.splitlines()[-1].split(",")[4]) > 1.1


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("--weather {epw} --latitude 40", "--latitude is given with --weather, whose file says it"),
        ("--weather {epw} --cloud 0.5", "--cloud is given with --weather"),
        ("--weather {uvi} --ozone 300", "--ozone is given with --weather"),
        ("--weather {epw} --sun 2026-06-23:10-12", "no row for the hour 11 of 6/23"),
        ("--weather {epw} --start 2026-06-22", "lies before hour 0"),
        (
            "--weather {uvi} --sun 2026-06-23:10-12",
            "which has UV indices of 2026-06-21 to 2026-06-22",
        ),
        ("--weather {uvi} --sun 2026-06-21:10-27", "hour of sun is 27; allowed is 0 to 24"),
        ("--weather /none.epw", "/none.epw cannot be read: No such file"),
        ("--schedule {epw}", "denver.epw cannot be read"),
    ],
)
def test_weather_that_cannot_be_used_is_one_sentence(epw, uvi, capsys, arguments, sentence):
    assert main(["dose", *arguments.format(epw=epw, uvi=uvi).split()]) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err
    assert printed.err.count("\n") == 1
    assert printed.out == ""
