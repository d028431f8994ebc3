"""Diffusion profiles of many stacks of one geometry from paths that they share.

Paths are pooled (`hylios.transport.path_mixture`), so neighbours help each other. How many rays are
spent in which state (`hylios.transport.ray_allocation`) is the fewest in all with which every state
has the effective sample size that it needs (`needed_samples`); where sharing does not pay, this
comes down to simulating every state by itself. A state that still falls short of its limit is
simulated anew.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from hylios.errors import InputError, require_range
from hylios.skin.specimen import Specimen
from hylios.spectra import require_wavelengths
from hylios.threads import in_threads, one_thread, thread_count
from hylios.tissue import Model, Stack
from hylios.transport.path_mixture import Mixture, pool_paths, straightened, try_paths
from hylios.transport.paths import effective_samples, ready, require_alike
from hylios.transport.ray_allocation import MOST_PER_PATH, allocate_rays, rays_missing, worthwhile
from hylios.transport.simulate import CHUNK, DISTANCE_EDGES, count
from hylios.transport.tallies import stream_key

TOGETHER = 96
"""States that share paths at most."""

FIRST = 0.35
"""Share of the limit up to which rays are spent at first, as a trial says it with much noise."""

DOUBT = 4.0
"""Standard errors by which a state's trial may have more light than shared paths find."""

PIECES = 4
"""Pieces of rays between two counts of how many came out."""

LIGHT = 0.3
"""Share of light from which on a profile has the error that was asked for."""

LARGEST_ERROR = 0.1
"""Largest error of a profile, however little its light."""

LEAST_LIGHT = 1e-300
"""Stands for no light where a root is taken."""


@dataclass(frozen=True)
class Profiles:
    """Light that leaves S stacks after having been inside, by distance from where it came in.

    Bin i of distances starts at `hylios.transport.simulate.DISTANCE_EDGES[i]`; there are B.

    Attributes
    ----------
    light : (S, B) array
        Share of the incident light.
    squares : (S, B) array
        Sum of squared weights, of which `light` is the sum.
    rays : (S,) int array
        Rays spent in each stack, those that are tried before not counted.
    anew : (S,) bool array
        Whether a stack's profile is from its own rays alone, counted.
    """

    light: np.ndarray
    squares: np.ndarray
    rays: np.ndarray
    anew: np.ndarray

    @property
    def subsurface(self) -> np.ndarray:
        """Share of the incident light that leaves after having been inside, (S,)."""
        return self.light.sum(axis=1)

    @property
    def subsurface_error(self) -> np.ndarray:
        """Standard error of `subsurface`, (S,), a little too large where paths are pooled."""
        return np.sqrt(self.squares.sum(axis=1))

    @property
    def effective_sample_size(self) -> np.ndarray:
        """How many paths of equal weight would tell as much, (S,); 0 where no light came out."""
        return effective_samples(self.light.sum(axis=1), self.squares.sum(axis=1))

    @property
    def within(self) -> np.ndarray:
        """Share of a stack's subsurface light that leaves nearer than the end of each bin, (S, B).

        A ratio of two estimates, whose bias is some 1 / `effective_sample_size`; 0 where no light
        came out, or less than none, as channels of colour can have by noise.
        """
        return self._of_light(np.cumsum(self.light, axis=1), 0.0)

    @property
    def standard_error(self) -> np.ndarray:
        """Standard error of `within`, (S, B), of a ratio to first order.

        Near .5 / sqrt(`effective_sample_size`) where half of the light is within; 1 at most, and
        where no light came out.
        """
        near = np.cumsum(self.squares, axis=1)
        far = self.squares.sum(axis=1)[:, None] - near
        variance = (1.0 - self.within) ** 2 * near + self.within**2 * np.maximum(far, 0.0)
        return np.minimum(self._of_light(np.sqrt(variance), 1.0), 1.0)

    def _of_light(self, values: np.ndarray, without: float) -> np.ndarray:
        """Values (S, B) over the light that came out; `without` where there is none."""
        whole = self.subsurface[:, None]
        return np.divide(values, whole, out=np.full_like(values, without), where=whole > 0.0)


def profiles(
    stacks: Sequence[Stack],
    *,
    error: float = 0.01,
    angle: float = 8.0,
    key: tuple[int, ...] = (1,),
    threads: int | None = None,
) -> Profiles:
    """Diffusion profiles of stacks of one geometry, from shared paths.

    The result does not depend on the number of threads.

    Parameters
    ----------
    stacks : sequence of Stack
        Of finite thickness. They may differ in absorption, in amounts of what scatters, and by
        one factor on all thicknesses.
    error : float
        Largest standard error of the cumulative profile, .0005 to .1, of light skin; darker skin's
        may be larger (`needed_samples`). Each stack gets that, and so large an effective sample
        size, unless hardly any light comes out of it.
    angle : float
        Of incidence, in degrees, 0 to 89.99.
    key : tuple of int
        Names the streams of random numbers.
    threads : int, optional
        All cores by default.

    Raises
    ------
    InputError
        If a number is out of range or the stacks differ in more.
    """
    error = require_range("error of a profile", error, 5e-4, LARGEST_ERROR)
    stacks = [ready(stack) for stack in stacks]
    if not stacks:
        raise InputError("profiles need at least 1 stack.")
    require_alike(stacks)
    with one_thread():  # all cores weight paths already
        groups = [
            _shared(stacks[first : first + TOGETHER], error, angle, (*key, first), threads)
            for first in range(0, len(stacks), TOGETHER)
        ]
    return Profiles(
        light=np.concatenate([group.light for group in groups]),
        squares=np.concatenate([group.squares for group in groups]),
        rays=np.concatenate([group.rays for group in groups]),
        anew=np.concatenate([group.anew for group in groups]),
    )


