"""Doses of sun, lamps and UV index, and the commands that take them."""

import subprocess
import sys
from datetime import date

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hylios.adding.absorptance import tabulated
from hylios.adding.spectrum import spectrum
from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS
from hylios.sun.action_spectra import (
    ERYTHEMA,
    MELANOGENESIS,
    Absorptance,
    action,
    erythemal_dose,
    melanogenesis_dose,
    thickening_dose,
)
from hylios.sun.doses import Doses, joined, of_sed, of_spectrum, of_sun, of_uv_index
from hylios.sun.forecast import of_forecast
from hylios.sun.position import sun
from hylios.sun.protection import clothing, sunscreen, sunscreen_film
from hylios.sun.sky import ClearSky
from hylios.sun.surroundings import ground_albedo
from hylios.sun.weather import of_weather

NM = np.arange(280.0, 401.0)
SKIN = Absorptance([280.0, 298.0, 340.0, 400.0], [0.95, 0.9, 0.8, 0.7])
SUMMER = date(2025, 6, 21)


def line(nanometres, joules=100.0):
    """Light of one wavelength, on a grid of 1 nm."""
    return np.where(nanometres == NM, joules, 0.0)


def test_a_specimen_is_tabulated_once():
    absorptance = tabulated(SPECIMENS["S3"])
    assert absorptance is tabulated(SPECIMENS["S3"])
    direct = spectrum(SPECIMENS["S3"], [280.0, 298.0, 400.0]).absorptance
    assert absorptance.at(np.array([280.0, 298.0, 400.0])) == pytest.approx(direct, abs=1e-9)
    assert absorptance.wavelengths[[0, -1]] == pytest.approx([280.0, 400.0])


def test_a_step_of_six_nanometres_changes_doses_of_the_sun_by_less_than_a_thousandth():
    fine, coarse = (tabulated(SPECIMENS["S3"], step_nm=step) for step in (2.0, 6.0))
    assert coarse.wavelengths.size == 21 and 298.0 in coarse.wavelengths
    for place in (0.0, 60.0):
        expected, told = (of_sun(SUMMER, 10, 16, place, skin) for skin in (fine, coarse))
        assert told.melanogenesis == pytest.approx(expected.melanogenesis, rel=1e-3)
        assert told.thickening == pytest.approx(expected.thickening, rel=1e-3)
    with pytest.raises(InputError, match="step between wavelengths is 0"):
        tabulated(SPECIMENS["S3"], step_nm=0.0)


def by_parrish(*light):
    return melanogenesis_dose(*light, tanning="parrish")


@pytest.mark.parametrize("dose", [melanogenesis_dose, by_parrish, thickening_dose])
def test_a_joule_of_298_nm_is_a_hundredth_sed(dose):
    assert dose(NM, line(298.0), SKIN) == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize(
    ("dose", "name"),
    [(by_parrish, MELANOGENESIS), (melanogenesis_dose, ERYTHEMA), (thickening_dose, ERYTHEMA)],
)
@pytest.mark.parametrize("nanometres", [285.0, 311.0, 365.0])
def test_other_lines_count_by_action_and_absorptance(dose, name, nanometres):
    """5.3 over 5.2, and 5.19 over 5.18, for a lamp's line."""
    weight = action(name, np.array([nanometres])) * SKIN.at(np.array([nanometres])) / 0.9
    assert dose(NM, line(nanometres), SKIN) == pytest.approx(weight.item(), rel=1e-9)


def test_the_erythema_action_spectrum_is_cies():
    """1 to 298 nm, 10^(.094 (298 - l)) to 328 nm, 10^(.015 (140 - l)) to 400 nm (ISO 17166)."""
    values = action(ERYTHEMA, np.array([290.0, 299.0, 313.0, 327.5, 365.0, 400.0]))
    expected = 10.0 ** np.array([0, -0.094, -1.41, -2.773, 0.015 * -225, 0.015 * -260])
    assert values == pytest.approx(expected, rel=2e-4)


def test_light_of_a_coarse_spectrum_ends_where_it_ends():
    """1 J/m^2/nm from 302 to 322 nm, given by its ends alone; erythema by hand."""
    fall = 0.094 * np.log(10.0)
    by_hand = (np.exp(-4.0 * fall) - np.exp(-24.0 * fall)) / fall / 100.0
    assert erythemal_dose([302.0, 322.0], [1.0, 1.0]) == pytest.approx(by_hand, rel=5e-3)


