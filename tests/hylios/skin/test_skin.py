"""A skin that tans: its untanned state, variations of its dynamics, melanin that would overfill."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hylios.errors import InputError
from hylios.skin import UNTANNED, Skin, varied
from hylios.skin.phototypes import specimens
from hylios.skin.specimen import SPECIMENS, overfull, tanned
from hylios.tanning import PIGMENTATIONS, Exposures, simulate, states_at

NAMES = list(specimens())
RELATIVE = st.floats(0.0, 1e3)


@pytest.mark.parametrize("name", list(SPECIMENS))
def test_a_specimens_own_distribution_is_kept_where_asked(name):
    """m_i(t)/m_i(0) times the specimen's own melanin, by hand; itself at the start."""
    usual = SPECIMENS[name]
    skin = Skin.of(usual, untanned="own")
    start, melanin = skin.untanned_melanin, np.array([0.9, 0.6, 0.2])
    assert skin.at(skin.untanned_state).melanin == pytest.approx(usual.melanin, abs=1e-15)
    if name != "S1":  # its layers are alike; others lie apart from their set's steady state
        untanned = Skin.of(usual).at(skin.untanned_state)
        assert untanned.melanin != pytest.approx(usual.melanin, rel=0.1)
    changed = skin.at([*melanin, 1.1])
    assert changed.melanin == pytest.approx(usual.melanin * melanin / start / 1.1)
    assert changed.basale_thickness == pytest.approx(1.1 * usual.basale_thickness)


def test_skin_without_melanin_stays_without():
    bare = replace(
        SPECIMENS["S3"],
        basale_melanosomes=0.0,
        **{f"{layer}_colloidal_melanin": 0.0 for layer in ("basale", "spinosum", "granulosum")},
    )
    for untanned in UNTANNED:
        assert not Skin.of(bare, untanned=untanned).at([3.0, 2.0, 1.0, 1.0]).melanin.any()


@settings(max_examples=200)
@given(
    name=st.sampled_from(NAMES),
    melanin=st.tuples(RELATIVE, RELATIVE, RELATIVE),
    thickness=st.sampled_from([1e-3, 0.5, 1.0, 1.25, 10.0]),
    untanned=st.sampled_from(list(UNTANNED)),
)
def test_melanin_never_overfills_a_layer_and_never_falls_with_more(
    name, melanin, thickness, untanned
):
    """What would not fit is cut: content is the least of 1 and what the state asks for."""
    skin = Skin.of(specimens()[name], untanned=untanned)
    melanin = np.array(melanin)
    held = skin.at([*melanin, thickness]).melanin
    assert held.max() <= 1.0
    more = skin.at([*(1.1 * melanin), thickness]).melanin
    assert np.all(more >= held)
    # Where nothing is cut, the content is proportional to the state's melanin.
    if not skin.overfull([*melanin, thickness]):
        half = skin.at([*(0.5 * melanin), thickness]).melanin
        assert half == pytest.approx(0.5 * held, rel=1e-9, abs=1e-300)
    else:
        assert held.max() == 1.0


def test_more_of_a_layer_than_fits_is_cut_at_the_thickness_of_a_tan():
    full = tanned(SPECIMENS["S4"], 1e3 * np.ones(3), 1.25)
    assert full.melanin.tolist() == [1.0, 1.0, 1.0]
    assert overfull(SPECIMENS["S4"], 1e3 * np.ones(3), 1.25)


@pytest.mark.parametrize(
    "untanned", [np.zeros(3), np.array([1.0, np.nan, 1.0]), np.ones(2), -np.ones(3)]
)
def test_an_untanned_state_without_melanin_is_refused(untanned):
    with pytest.raises(InputError, match="relative melanin without sun is"):
        tanned(SPECIMENS["S3"], np.ones(3), 1.0, untanned)


def test_the_thesis_variation_for_high_ability():
    """Figure 6.27: the low set with 0.0858; more than four times the melanin gained."""
    low = PIGMENTATIONS["low"]
    able = varied(low, {"basale_extra_production": 0.0858})
    assert able == replace(low, extra_production=(0.0858, 0.0, 0.0))
    peaks = [
        simulate(Exposures([0], [30.0]), dynamics, mmd=5.0, med=3.0, hours=720).total.max()
        for dynamics in (low, able)
    ]
    assert peaks[1] - 1.0 > 4.0 * (peaks[0] - 1.0)


