"""The published spectra, and one of the user's own."""

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS
from hylios.spectra import estimates_within, published_spectra, with_own_spectrum
from hylios.tissue import Model, Stack


def test_spectra_cover_the_model_and_name_their_sources():
    assert len(published_spectra()) == 17
    for spectrum in published_spectra().values():
        assert spectrum.source
        assert spectrum.unit
        assert (spectrum.wavelengths[0], spectrum.wavelengths[-1]) == (250.0, 2500.0)
        assert np.all(spectrum.values >= 0)


def test_estimates_stay_marked():
    lines = estimates_within(published_spectra(), published_spectra(), np.array([1700.0]))
    assert any(line.startswith("lipids") and "ESTIMATE" in line for line in lines)
    assert any("PROVISIONAL" in line for line in lines)
    assert not any(line.startswith("water,") for line in lines)


def test_a_spectrum_can_be_the_user_s_own(tmp_path):
    file = tmp_path / "keratin.csv"
    file.write_text("250,10\n2500,20\n")
    own = with_own_spectrum(published_spectra(), "keratin", file)
    assert own["keratin"].at(1375.0) == pytest.approx(15.0)
    usual = Stack.of(SPECIMENS["S3"], 1375.0).layers[0].absorption
    changed = Stack.of(SPECIMENS["S3"], 1375.0, Model(own)).layers[0].absorption
    assert changed == pytest.approx(usual + 0.65 * 15.0)


@pytest.mark.parametrize(
    "text",
    [
        "300,1\n250,2\n260,3\n",
        "250,1\n300,1e308\n",
        "250,-1\n300,2\n",
        "a,b\n",
        "",
        "250,nan\n260,1",
    ],
)
def test_a_bad_spectrum_is_refused(tmp_path, text):
    file = tmp_path / "own.csv"
    file.write_text(text)
    with pytest.raises(InputError):
        with_own_spectrum(published_spectra(), "keratin", file)
