"""Light of any spectrum, weighed by what it does to skin."""

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.spectra import published_spectra
from hylios.sun.action_spectra import equivalent_dose

WAVELENGTHS = np.arange(280.0, 401.0, 1.0)


@pytest.mark.parametrize("name", ["erythema_action", "melanogenesis_action"])
def test_light_of_298_nm_counts_in_full(name):
    """A narrow line of 100 J/m^2 at 298 nm is 1 SED, whatever the skin's absorptance."""
    line = np.where(WAVELENGTHS == 298.0, 100.0, 0.0)
    action = published_spectra()[name].at(WAVELENGTHS)
    for absorptance in (np.full(121, 0.9), np.linspace(0.99, 0.4, 121)):
        dose = equivalent_dose(WAVELENGTHS, line, action, absorptance)
        assert dose == pytest.approx(1.0, rel=1e-12)


def test_a_spectral_dose_is_weighed_by_action_and_absorptance():
    """5.3 over 5.2 by hand: flat light, flat skin, erythema action 1 to 298 and 10^0.094(298 - l)
    to 328 nm."""
    wavelengths = np.arange(290.0, 328.01, 0.5)
    action = np.where(wavelengths <= 298.0, 1.0, 10.0 ** (0.094 * (298.0 - wavelengths)))
    dose = equivalent_dose(wavelengths, np.full(wavelengths.size, 50.0), action, np.full(77, 0.8))
    tail = (1.0 - 10.0 ** (-0.094 * 30.0)) / (0.094 * np.log(10.0))
    assert dose == pytest.approx(50.0 * (8.0 + tail) / 100.0, rel=1e-3)
    half = equivalent_dose(
        wavelengths, np.full((3, 77), 25.0), action, np.full(wavelengths.size, 0.8)
    )
    assert half == pytest.approx(np.full(3, 0.5 * dose))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"wavelengths": WAVELENGTHS[::-1]}, "at least two wavelengths, ascending"),
        ({"wavelengths": WAVELENGTHS + 30.0}, "it must enclose 298 nm"),
        ({"exposure": np.full(121, -1.0)}, "negative or not a number"),
        ({"absorptance": np.zeros(121)}, "absorbs nothing at 298 nm"),
    ],
)
def test_a_bad_spectral_dose_is_named(change, sentence):
    usual = {
        "wavelengths": WAVELENGTHS,
        "exposure": np.ones(121),
        "action": np.ones(121),
        "absorptance": np.full(121, 0.9),
    }
    with pytest.raises(InputError, match=sentence):
        equivalent_dose(**{**usual, **change})