def test_every_rate_can_be_varied_by_name():
    low = PIGMENTATIONS["low"]
    several = varied(
        low,
        {"basale_transfer": 0.02, "granulosum_transfer": 0.03, "spinosum_production": 0.004}
        | {"granulosum_extra_transfer": 0.05, "melanin_decay": 0.98, "hill_constant": 400.0},
    )
    assert several.transfer == (0.02, 0.0051, 0.03)
    assert several.production == (0.01, 0.004, 0.0)
    assert several.extra_transfer == (0.045, 0.02, 0.05)
    assert (several.melanin_decay, several.hill_constant) == (0.98, 400.0)
    assert several.extra_production == low.extra_production
    assert varied(low, {}) == low


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"tanning": {"extra_production": 0.1}}, "there is no rate 'extra_production'"),
        ({"tanning": {"basale_melanin": 0.1}}, "there are basale_production, spinosum_production"),
        ({"tanning": {"basale_transfer": 1.5}}, "transfer rate of melanin is 1.5"),
        ({"tanning": {"basale_transfer": float("nan")}}, "transfer rate of melanin is nan"),
        ({"pigmentation": "medium"}, "pigmentation is 'medium'; allowed is low, intermediate"),
        ({"untanned": "none"}, "the untanned skin is 'none'; allowed is steady_state, own."),
        ({"mmd": 0.0}, "MMD is 0 SED"),
        ({"med": float("inf")}, "MED is inf SED"),
    ],
)
def test_bad_skins_are_refused(arguments, sentence):
    with pytest.raises(InputError, match=sentence):
        Skin.of(SPECIMENS["S3"], **arguments)


def test_minimal_doses_are_those_of_the_ends_beyond_the_range_of_3_1_and_3_2():
    bare = {f"{layer}_colloidal_melanin": 0.0 for layer in ("basale", "spinosum", "granulosum")}
    full = {layer: 60.0 for layer in bare}
    for values, level in ((bare, 0.013), (full, 0.43)):
        skin = Skin.of(replace(SPECIMENS["S3"], basale_melanosomes=0.0, **values))
        assert skin.mmd == pytest.approx(4.3132 * np.exp(5.1295 * level))
        assert skin.med == pytest.approx(2.1973 * np.exp(7.4043 * level))


def test_what_overfills_is_told_by_the_distribution_that_is_kept():
    """All melanin in the basale of its own: a state that overfills 5.16's granulosum does not."""
    usual = SPECIMENS["S3"]
    bare = replace(usual, granulosum_colloidal_melanin=0.0, spinosum_colloidal_melanin=0.0)
    state = np.array([0.5, 0.5, 100.0, 1.0])
    assert Skin.of(bare).overfull(state)
    assert not Skin.of(bare, untanned="own").overfull(state)


def test_a_skin_knows_its_doses():
    """`states` and `history` are the tanning model's with the skin's own dynamics and doses."""
    skin = Skin.of(SPECIMENS["S3"], "intermediate", 2.89, 1.7)
    sun, times = Exposures([0], [30.0]), [0.0, 24.0, 240.0]
    doses = {"mmd": 2.89, "med": 1.7}
    expected = states_at(sun, PIGMENTATIONS["intermediate"], times=times, **doses)
    assert np.array_equal(skin.states(sun, times), expected)
    assert np.array_equal(skin.history(sun, 240).states[[0, 24, 240]], expected)
    assert np.array_equal(skin.states(sun, [0.0])[0], skin.untanned_state)
    melanin, thickness = expected[2, :3], expected[2, 3]
    assert skin.at(expected[2]) == tanned(SPECIMENS["S3"], melanin, thickness)


@pytest.mark.parametrize("state", [np.ones(3), np.ones(6), np.ones((2, 4)), "tanned"])
def test_a_state_is_four_or_five_numbers(state):
    with pytest.raises(InputError, match="tanning state"):
        Skin.of(SPECIMENS["S3"]).at(state)


def test_blood_scales_in_both_dermal_layers_and_what_is_added_is_arterial():
    skin = Skin.of(SPECIMENS["S3"])
    usual, flushed = skin.at(skin.untanned_state), skin.at([*skin.untanned_state, 4.0])
    assert flushed.papillary_blood == pytest.approx(4.0 * usual.papillary_blood)
    assert flushed.reticular_blood == pytest.approx(4.0 * usual.reticular_blood)
    assert flushed.oxygenated_blood == pytest.approx((usual.oxygenated_blood + 3.0 * 97.0) / 4.0)
    changed = ("papillary_blood", "reticular_blood", "oxygenated_blood")
    assert replace(flushed, **{name: getattr(usual, name) for name in changed}) == usual
    assert skin.at([*skin.untanned_state, 1.0]) == usual
    assert skin.at([*skin.untanned_state, np.exp(np.log(12.0))]).papillary_blood == pytest.approx(
        12.0 * usual.papillary_blood
    )


@pytest.mark.parametrize("blood", [0.9, 12.1, np.nan])
def test_blood_beyond_its_range_is_refused(blood):
    skin = Skin.of(SPECIMENS["S3"])
    with pytest.raises(InputError, match=r"relative blood is .*; allowed is 1 to 12\."):
        skin.at([*skin.untanned_state, blood])