def test_light_beyond_the_ultraviolet_does_nothing():
    dark = erythemal_dose([390.0, 400.0, 400.1, 800.0], [0.0, 0.0, 5.0, 5.0])
    assert dark == 0.0
    assert melanogenesis_dose([500.0, 600.0], [1.0, 1.0], SKIN) == 0.0


def test_many_exposures_at_once_equal_each_alone():
    light = np.random.default_rng(1).uniform(0.0, 5.0, (2, 3, NM.size))
    together = melanogenesis_dose(NM, light, SKIN)
    assert together.shape == (2, 3)
    assert together[1, 2] == melanogenesis_dose(NM, light[1, 2], SKIN)


@pytest.mark.parametrize(
    ("wavelengths", "exposure", "sentence"),
    [
        ([254.0, 300.0], [1.0, 0.0], "has light at 254 nm; allowed is 280 nm and more"),
        ([300.0, 310.0], [1.0, -1.0], "negative or not a number"),
        ([300.0, 310.0], [1.0, np.nan], "negative or not a number"),
        ([310.0, 300.0], [1.0, 1.0], "at least two wavelengths, ascending"),
        ([300.0], [1.0], "at least two wavelengths, ascending"),
        ([300.0, 310.0], [1.0, 1.0, 1.0], "its last axis must match the 2 wavelengths"),
        ([300.0, 310.0], [1.0, 1e16], "too large; allowed is 0 to"),
        (["UVA", "UVB"], [1.0, 1.0], "wavelengths of a spectral dose are .* expected an array"),
        ([300.0, 310.0], [[1.0], [1.0, 2.0]], "values of a spectral dose are .* expected an array"),
    ],
)
def test_a_bad_spectrum_is_named(wavelengths, exposure, sentence):
    with pytest.raises(InputError, match=sentence):
        melanogenesis_dose(wavelengths, exposure, SKIN)


@pytest.mark.parametrize(
    ("wavelengths", "values", "sentence"),
    [
        ([280.0, 390.0], [0.9, 0.9], "needed is 280 to 400 nm"),
        ([280.0, 400.0], [0.9, 1.1], "absorptance has a value of 1.1; allowed is 0 to 1"),
        ([280.0, 400.0], [0.9], "expected two rows of one length"),
    ],
)
def test_a_bad_absorptance_is_named(wavelengths, values, sentence):
    with pytest.raises(InputError, match=sentence):
        Absorptance(wavelengths, values)


SPECTRA = st.lists(st.floats(0.0, 1e6), min_size=NM.size, max_size=NM.size).map(np.array)


@settings(max_examples=50)
@given(SPECTRA, st.floats(1.0, 1e3), st.floats(0.0, 3600.0), st.floats(1.0, 100.0))
def test_more_light_for_longer_is_more_dose(light, times, seconds, spf):
    usual = of_spectrum(0, NM, light, seconds, SKIN)
    for more in (
        of_spectrum(0, NM, times * light, seconds, SKIN),
        of_spectrum(0, NM, light, min(times * seconds, 3600.0), SKIN),
    ):
        assert np.all(every(more) >= every(usual) * (1.0 - 1e-12))
    less = of_spectrum(0, NM, light, seconds, SKIN, sunscreen(spf))
    assert every(less) == pytest.approx(every(usual) / spf)
    for doses in (usual, less):
        assert np.all(np.isfinite(every(doses)))
        assert np.all(every(doses) >= 0.0)


COLUMNS = ("erythemal", "melanogenesis", "thickening")


def every(doses: Doses):
    return np.array([doses.erythemal, doses.melanogenesis, doses.thickening])


def test_an_hour_at_uv_index_10_is_9_sed():
    doses = of_uv_index(7, 10.0, 1.5)
    assert doses.hours.tolist() == [7.0, 8.0]
    assert every(doses) == pytest.approx(np.array([[9.0, 4.5]] * 3))
    assert every(of_uv_index(7, 10.0, 0.0)).tolist() == [[0.0]] * 3


def test_a_lamp_for_two_hours_and_a_half():
    doses = of_spectrum(3, NM, line(298.0, 0.1), 9000.0, SKIN)
    assert doses.hours.tolist() == [3.0, 4.0, 5.0]
    assert every(doses) == pytest.approx(np.array([[3.6, 3.6, 1.8]] * 3))


