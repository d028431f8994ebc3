"""Which skins are offered, and in which order."""

from pathlib import Path

import numpy as np

from blender_addon.model import catalogue
from blender_addon.model.catalogue import ShippedTable
from blender_addon.props.skins import skin_items, usual_skin


def test_types_are_offered_first_and_type_3_is_usual():
    names = ["S4", "VI", "S1", "III", "I", "Ada", "IV"]
    assert sorted(names, key=catalogue.in_order) == ["I", "III", "IV", "VI", "Ada", "S1", "S4"]
    assert usual_skin(["I", "III", "S3", "FILE"]) == "III"
    assert usual_skin(["S1", "S3", "FILE"]) == "S3"
    assert usual_skin(["FILE"]) == "FILE"


def test_what_is_shipped_is_offered():
    items = skin_items(ShippedTable(name, Path()) for name in ("III", "S3", "Ada"))
    assert [item[0] for item in items] == ["III", "S3", "Ada", "FILE"]
    assert [item[1] for item in items[:3]] == ["Type III, intermediate", "Light (S3)", "Skin (Ada)"]
    assert [item[2] for item in items[:3]] == [
        "Fitzpatrick skin type III, fitted to measured people",
        "Skin S3 of the thesis",
        "Skin Ada",
    ]
    numbers = [item[3] for item in items]
    assert len(set(numbers)) == len(numbers) and np.all(np.array(numbers) >= 0)


def test_a_damaged_table_is_offered_with_what_to_do():
    (item, _) = skin_items([ShippedTable("VI", Path(), problem="it is cut short.")])
    assert item[:2] == ("VI", "Type VI, dark")
    assert item[2] == "This skin cannot be used, install the add-on anew: it is cut short."
