"""The smooth fit of near share and far width, on profiles whose answer is known."""

import numpy as np
import pytest

from hylios.burley import burley_share_within
from hylios.near_far import edge_spread, model_edge_spread
from hylios.skin.phototypes import phototype
from hylios.transport.simulate import DISTANCE_EDGES
from lut_builder.near_far_fit import degree_of, design_places, fitted, terms
from lut_builder.reachable import choose_axes

SKIN = phototype("III").skin


@pytest.fixture(scope="module")
def axes():
    return choose_axes(SKIN, (5, 2, 2, 3))


def light(share: np.ndarray, width: np.ndarray) -> np.ndarray:
    """Light in the bins (S, B) of near shares and the rest by Burley's profile."""
    ends = np.append(DISTANCE_EDGES[1:], np.inf)
    within = np.where(np.isinf(ends), 1.0, burley_share_within(ends, width[:, None]))
    bins = np.diff(within, axis=1, prepend=0.0) * (1.0 - share)[:, None]
    bins[:, 0] += share
    return bins


def truth(some: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Near share and width that are of the polynomials' kind, by the first terms."""
    share = 1.0 / (1.0 + np.exp(0.4 - 0.3 * some[:, 1]))
    return share, np.exp(0.3 - 0.2 * some[:, 1] - 0.2 * some[:, 2])


def test_places_fill_the_axes(axes):
    places = design_places(axes, 64)
    for knots, place in zip(axes.knots, places.T, strict=True):
        assert np.all((place >= knots[0]) & (place <= knots[-1]))
        share = np.interp(place, knots, np.linspace(0.0, 1.0, len(knots)))
        assert np.histogram(share, 4, (0.0, 1.0))[0].min() >= 8


def test_what_is_smooth_comes_back(axes):
    walked = terms(SKIN, axes, axes.states(design_places(axes, 40)))
    wanted = terms(SKIN, axes, axes.knot_states().reshape(-1, 5))
    told = fitted(walked, light(*truth(walked)), wanted)
    share, width = truth(wanted)
    assert told.near_share == pytest.approx(share, abs=0.03)
    assert told.far_width == pytest.approx(width, rel=0.1)
    assert told.near_share_error.max() < 0.05


def test_many_walked_states_tell_what_a_cubic_holds(axes):
    """Of four numbers it has 35 terms, each of which needs four states."""
    assert [degree_of(axes, count) for count in (40, 139, 140)] == [2, 2, 3]
    walked, wanted = axes.states(design_places(axes, 140)), axes.states(design_places(axes, 30))
    widths, off = (
        [np.exp(0.5 * terms(SKIN, axes, some)[:, 2] ** 3) for some in (walked, wanted)],
        [],
    )
    for degree in (2, 3):
        numbers = [terms(SKIN, axes, some, degree) for some in (walked, wanted)]
        told = fitted(numbers[0], light(np.full(140, 0.4), widths[0]), numbers[1], degree=degree)
        off.append(np.abs(np.log(told.far_width / widths[1])).max())
    assert off[1] < 0.05 < off[0] / 2.0


def test_the_faint_tail_of_a_spread_counts_as_it_is_seen(axes):
    """Two of Burley's profiles, as the one of skin over its hypodermis: some millimetres away the
    light is within 5 %, where the plainest squares of the spread miss 10 %."""
    walked = terms(SKIN, axes, axes.states(design_places(axes, 40)))
    none = np.zeros(len(walked))
    mixed = 0.7 * light(none, none + 0.3) + 0.3 * light(none, none + 2.0)
    place = np.array([2.0])
    told = fitted(walked, mixed, walked[:1])
    shown = model_edge_spread(place, told.near_share, told.far_width)
    assert shown == pytest.approx(edge_spread(DISTANCE_EDGES, mixed[:1], place), rel=0.05)


def test_states_whose_light_tells_nothing_take_it_from_their_neighbours(axes):
    """Without light, or with all of it near, no width can be told."""
    walked = terms(SKIN, axes, axes.states(design_places(axes, 40)))
    share, width = truth(walked)
    dark = light(share, width)
    dark[::8] = 0.0
    told = fitted(walked, dark, walked)
    assert told.near_share[::8] == pytest.approx(share[::8], abs=0.05)
    assert told.far_width[::8] == pytest.approx(width[::8], rel=0.2)


def test_noise_is_averaged_over_states(axes):
    random = np.random.default_rng(4)
    walked = terms(SKIN, axes, axes.states(design_places(axes, 60)))
    share, width = truth(walked)
    noisy = random.multinomial(1000, light(share, width)) / 1000.0
    told = fitted(walked, noisy, walked)
    off = told.near_share - share
    assert np.sqrt(np.mean(off**2)) < 0.025
    assert 0.3 < np.sqrt(np.mean((off / told.near_share_error) ** 2)) < 3.0


def test_skin_without_melanin_is_fitted_too():
    axes = choose_axes(phototype("I").skin, (3, 2, 2, 2))
    states = axes.states(design_places(axes, 20))
    assert np.isfinite(terms(phototype("I").skin, axes, states)).all()


def test_skin_of_which_no_light_comes_back_has_some_width(axes):
    walked = terms(SKIN, axes, axes.states(design_places(axes, 8)))
    told = fitted(walked, np.zeros((8, DISTANCE_EDGES.size)), walked)
    for numbers in (told.near_share, told.far_width, told.near_share_error, told.far_width_error):
        assert np.isfinite(numbers).all()