def test_protection_weighs_each_wavelength():
    """A film that stops the UVB alone leaves a UVA lamp as it is, and a dose in SED its UVA."""
    film = sunscreen_film([280.0, 330.0, 331.0, 400.0], [0.0, 0.0, 1.0, 1.0])
    assert every(of_spectrum(0, NM, line(365.0), 60.0, SKIN, film)) == pytest.approx(
        every(of_spectrum(0, NM, line(365.0), 60.0, SKIN))
    )
    assert np.all(every(of_spectrum(0, NM, line(311.0), 60.0, SKIN, film)) == 0.0)
    assert 0.0 < of_sed(0, 1.0, film).erythemal[0] < 0.2
    assert every(of_sed(0, 30.0, clothing(15.0))) == pytest.approx(2.0)
    assert every(of_uv_index(0, 10.0, 1.0, clothing(15.0))) == pytest.approx(0.6)


def test_melanin_and_thickness_are_given_their_own_doses():
    doses = of_spectrum(0, NM, line(365.0), 60.0, SKIN, tanning="parrish")
    assert doses.melanogenesis[0] > 2.0 * doses.thickening[0] > 0.0
    given = doses.exposures()
    assert np.array_equal(given.doses, doses.melanogenesis)
    assert np.array_equal(given.thickening_doses, doses.thickening)


def test_the_hours_of_a_day_add_up():
    """Hour by hour is the same light as every minute, within 1e-3."""
    day = of_sun(SUMMER, 4.25, 20.0, 40.0, SKIN)
    assert day.hours.tolist() == list(range(4, 20))
    hours = [of_sun(SUMMER, max(h, 4.25), h + 1.0, 40.0, SKIN) for h in range(4, 20)]
    assert np.array_equal(every(joined(hours)), every(day))
    minutes = np.linspace(4.25, 20.0, 946)
    fine = [
        of_sun(SUMMER, a, b, 40.0, SKIN) for a, b in zip(minutes[:-1], minutes[1:], strict=True)
    ]
    whole = every(day).sum(axis=1)
    assert every(joined(fine)).sum(axis=1) == pytest.approx(whole, rel=1e-3)


def test_a_share_of_an_hour_is_one():
    doses = of_sun(SUMMER, 10.5, 12.25, 40.0, SKIN, start=date(2025, 6, 19))
    assert doses.hours.tolist() == [58.0, 59.0, 60.0]
    halves = of_sun(SUMMER, 10.0, 10.5, 40.0, SKIN).erythemal + doses.erythemal[0]
    whole = of_sun(SUMMER, 10.0, 11.0, 40.0, SKIN).erythemal
    assert halves == pytest.approx(whole, rel=1e-3)


def test_no_sun_no_dose():
    night = of_sun(date(2025, 12, 21), 0.0, 24.0, 75.0, SKIN)
    assert night.hours.size == 24
    assert np.all(every(night) == 0.0)
    assert np.all(every(of_sun(SUMMER, 0.0, 4.0, 40.0, SKIN)) == 0.0)


def test_a_day_of_sun_tans_as_the_meter_says():
    """As minimal doses are, in SED of solar simulators: within 10 %, by what skin absorbs; by the
    thesis's spectrum three to four times that."""
    for day, most in ((SUMMER, 3.5), (date(2025, 12, 21), 4.5)):
        doses = of_sun(day, 10.0, 14.0, 40.0, SKIN)
        assert 0.9 < doses.melanogenesis.sum() / doses.erythemal.sum() < 1.0
        other = of_sun(day, 10.0, 14.0, 40.0, SKIN, tanning="parrish")
        assert 2.8 < other.melanogenesis.sum() / doses.erythemal.sum() < most
        assert np.array_equal(other.thickening, doses.thickening)


def test_lamps_of_uva_tan_by_the_theses_spectrum():
    """18 J/cm^2 of broad UVA just tan people of types III and up, whose MMD is about 6 SED."""
    light = NM[NM >= 320.0], np.full(81, 18e4 / 80.0)
    alike = Absorptance([280.0, 400.0], [1.0, 1.0])
    assert melanogenesis_dose(*light, alike, tanning="parrish") == pytest.approx(10.1, abs=0.1)
    assert melanogenesis_dose(*light, alike) == pytest.approx(1.6, abs=0.1)


def test_a_tanning_that_there_is_not_is_named():
    with pytest.raises(InputError, match="tanning is 'sunlamp'; allowed are erythema and parrish"):
        melanogenesis_dose(NM, line(298.0), SKIN, tanning="sunlamp")


