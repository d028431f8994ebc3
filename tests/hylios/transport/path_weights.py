"""Weights of single paths in other stacks, as shared paths have them, for the tests of these."""

from dataclasses import dataclass, replace

import numpy as np
from scipy import stats

from hylios.skin.specimen import SPECIMENS, tanned
from hylios.threads import in_order
from hylios.tissue import Stack
from hylios.transport.melanosome_paths import with_survival
from hylios.transport.paths import (
    Paths,
    log_density,
    ready,
    require_alike,
    rescaled,
    total_thickness,
    walk_paths,
)
from hylios.transport.simulate import CHUNK, DISTANCE_EDGES, count

LEVEL = 1e-4
STATES = (
    ((0.4, 0.4, 0.2), 1.0),
    ((0.46, 0.46, 0.24), 1.2),
    ((0.5, 0.5, 0.35), 1.35),
    ((0.35, 0.45, 0.15), 0.9),
)
"""Melanin of three layers and thickness, as a tan has them."""


def skin_stack(specimen, wavelength):
    """The stack of a specimen with walked survival in melanosomes."""
    return with_survival(Stack.of(specimen, wavelength))


def tans(name, wavelength, states=STATES):
    """Stacks of a specimen in tanning states."""
    return [skin_stack(tanned(SPECIMENS[name], *state), wavelength) for state in states]


def changed(stack, number, **factors):
    """The stack with coefficients of one layer multiplied."""
    layers = list(stack.layers)
    layer = layers[number]
    new = {name: getattr(layer, name) * factor for name, factor in factors.items()}
    layers[number] = replace(layer, **new)
    return replace(stack, layers=tuple(layers))


@dataclass(frozen=True)
class Walked:
    """Paths that came back, of so many rays in a stack."""

    stack: Stack
    rays: int
    paths: Paths

    def weights(self, stack):
        """Weight (N,) of each path in another stack: the ratio of its densities there and here.

        The sum of weights over the rays is the other's subsurface reflectance, and its exit
        distances are those here times the ratio of thicknesses.
        """
        require_alike([self.stack, stack])
        stack = rescaled(stack, total_thickness(self.stack))
        change = log_density(stack) - log_density(self.stack)
        return np.exp(self.paths.table @ change.ravel())


def walked(stack, rays, key, angle=0.0, threads=None):
    """Paths from streams of random numbers, of `CHUNK` rays each."""
    stack = ready(stack)
    tasks = [(min(CHUNK, rays - first), (*key, first)) for first in range(0, rays, CHUNK)]
    pieces = list(in_order(lambda task: walk_paths(stack, task[0], angle, task[1]), tasks, threads))
    distance = np.concatenate([piece.distance for piece in pieces])
    return Walked(stack, rays, Paths(distance, np.concatenate([piece.sums for piece in pieces])))


def exits(stack, rays, key):
    """Exits of a stack's own rays by distance."""
    return sum(
        count(stack, rays=min(CHUNK, rays - first), angle=8.0, key=(*key, first)).exits
        for first in range(0, rays, CHUNK)
    )


def assert_same_light(light, variance, counts, rays):
    """Chi squared of light by distance, with its variance, against counted rays'."""
    bins = np.digitize(np.cumsum(counts) - 0.5 * counts, np.linspace(0, counts.sum(), 13)[1:-1])
    light, variance, counts = (np.bincount(bins, values) for values in (light, variance, counts))
    misfit = np.sum((light - counts / rays) ** 2 / (variance + counts / rays**2))
    assert stats.chi2.sf(misfit, counts.size) > LEVEL


def assert_weights_give(ways, stack, rays, key):
    """The weighted paths leave as a stack's own rays do: how many, and where."""
    weight = ways.weights(stack)
    ratio = stack.layers[0].thickness / ways.stack.layers[0].thickness
    where = np.append(DISTANCE_EDGES, np.inf)
    light, squares = (
        np.histogram(ways.paths.distance * ratio, where, weights=values)[0] / ways.rays**power
        for power, values in ((1, weight), (2, weight**2))
    )
    assert_same_light(light, squares, exits(stack, rays, key), rays)
    assert np.any(np.abs(weight - 1.0) > 0.01)
