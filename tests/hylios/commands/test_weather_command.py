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


@pytest.fixture
def utc(tmp_path):
    """As OpenUV has a day in Tokyo: in universal time, 9 hours behind."""
    path = tmp_path / "utc.json"
    entries = (
        f'{{"uv": {uv}, "uv_time": "2026-06-{day}T{hour:02d}:00:00.000Z"}}'
        for day, hour, uv in ((20, 21, 0), (21, 0, 6), (21, 3, 8), (21, 6, 6), (21, 9, 0))
    )
    path.write_text(f'{{"result": [{",".join(entries)}]}}')
    return path


@pytest.fixture
def tokyo(tmp_path):
    """The same as OpenWeather has it, which says the place's clock, from midnight on."""
    path = tmp_path / "tokyo.json"
    entries = (
        f'{{"dt": {1781967600 + 10800 * number}, "uvi": {uv}}}'
        for number, uv in enumerate(("0", "0", "0", "6", "8", "6", "0", "null"))
    )
    path.write_text(f'{{"timezone_offset": 32400, "lon": 139.7, "hourly": [{",".join(entries)}]}}')
    return path


def run(arguments, capsys):
    return notes_of(arguments, capsys)[0]


def notes_of(arguments, capsys):
    """What is printed, and the notes."""
    assert main(arguments.split()) == 0
    return tuple(capsys.readouterr())


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


def test_hours_outside_are_those_of_the_place(utc, tokyo, capsys):
    """8 at noon in Tokyo, and 6 three hours before and after."""
    expected = {10: 0.9 * 7.0, 11: 0.9 * 23.0 / 3.0, 12: 0.9 * 23.0 / 3.0}
    said = "--sun 2026-06-21:10-13"
    out, notes = notes_of(f"dose --weather {tokyo} {said}", capsys)
    assert rows(out) == pytest.approx(expected)
    assert "1 of 8 UV indices of" in notes and "time zone" not in notes
    out, notes = notes_of(f"dose --weather {utc} {said} --utc-offset 9", capsys)
    assert rows(out) == pytest.approx(expected)
    assert "dark" not in notes and "in UTC" not in notes
    out, notes = notes_of(f"dose --weather {utc}", capsys)
    assert sum(rows(out).values()) == pytest.approx(0.9 * 60.0)
    assert "hours are in UTC: " in notes


def test_hours_without_light_are_noted(tokyo, uvi, capsys):
    """From noon to noon six of day are missing; at night there is no light."""
    assert "6 hours of day count as dark" in notes_of(f"dose --weather {uvi}", capsys)[1]
    out, notes = notes_of(f"dose --weather {tokyo} --sun 2026-06-21:0-3", capsys)
    assert "there is no UV index above 0 on 2026-06-21 from 0 to 3 h in" in notes
    assert "dark" not in notes and rows(out) == {}


def test_an_epw_file_with_gaps_and_a_wrong_clock(epw, tmp_path, capsys):
    """Noon is at 2 a.m. where a time zone of 7 hours is given for -7; radiation that is there is
    said to count, an hour with neither is dark."""
    _, notes = notes_of(f"dose --weather {epw}", capsys)
    assert "48 of 48 hours of" in notes and "to the power" not in notes
    assert notes.count("that haze thins out") == 1 and "dark" not in notes
    other = tmp_path / "odd.epw"
    text = epw.read_text().replace("-7.0,1650", "7.0,1650")
    lines = text.splitlines()
    lines[2] = lines[2].replace(",9999,", ",0,")
    lines[5] = lines[5].replace(",3,0,3", ",3,99,3")
    other.write_text("\n".join(lines))
    out, notes = notes_of(f"dose --weather {other}", capsys)
    assert "has a time zone of 7 hours and a longitude of -104.65 degrees" in notes
    assert "which puts noon at 1:59" in notes
    assert "to the power of .76" in notes
    assert "1 hour of day counts as dark: " in notes
    assert rows(out)[3] == 0.0 < rows(out)[2]


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
        ("--weather {uvi} --weather {epw}", "--weather is given 2 times; allowed is once"),
        ("--weather {uvi} --utc-offset 2", "sky.csv, whose times are on a place's clock; needed"),
        ("--weather {uvi} --sun 2026-06-21:12-11", "given from 12 to 11 h; the first must be less"),
        ("--weather {utc} --sun 2026-06-21:10-12", "which --sun is in; needed is --utc-offset"),
        ("--weather {utc} --utc-offset 20", "offset from UTC is 20 hours; allowed is -14 to 14"),
        ("--weather {tokyo} --utc-offset 9", "--utc-offset is given with --weather, whose file"),
        (
            "--weather {uvi} --sun 2026-06-23:10-12",
            "sky.csv, which has UV indices from 2026-06-21 10:00 to 2026-06-22 13:00.",
        ),
        ("--weather {uvi} --sun 2026-06-21:10-27", "hour of sun is 27; allowed is 0 to 24"),
        ("--weather /none.epw", "/none.epw cannot be read: No such file"),
        ("--schedule {epw}", "denver.epw cannot be read"),
    ],
)
def test_weather_that_cannot_be_used_is_one_sentence(
    epw, uvi, utc, tokyo, capsys, arguments, sentence
):
    files = {"epw": epw, "uvi": uvi, "utc": utc, "tokyo": tokyo}
    assert main(["dose", *arguments.format(**files).split()]) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err
    assert printed.err.count("\n") == 1
    assert printed.out == ""
