"""Light transport as arrays: rays through a stack, spectra and exit distances of a specimen."""

import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor, wait
from dataclasses import dataclass

import numpy as np

from hylios.errors import InputError, require_range, require_whole
from hylios.specimen import Specimen
from hylios.spectra import Figures
from hylios.tissue import Stack, stack
from hylios.transport.generator import stream
from hylios.transport.survival import with_survival
from hylios.transport.walk import (
    ABSORBED,
    ABSORBED_IN_MELANOSOME,
    LOST,
    SUBSURFACE,
    SURFACE,
    TRANSMITTED,
    kernel_arguments,
    walk,
)

CHUNK = 16384
"""Rays of one stream of random numbers; fixed, so that results do not depend on the threads."""

MOST_RAYS = 10**10

DISTANCE_EDGES = np.concatenate([[0.0], np.geomspace(1e-3, 100.0, 161)])
"""Edges in mm of the bins in which exit distances are counted; the last bin is open."""


@dataclass(frozen=True)
class Rays:
    """How rays ended.

    Attributes
    ----------
    outcome : (N,) int8 array
        SURFACE, SUBSURFACE, TRANSMITTED, ABSORBED or ABSORBED_IN_MELANOSOME.
    layer : (N,) int8 array
        Index of the layer that absorbed the ray, -1 if none did.
    place : (N, 2) array
        x and y in cm where the ray ended; it came in at the origin.
    direction : (N, 3) array
        Unit vector, z into the skin.
    """

    outcome: np.ndarray
    layer: np.ndarray
    place: np.ndarray
    direction: np.ndarray

    @property
    def distance(self) -> np.ndarray:
        """Distance in mm along the surface from where each ray came in, (N,)."""
        return 10.0 * np.hypot(self.place[:, 0], self.place[:, 1])


def trace(layers: Stack, *, rays: int, angle: float = 0.0, key: tuple[int, ...] = (1,)) -> Rays:
    """Trace rays through a stack, all at one place and angle of incidence.

    Parameters
    ----------
    rays : int
        At least 1.
    angle : float
        Of incidence, in degrees, 0 to 89.99.
    key : tuple of int
        Seed and whatever else names this stream of random numbers.

    Raises
    ------
    InputError
        If the angle or the number of rays is out of range.
    RuntimeError
        If a ray was lost: no way out and nothing that absorbs.
    """
    require_range("angle of incidence", angle, 0.0, 89.99, "degrees")
    rays = require_whole("number of rays", rays, 1, MOST_RAYS)
    outcome, layer = np.empty(rays, np.int8), np.empty(rays, np.int8)
    place, direction = np.empty((rays, 2)), np.empty((rays, 3))
    radians = np.radians(angle)
    walk(
        *kernel_arguments(layers),
        np.sin(radians),
        np.cos(radians),
        stream(*key),
        outcome,
        layer,
        place,
        direction,
    )
    if np.any(outcome == LOST):
        raise RuntimeError("a ray found no end: the stack neither absorbs light nor lets it out")
    return Rays(outcome, layer, place, direction)


@dataclass(frozen=True)
class Spectrum:
    """Directional-hemispherical reflectance and absorptance of a specimen.

    Attributes
    ----------
    wavelengths : (W,) array, nm
    rays : int
        Rays per wavelength.
    surface, subsurface : (W,) arrays
        Share of the light that the surface reflects, and that leaves after having been inside.
    absorbed, absorbed_in_melanosomes : (W, L) arrays
        Share that ends in each layer's absorbers and in its melanosomes, counted there.
    exit_counts : (W, len(DISTANCE_EDGES)) int array
        Subsurface rays by distance between entry and exit: bin i starts at DISTANCE_EDGES[i].
    """

    wavelengths: np.ndarray
    rays: int
    surface: np.ndarray
    subsurface: np.ndarray
    absorbed: np.ndarray
    absorbed_in_melanosomes: np.ndarray
    exit_counts: np.ndarray

    @property
    def total(self) -> np.ndarray:
        """Reflectance, (W,)."""
        return self.surface + self.subsurface

    @property
    def absorptance(self) -> np.ndarray:
        """Share of the light that is absorbed, (W,), from its own tally."""
        return (self.absorbed + self.absorbed_in_melanosomes).sum(axis=1)

    @property
    def standard_error(self) -> np.ndarray:
        """Standard error of the reflectance, (W,): binomial, with one more ray of either fate.

        So it is not 0 where no ray, or every ray, came back (Laplace's rule of succession).
        """
        share = (self.total * self.rays + 1.0) / (self.rays + 2.0)
        return np.sqrt(share * (1.0 - share) / self.rays)


