"""Which of many points differ in the shares that they get of several masks.

A tan jumps where the energy in the skin just reaches the threshold of its response (5.7, 5.23). So
points on the two sides of such a jump differ, however near their shares are.
"""

import numpy as np
from numpy.typing import NDArray

from hylios.tanning.shares import Energies

FREQUENT = 256
"""How many points come by their frequency; the others come in random order."""

SEED = 0


def distinct(
    shares: NDArray[np.floating],
    energies: Energies,
    hours: NDArray[np.int_],
    *,
    counts: NDArray[np.int_] | None = None,
    levels: int,
    most: int,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int_]]:
    """Points that differ (U, M), how often they are there, and which of them a point is (N,).

    The most frequent come first. Points that count as one are told by the mean of their shares.

    Parameters
    ----------
    shares : (N, M) array
        0 to 1.
    energies : pair of Retained
        Of the doses of M kinds.
    hours : int array
        In which doses arrive.
    counts : (N,) int array, optional
        How often the points are there; once, if not given.
    levels : int
        Even steps of a share that are told apart; fewer where too many points differ.
    most : int
        Most points; more only if so many jumps lie between them.
    """
    sides = _hashed(_sides(shares, energies, hours), 1)
    while True:
        steps = (shares * levels + 0.5).astype(np.uint64)
        key = sides + _hashed(steps, 2)
        differing, point = np.unique(key, return_inverse=True)
        if len(differing) <= most or levels <= 1:
            break
        levels //= 2
    often = np.asarray(np.bincount(point, weights=counts), float)
    order = np.argsort(-often, kind="stable")
    rest = np.random.default_rng(SEED).permutation(order[FREQUENT:])
    order = np.append(order[:FREQUENT], rest)
    number = np.empty(len(order), int)
    number[order] = np.arange(len(order))
    point, often = number[point], often[order]
    times = 1 if counts is None else counts
    sums = [np.bincount(point, weights=own * times) for own in shares.T]
    return np.clip(np.stack(sums, axis=1) / often[:, None], 0.0, 1.0), often, point


def _sides(
    shares: NDArray[np.floating], energies: Energies, hours: NDArray[np.int_]
) -> NDArray[np.uint64]:
    """On which side of every jump points lie, as bits in whole numbers (N, K)."""
    arriving = np.unique(hours)
    arriving = arriving[arriving < energies[0].energy.shape[1]]
    highest = np.concatenate([own.energy[:, arriving] for own in energies], axis=1)
    highest = highest[:, highest.sum(axis=0) >= 1.0].astype(np.float32)
    bits = np.packbits(shares.astype(np.float32) @ highest >= 1.0, axis=1)
    padded = np.pad(bits, ((0, 0), (0, -bits.shape[1] % 8)))
    return np.ascontiguousarray(padded).view(np.uint64)


def _hashed(numbers: NDArray[np.uint64], salt: int) -> NDArray[np.uint64]:
    """One whole number for every row; two of 100,000 rows agree by chance once in 10^9 times."""
    odd = np.random.default_rng([SEED, salt]).integers(0, 2**63, numbers.shape[1], np.uint64)
    return np.asarray((numbers * (2 * odd + 1)).sum(axis=1, dtype=np.uint64))
