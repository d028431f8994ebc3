"""The edge spread against integrals and drawn points, and the fit of a spike and a far lobe."""

import numpy as np
import pytest
from scipy.integrate import quad

from hylios.burley import burley_share_within
from hylios.errors import InputError
from hylios.near_far import (
    LARGEST_WIDTH,
    LEAST_WIDTH,
    UNKNOWN_WIDTH,
    burley_edge_spread,
    edge_spread,
    model_edge_spread,
    near_far_errors,
    near_share_and_far_width,
)

EDGES = np.concatenate([[0.0], np.geomspace(1e-3, 100.0, 161)])
DISTANCES = np.array([0.1, 0.3, 1.0, 4.0, 20.0])


def binned(near, width):
    """Light (..., bins) of a spike within the first bin and Burley's profile."""
    near, width = np.asarray(near, dtype=float)[..., None], np.asarray(width)[..., None]
    within = (1.0 - near) * burley_share_within(EDGES, width)
    within = np.concatenate([within, np.broadcast_to(1.0 - near, (*within.shape[:-1], 1))], -1)
    light = np.diff(within)
    light[..., 0] += near[..., 0]
    return light


@pytest.mark.parametrize("ratio", [1e-3, 0.1, 1.0, 5.0])
def test_edge_spread_of_burleys_profile(ratio):
    """The density of the distance is (exp(-r) + exp(-r / 3)) / 4."""

    def beyond(angle):
        # r = ratio / cos(angle), whose arc cosine over r is the angle
        radius = ratio / np.cos(angle)
        density = 0.25 * (np.exp(-radius) + np.exp(-radius / 3.0))
        return density * angle / np.pi * radius * np.tan(angle)

    value, error = quad(beyond, 0.0, 0.5 * np.pi, epsabs=1e-11, limit=500)
    assert burley_edge_spread(np.array(ratio)) == pytest.approx(value, abs=1e-8 + error)
    assert burley_edge_spread(np.zeros(1)) == pytest.approx([0.5], abs=1e-9)


def test_edge_spread_of_light_that_was_drawn_point_by_point():
    """Within 4.5 standard errors at five distances: false alarms 3e-5."""
    random = np.random.default_rng(3)
    radius = random.exponential(0.8, size=400_000)
    counts, _ = np.histogram(radius, [*EDGES, np.inf])
    place = radius * np.cos(random.uniform(0.0, 2.0 * np.pi, radius.size))
    seen = np.mean(place[:, None] > DISTANCES, axis=0)
    spread = edge_spread(EDGES, counts, DISTANCES)
    assert np.all(np.abs(spread - seen) < 4.5 * np.sqrt(seen / radius.size) + 1e-6)


def test_the_model_is_recovered():
    near, width = np.meshgrid([0.0, 0.2, 0.6, 0.95], [0.06, 0.3, 1.0, 3.0], indexing="ij")
    light = binned(near, width) * 0.3
    own_near, own_width = near_share_and_far_width(EDGES, light)
    assert own_near == pytest.approx(near, abs=1e-3)
    assert own_width == pytest.approx(width, rel=2e-3)
    spread = edge_spread(EDGES, light, DISTANCES)
    assert spread == pytest.approx(model_edge_spread(DISTANCES, near, width), abs=5e-4)


def test_profiles_together_are_as_alone():
    light = binned(np.array([0.1, 0.7]), np.array([0.5, 2.0]))
    together = near_share_and_far_width(EDGES, light)
    for row in range(2):
        alone = near_share_and_far_width(EDGES, light[row])
        assert np.ndim(alone[0]) == 0
        assert np.allclose([part[row] for part in together], alone, rtol=0.0, atol=1e-12)


def test_standard_errors_are_those_of_many_drawings():
    """Poisson counts; the spread of 400 drawings is known to 3.5 %, first order to some more."""
    light = binned(0.4, 1.0)
    counts = np.random.default_rng(1).poisson(2000.0 * light, size=(400, light.size))
    drawn = near_share_and_far_width(EDGES, counts)
    errors = near_far_errors(EDGES, 2000.0 * light, 2000.0 * light)
    for many, error in zip(drawn, errors, strict=True):
        assert np.std(many) == pytest.approx(error, rel=0.15)


def test_no_light_has_a_share_and_width_that_nothing_is_known_of():
    light = np.zeros((3, EDGES.size))
    light[1, 5] = -1.0
    light[2, 0] = 1.0  # all within the first micrometre
    near, width = near_share_and_far_width(EDGES, light)
    assert near.tolist() == [1.0, 1.0, 1.0] and width.tolist() == [UNKNOWN_WIDTH] * 3
    near_error, width_error = near_far_errors(EDGES, light, np.ones_like(light))
    assert near_error.tolist() == [1.0] * 3 and np.all(np.isinf(width_error))


def test_whatever_the_light_share_and_width_are_within_their_ranges():
    light = np.random.default_rng(2).normal(size=(300, EDGES.size))
    near, width = near_share_and_far_width(EDGES, light)
    assert np.all((near >= 0.0) & (near <= 1.0))
    assert np.all((width >= 0.999 * LEAST_WIDTH) & (width <= 1.001 * LARGEST_WIDTH))
    errors = near_far_errors(EDGES, light, np.ones_like(light))
    assert not np.isnan(errors).any()


@pytest.mark.parametrize(
    ("edges", "light", "sentence"),
    [
        (EDGES, np.ones(5), r"light has shape \(5,\); expected \(\.\.\., 162\)"),
        (EDGES[1:], np.ones(161), "ascending distances, the first 0"),
        (EDGES[::-1], np.ones(162), "ascending distances, the first 0"),
    ],
)
def test_bad_bins_are_named(edges, light, sentence):
    with pytest.raises(InputError, match=sentence):
        near_share_and_far_width(edges, light)
