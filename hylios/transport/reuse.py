"""Diffusion profiles of many stacks of one geometry from paths that they share.

Paths are pooled: rays are spent in several states, and a path (`hylios.transport.paths`) counts
for a state with its density there over the sum of its densities in all of those, times their rays
(the balance heuristic of E. Veach and L. Guibas 1995, "Optimally combining sampling techniques for
Monte Carlo rendering").
So neighbours help each other, and where rays are spent in a state itself, no weight exceeds what
these alone would give. How many are spent in which state (`allocated`) is chosen for the fewest in
all with which every state has the effective sample size that it needs (`needed_samples`); where
reuse does not pay, this comes down to simulating each state for itself. What falls short of its
limit all the same is simulated anew.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from hylios.errors import InputError, require_range
from hylios.skin.specimen import Specimen
from hylios.spectra import require_wavelengths
from hylios.threads import in_order, in_threads, one_thread, thread_count
from hylios.tissue import Layer, Model, Stack
from hylios.tissue.melanosome_encounters import encounters
from hylios.transport.counting import skin_key
from hylios.transport.paths import (
    LEAST,
    Paths,
    effective,
    log_density,
    ready,
    recorded,
    require_alike,
    rescaled,
    total_thickness,
)
from hylios.transport.simulate import CHUNK, DISTANCE_EDGES, count

LIGHTER = 0.6
"""Absorption with which shared paths are walked, relative to the state's own: more of them come
out, and weigh less. The fewest seconds per effective path, flatly, at .5 to .7 for S3 and S4."""

TOGETHER = 96
"""States that share paths at most."""

PILOT_RAYS, PILOT_PATHS, PILOT_ROUNDS = 64, 512, 48
"""Of the trial before rays are allocated: rays per state and round, paths wanted, most rounds."""

DOUBT = 4.0
"""Standard errors by which a state's trial may have more light than shared paths find."""

STEPS = 50
"""Of the iteration that allocates rays."""

FIRST = 0.35
"""Share of the limit up to which rays are spent at first, as a trial says it with much noise."""

SPARE = 1.05
"""Factor on what is missing where more rays are added, for noise not to leave it missing."""

FEWEST = 0.003
"""Share of all rays below which none are spent in a state."""

BLOCK = 4096
"""Paths weighted at once."""

PIECES = 4
"""Of rays that are counted between looks at how many came out."""

LIGHT = 0.3
"""Share of light from which on a profile has the error that was asked for."""

LARGEST_ERROR = 0.1
"""Of the profile of however little light."""