Progress = Callable[[int], object]
"""Told, as each piece of work ends, how many rays it had."""


def spectrum(
    specimen: Specimen,
    wavelengths: Iterable[float],
    *,
    angle: float = 8.0,
    rays: int = 100_000,
    seed: int = 1,
    threads: int | None = None,
    known: Figures | None = None,
    chosen: Mapping[str, str] | None = None,
    as_printed: bool = False,
    progress: Progress | None = None,
) -> Spectrum:
    """Simulate a specimen's spectrum by random walk.

    A wavelength's result depends on the seed, the rays and itself, not on which others are asked
    for or on the number of threads.

    Parameters
    ----------
    wavelengths : iterable of float
        nm, 250 to 2500.
    angle : float
        Of incidence, in degrees, 0 to 89.99.
    rays : int
        Per wavelength.
    threads : int, optional
        All cores by default.
    known : Figures, optional
        The project's own spectral figures by default.
    chosen : mapping, optional
        Readings of the thesis's text that differ from the defaults (`hylios.tissue.READINGS`).
    as_printed : bool
        Walk every path inside a melanosome instead of using its tabulated survival: the same
        model (see `hylios.transport.survival` for how nearly), slower.

    Raises
    ------
    InputError
        If a wavelength, the angle or the number of rays is out of range.
    """
    asked = np.atleast_1d(np.asarray(wavelengths, dtype=float))
    if asked.ndim != 1 or asked.size == 0:
        raise InputError("wavelengths are no list of numbers; at least one is needed, in nm.")
    rays = require_whole("number of rays", rays, 1, MOST_RAYS)
    seed = require_whole("seed", seed, 0, 2**63)
    threads = require_whole("number of threads", threads or os.cpu_count() or 1, 1, 1024)
    stacks = [stack(specimen, each, known=known, chosen=chosen) for each in asked]
    if not as_printed:
        stacks = [with_survival(each) for each in stacks]
    work = (
        (row, stacks[row], min(CHUNK, rays - first), (seed, round(asked[row] * 1000), first))
        for row in range(asked.size)
        for first in range(0, rays, CHUNK)
    )
    depth = len(stacks[0].layers)
    counts = np.zeros((asked.size, 2 + 2 * depth), int)
    exits = np.zeros((asked.size, DISTANCE_EDGES.size), int)

    def piece(task):
        row, layers, size, key = task
        traced = trace(layers, rays=size, angle=angle, key=key)
        return row, size, _tally(traced, depth), _exit_counts(traced)

    for row, size, tally, counted in in_threads(piece, work, threads):
        counts[row] += tally
        exits[row] += counted
        if progress:
            progress(size)

    shares = counts / rays
    return Spectrum(
        wavelengths=asked,
        rays=rays,
        surface=shares[:, 0],
        subsurface=shares[:, 1],
        absorbed=shares[:, 2 : 2 + depth],
        absorbed_in_melanosomes=shares[:, 2 + depth :],
        exit_counts=exits,
    )


def _tally(traced: Rays, depth: int) -> np.ndarray:
    """Counts of surface, subsurface, absorbed by layer, absorbed in melanosomes by layer."""
    ends = np.bincount(traced.outcome, minlength=LOST + 1)
    if ends[TRANSMITTED]:
        raise RuntimeError("light left through the floor of a skin, whose reflectance is 1")
    layers = [
        np.bincount(traced.layer[traced.outcome == kind], minlength=depth)
        for kind in (ABSORBED, ABSORBED_IN_MELANOSOME)
    ]
    return np.concatenate([[ends[SURFACE], ends[SUBSURFACE]], *layers])


def _exit_counts(traced: Rays) -> np.ndarray:
    distance = traced.distance[traced.outcome == SUBSURFACE]
    bins = np.searchsorted(DISTANCE_EDGES, distance, side="right") - 1
    return np.bincount(bins, minlength=DISTANCE_EDGES.size)


def in_threads(function: Callable, tasks: Iterator, threads: int) -> Iterator:
    """Results as they end, with a few tasks waiting; on any exception the waiting ones are dropped.

    The kernels release the interpreter's lock, so threads run at once.
    """
    with ThreadPoolExecutor(max_workers=threads) as pool:
        running: set[Future] = set()
        try:
            for task in tasks:
                running.add(pool.submit(function, task))
                if len(running) >= 2 * threads:
                    ended, running = wait(running, return_when="FIRST_COMPLETED")
                    yield from (each.result() for each in ended)
            while running:
                ended, running = wait(running, return_when="FIRST_COMPLETED")
                yield from (each.result() for each in ended)
        finally:
            for each in running:
                each.cancel()