def skin_profiles(
    specimens: Sequence[Specimen],
    wavelengths: Iterable[float],
    *,
    error: float = 0.01,
    angle: float = 8.0,
    seed: int = 1,
    threads: int | None = None,
    model: Model | None = None,
) -> list[Profiles]:
    """Profiles of a specimen's tanning states (`Skin.at`) at each wavelength in nm.

    Parameters and errors as in `profiles` and `hylios.transport.simulate.spectrum`. A wavelength's
    result does not depend on what other wavelengths there are.
    """
    model = model or Model()
    return [
        profiles(
            [Stack.of(specimen, wavelength, model) for specimen in specimens],
            error=error,
            angle=angle,
            key=stream_key(seed, wavelength),
            threads=threads,
        )
        for wavelength in require_wavelengths(wavelengths, model.spectra)
    ]


def needed_samples(light: float | np.ndarray, error: float) -> np.ndarray:
    """Effective sample size (...) with which a profile's error is seen no more than others'.

    Lightness L* goes with the cube root of the light (CIE 1976): where a small share of a little
    light is missing it falls by less, so the profile of a share of light below `LIGHT` may have a
    standard error that is larger by the cube root of their ratio, up to `LARGEST_ERROR`.

    Parameters
    ----------
    light : (...) array
        Share of the incident light.
    error : float
        Standard error of the cumulative profile, where it is .5, of more light.
    """
    darker = np.clip(light / LIGHT, LEAST_LIGHT, 1.0)
    return 0.25 / np.minimum(error * darker ** (-1.0 / 3.0), LARGEST_ERROR) ** 2


def _shared(
    stacks: list[Stack], error: float, angle: float, key: tuple[int, ...], threads: int | None
) -> Profiles:
    """Profiles of stacks with the effective sample size that they need, as far as can be."""
    mixture = Mixture.of([straightened(stack) for stack in stacks])
    proposed, wanted = try_paths(mixture, angle, (*key, 0), threads)
    trial = wanted.sum(axis=0), np.sqrt((wanted**2).sum(axis=0))
    rays = allocate_rays(proposed, wanted, FIRST * needed_samples(trial[0], error))
    pooled = _pooled(mixture, rays, angle, (*key, 1), threads)
    missing = _missing(pooled, trial, error)
    alone = needed_samples(pooled.subsurface, error)
    alone = alone / np.maximum(pooled.subsurface, 1.0 / MOST_PER_PATH)
    more = np.ceil(rays * worthwhile(missing, alone / max(rays.sum(), 1))).astype(int)
    if more.any():
        pooled = _joined(pooled, _pooled(mixture, more, angle, (*key, 2), threads))
        missing = _missing(pooled, trial, error)
    for number in np.flatnonzero(missing):
        own = (*key, 3, int(number))
        exits, spent = _counted(stacks[number], error, angle, own, threads)
        pooled.light[number], pooled.squares[number] = exits / spent, exits / spent**2
        pooled.rays[number] += spent
        pooled.anew[number] = True
    return pooled


def _pooled(
    mixture: Mixture, rays: np.ndarray, angle: float, key: tuple[int, ...], threads: int | None
) -> Profiles:
    light, squares = pool_paths(mixture, rays, angle, key, threads)
    return Profiles(light, squares, rays, np.zeros(rays.size, bool))


def _missing(pooled: Profiles, trial: tuple[np.ndarray, np.ndarray], error: float) -> np.ndarray:
    """How many times the rays spent every state needs besides for its limit, (S,); 0 where none.

    Weights that go with distance can make the profile less sure than so many equal paths would.
    And where paths of others miss most of a state's light, their weights do not show it: its own
    trial, light (S,) and standard error (S,), does.
    """
    largest = np.maximum(pooled.standard_error.max(axis=1), 1e-9)
    reached = np.minimum(pooled.effective_sample_size, (0.5 / largest) ** 2)
    doubt = DOUBT * np.hypot(trial[1], pooled.subsurface_error)
    reached[trial[0] - pooled.subsurface > doubt] = 0.0
    return rays_missing(reached, needed_samples(pooled.subsurface, error))


def _joined(first: Profiles, second: Profiles) -> Profiles:
    """Profiles from the rays of both, which have been spent in the same proportions."""
    both = first.rays.sum() + second.rays.sum()
    share, rest = first.rays.sum() / both, second.rays.sum() / both
    return Profiles(
        light=share * first.light + rest * second.light,
        squares=share**2 * first.squares + rest**2 * second.squares,
        rays=first.rays + second.rays,
        anew=first.anew,
    )


def _counted(
    stack: Stack, error: float, angle: float, key: tuple[int, ...], threads: int | None
) -> tuple[np.ndarray, int]:
    """Exits (B,) of one stack's own rays, as many as it needs, and how many rays it took.

    Fewer where hardly any light comes out.
    """
    most = needed_samples(1.0, error)
    size = int(np.clip(most / PIECES**2, 256, CHUNK))

    def piece(first: int) -> np.ndarray:
        return count(stack, rays=size, angle=angle, key=(*key, first)).exits

    exits, spent = np.zeros(DISTANCE_EDGES.size, int), 0
    while spent < MOST_PER_PATH * most:
        firsts = range(spent, spent + PIECES * size, size)
        exits += sum(in_threads(piece, iter(firsts), thread_count(threads)))
        spent += PIECES * size
        if exits.sum() >= needed_samples(exits.sum() / spent, error):
            break
    return exits, spent