MOST_PER_PATH = 400
"""Rays per effective path after which a state that lets out hardly any light is left as it is."""


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
        return effective(self.light.sum(axis=1), self.squares.sum(axis=1))

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
        Largest standard error of the cumulative profile that is asked for, .0005 to .1, of light
        skin; darker skin's may be larger (`needed_samples`). Each stack gets that, and so large an
        effective sample size, unless hardly any light comes out of it.
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
    stacks = [ready(each) for each in stacks]
    if not stacks:
        raise InputError("profiles need at least 1 stack.")
    require_alike(stacks)
    with one_thread():  # all cores weight paths already
        groups = [
            _shared(stacks[first : first + TOGETHER], error, angle, (*key, first), threads)
            for first in range(0, len(stacks), TOGETHER)
        ]
    return Profiles(
        light=np.concatenate([each.light for each in groups]),
        squares=np.concatenate([each.squares for each in groups]),
        rays=np.concatenate([each.rays for each in groups]),
        anew=np.concatenate([each.anew for each in groups]),
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
    """Profiles of a specimen's tanning states (`Skin.tanned`) at each wavelength in nm.

    Parameters and errors as in `profiles` and `hylios.transport.simulate.spectrum`. A wavelength's
    result does not depend on which others are asked for.
    """
    return [
        profiles(
            [Stack.of(each, wavelength, model) for each in specimens],
            error=error,
            angle=angle,
            key=skin_key(seed, wavelength),
            threads=threads,
        )
        for wavelength in require_wavelengths(wavelengths, (model or Model()).spectra)
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
    darker = np.clip(light / LIGHT, LEAST, 1.0)
    return 0.25 / np.minimum(error * darker ** (-1.0 / 3.0), LARGEST_ERROR) ** 2


def _shared(
    stacks: list[Stack], error: float, angle: float, key: tuple[int, ...], threads: int | None
) -> Profiles:
    """Profiles of stacks with the effective sample size that they need, as far as can be."""
    mixture = _Mixture.of([_straightened(each) for each in stacks])
    proposed, wanted = _tried(mixture, angle, (*key, 0), threads)
    trial = wanted.sum(axis=0), np.sqrt((wanted**2).sum(axis=0))
    rays = allocated(proposed, wanted, FIRST * needed_samples(trial[0], error))
    found = _pooled(mixture, rays, angle, (*key, 1), threads)
    missing = _missing(found, trial, error)
    alone = needed_samples(found.subsurface, error)
    alone = alone / np.maximum(found.subsurface, 1.0 / MOST_PER_PATH)
    more = np.ceil(rays * _worthwhile(missing, alone / max(rays.sum(), 1))).astype(int)
    if more.any():
        found = _joined(found, _pooled(mixture, more, angle, (*key, 2), threads))
        missing = _missing(found, trial, error)
    for number in np.flatnonzero(missing):
        own = (*key, 3, int(number))
        exits, spent = _counted(stacks[number], error, angle, own, threads)
        found.light[number], found.squares[number] = exits / spent, exits / spent**2
        found.rays[number] += spent
        found.anew[number] = True
    return found


def _missing(found: Profiles, trial: tuple[np.ndarray, np.ndarray], error: float) -> np.ndarray:
    """Of the rays spent, how many more each state needs for its limit, (S,); 0 where none.

    Weights that go with distance can make the profile less sure than so many equal paths would.
    And where paths of others miss most of a state's light, their weights do not show it: its own
    trial, light (S,) and standard error (S,), does.
    """
    limit = needed_samples(found.subsurface, error)
    largest = np.maximum(found.standard_error.max(axis=1), 1e-9)
    reached = np.minimum(found.effective_sample_size, (0.5 / largest) ** 2)
    doubt = DOUBT * np.hypot(trial[1], found.subsurface_error)
    reached[trial[0] - found.subsurface > doubt] = 0.0
    needed = SPARE * limit / np.maximum(reached, 1e-6 * limit)
    return np.where(reached < limit, needed - 1.0, 0.0)


def _worthwhile(missing: np.ndarray, alone: np.ndarray) -> float:
    """Of the rays spent, how many more to share, and leave to themselves who need yet more.

    The fewest rays in all, where `alone` (S,) is what each state would need by itself.
    """
    choices = np.append(0.0, missing)
    costs = [each + alone[missing > each].sum() for each in choices]
    return float(choices[np.argmin(costs)])


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


@dataclass(frozen=True)
class _Mixture:
    """S states in one geometry, and the stacks in which paths are walked for them, one each.

    Attributes
    ----------
    walked : tuple of Stack
    columns : (C,) int array
        Of a path's sums, those that matter.
    proposed, wanted : (C, S) arrays
        `log_density` of the walked stacks and of the states, less that of the first walked one.
    scale : (S,) array
        Thickness of the states relative to that of the walked stacks.
    """

    walked: tuple[Stack, ...]
    columns: np.ndarray
    proposed: np.ndarray
    wanted: np.ndarray
    scale: np.ndarray

    @classmethod
    def of(cls, stacks: Sequence[Stack]) -> "_Mixture":
        """Of states of any thickness; paths are walked in the middle one's."""
        thickness = np.array([total_thickness(each) for each in stacks])
        middle = float(np.sort(thickness)[thickness.size // 2])
        states = [rescaled(each, middle) for each in stacks]
        walked = tuple(_lightened(each) for each in states)
        proposed, wanted = (
            np.array([log_density(each).ravel() for each in some]).T for some in (walked, states)
        )
        first = proposed[:, :1]
        proposed, wanted = proposed - first, wanted - first
        columns = np.flatnonzero(proposed.any(axis=1) | wanted.any(axis=1))
        return cls(walked, columns, proposed[columns], wanted[columns], thickness / middle)

    def densities(self, paths: Paths) -> tuple[np.ndarray, np.ndarray]:
        """Densities (N, S) of paths in the walked stacks and in the states, to a factor each."""
        sums = paths.table[:, self.columns]
        proposed, wanted = sums @ self.proposed, sums @ self.wanted
        largest = proposed.max(axis=1, keepdims=True)
        return np.exp(proposed - largest), np.exp(wanted - largest)


def _tried(
    mixture: _Mixture, angle: float, key: tuple[int, ...], threads: int | None
) -> tuple[np.ndarray, np.ndarray]:
    """Densities (N, S) of some paths in walked stacks and states, over that of being tried.

    As many rays are tried in every stack.
    """
    found: list[tuple[np.ndarray, np.ndarray]] = []
    for turn in range(PILOT_ROUNDS):
        keys = ((*key, turn, number) for number in range(len(mixture.walked)))

        def one(task: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
            return mixture.densities(recorded(mixture.walked[task[-1]], PILOT_RAYS, angle, task))

        found += in_order(one, keys, threads)
        if sum(each.shape[0] for each, _ in found) >= PILOT_PATHS:
            break
    proposed = np.concatenate([each for each, _ in found])
    wanted = np.concatenate([each for _, each in found])
    rounds = len(found) // len(mixture.walked)
    tried = rounds * PILOT_RAYS * proposed.sum(axis=1, keepdims=True)
    return proposed / tried, wanted / tried


def allocated(proposed: np.ndarray, wanted: np.ndarray, limit: np.ndarray) -> np.ndarray:
    """How many rays to spend in each of A walked stacks, (A,) int.

    With n_a rays in stack a, state s has, for each path of density p_s, the weight
    p_s / sum(n_a q_a), and an effective sample size that follows from the mean of its square. Its
    inverse is convex in n. Found are the fewest rays for which no state has less than its limit: by
    the multiplicative iteration of optimal design for n, and one of the same kind for how much
    each state has to say.

    Parameters
    ----------
    proposed, wanted : (N, A) and (N, S) arrays
        Densities of N tried paths in the walked stacks and in the states, each over the density
        of that path's being tried: their sums are shares of light.
    limit : (S,) array
        Effective sample sizes.
    """
    light = wanted.sum(axis=0)
    seen = light > 0.0
    if not seen.any():
        return np.zeros(proposed.shape[1], int)
    scaled = limit[seen] * (wanted[:, seen] / light[seen]) ** 2
    rays = np.full(proposed.shape[1], 1.0)
    say = np.full(scaled.shape[1], 1.0 / scaled.shape[1])
    for _ in range(STEPS):
        pooled = proposed @ rays
        needed = (1.0 / pooled) @ scaled
        say *= needed / needed.max()
        say /= say.sum()
        rays *= np.sqrt((scaled @ say / pooled**2) @ proposed)
        rays /= rays.sum()
    rays[rays < FEWEST] = 0.0
    needed = ((1.0 / np.maximum(proposed @ rays, LEAST)) @ scaled).max()
    return np.ceil(rays * min(needed, MOST_PER_PATH * rays.size * limit.max())).astype(int)


def _pooled(
    mixture: _Mixture, rays: np.ndarray, angle: float, key: tuple[int, ...], threads: int | None
) -> Profiles:
    """Profiles from so many rays in each walked stack; paths are weighted as they come."""
    tasks = (
        (mixture.walked[number], min(CHUNK, int(rays[number]) - first), (*key, number, first))
        for number in np.flatnonzero(rays)
        for first in range(0, int(rays[number]), CHUNK)
    )

    def piece(task):
        return _weighted(mixture, rays, recorded(task[0], task[1], angle, task[2]))

    total = np.zeros((2, mixture.scale.size, DISTANCE_EDGES.size))
    for each in in_order(piece, tasks, threads):
        total += each
    return Profiles(total[0], total[1], rays, np.zeros(rays.size, bool))


def _weighted(mixture: _Mixture, rays: np.ndarray, paths: Paths) -> np.ndarray:
    """Sums (2, S, B) of weights of paths, and of their squares, by exit distance."""
    total = np.zeros((2, mixture.scale.size, DISTANCE_EDGES.size))
    order = np.argsort(paths.distance, kind="stable")
    for first in range(0, order.size, BLOCK):
        some = order[first : first + BLOCK]
        block = replace(paths, distance=paths.distance[some], sums=paths.sums[some])
        proposed, wanted = mixture.densities(block)
        weight = wanted / (proposed @ rays)[:, None]
        starts = np.searchsorted(block.distance, DISTANCE_EDGES / mixture.scale[:, None])
        for row, each in zip(total, (weight, weight**2), strict=True):
            up_to = np.concatenate([np.zeros((1, mixture.scale.size)), np.cumsum(each, axis=0)])
            before = np.take_along_axis(up_to.T, starts, axis=1)
            row += np.diff(before, axis=1, append=up_to[-1][:, None])
    return total


def _counted(
    layers: Stack, error: float, angle: float, key: tuple[int, ...], threads: int | None
) -> tuple[np.ndarray, int]:
    """Exits (B,) of one stack's own rays, as many as it needs, and how many rays it took.

    Fewer where hardly any light comes out.
    """
    most = needed_samples(1.0, error)
    size = int(np.clip(most / PIECES**2, 256, CHUNK))

    def piece(first: int) -> np.ndarray:
        return count(layers, rays=size, angle=angle, key=(*key, first)).exits

    exits, spent = np.zeros(DISTANCE_EDGES.size, int), 0
    while spent < MOST_PER_PATH * most:
        firsts = range(spent, spent + PIECES * size, size)
        exits += sum(in_threads(piece, iter(firsts), thread_count(threads)))
        spent += PIECES * size
        if exits.sum() >= needed_samples(exits.sum() / spent, error):
            break
    return exits, spent


def _lightened(layers: Stack) -> Stack:
    """The stack with `LIGHTER` of its absorption."""
    return replace(
        layers,
        layers=tuple(
            replace(
                each,
                absorption=LIGHTER * each.absorption,
                survival=each.survival**LIGHTER if each.encounter > 0.0 else each.survival,
            )
            for each in layers.layers
        ),
    )


def _straightened(layers: Stack) -> Stack:
    """The stack with melanosomes that turn no light as absorbers, as they are for light then."""
    if layers.scattering_angle > 0.0:
        return layers
    by_diameter = layers.readings["complex_melanosomes"] == "diameter"

    def absorbing(layer: Layer) -> Layer:
        if layer.encounter == 0.0:
            return layer
        rate, once, twice = encounters(layer, layer.survival, by_diameter)
        lost = rate * (1.0 - once - twice)
        return replace(layer, absorption=layer.absorption + lost, encounter=0.0)

    return replace(layers, layers=tuple(absorbing(each) for each in layers.layers))
