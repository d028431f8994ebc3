"""Which skins are offered, in which order, and how a table's skin tans."""

from dataclasses import replace

import numpy as np
import pytest

from blender_addon import properties, tables
from blender_addon.tan import tan
from hylios.errors import InputError
from hylios.skin import varied
from hylios.table import described_dynamics
from hylios.tanning import PIGMENTATIONS
from hylios.ultraviolet.exposures import of_sed

SPAN = {"mmd": 4.9, "med": 2.9, "first_day": 0.0, "last_day": 10.0}


def with_header(table, **changes):
    return replace(table, provenance={**table.provenance, **changes})


def darkest(table) -> float:
    return float(tan(table, of_sed(0, 30.0), **SPAN).colour.min())


def test_the_dynamics_in_the_header_count(table):
    """As numbers where they are there, by the set's name where not."""
    usual = PIGMENTATIONS["intermediate"]
    spelt = with_header(table, melanin_dynamics=described_dynamics(usual), pigmentation="low")
    assert darkest(spelt) == darkest(table)
    less = varied(usual, {"basale_extra_production": 0.0, "spinosum_extra_production": 0.0})
    assert darkest(with_header(table, melanin_dynamics=described_dynamics(less))) > darkest(table)


def test_a_table_that_does_not_say_how_it_tans_is_refused(table):
    with pytest.raises(InputError, match="the table's pigmentation is 'none'"):
        darkest(with_header(table, pigmentation="none"))
    with pytest.raises(InputError, match="the table's melanin dynamics need the rates"):
        darkest(with_header(table, melanin_dynamics={"production": 1.0}))


def test_types_are_offered_first_and_type_3_is_usual():
    names = ["S4", "VI", "S1", "III", "I", "Ada", "IV"]
    assert sorted(names, key=tables.in_order) == ["I", "III", "IV", "VI", "Ada", "S1", "S4"]
    assert properties.usual_skin(["I", "III", "S3", "FILE"]) == "III"
    assert properties.usual_skin(["S1", "S3", "FILE"]) == "S3"
    assert properties.usual_skin(["FILE"]) == "FILE"


def test_what_is_shipped_is_offered(monkeypatch, table_path):
    shipped = tuple(tables.ShippedTable(name, "low", table_path) for name in ("III", "S3", "Ada"))
    monkeypatch.setattr(properties, "SHIPPED", shipped)
    items = properties._skin_items()
    assert [item[0] for item in items] == ["III", "S3", "Ada", "FILE"]
    assert [item[1] for item in items[:3]] == ["Type III, intermediate", "Light (S3)", "Skin (Ada)"]
    assert items[0][2] == "Fitzpatrick skin type III, low pigmentation"
    numbers = [item[3] for item in items]
    assert len(set(numbers)) == len(numbers) and np.all(np.array(numbers) >= 0)
