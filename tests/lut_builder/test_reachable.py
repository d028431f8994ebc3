"""Which states a skin reaches, and the axes and knots that span them."""

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.skin import Skin
from hylios.skin.phototypes import phototype
from hylios.skin.specimen import SPECIMENS
from lut_builder.reachable import choose_axes, reachable_states, untanned_state


@pytest.mark.parametrize(
    ("name", "pigmentation"), [("S1", "low"), ("S3", "intermediate"), ("S4", "high")]
)
def test_three_axes_span_the_states_that_can_be_reached(name, pigmentation):
    """Schedules and times other than those that chose the axes: 0.015 rms in the logarithm is
    left over three axes, and no state lies far beyond the knots."""
    skin = Skin.of(SPECIMENS[name], pigmentation)
    axes = choose_axes(skin, (9, 3, 3))
    states = reachable_states(skin, 100, seed=99)
    coordinates = axes.coordinates(states)
    left = np.log(states / axes.states(coordinates))
    assert np.sqrt((left**2).sum(axis=1).mean()) < 0.015
    for axis, knots in enumerate(axes.knots):
        over = np.maximum(coordinates[:, axis] - knots[-1], knots[0] - coordinates[:, axis])
        assert over.max() < 0.03


@pytest.mark.parametrize("knots", [(1,), (2, 2), (7, 3, 1), (9, 3, 2, 2)])
def test_the_untanned_skin_is_a_knot(knots):
    skin = Skin.of(SPECIMENS["S3"])
    axes = choose_axes(skin, knots)
    assert axes.shape == knots
    untanned = untanned_state(skin)
    states = axes.knot_states().reshape(-1, 4)
    assert np.abs(states - untanned).max(axis=1).min() < 1e-12
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


def test_skin_that_makes_no_melanin_varies_in_thickness_alone():
    skin = phototype("I").skin
    axes = choose_axes(skin, (5, 3, 2))
    assert axes.shape == (5, 1, 1)
    assert np.abs(axes.basis[:, 0]) == pytest.approx([0.0, 0.0, 0.0, 1.0], abs=1e-9)
    states = axes.knot_states()
    assert np.ptp(states[..., :3], axis=0).max() < 1e-9
    assert states[..., 3].min() == 1.0
