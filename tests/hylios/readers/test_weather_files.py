"""EPW files and UV indices by time: read as they are, refused in one sentence, however spoilt."""

import json
from datetime import date

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hylios.errors import InputError
from hylios.readers.epw import epw_of, is_epw, read_epw
from hylios.readers.uv_forecast import forecast_of, read_forecast
from hylios.sun.file_notes import of_forecast

HEAD = """\
LOCATION,Denver Intl Ap,CO,USA,TMY3,725650,39.83,-104.65,-7.0,1650.0
DESIGN CONDITIONS,0
TYPICAL/EXTREME PERIODS,0
GROUND TEMPERATURES,0
HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0
COMMENTS 1,made up
COMMENTS 2,as the format has it
DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31
"""


def row(month, day, hour, radiation=500, cover=3):
    return (
        f"1999,{month},{day},{hour},60,A7A7*0*0,-3.0,-9.0,60,83400,0,0,250,{radiation},0,0,0,0,0,0,"
        f"200,3.1,{cover},3,20.0,77777,9,999999999,50,0.0500,0,88,0.000,0.0,0.0\n"
    )


EPW = HEAD + row(6, 21, 12, 917, 0) + row(6, 21, 13, 9999, 7) + row(6, 21, 14, 120, 99)


def epw(text):
    return epw_of(text.splitlines(), "denver.epw")


def test_an_epw_file_as_it_is_written(tmp_path):
    path = tmp_path / "denver.epw"
    path.write_bytes(EPW.replace("\n", "\r\n").encode())
    weather = read_epw(path)
    place = weather.latitude, weather.longitude, weather.utc_offset, weather.altitude
    assert place == (39.83, -104.65, -7.0, 1650.0)
    assert weather.rows == {(6, 21, 11): 0, (6, 21, 12): 1, (6, 21, 13): 2}
    assert np.array_equal(weather.radiation, [917.0, np.nan, 120.0], equal_nan=True)
    assert weather.cover[:2] == pytest.approx([0.0, 0.7])
    assert np.isnan(weather.cover[2])
    assert weather.lines.tolist() == [9, 10, 11]


@pytest.mark.parametrize(
    ("before", "after", "sentence"),
    [
        ("LOCATION", "PLACE", "its first line is not LOCATION of an EPW file"),
        ("39.83", "139.83", "has a latitude of 139.83 in line 1; allowed is -90 to 90"),
        ("39.83", "north", "has a latitude of 'north' in line 1; expected a number"),
        (",-7.0,1650.0", "", "has 8 cells in line 1; the time zone is cell 9"),
        ("DATA PERIODS", "DATES", "it has no line DATA PERIODS in its first 30 lines"),
        ("DATA PERIODS,1,1", "DATA PERIODS,1,4", "rows per hour of 4 in line 8; allowed is 1"),
        ("1999,6,21,13", "1999,6,31,13", "has a day of 31 in line 10; month 6 has none"),
        ("1999,6,21,13", "1999,6,21,25", "has a clock hour of 25 in line 10; allowed is 1 to 24"),
        ("1999,6,21,13", "1999,6,21,1.5", "has a clock hour of 1.5 in line 10; allowed are whole"),
        ("1999,6,21,13", "1999,6,21,12", "has the hour 12 of 6/21 in line 10 and in line 9"),
        (",917,", ",-5,", "has a global radiation of -5 in line 9; allowed is 0 to 2000"),
        (",917,", ",nan,", "has a global radiation of nan in line 9; allowed is 0 to 2000"),
        (",917,", ",,", "has a global radiation of '' in line 9; expected a number"),
        (",3.1,7,", ",3.1,11,", "has a total sky cover of 11 in line 10; allowed is 0 to 10"),
        (EPW[len(HEAD) :], "", "has no rows after DATA PERIODS"),
    ],
)
def test_a_bad_epw_file_is_one_sentence(before, after, sentence):
    assert before in EPW
    with pytest.raises(InputError, match="denver.epw .*" + sentence.replace("(", "\\(")):
        epw(EPW.replace(before, after, 1))


