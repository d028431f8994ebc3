"""Tallies of many rays through one stack, piece by piece on all cores."""

from collections.abc import Callable

import numpy as np

from hylios.errors import require_whole
from hylios.threads import in_threads, thread_count
from hylios.tissue import Stack
from hylios.transport.simulate import CHUNK, MOST_RAYS, Rays, ready_to_walk, trace


def stream_key(seed: int, wavelength: float) -> tuple[int, int]:
    """Key of the random numbers of a wavelength in nm: the same as in a spectrum.

    Raises
    ------
    InputError
        If the seed is out of range.
    """
    return require_whole("seed", seed, 0, 2**63), round(wavelength * 1000)


def tallied(
    tally: Callable[[Rays], np.ndarray],
    stack: Stack,
    *,
    rays: int,
    angle: float,
    key: tuple[int, ...],
    threads: int | None = None,
) -> np.ndarray:
    """Sum of a tally over rays through a stack; it does not depend on the number of threads.

    Parameters
    ----------
    tally : callable
        From the rays of one piece to an integer array of always the same shape.
    angle : float
        Of incidence, in degrees, 0 to 89.99.
    key : tuple of int
        Names the streams of random numbers.
    threads : int, optional
        All cores by default.

    Raises
    ------
    InputError
        If the angle or a number is out of range.
    """
    rays = require_whole("number of rays", rays, 1, MOST_RAYS)
    threads, stack = thread_count(threads), ready_to_walk(stack)

    def piece(first: int) -> np.ndarray:
        size = min(CHUNK, rays - first)
        return tally(trace(stack, rays=size, angle=angle, key=(*key, first)))

    results = in_threads(piece, iter(range(0, rays, CHUNK)), threads)
    total = next(results).copy()
    for result in results:
        total += result
    return total
