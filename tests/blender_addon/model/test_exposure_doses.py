"""Exposures as an artist gives them, against the functions of hylios that turn them into doses."""

from dataclasses import replace
from datetime import date

import numpy as np
import pytest
from exposures import USUAL

from blender_addon.model import doses
from hylios.errors import InputError
from hylios.sun.action_spectra import Absorptance
from hylios.sun.doses import of_sun
from hylios.sun.protection import layered, sunscreen, water, window
from hylios.sun.sky import ClearSky

HEADER = {"absorptance": {"wavelengths_nm": [280.0, 340.0, 400.0], "values": [0.97, 0.9, 0.7]}}
EXPOSURE = replace(USUAL, day=3.0, multiple=2.5, duration=2.5, to_hour=13.5)


def received(**changes):
    return doses.received([replace(EXPOSURE, **changes)], 4.0, HEADER)


def test_the_same_in_all_units_but_the_sun():
    """10 SED; 2.5 MMD of 4 SED; an hour and a bit at UV index 8, spread over its hours."""
    for changes in ({}, {"unit": "MMD"}):
        once = received(**changes)
        assert once.hours.tolist() == [72] and once.melanogenesis.tolist() == [10.0]
    spread = received(unit="UV_INDEX")
    assert spread.hours.tolist() == [72.0, 73.0, 74.0]
    assert spread.thickening == pytest.approx([7.2, 7.2, 3.6])


def test_the_sun_of_a_day_is_placed_on_the_day_of_the_tan():
    sun = received(unit="SUN", day=3.4)
    absorptance = HEADER["absorptance"]
    skin = Absorptance(np.array(absorptance["wavelengths_nm"]), np.array(absorptance["values"]))
    expected = of_sun(date(doses.ANY_YEAR, 7, 15), 11.0, 13.5, 40.0, skin)
    assert sun.hours.tolist() == [72 + 11, 72 + 12, 72 + 13]
    assert np.array_equal(sun.melanogenesis, expected.melanogenesis)
    assert sun.melanogenesis == pytest.approx(sun.erythemal, rel=0.1)
    assert np.all(received(unit="SUN", latitude=-40.0).erythemal < 0.5 * sun.erythemal)


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"altitude": 2000.0, "ground": "SNOW"}, {"sky": ClearSky(altitude=2000.0, albedo=0.8)}),
        ({"cloud": 50.0}, {"cloud": 0.5}),
        ({"through": "CAR"}, {"protection": window("car")}),
        (
            {"through": "WATER", "depth": 0.5, "sunscreen": True},
            {"protection": layered([water(0.5), sunscreen(30.0)])},
        ),
    ],
)
def test_the_sun_of_a_place_with_what_lies_between(changes, expected):
    absorptance = HEADER["absorptance"]
    skin = Absorptance(np.array(absorptance["wavelengths_nm"]), np.array(absorptance["values"]))
    wanted = of_sun(date(doses.ANY_YEAR, 7, 15), 11.0, 13.5, 40.0, skin, **expected)
    sun = received(unit="SUN", **changes)
    assert sun.melanogenesis == pytest.approx(wanted.melanogenesis, rel=1e-12)
    # They belong to a place: a dose that is given is as it is.
    assert (
        received(**changes).melanogenesis.sum()
        == received(sunscreen=changes.get("sunscreen", False)).melanogenesis.sum()
    )


def test_a_day_of_sun_is_computed_once_for_all_days_and_skins_apart(monkeypatch):
    """Another protection or another skin is another dose; the same one is kept."""
    bare, covered = received(unit="SUN"), received(unit="SUN", sunscreen=True)
    assert np.all(covered.melanogenesis < bare.melanogenesis)
    pale = {"absorptance": {**HEADER["absorptance"], "values": [0.5, 0.5, 0.5]}}
    other = doses.received([replace(EXPOSURE, unit="SUN")], 4.0, pale)
    assert np.all(other.melanogenesis != bare.melanogenesis)
    monkeypatch.setattr(doses, "of_sun", None)
    again = received(unit="SUN", day=9.0)
    assert np.array_equal(again.hours, bare.hours + 144.0)
    assert np.array_equal(again.melanogenesis, bare.melanogenesis)


def test_thin_sunscreen_lets_through_the_root():
    """SPF 30 at 2 and at 0.5 mg/cm^2: a thirtieth, and the fourth root of that."""
    assert received(sunscreen=True).thickening == pytest.approx([10.0 / 30.0])
    thin = received(sunscreen=True, sunscreen_amount=0.5)
    assert thin.melanogenesis == pytest.approx([10.0 * 30.0**-0.25])


def test_a_leap_day_lies_between_its_neighbours():
    dates = ((2, 28), (2, 29), (3, 1))
    before, leap, after = (
        received(unit="SUN", month=month, day_of_month=day).erythemal.sum() for month, day in dates
    )
    assert before < leap <= after


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"day": -1.0}, "day of a time in the sun is -1"),
        ({"unit": "SUN", "month": 2, "day_of_month": 30}, "day of the month is 30, which month 2"),
        ({"unit": "SUN", "from_hour": 15.0}, "sun is given from 15 to 13.5 h"),
        ({"sunscreen": True, "spf": 0.5}, "SPF is 0.5; allowed is 1 to"),
        ({"dose": 1e308}, "dose of a time in the sun is 1e\\+308 SED; allowed is 0 to"),
        ({"dose": float("nan")}, "dose of a time in the sun is nan SED"),
        (
            {"unit": "MMD", "multiple": 1e308},
            "number of tanning doses is 1e\\+308; allowed is 0 to",
        ),
        ({"unit": "UV_INDEX", "uv_index": float("nan")}, "UV index is nan; allowed is 0 to 50"),
        ({"unit": "UV_INDEX", "duration": 1e308}, "duration is 1e\\+308 hours; allowed is 0 to"),
        ({"unit": "SUN", "from_hour": float("nan")}, "hour of sun is nan; allowed is 0 to 24"),
        ({"unit": "SUN", "from_hour": float("inf")}, "hour of sun is inf; allowed is 0 to 24"),
        ({"unit": "SUN", "latitude": 1e308}, "latitude is 1e\\+308"),
        ({"unit": "SUN", "month": 13}, "month is 13; allowed is 1 to 12"),
        ({"sunscreen": True, "sunscreen_amount": float("nan")}, "nan"),
        (
            {"unit": "GY"},
            "unit of a time in the sun is 'GY'; allowed are SED, MMD, UV_INDEX and SUN",
        ),
    ],
)
def test_what_cannot_be_is_named(changes, sentence):
    with pytest.raises(InputError, match=sentence):
        received(**changes)


def test_a_table_without_absorptance_has_no_sun():
    exposure = replace(EXPOSURE, unit="SUN")
    with pytest.raises(InputError, match="what its skin absorbs in the ultraviolet"):
        doses.received([exposure], 4.0, {})
