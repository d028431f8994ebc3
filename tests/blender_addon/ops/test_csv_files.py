"""Exposures written as CSV and read back by the buttons."""

import bpy
import pytest
from scenes import tan_object
from synthetic import provenance

from blender_addon.model import doses
from blender_addon.model.settings import Exposure


@pytest.fixture
def body(table_path):
    return tan_object(table_path)


def shown(obj):
    return [
        (item.name, item.enabled, item.day, item.unit, item.dose, item.multiple, item.sunscreen)
        for item in obj.skin_tan.exposures
    ]


def test_there_and_back(body, tmp_path):
    first = body.skin_tan.exposures[0]
    first.name, first.enabled = "Beach, first day", False
    bpy.ops.skin_tan.add_exposure(name="Boat", day=3.0)
    boat = body.skin_tan.exposures[1]
    boat.unit, boat.multiple, boat.sunscreen = "MMD", 2.5, True
    path = str(tmp_path / "sun.csv")
    bpy.ops.skin_tan.export_exposures(filepath=path)
    before = [row[:4] + row[6:] for row in shown(body)]
    body.skin_tan.exposures.clear()
    bpy.ops.skin_tan.import_exposures(filepath=path)
    assert [row[:4] + row[6:] for row in shown(body)] == before
    bpy.ops.skin_tan.import_exposures(filepath=path, replace=False)
    assert len(body.skin_tan.exposures) == 4


def test_day_and_sed_are_enough(body, tmp_path):
    path = tmp_path / "sun.csv"
    path.write_text("day,SED\n0,12.5\n2,6\n")
    bpy.ops.skin_tan.import_exposures(filepath=str(path))
    assert [row[2:5] for row in shown(body)] == [(0.0, "SED", 12.5), (2.0, "SED", 6.0)]


def test_a_bad_file_changes_nothing(body, tmp_path):
    path = tmp_path / "sun.csv"
    path.write_text("day,SED\n0,a lot\n")
    before = shown(body)
    with pytest.raises(RuntimeError, match="sun.csv"):
        bpy.ops.skin_tan.import_exposures(filepath=str(path))
    assert shown(body) == before


def test_apply_names_the_time_in_the_sun_that_cannot_be(body):
    first = body.skin_tan.exposures[0]
    first.unit, first.name, first.month, first.day_of_month = "SUN", "Carnival", 2, 30
    with pytest.raises(RuntimeError, match="used, 'Carnival': day of the month is 30, .* 1 to 29"):
        bpy.ops.skin_tan.apply()


DAYS = "time,uv_index\n" + "".join(
    f"2026-06-{day}T{hour:02d}:00,{index}\n"
    for day in (21, 22)
    for hour, index in ((8, 0), (11, 6), (12, 8), (13, 6), (20, 0))
)


def test_uv_indices_become_days_of_sun(body, tmp_path):
    """Six and eight from 11 to 12 are seven on average, and an hour of UV index 1 is .9 SED."""
    path = tmp_path / "uv.csv"
    path.write_text(DAYS)
    more = {"from_hour": 11.0, "to_hour": 13.0, "replace": True}
    assert bpy.ops.skin_tan.import_weather(filepath=str(path), **more) == {"FINISHED"}
    told = [(item.name, item.unit, item.day, item.dose) for item in body.skin_tan.exposures]
    assert [row[:2] for row in told] == [("2026-06-21", "SED"), ("2026-06-22", "SED")]
    assert [row[2] for row in told] == pytest.approx([11 / 24, 1 + 11 / 24])
    assert [row[3] for row in told] == pytest.approx([14.0 * 0.9] * 2)
    with pytest.raises(RuntimeError, match="no sun from 1 to 3 h"):
        bpy.ops.skin_tan.import_weather(filepath=str(path), from_hour=1.0, to_hour=3.0)
    assert len(body.skin_tan.exposures) == 2


def test_a_clear_week_of_an_epw_file_is_that_of_the_sun(body, tmp_path):
    """By the clock of Denver, where the sun stands highest at 12:00 within minutes in June."""
    rows = [
        ",".join(["2001", "6", str(day), str(hour), "60", "", *["0"] * 7, "9999", *["0"] * 8, "0"])
        for day in (21, 22, 23)
        for hour in range(1, 25)
    ]
    place = "LOCATION,Denver,CO,USA,TMY3,724690,39.83,-104.65,-7.0,1650.0"
    periods = "DATA PERIODS,1,1,Data,Thursday,6/21,6/23"
    path = tmp_path / "denver.epw"
    path.write_text("\n".join([place, periods, *rows]) + "\n")
    more = {"month": 6, "day_of_month": 21, "days": 3, "from_hour": 11.0, "to_hour": 13.0}
    assert bpy.ops.skin_tan.import_weather(filepath=str(path), **more) == {"FINISHED"}
    first, second, third = body.skin_tan.exposures
    assert (first.name, third.name) == ("06-21", "06-23")
    sun = body.skin_tan.exposures.add()
    sun.unit, sun.latitude, sun.altitude = "SUN", 39.83, 1650.0
    sun.month, sun.day_of_month, sun.from_hour, sun.to_hour = 6, 21, 11.0, 13.0
    clear = doses.received([Exposure.of(sun)], 5.0, provenance("intermediate")).erythemal.sum()
    assert first.dose == pytest.approx(clear, rel=0.01)
    assert second.dose == pytest.approx(first.dose, rel=0.01)
    with pytest.raises(RuntimeError, match="denver.epw has no row for the hour 12 of 6/24"):
        bpy.ops.skin_tan.import_weather(filepath=str(path), **(more | {"days": 4}))
    with pytest.raises(RuntimeError, match="number of days is 0; allowed is 1 to"):
        bpy.ops.skin_tan.import_weather(filepath=str(path), **(more | {"days": 0}))
    assert len(body.skin_tan.exposures) == 4
    sun.day = 20.3
    bpy.ops.skin_tan.import_weather(filepath=str(path), replace=False, **more)
    added = [exposure.day - 11.0 / 24.0 for exposure in list(body.skin_tan.exposures)[4:]]
    assert added == pytest.approx([21.0, 22.0, 23.0], abs=1e-5)
