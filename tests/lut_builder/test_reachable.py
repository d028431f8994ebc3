"""Which states a table spans, and where its knots lie."""

import numpy as np
import pytest

from hylios.adding import colours
from hylios.errors import InputError
from hylios.lab.colour import difference
from hylios.skin import Skin
from hylios.skin.phototypes import phototype, skin_type
from hylios.skin.specimen import SPECIMENS
from hylios.table import SkinTable
from hylios.tanning import KINETICS
from lut_builder.reachable import (
    FRECKLE,
    by_kinetics,
    choose_axes,
    reachable_states,
    untanned_state,
    within,
)


@pytest.mark.parametrize(
    ("name", "pigmentation"), [("S1", "low"), ("S3", "intermediate"), ("S4", "high")]
)
def test_the_axes_span_the_states_that_can_be_reached(name, pigmentation):
    """Schedules and times other than those that chose the axes, by either kinetics: no state lies
    beyond the knots."""
    skin = Skin.of(SPECIMENS[name], pigmentation)
    axes = choose_axes(skin, (9, 3, 3, 2))
    states = np.concatenate([reachable_states(one, 50, seed=99) for one in by_kinetics(skin)])
    places = axes.coordinates(states)
    for knots, place in zip(axes.knots, places.T, strict=True):
        assert np.maximum(place - knots[-1], knots[0] - place).max() < 0.02


@pytest.mark.parametrize("kinetics", KINETICS)
@pytest.mark.parametrize("name", ["II", "V", "VI"])
def test_states_told_by_four_coordinates_look_as_they_are(name, kinetics):
    skin = skin_type(name, kinetics=kinetics)
    axes = choose_axes(skin, (3, 2, 2, 2))
    states = np.random.default_rng(2).choice(reachable_states(skin, 20, seed=9), 24)
    told = axes.states(axes.coordinates(states))[:, :4]
    apart = difference(colours(skin, states, count=5).total, colours(skin, told, count=5).total)
    assert apart.mean() < 0.02 and apart.max() < 0.1


@pytest.mark.parametrize("name", ["I", "III", "VI"])
def test_melanin_reaches_from_hardly_any_to_a_freckle_at_the_height_of_its_tan(name):
    skin = phototype(name).skin
    axes = choose_axes(skin, (12, 3, 2, 4))
    melanin, _, _, blood = axes.knots
    most = reachable_states(skin, 30, seed=3)[:, :3].sum(axis=1).max()
    assert FRECKLE * most < np.exp(melanin[-1]) < 1.2 * FRECKLE * most
    assert np.exp(blood[[0, -1]]) == pytest.approx([1.0, 12.0])
    least = axes.states(np.array([melanin[0], 0.0, 0.0, 0.0]))
    none = least * np.array([0.01, 0.01, 0.01, 1.0, 1.0])
    seen = colours(skin, np.array([least[:4], none[:4]]), count=5).total
    assert difference(seen[:1], seen[1:]).max() < 0.5


@pytest.mark.parametrize("knots", [(1,), (2, 2), (7, 3, 1), (9, 3, 2, 2)])
def test_the_untanned_skin_is_a_knot(knots):
    skin = Skin.of(SPECIMENS["S3"])
    axes = choose_axes(skin, knots)
    assert axes.shape == (*knots, 1, 1, 1)[:4]
    states = axes.knot_states().reshape(-1, 5)
    assert np.abs(states - [*untanned_state(skin), 1.0]).max(axis=1).min() < 1e-12
    assert all(np.all(np.diff(knots_of_axis) > 0) for knots_of_axis in axes.knots)


def test_reachable_states_are_those_that_the_issue_of_a_tan_can_be():
    states = reachable_states(Skin.of(SPECIMENS["S3"], "low"), 50, seed=4)
    assert states.min() > 0
    assert states[:, :3].sum(axis=1).max() < 2.2
    assert states[:, 3].max() < 1.25 + 1e-9


def test_a_layer_without_melanin_has_no_axes():
    skin = Skin.of(SPECIMENS["S3"], "low", tanning={"basale_transfer": 0.0})
    with pytest.raises(InputError, match="melanin without sun is .* more than 0 in each"):
        choose_axes(skin, (3, 2))


def test_a_table_says_which_kinetics_it_tells():
    for name, knots, told in (
        ("V", (3, 2, 2), ("thesis", "measured")),
        ("V", (3, 2, 1), ("thesis",)),
        ("I", (3, 2, 2), ("thesis", "measured")),
    ):
        axes = choose_axes(phototype(name).skin, knots)
        assert SkinTable(axes, {}, {}).kinetics == told


def test_spread_has_knots_where_tans_rise_before_it_has_any_between_the_sheets():
    knots = [choose_axes(phototype("VI").skin, (3, 2, count)).knots[2] for count in (2, 3, 4, 5)]
    least = knots[1][0]
    assert least < -0.1
    expected = [0, 1], [least, 0, 1], [least, least / 3, 0, 1], [least, least / 3, 0, 0.5, 1]
    for own, told in zip(knots, expected, strict=True):
        assert own == pytest.approx(told, abs=1e-12)


def test_skin_that_makes_no_melanin_has_one_spread():
    axes = choose_axes(phototype("I").skin, (7, 3, 3, 4))
    assert axes.shape == (7, 3, 1, 4)
    shares = axes.knot_states()[..., :3]
    shares = shares / shares.sum(axis=-1, keepdims=True)
    assert np.ptp(shares.reshape(-1, 3), axis=0).max() < 1e-9


def test_a_scene_s_axes_are_the_whole_table_s_cut_to_what_it_reaches():
    skin = phototype("III").skin
    whole = choose_axes(skin, (16, 3, 3, 4))
    reached = reachable_states(skin, 2, seed=5)
    axes = within(whole, reached)
    assert axes.bounded and axes.hold(reached).all()
    places = axes.coordinates(reached)
    for number, (own, other) in enumerate(zip(axes.knots, whole.knots, strict=True)):
        ends = [min(places[:, number].min(), 0.0), max(places[:, number].max(), 0.0)]
        assert own[[0, -1]] == pytest.approx(ends, abs=0.01)
        assert len(own) <= len(other) and 0.0 in own
        inside = other[(other > own[0]) & (other < own[-1])]
        assert set(own[1:-1]) <= {*inside, 0.0} or len(own) == 3
