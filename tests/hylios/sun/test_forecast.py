"""Doses of UV indices over time."""

from datetime import date

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from hylios.errors import InputError
from hylios.readers.uv_forecast import Forecast
from hylios.sun.doses import of_uv_index
from hylios.sun.forecast import hours_without_index, of_forecast
from hylios.sun.protection import clothing

SUMMER = date(2026, 6, 21)


def forecast(hours, indices):
    return Forecast("sky.json", SUMMER, np.array(hours, float), np.array(indices, float))


def test_an_even_uv_index_is_that_of_its_hours():
    told = of_forecast(forecast([10.0, 11.0, 12.0, 12.5], [8.0] * 4), protection=clothing(2.0))
    expected = of_uv_index(10, 8.0, 2.5, clothing(2.0))
    assert told.hours.tolist() == expected.hours.tolist()
    assert told.erythemal == pytest.approx(expected.erythemal)


def test_a_uv_index_is_linear_between_times_and_a_night_is_dark():
    """5 to 7 in an hour is 6; 8 to 17 h of two days, of which the second begins at hour 32."""
    rise = of_forecast(forecast([10.0, 11.0], [5.0, 7.0]))
    assert rise.erythemal == pytest.approx([5.4])
    days = forecast([16.0, 17.0, 32.0, 33.0], [3.0, 2.0, 1.0, 2.0])
    assert of_forecast(days).hours.tolist() == [16.0, 32.0]
    outside = of_forecast(days, 16.5, 32.5, start=date(2026, 6, 20))
    assert outside.hours.tolist() == [40.0, 56.0]
    assert outside.erythemal == pytest.approx([0.9 * 0.5 * 2.25, 0.9 * 0.5 * 1.25])
    assert of_forecast(days, 20.0, 24.0).hours.size == 0
    with pytest.raises(InputError, match="begin on 2026-06-21, before hour 0"):
        of_forecast(days, start=date(2026, 6, 22))


@pytest.mark.parametrize(
    ("hours", "indices", "begin", "end", "dark"),
    [
        ([6, 9, 12, 15, 18], [0, 4, 8, 4, 0], 6, 18, 0.0),
        ([8, 9, 12, 16, 17], [1, 2, 8, 2, 1], 8, 17, 4.0),
        ([8, 9, 12, 16, 17], [1, 2, 8, 2, 1], 13, 14.5, 1.5),
        ([10, 11, 12, 13, 14, 34, 35, 36, 37, 38], [6, 7, 8, 7, 6] * 2, 10, 38, 2.0),
        ([11, 12, 13], [7, 8, 7], 0, 24, 4.0),
        ([1, 2, 3, 4, 5], [4, 7, 8, 7, 4], 0, 24, 2.0),
        ([16, 17, 32, 33], [3, 2, 1, 2], 16, 33, 0.0),
        ([0, 1, 12, 13], [0, 0, 0, 0], 0, 24, 0.0),
    ],
)
def test_hours_of_day_without_an_index_are_counted(hours, indices, begin, end, dark):
    """Three hours before and after noon, whatever clock has it, and steps of 3 to 8 hours."""
    told = hours_without_index(forecast(hours, indices), begin, end)
    assert told == pytest.approx(dark, abs=1e-9)


def test_indices_far_apart_are_refused():
    """Else a day of 2, 8 and 3 every four hours, or every day's greatest, would be no dose."""
    for told in (forecast([8, 12, 16], [2, 8, 3]), forecast([0, 24, 48], [8, 9, 8])):
        with pytest.raises(InputError, match="hours apart or more; allowed is 3 hours"):
            of_forecast(told)


@settings(max_examples=60)
@given(
    st.lists(st.tuples(st.floats(0.01, 5.0), st.floats(0.0, 12.0)), min_size=2, max_size=20),
    st.floats(0.0, 60.0),
)
def test_parts_of_a_forecast_add_up(steps, cut):
    assume(min(step for step, _ in steps[1:]) < 3.0)
    told = forecast(np.cumsum([step for step, _ in steps]), [index for _, index in steps])
    whole = of_forecast(told).erythemal.sum()
    parts = of_forecast(told, 0.0, cut).erythemal.sum(), of_forecast(told, cut).erythemal.sum()
    assert sum(parts) == pytest.approx(whole, abs=1e-9)