@st.composite
def spoilt(draw, text):
    """A text with a few characters, lines or parts taken out, doubled or replaced."""
    for _ in range(draw(st.integers(1, 4))):
        begin = draw(st.integers(0, max(len(text) - 1, 0)))
        end = min(len(text), begin + draw(st.sampled_from([0, 1, 1, 2, 5, 60, 500])))
        other = draw(
            st.sampled_from(["", ",", "\n", "-", "9", "1e400", "nan", "x", '"', "[", "}", "null"])
            | st.text(max_size=3)
            | st.just(text[begin:end] * 2)
        )
        text = text[:begin] + other + text[end:]
    return text


@settings(max_examples=80)
@given(spoilt(EPW))
def test_a_spoilt_epw_file_is_read_or_refused(text):
    try:
        weather = epw(text)
    except InputError as error:
        assert str(error).startswith("denver.epw ")
        assert str(error).endswith(".") and "\n" not in str(error)
        return
    assert weather.radiation.size == weather.cover.size == len(weather.rows) > 0
    for values, most in ((weather.radiation, 2000.0), (weather.cover, 1.0)):
        present = values[~np.isnan(values)]
        assert np.all((present >= 0.0) & (present <= most))


HOURS = ["2026-06-21T10:00", "2026-06-21T11:00", "2026-06-21T12:30"]
UVI = [5.0, 7.25, 8.0]
ENTRIES = [{"uv": index, "uv_time": f"{hour}Z"} for hour, index in zip(HOURS, UVI, strict=True)]
SECONDS = [1782036000 + 3600 * hours for hours in (0.0, 1.0, 2.5)]
WRITTEN = {
    "csv": "time,uv_index\n" + "".join(f"{h},{u}\n" for h, u in zip(HOURS, UVI, strict=True)),
    "excel": "Time;UV index\n2026-06-21 10:00;5,0\n2026-06-21 11:00;7,25\n2026-06-21 12:30;8,0\n",
    "open-meteo": json.dumps({"latitude": 52.0, "hourly": {"time": HOURS, "uv_index": UVI}}),
    "openuv": json.dumps({"result": ENTRIES}),
    "openweather": json.dumps(
        {"hourly": [{"dt": dt, "uvi": u} for dt, u in zip(SECONDS, UVI, strict=True)]}
    ),
    "list": json.dumps([{"Time": h, "UVI": u} for h, u in zip(HOURS, UVI, strict=True)]),
}


def forecast(text):
    return forecast_of(text.splitlines(), "sky.txt")


@pytest.mark.parametrize("written", WRITTEN.values(), ids=WRITTEN)
def test_uv_indices_as_services_write_them(written, tmp_path):
    path = tmp_path / "sky.txt"
    path.write_text(written)
    told = read_forecast(path)
    assert told.day == date(2026, 6, 21)
    assert told.hours == pytest.approx([10.0, 11.0, 12.5])
    assert told.indices.tolist() == UVI


def test_uv_indices_of_the_environmental_protection_agency():
    told = forecast(
        '[{"ORDER": 1, "DATE_TIME": "Jun/21/2026 11 AM", "UV_VALUE": 7},'
        ' {"ORDER": 2, "DATE_TIME": "Jun/21/2026 12 PM", "UV_VALUE": 8}]'
    )
    assert told.hours.tolist() == [11.0, 12.0]


TOKYO = {"lon": 139.7, "timezone": "Asia/Tokyo", "timezone_offset": 32400}
SET = {"utc_offset_seconds": 7200, "timezone": "Europe/Paris"}
UNSET = {"longitude": 139.7, "utc_offset_seconds": 0, "timezone": "GMT"}
LONDON = {"utc_offset_seconds": 0, "timezone": "Europe/London"}


