"""Which skins are offered, in which order, and how a table's skin tans."""

from dataclasses import replace

import bpy
import numpy as np
import pytest
from synthetic import tan_object

import blender_addon.tan as module
from blender_addon import doses, properties, tables
from blender_addon.tan import tan
from hylios.errors import InputError
from hylios.skin import varied
from hylios.sun.action_spectra import Absorptance
from hylios.sun.doses import of_sed
from hylios.table import described_dynamics
from hylios.tanning import PIGMENTATIONS, states_at

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


def test_thickness_has_its_own_doses_and_the_med(table_path, monkeypatch):
    """What Apply asks of the tanning model: sun counts more for melanin; the frame range alone."""
    asked = {}

    def recorded(exposures, dynamics, **more):
        asked.update(more, exposures=exposures)
        return states_at(exposures, dynamics, **more)

    monkeypatch.setattr(module, "states_at", recorded)
    monkeypatch.setattr(doses, "absorptance", lambda _: Absorptance([280.0, 400.0], [0.9, 0.9]))
    settings = tan_object(table_path).skin_tan
    settings.exposures[0].unit = "SUN"
    settings.own_minimal_doses, settings.mmd, settings.med = True, 6.0, 4.0
    settings.first_day, settings.last_day = 3.0, 10.0
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    assert (asked["mmd"], asked["med"]) == (6.0, 4.0)
    assert (asked["times"].min(), asked["times"].max()) == (72.0, 240.0)
    whole = doses.of_exposure(settings.exposures[0], 6.0, {})
    assert np.array_equal(asked["exposures"].doses[-1], whole.melanogenesis)
    assert np.array_equal(asked["exposures"].thickening_doses[-1], whole.thickening)
    assert np.all(whole.melanogenesis > 2.0 * whole.thickening)


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
