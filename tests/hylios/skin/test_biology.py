"""Changes to a skin, within what living people have."""

from dataclasses import asdict, replace

import numpy as np
import pytest

import hylios
from hylios.errors import InputError
from hylios.skin.biology import RANGES, Biology
from hylios.skin.specimen import specimen_of

TYPES = ("I", "II", "III", "IV", "V", "VI")


@pytest.mark.parametrize("name", TYPES)
def test_no_change_gives_the_skin_back(name):
    specimen = hylios.skin_type(name).specimen
    assert Biology().changes(specimen) == {}
    assert Biology().of(specimen) == specimen


def test_each_changes_what_it_says():
    skin = hylios.skin_type("III").specimen
    changed = Biology(melanin=1.5, blood=0.5, oxygenation=-10.0, pheomelanin=2.0).of(skin)
    np.testing.assert_allclose(changed.melanin, 1.5 * skin.melanin)
    assert changed.papillary_blood == pytest.approx(0.5 * skin.papillary_blood)
    assert changed.reticular_blood == pytest.approx(0.5 * skin.reticular_blood)
    assert changed.oxygenated_blood == pytest.approx(skin.oxygenated_blood - 10.0)
    assert changed.pheomelanin_concentration == 2.0 * skin.pheomelanin_concentration
    assert changed.eumelanin_concentration == skin.eumelanin_concentration


def test_thick_skin_has_the_same_melanin():
    skin = hylios.skin_type("IV").specimen
    thick = Biology(thickness=1.3).of(skin)
    np.testing.assert_allclose(thick.epidermal_thickness, 1.3 * skin.epidermal_thickness)
    assert thick.reticular_thickness == pytest.approx(1.3 * skin.reticular_thickness)
    assert thick.melanin @ thick.epidermal_thickness == pytest.approx(
        skin.melanin @ skin.epidermal_thickness
    )


@pytest.mark.parametrize("name", TYPES)
@pytest.mark.parametrize("end", [0, 1])
def test_what_sliders_make_is_living_skin(name, end):
    specimen = hylios.skin_type(name).specimen
    changed = Biology(**{key: span[end] for key, span in RANGES.items()}).of(specimen)
    assert specimen_of(asdict(changed)) == changed  # raises where a value is not physiological


def test_skin_beyond_physiology_stays_where_it_is():
    odd = replace(hylios.skin_type("II").specimen, papillary_blood=6.0)
    assert Biology().of(odd) == odd
    assert Biology(blood=2.0).of(odd).papillary_blood == 6.0


def test_a_value_out_of_range_is_told():
    with pytest.raises(InputError, match="blood is 100; allowed is 0.25 to 8"):
        Biology(blood=100.0)
