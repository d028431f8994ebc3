"""Exposures as an artist gives them, against the functions of hylios that turn them into doses."""

from datetime import date
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from synthetic import tan_object

from blender_addon import doses
from hylios.errors import InputError
from hylios.sun.action_spectra import Absorptance
from hylios.sun.doses import of_sun

KNOWN = {"absorptance": {"wavelengths_nm": [280.0, 340.0, 400.0], "values": [0.97, 0.9, 0.7]}}
USUAL = {
    "day": 3.0,
    "unit": "SED",
    "dose": 10.0,
    "multiple": 2.5,
    "uv_index": 8.0,
    "duration": 2.5,
    "latitude": 40.0,
    "month": 7,
    "day_of_month": 15,
    "from_hour": 11.0,
    "to_hour": 13.5,
    "sunscreen": False,
    "spf": 30.0,
    "sunscreen_amount": 2.0,
}


def received(**changes):
    return doses.received([SimpleNamespace(**{**USUAL, **changes})], 4.0, KNOWN)


def test_the_same_in_all_units_but_the_sun():
    """10 SED; 2.5 MMD of 4 SED; an hour and a bit at UV index 8, spread over its hours."""
    for changes in ({}, {"unit": "MMD"}):
        found = received(**changes)
        assert found.hours.tolist() == [72] and found.melanogenesis.tolist() == [10.0]
    spread = received(unit="UV_INDEX")
    assert spread.hours.tolist() == [72.0, 73.0, 74.0]
    assert spread.thickening == pytest.approx([7.2, 7.2, 3.6])


def test_the_sun_of_a_day_is_placed_on_the_day_of_the_tan():
    found = received(unit="SUN", day=3.4)
    known = KNOWN["absorptance"]
    skin = Absorptance(np.array(known["wavelengths_nm"]), np.array(known["values"]))
    expected = of_sun(date(doses.ANY_YEAR, 7, 15), 11.0, 13.5, 40.0, skin)
    assert found.hours.tolist() == [72 + 11, 72 + 12, 72 + 13]
    assert np.array_equal(found.melanogenesis, expected.melanogenesis)
    assert np.all(found.melanogenesis > found.erythemal)
    assert np.all(received(unit="SUN", latitude=-40.0).erythemal < 0.5 * found.erythemal)


@pytest.mark.parametrize(("from_hour", "late"), [(0.0, False), (12.0, False), (13.0, True)])
def test_sun_is_late_by_its_hours(table_path, monkeypatch, capfd, from_hour, late):
    """Day 30.9 stands for day 30; what begins by the last day, noon of it, has an effect."""
    obj = tan_object(table_path)
    monkeypatch.setattr(doses, "absorptance", lambda _: Absorptance([280.0, 400.0], [0.9, 0.9]))
    exposure, obj.skin_tan.last_day = obj.skin_tan.exposures[0], 30.5
    exposure.unit, exposure.day = "SUN", 30.9
    exposure.from_hour, exposure.to_hour = from_hour, 16.0
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    assert ("after day 30.5 have no effect: 1." in capfd.readouterr().out) == late
    assert (np.ptp(pixels()[-4 * 512 :][::4]) > 0.0) != late


def test_thin_sunscreen_lets_through_the_root():
    """SPF 30 at 2 and at 0.5 mg/cm^2: a thirtieth, and the fourth root of that."""
    assert received(sunscreen=True).thickening == pytest.approx([10.0 / 30.0])
    thin = received(sunscreen=True, sunscreen_amount=0.5)
    assert thin.melanogenesis == pytest.approx([10.0 * 30.0**-0.25])


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"day": -1.0}, "day of an exposure is -1"),
        ({"unit": "SUN", "month": 2, "day_of_month": 30}, "day of the month is 30, which month 2"),
        ({"unit": "SUN", "from_hour": 15.0}, "sun is asked for from 15 to 13.5 h"),
        ({"sunscreen": True, "spf": 0.5}, "SPF is 0.5; allowed is 1 to"),
    ],
)
def test_what_cannot_be_is_named(changes, sentence):
    with pytest.raises(InputError, match=sentence):
        received(**changes)


def test_a_table_without_absorptance_has_no_sun():
    exposure = SimpleNamespace(**{**USUAL, "unit": "SUN"})
    with pytest.raises(InputError, match="what its skin absorbs in the ultraviolet"):
        doses.received([exposure], 4.0, {})
    with pytest.raises(InputError, match="what its skin absorbs"):
        doses.absorptance({"absorptance": {"wavelengths_nm": None, "values": 3}})


def test_apply_takes_every_unit(table_path, monkeypatch):
    """In Blender's own property groups; an image for each differs from that of no sun."""
    obj = tan_object(table_path)
    monkeypatch.setattr(doses, "absorptance", lambda _: Absorptance([280.0, 400.0], [0.9, 0.9]))
    exposure = obj.skin_tan.exposures[0]
    seen = {}
    for unit in ("SED", "MMD", "UV_INDEX", "SUN"):
        exposure.unit = unit
        exposure.sunscreen = False
        assert bpy.ops.skin_tan.apply() == {"FINISHED"}
        bare = pixels()
        exposure.sunscreen, exposure.spf = True, 50.0
        assert bpy.ops.skin_tan.apply() == {"FINISHED"}
        seen[unit] = bare
        assert np.abs(pixels() - bare).max() > 0.02
    assert len({each.tobytes() for each in seen.values()}) == 4


def pixels() -> np.ndarray:
    image = bpy.data.images["Skin Tan Colour Body"]
    values = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(values)
    return values
