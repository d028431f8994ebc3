"""Doses under the weather of a file."""

from datetime import date, timedelta

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.readers.epw import Weather
from hylios.sun.action_spectra import Absorptance
from hylios.sun.doses import of_sun
from hylios.sun.position import sun
from hylios.sun.sky import ClearSky
from hylios.sun.weather import EXPONENT, days_of, of_days, of_weather, ultraviolet_factor

SKIN = Absorptance([280.0, 400.0], [0.9, 0.7])
SUMMER = date(2026, 6, 21)
DENVER = 39.83, -104.65, -7.0, 1650.0


def haurwitz(hour):
    """W/m^2 under a clear sky on average over an hour that begins then."""
    instants = np.linspace(hour, hour + 1.0, 601)
    zenith = sun(SUMMER, instants, *DENVER[:3]).zenith
    cosine = np.maximum(np.cos(np.radians(zenith)), 1e-3)
    return float(np.mean(1098.0 * cosine * np.exp(-0.057 / cosine)))


def weather(radiation, cover, day=(6, 21)):
    """From midnight on, an hour for each value."""
    rows = {(*day, hour): hour for hour in range(len(radiation))}
    lines = np.arange(9, 9 + len(radiation))
    values = np.array(radiation, dtype=float), np.array(cover, dtype=float)
    return Weather("denver.epw", *DENVER, rows, *values, lines)


CLEAR = [haurwitz(hour) for hour in range(24)]
ALL = of_sun(
    SUMMER,
    0,
    24,
    DENVER[0],
    SKIN,
    longitude=DENVER[1],
    utc_offset=-7.0,
    sky=ClearSky(altitude=1650),
)


def every(doses):
    told = doses.erythemal, doses.melanogenesis, doses.thickening, doses.uva
    return np.array([values for values in told if values is not None])


def test_a_clear_day_is_the_clear_skys():
    """At the file's place, clock and height."""
    doses = of_weather(weather(CLEAR, [0.0] * 24), SUMMER, 0.0, 24.0, SKIN)
    assert doses.hours.tolist() == list(range(24))
    assert every(doses) == pytest.approx(every(ALL), rel=2e-3)


def test_half_the_radiation_is_more_than_half_the_ultraviolet():
    """2^-.76 = .59; hours without radiation go by clouds, of which half a sky leaves .837; and a
    share of an hour is one."""
    radiation = [0.5 * value if hour < 13 else np.nan for hour, value in enumerate(CLEAR)]
    grey = weather(radiation, [0.5] * 24)
    doses = of_weather(grey, SUMMER, 11.5, 14.0, SKIN, start=date(2026, 6, 20))
    assert doses.hours.tolist() == [35.0, 36.0, 37.0]
    ratio = doses.erythemal[1:] / ALL.erythemal[12:14]
    assert ratio == pytest.approx([0.5**EXPONENT, 0.8367], rel=2e-3)
    assert doses.uva[1:] / ALL.uva[12:14] == pytest.approx(ratio)
    assert doses.erythemal[0] == pytest.approx(0.5**EXPONENT * 0.5 * ALL.erythemal[11], rel=3e-2)


def test_bright_clouds_and_a_low_sun_are_bounded():
    """More than the clear sky counts up to 1.2 times; at sunrise the clouds count."""
    bright = weather([3.0 * value for value in CLEAR], [0.8] * 24)
    assert ultraviolet_factor(bright, SUMMER, 12) == pytest.approx(1.2**EXPONENT)
    assert 0.0 < CLEAR[4] < 50.0
    assert ultraviolet_factor(bright, SUMMER, 4) == pytest.approx(0.646)


def test_the_night_needs_no_weather_and_the_day_does():
    nothing = weather([np.nan] * 24, [np.nan] * 24)
    assert of_weather(nothing, SUMMER, 0.0, 4.0, SKIN).erythemal.sum() == 0.0
    with pytest.raises(InputError, match="neither global radiation nor .* in line 21; needed is"):
        of_weather(nothing, SUMMER, 12.0, 13.0, SKIN)
    with pytest.raises(InputError, match="denver.epw has no row for the hour 13 of 6/22"):
        of_weather(nothing, date(2026, 6, 22), 12.0, 13.0, SKIN)


def test_days_of_a_file_go_on_into_the_next_year():
    rows = {key: number for number, key in enumerate([(12, 31, 22), (12, 31, 23), (1, 1, 0)])}
    some = Weather("x.epw", *DENVER, rows, np.ones(3), np.ones(3), np.arange(3))
    assert days_of(some) == [(date(2001, 12, 31), 22.0, 24.0), (date(2002, 1, 1), 0.0, 1.0)]
    leap = weather([1.0], [1.0], (2, 29))
    assert days_of(leap) == [(date(2000, 2, 29), 0.0, 1.0)]


@pytest.mark.parametrize(
    ("first", "count"),
    [(date(2003, 7, 1), 366), (date(2003, 12, 1), 122), (date(2004, 1, 1), 366)],
)
def test_a_span_with_29_february_begins_in_any_month(first, count):
    days = [first + timedelta(days=passed) for passed in range(count)]
    rows = {(day.month, day.day, hour): 0 for day in days for hour in (0, 23)}
    told = days_of(Weather("x.epw", *DENVER, rows, np.ones(1), np.ones(1), np.zeros(1)))
    assert told == [(day.replace(year=day.year - 4), 0.0, 24.0) for day in days]


def test_hours_of_which_a_file_says_nothing_are_dark_and_counted():
    """Here 11 and 12 h; at night nothing is needed."""
    radiation, cover = np.array(CLEAR), np.full(24, np.nan)
    radiation[[2, 11, 12]] = np.nan
    some = weather(radiation, cover)
    (doses,), dark = of_days(some, [(SUMMER, 0.0, 24.0)], SKIN)
    expected = every(of_weather(weather(CLEAR, cover), SUMMER, 0.0, 24.0, SKIN))
    assert dark == 2
    expected[:, [11, 12]] = 0.0
    assert every(doses) == pytest.approx(expected)
    with pytest.raises(InputError, match="in line 20; needed is one of them"):
        of_weather(some, SUMMER, 0.0, 24.0, SKIN)
    nothing = weather([np.nan] * 24, [np.nan] * 24)
    with pytest.raises(InputError, match="total sky cover of any hour with sun; needed"):
        of_days(nothing, [(SUMMER, 10.0, 14.0)], SKIN)
