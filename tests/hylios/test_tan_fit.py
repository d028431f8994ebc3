"""A skin's tans follow from a few of them."""

import numpy as np
import pytest

from hylios.skin.phototypes import phototype
from hylios.tan_fit import PLACES, TanFit
from hylios.tanning.spread import spread_of


@pytest.fixture(scope="module")
def fit():
    skin = phototype("IV").skin
    return TanFit(skin, spread_of(skin.dynamics, mmd=skin.mmd, med=skin.med), high=1.6)


def test_what_bends_is_told_between_solved_tans(fit):
    def number(tans):
        return np.exp(tans[..., 1:] - tans[..., :1] ** 2)

    fitted = fit.fitted({"bent": number(fit.tans(PLACES))})
    x = np.linspace(-1.0, 1.0, 9)
    tans = fit.tans(np.stack([x, np.full_like(x, 0.5)], axis=-1))
    np.testing.assert_allclose(fitted.numbers(tans)["bent"], number(tans), atol=0.01)


def test_what_is_linear_is_told_everywhere(fit):
    def number(tans):
        return np.stack([3.0 + 2.0 * tans[..., 1], np.exp(0.5 * tans[..., 0])], axis=-1)

    fitted = fit.fitted({"linear": number(fit.tans(PLACES))})
    random = np.random.default_rng(2)
    tans = fit.tans(np.stack([random.uniform(-1, 1, 50), random.uniform(0, 1, 50)], axis=-1))
    np.testing.assert_allclose(fitted.numbers(tans)["linear"], number(tans), atol=0.01)


def test_states_beyond_are_told_by_the_nearest_tan(fit):
    nearest = fit.nearest(np.array([-2.0, 9.0, 0.3]), np.array([-1.0, 5.0, 0.1]))
    np.testing.assert_allclose(nearest, [[0.0, 0.0], [2.0 * np.log(1.6), fit.thickest], [0.3, 0.1]])
