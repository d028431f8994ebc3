"""The skin nearest to a colour."""

from dataclasses import replace

import numpy as np
import pytest

from blender_addon.model import catalogue
from blender_addon.model.fitting import type_colours
from blender_addon.model.matching import nearest
from hylios.adding import colours
from hylios.errors import InputError
from hylios.skin.biology import Biology
from hylios.table import skin_of


@pytest.mark.parametrize("name", catalogue.TYPES)
def test_a_types_own_colour_is_that_type(name):
    match = nearest(type_colours()[name])
    assert match.skin == name and match.distance < 1e-9
    assert match.biology == Biology() and match.left == match.distance


def test_types_are_ever_darker():
    green = [colour[1] for colour in type_colours().values()]
    assert list(type_colours()) == list(catalogue.TYPES)
    assert np.all(np.diff(green) < 0.0)


@pytest.mark.parametrize(("melanin", "blood"), [(1.1, 1.25), (0.95, 0.8)])
def test_melanin_and_blood_are_found_again(melanin, blood):
    skin = skin_of(catalogue.provenance(catalogue.shipped_path("III")))
    changed = replace(skin, specimen=Biology(melanin=melanin, blood=blood).of(skin.specimen))
    match = nearest(colours(changed, changed.untanned_state[None]).subsurface[0])
    assert match.skin == "III" and match.distance > 0.5
    assert match.biology.melanin == pytest.approx(melanin, rel=0.02)
    assert match.biology.blood == pytest.approx(blood, rel=0.02)
    assert match.left < 0.05


def test_what_no_skin_has_comes_as_near_as_it_can():
    match = nearest(np.array([0.1, 0.3, 0.8]))
    assert 20.0 < match.left <= match.distance


@pytest.mark.parametrize("colour", [(1.2, 0.5, 0.4), (0.5, np.nan, 0.4), (0.5, -0.1, 0.4)])
def test_what_is_no_colour_is_refused(colour):
    with pytest.raises(InputError, match="the colour is .*; allowed is 0 to 1"):
        nearest(np.array(colour))
