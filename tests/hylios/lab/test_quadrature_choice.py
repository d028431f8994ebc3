"""How wavelengths are chosen that give the colours of spectra."""

from itertools import combinations

import numpy as np
import pytest

from hylios.lab.quadrature_choice import Colours, choose


def colours_of(reflectances, weights=None, wavelengths=None):
    size = reflectances.shape[1]
    if weights is None:
        weights = np.random.default_rng(3).uniform(0.5, 1.5, (3, size))
        weights /= weights.sum(axis=1, keepdims=True)
    grid = np.arange(size, dtype=float) if wavelengths is None else wavelengths
    return Colours(grid, weights, reflectances, np.tile(np.eye(3), (len(reflectances), 1, 1)))


def test_as_many_wavelengths_as_the_spectra_have_degrees_of_freedom_are_enough():
    """Lines between 4 knots: with 4 wavelengths there is no error, whatever the weights."""
    random = np.random.default_rng(1)
    knots = random.uniform(0.1, 0.9, (50, 4))
    spectra = np.array([np.interp(np.arange(25), [0, 8, 16, 24], values) for values in knots])
    problem = colours_of(spectra)
    quadrature = choose(problem, 4, rays=1e12)[-1]
    picked = spectra[:, quadrature.wavelengths.astype(int)]
    assert picked @ quadrature.weights.T == pytest.approx(spectra @ problem.weights.T, abs=1e-5)


def test_two_wavelengths_are_the_best_pair_of_all():
    """Against every pair, its weights by least squares with the sum built in."""
    random = np.random.default_rng(2)
    spectra = 0.5 + 0.1 * np.cumsum(random.normal(size=(40, 12)), axis=1)
    problem = colours_of(spectra)
    goal = spectra @ problem.weights.T

    def error(first, second):
        across = spectra[:, [first]] - spectra[:, [second]]
        rest = goal - spectra[:, [second]]
        weight = np.linalg.lstsq(across, rest, rcond=None)[0]
        return float(np.mean(np.sum((across @ weight - rest) ** 2, axis=1)))

    best = min(error(*pair) for pair in combinations(range(12), 2))
    quadrature = choose(problem, 2, rays=1e12)[-1]
    missed = spectra[:, quadrature.wavelengths.astype(int)] @ quadrature.weights.T - goal
    assert np.mean(np.sum(missed**2, axis=1)) == pytest.approx(best, rel=1e-6)


def test_few_rays_make_for_even_weights():
    """With noise all that counts, a grey spectrum's rays are shared by all wavelengths alike."""
    problem = colours_of(np.full((5, 6), 0.5))
    quadrature = choose(problem, 3, rays=1.0)[-1]
    assert quadrature.weights == pytest.approx(np.full((3, 3), 1.0 / 3.0), abs=1e-9)


def test_wavelengths_come_from_those_allowed():
    allowed = np.arange(12) % 3 == 1
    spectra = np.random.default_rng(6).uniform(0.1, 0.9, (20, 12))
    for quadrature in choose(colours_of(spectra), 4, allowed=allowed):
        assert np.all(np.isin(quadrature.wavelengths, [1.0, 4.0, 7.0, 10.0]))