@pytest.mark.parametrize(
    ("place", "times", "first", "offset", "is_local"),
    [
        (TOKYO, SECONDS, 19.0, 9.0, True),
        ({"lat": 35.7}, SECONDS, 10.0, 0.0, False),
        (UNSET, HOURS, 10.0, 0.0, False),
        (UNSET, SECONDS, 10.0, 0.0, False),
        (LONDON, SECONDS, 10.0, 0.0, True),
        (SET, HOURS, 10.0, 2.0, True),
        ({}, HOURS, 10.0, None, True),
        ({}, [f"{hour}+09:30" for hour in HOURS], 10.0, 9.5, True),
        (SET, [f"{hour}Z" for hour in HOURS], 12.0, 2.0, True),
        ({}, [f"{hour}Z" for hour in HOURS], 10.0, 0.0, False),
    ],
)
def test_times_are_on_the_clock_of_the_place_where_the_file_says_it(
    place, times, first, offset, is_local
):
    """Open-Meteo and OpenWeather say its offset from UTC; GMT is what Open-Meteo takes for none."""
    told = forecast(json.dumps({**place, "hourly": {"time": times, "uv_index": UVI}}))
    assert told.hours == pytest.approx([first, first + 1.0, first + 2.5])
    assert (told.day, told.utc_offset, told.is_local) == (date(2026, 6, 21), offset, is_local)
    assert told.longitude == (139.7 if place in (TOKYO, UNSET) else None)


@pytest.mark.parametrize(
    ("times", "first", "offset"),
    [
        # Berlin, 29 March: an hour after 01:30 it is 03:30. 25 October: there are two hours of 2.
        (("2026-03-29T01:30+01:00", "2026-03-29T03:30+02:00", "2026-03-30T12+02:00"), 1.5, 1.0),
        (("2026-10-25T02:30+02:00", "2026-10-25T02:30+01:00", "2026-10-26T10+01:00"), 2.5, 2.0),
        (("2026-03-29T00:30+00:00", "2026-03-29T02:30+01:00", "2026-03-30T12+01:00"), 0.5, 0.0),
    ],
)
def test_where_the_clock_changes_all_hours_are_on_the_first(times, first, offset):
    told = forecast("time,uv_index\n" + "".join(f"{time},5\n" for time in times))
    assert told.hours == pytest.approx([first, first + 1.0, 35.0], abs=1e-9)
    assert (told.utc_offset, told.is_local, told.has_changes) == (offset, True, True)
    assert "hours are on the clock of the first time in sky.txt" in of_forecast(told, [])[0]


def test_universal_times_go_on_a_clock():
    """22:30 and 23:00 of Friday in Greenwich are 7:30 and 8:00 of Saturday in Tokyo."""
    told = forecast('[{"dt": 1782081000, "uvi": 1}, {"dt": 1782082800, "uvi": 2}]')
    assert told.hours.tolist() == [22.5, 23.0] and told.day == date(2026, 6, 21)
    here = told.on_clock(9.0)
    assert here.hours.tolist() == [7.5, 8.0] and here.day == date(2026, 6, 22)
    assert (here.utc_offset, here.is_local) == (9.0, True)
    with pytest.raises(InputError, match="offset from UTC is 15 hours; allowed is -14 to 14"):
        told.on_clock(15.0)
    with pytest.raises(InputError, match="sky.txt, whose times are on a place's clock; needed"):
        here.on_clock(9.0)


