"""Where the sun stands, against published values."""

from datetime import date

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hylios.errors import InputError
from hylios.sun.position import sun

SUMMER, WINTER = date(2025, 6, 21), date(2025, 12, 21)
LATITUDES = st.floats(-90.0, 90.0)
DAYS = st.dates(date(1900, 1, 1), date(2100, 12, 31))


def test_the_worked_example_of_the_solar_position_algorithm():
    """Reda and Andreas, NREL/TP-560-34302: 2003-10-17, 12:30:30 at UTC - 7, before refraction."""
    place = sun(date(2003, 10, 17), 12.0 + 30.5 / 60.0, 39.742476, -105.1786, -7.0)
    assert 90.0 - place.zenith == pytest.approx(39.872046, abs=0.003)
    assert place.azimuth == pytest.approx(194.340241, abs=0.003)
    assert place.distance == pytest.approx(0.9965423, abs=1e-5)


def test_the_worked_example_of_meeus():
    """Example 25.a: 1992-10-13, 0 h: declination -7.78507, distance .99766."""
    place = sun(date(1992, 10, 13), 0.0, 90.0, 0.0)
    assert 90.0 - place.zenith == pytest.approx(-7.78507, abs=1e-3)
    assert place.distance == pytest.approx(0.99766, abs=1e-5)


@pytest.mark.parametrize(
    ("day", "declination", "error"),
    [
        (SUMMER, 23.436, 0.005),
        (WINTER, -23.436, 0.005),
        (date(2025, 3, 20), 0.0, 0.2),
        (date(2025, 9, 22), 0.0, 0.2),
    ],
)
@pytest.mark.parametrize("latitude", [-35.0, 0.0, 40.0, 60.0])
def test_noon_at_the_turns_of_the_year(day, declination, error, latitude):
    place = sun(day, 12.0, latitude)
    assert place.zenith == pytest.approx(abs(latitude - declination), abs=error)
    towards = 180.0 if latitude > declination else 0.0
    if abs(latitude - declination) > 1.0:
        assert np.cos(np.radians(place.azimuth - towards)) == pytest.approx(1.0)


def test_the_sun_rises_in_the_east_and_sets_in_the_west():
    for latitude in (-35.0, 50.0):
        place = sun(date(2025, 3, 20), np.array([6.0, 18.0]), latitude)
        assert place.azimuth == pytest.approx([90.0, 270.0], abs=0.5)
        assert place.zenith == pytest.approx([90.0, 90.0], abs=0.5)


def test_polar_night_and_midnight_sun():
    hours = np.linspace(0.0, 24.0, 97)
    assert np.all(sun(WINTER, hours, 75.0).zenith > 90.0)
    assert np.all(sun(SUMMER, hours, 75.0).zenith < 90.0)
    assert np.all(sun(SUMMER, hours, -75.0).zenith > 90.0)


@pytest.mark.parametrize(("day", "minutes"), [((2025, 11, 3), 16.45), ((2025, 2, 11), -14.22)])
def test_a_clock_at_greenwich_differs_by_the_equation_of_time(day, minutes):
    """At its two extremes, which almanacs have at 16 min 27 s and -14 min 13 s."""
    hours = np.linspace(11.0, 13.0, 12_001)
    south = hours[np.argmin(np.abs(sun(date(*day), hours, 51.48, 0.0).azimuth - 180.0))]
    assert 60.0 * (12.0 - south) == pytest.approx(minutes, abs=0.05)


def test_a_clock_is_set_by_its_offset():
    summer_time = sun(SUMMER, 13.0, 48.0, 11.0, 2.0)
    assert summer_time == sun(SUMMER, 11.0, 48.0, 11.0)


@settings(max_examples=200)
@given(DAYS, st.floats(0.0, 24.0), LATITUDES, st.none() | st.floats(-180.0, 180.0))
def test_the_sun_is_somewhere(day, hour, latitude, longitude):
    place = sun(day, hour, latitude, longitude)
    assert 0.0 <= place.zenith <= 180.0
    assert 0.0 <= place.azimuth <= 360.0
    assert 0.98 < place.distance < 1.02


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((date(1899, 1, 1), 12.0, 40.0), "year of the sun is 1899; allowed is 1900 to 2100"),
        ((SUMMER, 12.0, 91.0), "latitude is 91 degrees"),
        ((SUMMER, 12.0, np.nan), "latitude is nan degrees"),
        ((SUMMER, np.nan, 40.0), "an hour of the day is not a number"),
        ((SUMMER, 12.0, 40.0, 181.0), "longitude is 181 degrees"),
        ((SUMMER, 12.0, 40.0, 0.0, 15.0), "offset from UTC is 15 hours"),
    ],
)
def test_a_bad_place_or_time_is_named(arguments, sentence):
    with pytest.raises(InputError, match=sentence):
        sun(*arguments)
