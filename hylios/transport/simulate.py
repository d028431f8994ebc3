"""Light transport as arrays: rays through a stack, spectra and exit distances of a specimen."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.errors import require_range, require_whole
from hylios.skin.specimen import Specimen
from hylios.spectra import require_wavelengths
from hylios.threads import in_threads, thread_count
from hylios.tissue import ABSORBERS, PARTS, Model, Stack, absorbers
from hylios.transport.events import SUBSURFACE, SURFACE, TRANSMITTED
from hylios.transport.generator import stream
from hylios.transport.kernels import (
    count_as_printed,
    count_equivalent,
    trace_as_printed,
    trace_equivalent,
)
from hylios.transport.melanosome_paths import with_survival
from hylios.transport.stack_arrays import kernel_arguments

CHUNK = 16384
"""Rays of one stream of random numbers; fixed, so that results do not depend on the threads."""

MOST_RAYS = 10**10

DISTANCE_EDGES = np.concatenate([[0.0], np.geomspace(1e-3, 100.0, 161)])
"""Edges in mm of the bins in which exit distances are counted; the last bin is open."""

NO_END = "a ray found no end: the stack neither absorbs light nor lets it out"


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


def trace(
    stack: Stack,
    *,
    rays: int,
    angle: float = 0.0,
    key: tuple[int, ...] = (1,),
    as_printed: bool = False,
) -> Rays:
    """Trace rays through a stack, all at one place and angle of incidence.

    Parameters
    ----------
    rays : int
        At least 1.
    angle : float
        Of incidence, in degrees, 0 to 89.99.
    key : tuple of int
        Seed and whatever else names this stream of random numbers.
    as_printed : bool
        As in `spectrum`.

    Raises
    ------
    InputError
        If the angle or the number of rays is out of range.
    RuntimeError
        If a ray was lost: no way out and nothing that absorbs.
    """
    rays = require_whole("number of rays", rays, 1, MOST_RAYS)
    arrival = arrival_along(angle)
    outcome, layer = np.empty(rays, np.int8), np.empty(rays, np.int8)
    place, direction = np.empty((rays, 2)), np.empty((rays, 3))
    walk = trace_as_printed if as_printed else trace_equivalent
    arguments = kernel_arguments(ready_to_walk(stack, as_printed))
    if not walk(*arguments, *arrival, stream(*key), outcome, layer, place, direction):
        raise RuntimeError(NO_END)
    return Rays(outcome, layer, place, direction)


def ready_to_walk(stack: Stack, as_printed: bool = False) -> Stack:
    """The stack with survival in melanosomes tabulated, where the way of walking needs it."""
    missing = any(layer.encounter > 0.0 and layer.survival < 0.0 for layer in stack.layers)
    return with_survival(stack) if missing and not as_printed else stack


def arrival_along(angle: float) -> tuple[float, float]:
    """Sine and cosine of an angle of incidence in degrees."""
    require_range("angle of incidence", angle, 0.0, 89.99, "degrees")
    return float(np.sin(np.radians(angle))), float(np.cos(np.radians(angle)))


@dataclass(frozen=True)
class Counts:
    """How many rays ended how, each counted where it ended.

    Attributes
    ----------
    left : (3,) int array
        Reflected by the surface, come back from below it, and gone through the lower face.
    absorbed : (2, L) int array
        Absorbed by each layer's absorbers and in its melanosomes.
    exits : (len(DISTANCE_EDGES),) int array
        Those come back, by distance between entry and exit: bin i starts at DISTANCE_EDGES[i].
    """

    left: np.ndarray
    absorbed: np.ndarray
    exits: np.ndarray

    @classmethod
    def none(cls, layers: int) -> "Counts":
        """Counts of no rays through so many layers."""
        return cls(
            np.zeros(3, np.int64),
            np.zeros((2, layers), np.int64),
            np.zeros(DISTANCE_EDGES.size, np.int64),
        )

    @property
    def arrays(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """`left`, `absorbed` and `exits`."""
        return self.left, self.absorbed, self.exits

    @property
    def rays(self) -> int:
        """All that were counted."""
        return int(self.left.sum() + self.absorbed.sum())

    def __add__(self, other: "Counts") -> "Counts":
        return Counts(
            self.left + other.left, self.absorbed + other.absorbed, self.exits + other.exits
        )


def count(
    stack: Stack,
    *,
    rays: int,
    angle: float = 0.0,
    key: tuple[int, ...] = (1,),
    as_printed: bool = False,
) -> Counts:
    """Count how rays through a stack end: those that `trace` gives one by one.

    Parameters and errors as in `trace`.
    """
    rays = require_whole("number of rays", rays, 1, MOST_RAYS)
    arrival = arrival_along(angle)
    ends = Counts.none(len(stack.layers))
    walk = count_as_printed if as_printed else count_equivalent
    arguments = kernel_arguments(ready_to_walk(stack, as_printed))
    edges = 0.1 * DISTANCE_EDGES
    if not walk(*arguments, *arrival, stream(*key), rays, edges, *ends.arrays):
        raise RuntimeError(NO_END)
    return ends


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
    transmittance : (W,) array
        Share that leaves below and that the hypodermis swallows; none where its reflectance is 1.
    absorbed, absorbed_in_melanosomes : (W, L) arrays
        Share that ends in each layer's absorbers and in its melanosomes, counted there. Layers
        are those of `hylios.tissue.PARTS`.
    absorber_shares : (W, L, A) array
        Of each layer's absorption coefficient, the share of each of `hylios.tissue.ABSORBERS`.
    exit_counts : (W, len(DISTANCE_EDGES)) int array
        Subsurface rays by distance between entry and exit: bin i starts at DISTANCE_EDGES[i].
    """

    wavelengths: NDArray[np.float64]
    rays: int
    surface: NDArray[np.float64]
    subsurface: NDArray[np.float64]
    transmittance: NDArray[np.float64]
    absorbed: NDArray[np.float64]
    absorbed_in_melanosomes: NDArray[np.float64]
    absorber_shares: NDArray[np.float64]
    exit_counts: NDArray[np.float64]

    @property
    def total(self) -> NDArray[np.float64]:
        """Reflectance, (W,)."""
        return self.surface + self.subsurface

    @property
    def absorptance(self) -> NDArray[np.float64]:
        """Share of the light that is absorbed, also in the hypodermis, (W,); counted itself."""
        return self.transmittance + (self.absorbed + self.absorbed_in_melanosomes).sum(axis=1)

    @property
    def absorbed_by(self) -> NDArray[np.float64]:
        """Share of the light that ends in each layer's absorbers, one by one, (W, L, A).

        What a layer's absorbers take together is counted; which of them took a ray depends on
        nothing but their coefficients, so it is split by these, exactly: to draw the absorber
        would only add noise.
        """
        return self.absorbed[:, :, None] * self.absorber_shares

    @property
    def standard_error(self) -> NDArray[np.float64]:
        """Standard error of the reflectance, (W,); not 0 where no ray came back (`share_error`)."""
        return share_error(self.total * self.rays, self.rays)