def test_december_in_the_south_is_stronger_than_june_in_the_north():
    """By the squares of the distances, 1.0163 and .9838 astronomical units, and nothing else."""
    north = of_sun(SUMMER, 8.0, 16.0, 40.0, SKIN).erythemal.sum()
    south = of_sun(date(2025, 12, 21), 8.0, 16.0, -40.0, SKIN).erythemal.sum()
    assert south / north == pytest.approx((1.0163 / 0.9838) ** 2, rel=2e-3)


def test_a_day_in_june_is_tens_of_sed():
    """Six hours around noon at 40 degrees: Madronich's UV index has 49 SED for clean air, from
    which this model lacks what it does for the UV index."""
    doses = of_sun(SUMMER, 9.0, 15.0, 40.0, SKIN, sky=ClearSky(aerosol=0.0))
    published = 0.0
    for hour in np.arange(9.0, 15.0, 0.1) + 0.05:
        cosine = np.cos(np.radians(sun(SUMMER, hour, 40.0).zenith))
        published += 12.5 * cosine**2.42 * 0.9 * 0.1
    assert 0.88 < doses.erythemal.sum() / published < 0.96


@settings(max_examples=40)
@given(
    st.dates(date(1950, 1, 1), date(2050, 12, 31)),
    st.floats(-90.0, 90.0),
    st.floats(0.0, 23.0),
    st.floats(0.01, 1.0),
)
def test_longer_in_the_sun_is_never_less(day, latitude, first, length):
    """But for the five minutes between looks at the sun: 2e-3 of a dose, 1e-3 SED at sunset."""
    short = every(of_sun(day, first, first + length, latitude, SKIN)).sum(axis=1)
    long = every(of_sun(day, first, 24.0, latitude, SKIN)).sum(axis=1)
    assert np.all(np.isfinite(long))
    assert np.all(short >= 0.0)
    assert np.all(long >= short * (1.0 - 2e-3) - 1e-3)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((SUMMER, 16.0, 10.0, 40.0), "sun is given from 16 to 10 h"),
        ((SUMMER, 10.0, 10.0, 40.0), "sun is given from 10 to 10 h"),
        ((SUMMER, 10.0, 25.0, 40.0), "hour of sun is 25; allowed is 0 to 24"),
        ((SUMMER, np.nan, 16.0, 40.0), "hour of sun is nan"),
    ],
)
def test_bad_hours_of_sun_are_named(arguments, sentence):
    with pytest.raises(InputError, match=sentence):
        of_sun(*arguments, SKIN)


NOON = SUMMER, 12.0, 13.0, 40.0, SKIN


@pytest.mark.parametrize(
    ("made", "sentence"),
    [
        (lambda: of_sun(*NOON, utc_offset=2.0), "offset from UTC is 2.0 without a longitude"),
        (lambda: of_sun(*NOON, sky="clear"), "the sky is 'clear'; expected a hylios.sun.sky"),  # type: ignore[arg-type]
        (lambda: of_sun(*NOON, protection="spf"), "the protection is 'spf'; expected one such"),  # type: ignore[arg-type]
        (lambda: of_sun(*NOON[:4], 0.9), "the absorptance is '0.9'; expected a skin's"),  # type: ignore[arg-type]
        (lambda: of_sed(0, 1.0, 30), "the protection is '30'; expected one such"),  # type: ignore[arg-type]
        (lambda: of_uv_index("a", 8, 1), "an hour of exposure is 'a'; expected a number"),  # type: ignore[arg-type]
        (lambda: of_sed("a", 8), "an hour of exposure is 'a'; expected a number"),  # type: ignore[arg-type]
        (lambda: of_sed(0, "8"), "dose is '8'; expected a number"),  # type: ignore[arg-type]
        (lambda: of_weather("w", *NOON[:3], SKIN), "the weather is 'w'; expected that of a file"),  # type: ignore[arg-type]
        (lambda: of_forecast("w"), "the forecast is 'w'; expected that of a file"),  # type: ignore[arg-type]
        (lambda: ground_albedo(["snow"]), "the ground is .*; allowed are grass"),  # type: ignore[arg-type]
    ],
)
def test_what_is_of_another_kind_is_one_sentence(made, sentence):
    with pytest.raises(InputError, match=sentence):
        made()


def test_the_sun_needs_no_numba():
    code = (
        "import sys; sys.modules['numba'] = None; sys.modules['colour'] = None;"
        "from hylios.commands.cli import main;"
        "sys.exit(main('tan --sun 2025-06-21:12-13 --latitude 40 --hours 1'.split()))"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True).returncode == 0
