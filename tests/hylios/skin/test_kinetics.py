"""Measured kinetics of the skin types: the gain of one MMD, and the hue of tans."""

from dataclasses import replace

import numpy as np
import pytest

from hylios.adding import spectra
from hylios.errors import InputError
from hylios.lab.colour import lab, linear_rec709
from hylios.skin import Skin
from hylios.skin.phototypes import named_specimen, skin_type
from hylios.tanning import Exposures, MelaninDynamics

WAVELENGTHS = np.arange(400.0, 701.0, 15.0)
TANNING = ("II", "III", "IV", "V", "VI")


def changes(skin, new):
    """Change of L*, a*, b* (N, 3) by amounts of new melanin (N,)."""
    kinetics = skin.melanin_kinetics
    layers = np.array(kinetics.untanned) + np.multiply.outer(new, kinetics.places)
    specimens = [skin.specimen, *(skin.at([*state, 1.0]) for state in layers)]
    seen = spectra(specimens, WAVELENGTHS).total
    told = np.array([lab(linear_rec709(WAVELENGTHS, one)) for one in seen])
    return told[1:] - told[0]


def at_lightness(skin, change):
    """Change of L*, a*, b* where L* has changed by so much."""
    told = changes(skin, np.linspace(0.0, skin.melanin_kinetics.most, 12))
    assert told[:, 0].min() <= change
    fallen = int(np.argmax(told[:, 0] <= change)) + 1
    return [np.interp(-change, -told[:fallen, 0], told[:fallen, part]) for part in range(3)]


@pytest.mark.parametrize("name", TANNING)
def test_one_mmd_can_just_be_seen_in_every_skin(name):
    skin = skin_type(name, kinetics="measured")
    doses = np.zeros((2, 1))
    doses[1] = skin.mmd
    states = skin.states(Exposures([0], doses), times=np.arange(0, 480, 6))
    peak = states[1, :, :3].sum(axis=1).max() - 1.0
    assert changes(skin, np.array([peak]))[0, 0] == pytest.approx(-0.8, abs=0.15)


@pytest.mark.parametrize("name", ["V", "VI"])
def test_dark_skin_keeps_its_redness(name):
    """People's a* changes by -.1 where L* falls by 4.7; type VI's deepest tan is just that."""
    skin = skin_type(name, kinetics="measured")
    _, redness, _ = at_lightness(skin, -4.6)
    assert abs(redness) < 0.7


def test_the_thesis_greys_the_darkest_skin():
    states = skin_type("VI").states(Exposures([0], [60.0]), times=[240])
    skin = skin_type("VI")
    seen = spectra([skin.specimen, skin.at(states[0])], WAVELENGTHS).total
    before, after = (lab(linear_rec709(WAVELENGTHS, one)) for one in seen)
    assert after[1] - before[1] < -2.0


@pytest.mark.parametrize(("name", "yellow"), [("II", 2.4), ("III", 1.9), ("IV", 0.8)])
def test_light_skin_reddens_and_yellows(name, yellow):
    """As from class to class of people's inner arms, whose a* rises by 1 for L* -4; but for .4."""
    skin = skin_type(name, kinetics="measured")
    _, redness, yellowness = at_lightness(skin, -4.0)
    assert redness == pytest.approx(1.05, abs=0.4)
    assert yellowness == pytest.approx(yellow, abs=0.4)


def test_type_i_does_not_tan_and_no_layer_overfills():
    long = Exposures(np.arange(0, 1440, 24), np.full(60, 60.0))
    pale = skin_type("I", kinetics="measured")
    assert pale.states(long, [240.0])[0, :3] == pytest.approx(pale.untanned_melanin)
    for name in ("II", "VI"):
        skin = skin_type(name, kinetics="measured")
        states = skin.states(long, times=np.arange(0, 1440, 60))
        assert np.all(states > 0.0)
        assert not any(skin.overfull([*state[:3], 1.0]) for state in states)


def test_both_kinetics_start_from_the_same_skin():
    for name in TANNING:
        skin, people = skin_type(name), skin_type(name, kinetics="measured")
        assert people == replace(skin, kinetics="measured")
        assert people.untanned_melanin == pytest.approx(people.melanin_kinetics.untanned)
        assert skin.melanin_kinetics == skin.dynamics


def test_skin_without_melanin_and_what_cannot_be_used():
    bare = replace(
        named_specimen("III"),
        **{
            f"{layer}_{form}": 0.0
            for layer in ("basale", "spinosum", "granulosum")
            for form in ("melanosomes", "colloidal_melanin")
        },
    )
    skin = Skin.of(bare, "low", kinetics="measured")
    assert skin.at(skin.states(Exposures([0], [30.0]), [240])[0]).pigmentation == 0.0
    with pytest.raises(InputError, match="kinetics are 'mine'; allowed is thesis, measured"):
        skin_type("II", kinetics="mine")
    none = MelaninDynamics((0.01, 0.0, 0.0), (0.0,) * 3, (0.0,) * 3, (0.0,) * 3)
    still = replace(skin_type("II", kinetics="measured"), dynamics=none)
    assert still.melanin_kinetics.gain == 0.0
