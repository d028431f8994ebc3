"""Every sampled distribution of chapter 4 against its density.

Kolmogorov-Smirnov over 200,000 draws at a level of 1e-4 each: with 13 cases a correct sampler
fails for about one seed in 800, and the seeds are fixed.
"""

import math

import numpy as np
import pytest
from numba import njit
from scipy import stats
from scipy.integrate import cumulative_simpson

from hylios.transport import sampling
from hylios.transport.generator import stream, uniform

DRAWS = 200_000


@njit
def _draw(sampler, argument, state, out):
    for index in range(out.size):
        out[index] = sampler(state, argument)


@njit
def _draw_plain(sampler, state, out):
    for index in range(out.size):
        out[index] = sampler(state)


def drawn(sampler, *argument):
    out = np.empty(DRAWS)
    if argument:
        _draw(sampler, argument[0], stream(5, 1), out)
    else:
        _draw_plain(sampler, stream(5, 1), out)
    return out


def assert_follows(values, density, low, high):
    """The values follow a density, which need not be normalised, on [low, high]."""
    grid = np.linspace(low, high, 400_001)
    cumulative = cumulative_simpson(density(grid), x=grid, initial=0.0)
    cumulative /= cumulative[-1]
    result = stats.kstest(values, lambda x: np.interp(x, grid, cumulative))
    assert result.pvalue > 1e-4


@pytest.mark.parametrize("degrees", [0.05, 5.0, 40.0])
def test_algorithm_1(degrees):
    scale = np.radians(degrees)
    values = np.arccos(drawn(sampling.forward_cosine, scale))
    top = min(math.pi, 40.0 * scale)
    assert_follows(values, lambda x: np.exp(-x / scale) * np.sin(x), 0.0, top)


def test_algorithm_1_has_a_mean_near_10_degrees():
    values = np.degrees(np.arccos(drawn(sampling.forward_cosine, np.radians(5.0))))
    assert values.mean() == pytest.approx(9.85, abs=0.1)


def test_exponential_of_the_text():
    mean = np.radians(5.0)
    values = drawn(sampling.exponential_angle, mean)
    assert_follows(values, lambda x: np.exp(-x / mean), 0.0, 40.0 * mean)


def test_algorithm_2():
    values = drawn(sampling.rayleigh_cosine)
    assert_follows(values, lambda x: 1.0 + x**2, -1.0, 1.0)


def test_cosine_distribution():
    angles = np.arccos(drawn(sampling.lambertian_cosine))
    assert_follows(angles, lambda x: np.sin(x) * np.cos(x), 0.0, math.pi / 2)


@pytest.mark.parametrize("roughness", [0.1, 0.45, 1.0, 3.0])
def test_surface_normal(roughness):
    """Equation 4.8, tangent of the angle turned back into the angle."""
    angles = np.arctan(np.sqrt(drawn(sampling.surface_slope_squared, roughness)))

    def density(x):
        return np.sin(x) / (roughness**2 * np.cos(x) ** 2 + np.sin(x) ** 2) ** 2

    assert_follows(angles, density, 0.0, math.pi / 2)


def test_orientation_of_spheroid():
    """Equation 4.5 with the measure sin(alpha): in the cosine without it; one end of the axis."""
    evenly = (np.arange(DRAWS) + 0.5) / DRAWS
    for aspect in (0.17 / 0.41, 1.0, 0.001):
        values = [sampling.spheroid_cosine(number, aspect) for number in evenly]
        assert_follows(values, lambda x, a=aspect: (1.0 - x) + a * x, 0.0, 1.0)


@pytest.mark.parametrize("anisotropy", [-0.6, 0.0, 0.9])
def test_henyey_greenstein(anisotropy):
    values = drawn(sampling.henyey_greenstein_cosine, anisotropy)
    assert_follows(
        values, lambda x: (1.0 + anisotropy**2 - 2.0 * anisotropy * x) ** -1.5, -1.0, 1.0
    )


def test_free_path_is_exponential_and_infinite_without_attenuation():
    assert_follows(drawn(sampling.free_path, 7.0), lambda x: np.exp(-7.0 * x), 0.0, 6.0)
    assert np.all(np.isinf(drawn(sampling.free_path, 0.0)))


def test_uniform_numbers_fill_the_unit_interval_and_streams_differ():
    first, second = np.empty(DRAWS), np.empty(DRAWS)
    _draw_plain(uniform, stream(1, 2, 3), first)
    _draw_plain(uniform, stream(1, 2, 4), second)
    assert stats.kstest(first, "uniform").pvalue > 1e-4
    assert first.min() >= 0.0
    assert first.max() < 1.0
    assert abs(np.corrcoef(first, second)[0, 1]) < 4.0 / math.sqrt(DRAWS)
