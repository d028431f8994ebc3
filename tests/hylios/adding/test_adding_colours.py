"""Colours of tanning states without noise."""

import numpy as np
import pytest

from hylios.adding import colours, spectra, spectrum
from hylios.errors import InputError
from hylios.lab import colour
from hylios.skin import Skin
from hylios.skin.specimen import SPECIMENS, with_values

S3 = Skin.of(SPECIMENS["S3"])
STATES = np.array([[*S3.untanned_melanin * more, 1.0 + 0.1 * more] for more in (1.0, 1.5, 2.5)])
WHOLE = np.arange(360.0, 781.0, 5.0)


@pytest.mark.parametrize("name", ["S1", "S3", "S4"])
def test_colours_of_few_wavelengths_are_those_of_whole_spectra(name):
    skin = Skin.of(SPECIMENS[name])
    few_nm = colours(skin, STATES, bands=[365.0, 1650.0])
    for row, state in enumerate(STATES):
        tanned = skin.at(state)
        whole = spectrum(tanned, WHOLE)
        weights = colour.rec709_weights(WHOLE)
        assert colour.difference(weights @ whole.total, few_nm.total[row]) < 0.05
        assert colour.difference(weights @ whole.subsurface, few_nm.subsurface[row]) < 0.05
        bands = spectrum(tanned, [365.0, 1650.0]).total
        assert few_nm.bands[row] == pytest.approx(bands, abs=1e-12)


def test_more_wavelengths_change_colours_little_and_states_are_as_alone():
    many = np.repeat(STATES, 7, axis=0)
    told = []
    few_nm = colours(S3, many, count=16, progress=told.append)
    assert sum(told) == len(many) and len(told) > 1
    for first in range(7):
        assert np.allclose(few_nm.total[first::7], few_nm.total[::7], rtol=0.0, atol=1e-12)
    few = colours(S3, STATES)
    assert colour.difference(few_nm.total[::7], few.total).max() < 0.05
    assert few.bands.shape == (3, 0)
    assert colours(S3, np.empty((0, 4)), bands=[400.0]).bands.shape == (0, 1)


def test_blood_is_a_fifth_number():
    with_blood = np.column_stack([STATES, [1.0, 1.0, 6.0]])
    usual, flushed = colours(S3, STATES, count=4).total, colours(S3, with_blood, count=4).total
    assert np.array_equal(usual[:2], flushed[:2])
    assert flushed[2, 1] < 0.9 * usual[2, 1]


ABSORBING = ("blood", "melanosomes", "melanin", "lipids", "water", "carotene", "keratin", "acid")


def test_skin_without_absorbers_is_white():
    none = {
        name: 0.0
        for name in vars(SPECIMENS["S3"])
        if name.endswith(ABSORBING) or name == "skin_dna"
    }
    kept = {"oxygenated_blood": SPECIMENS["S3"].oxygenated_blood}
    clear = with_values(SPECIMENS["S3"], {**none, **kept}, allow_unphysical=True)
    few_nm = colours(Skin.of(clear), STATES, bands=[365.0])
    assert np.abs(few_nm.total - 1.0).max() < 1e-9
    assert np.abs(few_nm.bands - 1.0).max() < 1e-9
    assert np.all(few_nm.subsurface < 0.98)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"states": STATES[0]}, r"tanning states have shape \(4,\); expected \(N, 4\)"),
        ({"states": -STATES}, "relative melanin is"),
        ({"count": 3}, "number of wavelengths is 3; allowed is 4 to 20"),
        ({"bands": [100.0]}, "wavelength 100 nm is outside"),
        ({"angle": 90.0}, "angle of incidence is 90 degrees"),
    ],
)
def test_bad_input_is_named(arguments, sentence):
    with pytest.raises(InputError, match=sentence):
        colours(S3, **{"states": STATES, **arguments})


def test_no_wavelengths_are_no_numbers():
    """As a table without bands asks for them."""
    assert spectra([SPECIMENS["S3"]] * 2, (), angle=(8.0, 45.0)).total.shape == (2, 2, 0)
