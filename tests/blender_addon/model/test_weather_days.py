"""Times in the sun from a weather file: what the file leaves out is said."""

import pytest

from blender_addon.model.weather import weather_exposures
from hylios.errors import InputError


def test_what_a_file_leaves_out_is_said(tmp_path):
    """Times in UTC, one without an index, and no index from 8 to 12 h."""
    path = tmp_path / "uv.json"
    hours = (7, 8, 10, 12, 13, 14)
    entries = (
        f'{{"uv_time": "2026-06-21T{hour:02d}:00Z", "uv": {"null" if hour == 10 else 5}}}'
        for hour in hours
    )
    path.write_text(f"[{','.join(entries)}]")
    read = weather_exposures(path, month=1, day_of_month=1, days=3, first=7.0, last=13.0)
    (exposure,) = read.exposures
    assert (exposure["name"], exposure["dose"]) == ("2026-06-21", 9.0)
    few, missing, clock, dark = read.remarks
    assert few.endswith(" holds 1 of the 3 days.")
    assert missing.startswith("1 of 6 UV indices of ") and missing.endswith("is missing.")
    assert clock.startswith("Hours are in UTC: ")
    assert dark.startswith("4 hours of day count as dark: ")


def test_a_file_without_any_index_says_that_all_are_missing(tmp_path):
    path = tmp_path / "uv.csv"
    path.write_text("time,uv_index\n" + "".join(f"2026-06-21T{h:02d}:00,\n" for h in range(24)))
    with pytest.raises(InputError, match="no UV index: all 24 are missing"):
        weather_exposures(path, month=1, day_of_month=1, days=3, first=7.0, last=13.0)
