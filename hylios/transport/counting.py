"""Counts over many rays through one stack, piece by piece on all cores."""

from collections.abc import Callable

import numpy as np

from hylios.errors import require_whole
from hylios.skin.specimen import Specimen
from hylios.threads import in_threads, thread_count
from hylios.tissue import Model, Stack
from hylios.transport.melanosome_paths import with_survival
from hylios.transport.simulate import CHUNK, MOST_RAYS, Rays, trace


def skin_stack(specimen: Specimen, wavelength: float, model: Model | None = None) -> Stack:
    """The layers of a specimen at one wavelength in nm, ready to be walked.

    Raises
    ------
    InputError
        As `hylios.tissue.Stack.of`.
    """
    return with_survival(Stack.of(specimen, wavelength, model))


def skin_key(seed: int, wavelength: float) -> tuple[int, int]:
    """What names the random numbers of a wavelength, in nm: the same as in a spectrum.

    Raises
    ------
    InputError
        If the seed is out of range.
    """
    return require_whole("seed", seed, 0, 2**63), round(wavelength * 1000)


def counted(
    tally: Callable[[Rays], np.ndarray],
    layers: Stack,
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
    threads = thread_count(threads)

    def piece(first: int) -> np.ndarray:
        size = min(CHUNK, rays - first)
        return tally(trace(layers, rays=size, angle=angle, key=(*key, first)))

    results = in_threads(piece, iter(range(0, rays, CHUNK)), threads)
    total = next(results).copy()
    for result in results:
        total += result
    return total
