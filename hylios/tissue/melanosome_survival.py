"""Survival of light that meets a melanosome, from a table of lengths of paths through it.

The table, `melanosome_survival.csv`, is made by `hylios.transport.survival_table` by walking the
paths, for light that goes in straight on. For each shape and ratio of refractive indices it has a
few lengths and weights, with which the mean of exp(-absorption length) over all paths is a sum. Its
standard error is 0.04 % of the light absorbed in one melanosome; sums and interpolation add less
than that, in long melanosomes that absorb little up to 0.1 %. The shapes go beyond every pair of
axes within physiology (`hylios.skin.physiology`).
"""

from functools import lru_cache
from pathlib import Path

import numpy as np

from hylios.errors import require_range
from hylios.lagrange import lagrange
from hylios.packaged import numbers_of
from hylios.tissue import Layer

TABLE = Path(__file__).with_name("melanosome_survival.csv")

ASPECTS, RATIOS, POINTS = 10, 8, 12
"""Shapes, ratios of refractive indices, and lengths for each pair of them."""

LEAST_ASPECT, MOST_RATIO = 0.08, 1.6
"""Ends of the table: semi-minor to semi-major axis from there to 1, index inside to outside from 1
to there."""


def aspects() -> np.ndarray:
    """Shapes in the table, (ASPECTS,): Chebyshev's points of the logarithm."""
    return np.exp(np.log(LEAST_ASPECT) * _chebyshev(ASPECTS))


def ratios() -> np.ndarray:
    """Ratios of refractive indices in the table, (RATIOS,).

    Chebyshev's points of sqrt(ratio - 1), as total reflection inside sets in like that root.
    """
    return 1.0 + (MOST_RATIO - 1.0) * _chebyshev(RATIOS) ** 2


def survival_in_melanosome(layer: Layer, melanin_index: float) -> float:
    """Probability that light leaves one melanosome of a layer unabsorbed.

    Parameters
    ----------
    melanin_index : float
        Refractive index inside.

    Raises
    ------
    InputError
        If the melanosome's shape or the ratio of refractive indices lies outside the table.
    """
    aspect, ratio = _looked_up(layer, melanin_index)
    require_range("minor to major axis of melanosomes", aspect, LEAST_ASPECT, 1.0)
    require_range("refractive index of melanosomes relative to the tissue", ratio, 1.0, MOST_RATIO)
    return _survival(float(layer.melanin_absorption * layer.semi_minor), aspect, ratio)


def is_tabulated(layer: Layer, melanin_index: float) -> bool:
    """Whether the table reaches to the shape and the refractive index of a layer's melanosomes."""
    aspect, ratio = _looked_up(layer, melanin_index)
    return LEAST_ASPECT <= aspect <= 1.0 <= ratio <= MOST_RATIO


def _looked_up(layer: Layer, melanin_index: float) -> tuple[float, float]:
    """Semi-minor to semi-major axis, and refractive index inside to outside."""
    return layer.semi_minor / layer.semi_major, melanin_index / layer.refractive_index


@lru_cache(maxsize=4096)
def _survival(depth: float, aspect: float, ratio: float) -> float:
    """Survival where melanin absorbs that much over the semi-minor axis; states share it."""
    lengths, weights = _table()
    survivals = (weights * np.exp(-depth * lengths)).sum(axis=2)
    along, across = _interpolating(aspect, ratio)
    return float(np.clip(along @ survivals @ across, 0.0, 1.0))


@lru_cache(maxsize=1024)
def _interpolating(aspect: float, ratio: float) -> tuple[np.ndarray, np.ndarray]:
    """Weights of the table's shapes and ratios, (ASPECTS,) and (RATIOS,)."""
    return (
        lagrange(np.log(aspects()), np.log([aspect]))[0],
        lagrange(np.sqrt(ratios() - 1.0), np.sqrt([ratio - 1.0]))[0],
    )


@lru_cache(maxsize=1)
def _table() -> tuple[np.ndarray, np.ndarray]:
    """Lengths in semi-minor axes, and their weights, (ASPECTS, RATIOS, POINTS) each."""
    _, rows = numbers_of("hylios.tissue", TABLE.name)
    lengths, weights = np.split(rows[:, 2:], 2, axis=1)
    weights /= weights.sum(axis=1, keepdims=True)  # printed with few digits
    shape = (ASPECTS, RATIOS, POINTS)
    return lengths.reshape(shape), weights.reshape(shape)


def _chebyshev(count: int) -> np.ndarray:
    """Chebyshev's points of [0, 1], descending."""
    return 0.5 + 0.5 * np.cos(np.pi * (np.arange(count) + 0.5) / count)
