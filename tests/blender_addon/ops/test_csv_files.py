"""Exposures written as CSV and read back by the buttons."""

import bpy
import pytest
from scenes import tan_object


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
    with pytest.raises(RuntimeError, match="used, 'Carnival': day of the month is 30, .* 1 to 28"):
        bpy.ops.skin_tan.apply()