@pytest.mark.parametrize(
    "text",
    [
        json.dumps({"hourly": {"time": HOURS, "uv_index": [5.0, None, 8.0]}}),
        json.dumps(
            [{"dt": SECONDS[0], "uvi": 5}, {"dt": SECONDS[1]}, {"dt": SECONDS[2], "uvi": 8}]
        ),
        "time,uv_index\n{},5\n{},\n{},8\n".format(*HOURS),
        "time;uv_index\n{};5,0\n{};NA\n{};8,0\n".format(*HOURS),
    ],
)
def test_times_without_an_index_are_left_out_and_counted(text):
    told = forecast(text)
    assert told.hours == pytest.approx([10.0, 12.5])
    assert told.indices.tolist() == [5.0, 8.0]
    assert told.missing == 1


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("time,uv_index\n2026-06-21 10:00,5\n", "has 1 UV indices; needed are two or more"),
        ("time,uv_index\nnoon,5\n13,6\n", "has a time of 'noon' in line 2; expected one such as"),
        ("time,wind\n2026-06-21,5\n2026-06-22,5\n", "uv_index"),
        (
            "time,uv_index\n2026-06-21 10:00,5\n2026-06-21 11:00,-1\n",
            "has a UV index of -1.0 in line 3; allowed is 0 to 50",
        ),
        (
            "time,uv_index\n2026-06-21 10:00,5\n2026-06-21 10:00,6\n",
            "in line 3 after 2026-06-21T10:00:00; allowed are times that ascend",
        ),
        (
            "time,uv_index\n2026-06-21 10:00,5\n2026-06-21 11:00+02:00,6\n",
            "allowed is an offset from UTC in all times or in none",
        ),
        ("time,uv_index\n1901-06-21,5\n2026-06-22,5\n", "allowed is a century"),
        ("time,uv_index\n1026-06-21,5\n2026-06-22,5\n", "allowed are the years 1900 to 2100"),
        (
            '[{"dt": 1, "uvi": 2}, {"dt": 253402300000, "uvi": 3}]',
            "has a time of '253402300000' in entry 2; allowed are the years",
        ),
        ('{"hourly": {"time": [1, 2], "uv_index": [3]}}', "has 2 times and 1 UV indices"),
        ('{"hourly": {"time": [1, 2], "uv_index": [3, "x"]}}', "a UV index of 'x' in entry 2"),
        ('{"hourly": {"time": [1, 2], "uv_index": [3, 1e400]}}', "UV index of inf in entry 2"),
        ('{"hourly": {"time": [true, 2], "uv_index": [3, 4]}}', "has a time of true in entry 1"),
        ('{"hourly": {"time": [1, null], "uv_index": [3, 4]}}', "a time of null in entry 2"),
        ('{"hourly": {"time": [1, 2], "uv_index": [3, null]}}', "has 1 UV indices; needed are two"),
        ('{"timezone_offset": "+9", "hourly": [{"dt": 1, "uvi": 2}]}', "from UTC of '+9'; allowed"),
        ('{"utc_offset_seconds": 9e9, "hourly": []}', "allowed is -50400 to 50400 seconds"),
        (
            '{"daily": {"time": ["2026-06-21"], "uv_index_max": [8]}}',
            "has UV indices of whole days",
        ),
        ('{"hourly": {"time": [1, 2]}}', "has no times and UV indices; expected are lists called"),
        ('{"hourly": {"time": [1, 2],\n"uv', "it is no JSON in line 2"),
        ("[" * 100_000, "cannot be read: "),
    ],
)
def test_bad_uv_indices_are_one_sentence(text, sentence):
    with pytest.raises(InputError) as caught:
        forecast(text)
    assert sentence in str(caught.value)
    assert str(caught.value).startswith("sky.txt ")
    assert "\n" not in str(caught.value)


@settings(max_examples=80)
@given(st.sampled_from(list(WRITTEN.values())).flatmap(spoilt))
def test_spoilt_uv_indices_are_read_or_refused(text):
    try:
        told = forecast(text)
    except InputError as error:
        assert str(error).startswith("sky.txt ")
        assert str(error).endswith(".") and "\n" not in str(error)
        return
    assert told.hours.size == told.indices.size >= 2
    assert np.all(np.diff(told.hours) > 0.0)
    assert np.all((told.indices >= 0.0) & (told.indices <= 50.0))


def test_an_epw_file_is_told_from_others():
    assert is_epw(EPW.splitlines())
    assert not any(is_epw(text.splitlines()) for text in (*WRITTEN.values(), ""))