def share_error(counts: NDArray[np.float64], rays: int) -> NDArray[np.float64]:
    """Standard error of counts / rays: binomial, with one more ray of either fate.

    So it is not 0 where no ray, or every ray, was counted (Laplace's rule of succession).
    """
    share = (counts + 1.0) / (rays + 2.0)
    return np.sqrt(share * (1.0 - share) / rays)


Progress = Callable[[int], object]
"""A function that is told how many rays a piece of work had, as it ends."""


def spectrum(
    specimen: Specimen,
    wavelengths: Iterable[float],
    *,
    angle: float = 8.0,
    rays: int = 100_000,
    seed: int = 1,
    threads: int | None = None,
    model: Model | None = None,
    as_printed: bool = False,
    progress: Progress | None = None,
) -> Spectrum:
    """Simulate a specimen's spectrum by random walk.

    A wavelength's result depends on the seed, the rays and itself, not on the other wavelengths or
    on the number of threads.

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
    model : Model, optional
        Spectra and readings, the project's own by default.
    as_printed : bool
        Walk as the thesis prints it (`hylios.transport.printed`): the same model, slower than
        without waste (`hylios.transport.equivalent`, which says how nearly the same).

    Raises
    ------
    InputError
        If a wavelength, the angle or the number of rays is out of range.

    Examples
    --------
    >>> import hylios
    >>> spectrum = hylios.walk_spectrum(hylios.specimen("S3"), [550], rays=1000, seed=1)
    >>> print(f"{spectrum.total[0]:.2f} +- {spectrum.standard_error[0]:.2f}")
    0.31 +- 0.01
    """
    model = model or Model()
    wavelengths = require_wavelengths(wavelengths, model.spectra)
    rays = require_whole("number of rays", rays, 1, MOST_RAYS)
    seed = require_whole("seed", seed, 0, 2**63)
    stacks = [
        ready_to_walk(Stack.of(specimen, wavelength, model), as_printed)
        for wavelength in wavelengths
    ]

    def piece(row: int, first: int) -> Counts:
        size, key = min(CHUNK, rays - first), (seed, round(wavelengths[row] * 1000), first)
        return count(stacks[row], rays=size, angle=angle, key=key, as_printed=as_printed)

    counts = _counted(piece, len(stacks), rays, thread_count(threads), progress)
    return _of_counts(wavelengths, rays, counts, _absorber_shares(specimen, wavelengths, model))


def _counted(
    piece: Callable[[int, int], Counts],
    rows: int,
    rays: int,
    threads: int,
    progress: Progress | None,
) -> list[Counts]:
    """Counts of each row's rays, from pieces that begin at a ray."""
    counts = [Counts.none(len(PARTS)) for _ in range(rows)]
    tasks = ((row, first) for row in range(rows) for first in range(0, rays, CHUNK))
    for row, counted in in_threads(lambda task: (task[0], piece(*task)), tasks, threads):
        counts[row] += counted
        if progress:
            progress(counted.rays)
    return counts


def _of_counts(
    wavelengths: np.ndarray, rays: int, counts: list[Counts], absorber_shares: np.ndarray
) -> Spectrum:
    left = np.array([ends.left for ends in counts]) / rays
    absorbed = np.array([ends.absorbed for ends in counts]) / rays
    return Spectrum(
        wavelengths=wavelengths,
        rays=rays,
        surface=left[:, SURFACE],
        subsurface=left[:, SUBSURFACE],
        transmittance=left[:, TRANSMITTED],
        absorbed=absorbed[:, 0],
        absorbed_in_melanosomes=absorbed[:, 1],
        absorber_shares=absorber_shares,
        exit_counts=np.array([ends.exits for ends in counts]),
    )


def _absorber_shares(specimen: Specimen, wavelengths: np.ndarray, model: Model) -> np.ndarray:
    """Shares (W, L, A) that absorbers have in a layer's absorption; 0 where nothing absorbs."""
    coefficients = absorbers(specimen, wavelengths, model=model)
    none = np.zeros(wavelengths.size)
    table = np.array([[coefficients[part].get(name, none) for name in ABSORBERS] for part in PARTS])
    table = np.moveaxis(table, -1, 0)
    whole = table.sum(axis=-1, keepdims=True)
    return np.divide(table, whole, out=np.zeros_like(table), where=whole > 0)
