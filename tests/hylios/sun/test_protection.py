"""Sunscreen, cloth, panes and water."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hylios.errors import InputError
from hylios.sun.action_spectra import erythemal_dose
from hylios.sun.protection import (
    BARE,
    Protection,
    clothing,
    layered,
    sunscreen,
    sunscreen_film,
    water,
    window,
)
from hylios.sun.sky import ClearSky, sunlight

NM = np.arange(290.0, 401.0, 5.0)
FILTER = np.where(NM < 330.0, 0.02, 0.5)


def test_the_nominal_amount_gives_the_factor_on_the_label():
    assert 1.0 / sunscreen(30.0).of_sunlight() == pytest.approx(30.0)
    assert 1.0 / clothing(15.0).of_sunlight() == pytest.approx(15.0)
    assert BARE.of_sunlight() == 1.0


def test_a_quarter_of_the_amount_gives_the_fourth_root():
    """SPF 16 in the .5 mg/cm^2 of real life is an SPF of 2."""
    assert 1.0 / sunscreen(16.0, 0.5).of_sunlight() == pytest.approx(2.0)
    assert sunscreen(50.0, 0.0).of_sunlight() == 1.0


def test_a_grey_film_is_a_factor():
    film = sunscreen_film(NM, np.full(NM.size, 1.0 / 16.0), 0.5)
    assert film.at(NM) == pytest.approx(0.5)
    assert film.of_sunlight() == pytest.approx(0.5)


def test_the_spf_of_a_film_is_weighed_by_erythema():
    """It lies between its UVB's and its UVA's, near the UVB's: nine tenths of the sun's erythemal
    irradiance are below 330 nm, roughly."""
    share = sunscreen_film(NM, FILTER).of_sunlight()
    below_330 = (0.5 - share) / (0.5 - 0.02)
    assert 0.8 < below_330 < 0.95


def test_the_sun_of_an_spf():
    """20 degrees from the zenith, 305 Dobson units, on level ground."""
    light = sunlight(20.0, ClearSky(ozone=305.0))
    film = sunscreen_film(NM, FILTER)
    passed = erythemal_dose(light.wavelengths, light.level * film.at(light.wavelengths))
    assert film.of_sunlight() == pytest.approx(
        passed / erythemal_dose(light.wavelengths, light.level)
    )


def test_a_film_is_thinned_at_every_wavelength_for_itself():
    thin = sunscreen_film(NM, FILTER, 1.0)
    assert thin.at(NM) == pytest.approx(np.sqrt(FILTER))
    opaque = sunscreen_film(NM, np.zeros(NM.size), 0.0)
    assert np.all(opaque.at(NM) == 1.0)
    assert sunscreen_film(NM, np.zeros(NM.size)).of_sunlight() == 0.0


def test_layers_multiply():
    both = layered([sunscreen_film(NM, FILTER), clothing(4.0)])
    assert both.at(NM) == pytest.approx(0.25 * FILTER)
    assert layered([]) is BARE


def test_a_window_stops_the_uvb_and_lets_the_uva_through():
    """.743 of it, Duarte et al. 2009; the sun through it burns a tenth as much."""
    uva = np.arange(320.0, 400.1, 0.1)
    assert window().at(uva).mean() == pytest.approx(0.743, abs=1e-3)
    assert np.all(window().at(uva[uva <= 320.0]) == 0.0)
    assert 0.05 < window().of_sunlight() < 0.12
    assert window("laminated").at(uva).mean() == pytest.approx(0.02, abs=1e-3)
    assert np.all(window("car").at(uva) <= 1.0)


def test_a_metre_of_water_leaves_what_was_measured():
    assert water(1.0).at(np.array([305.0, 360.0])) == pytest.approx([0.46, 0.72], abs=2e-3)
    assert water(2.0).at(np.array([305.0])) == pytest.approx([0.46**2], abs=2e-3)
    assert water(0.0).of_sunlight() == 1.0
    assert 0.46 < water(1.0).of_sunlight() < 0.6


FACTORS = st.floats(1.0, 1e4)
AMOUNTS = st.floats(0.0, 20.0)


@given(FACTORS, FACTORS, AMOUNTS, AMOUNTS)
def test_more_of_a_better_sunscreen_lets_less_through(spf, other, amount, another):
    worse = sunscreen(min(spf, other), min(amount, another)).of_sunlight()
    better = sunscreen(max(spf, other), max(amount, another)).of_sunlight()
    assert 0.0 <= better <= worse <= 1.0


@pytest.mark.parametrize(
    ("made", "sentence"),
    [
        (lambda: sunscreen(0.5), "SPF is 0.5; allowed is 1 to 10000"),
        (lambda: sunscreen(np.nan), "SPF is nan"),
        (lambda: sunscreen(30.0, -1.0), "amount of sunscreen is -1 mg/cm\\^2"),
        (lambda: clothing(0.0), "UPF is 0"),
        (lambda: water(-1.0), "depth of water is -1 m; allowed is 0 to 100 m"),
        (lambda: window(["car"]), "the glass is .*; allowed are window, car, laminated"),  # type: ignore[arg-type]
        (lambda: window("ice"), "the glass is 'ice'; allowed are window, car, laminated"),
        (lambda: sunscreen_film(NM, 2.0 * FILTER + 0.5), "transmittance has a value of 1.5"),
        (lambda: sunscreen_film(NM[:5], FILTER[:5]), "needed is 290 to 400 nm"),
        (lambda: sunscreen_film(NM, FILTER[:5]), "expected two rows of one length"),
        (lambda: Protection(NM[::-1], FILTER), "at least two wavelengths, ascending"),
    ],
)
def test_bad_protection_is_named(made, sentence):
    with pytest.raises(InputError, match=sentence):
        made()
