"""Reflectance curves for the figures, without noise or by random walk."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from examples.figures.measured_people import People
from hylios.adding import solve
from hylios.skin.specimen import Specimen
from hylios.tissue import Model, Stack
from hylios.transport.melanosome_paths import with_survival
from hylios.transport.simulate import spectrum

RANGE = np.arange(250.0, 2501.0, 5.0)
"""The whole range of the thesis at its resolution of 5 nm, (451,)."""

THESIS_RAYS = 100_000
"""Rays per wavelength in the thesis (section 6.1.4)."""

BATCH = 64
"""Wavelengths of a curve without noise between two reports of progress."""

RAYS_AS_LONG = 1500
"""Rays that walk while a wavelength is solved without noise; only the time left follows from it."""

Tick = Callable[[float], object]
"""Called with the size of a piece of work when it has ended; see `Task`."""


@dataclass(frozen=True)
class Effort:
    """Rays per wavelength, seed, threads (all cores if None), and measured people, if any.

    `figures` are those to draw, all if there are none; groups of many pictures heed it.
    """

    rays: int = THESIS_RAYS
    seed: int = 1
    threads: int | None = None
    people: People | None = None
    figures: tuple[str, ...] = ()

    def wanted(self, figures: Sequence[str]) -> tuple[str, ...]:
        """Those of a group's figures that are to be drawn."""
        return tuple(name for name in figures if not self.figures or name in self.figures)


@dataclass(frozen=True)
class Curve:
    """Directional-hemispherical reflectance.

    Attributes
    ----------
    wavelengths, reflectance, standard_error : (W,) arrays; nm, 1, 1
    rays : int
        Per wavelength; 0 where the curve has no noise.
    """

    wavelengths: np.ndarray
    reflectance: np.ndarray
    standard_error: np.ndarray
    rays: int

    def within(self, first: float, last: float) -> np.ndarray:
        """Reflectance from `first` to `last` nm, both included."""
        return self.reflectance[(self.wavelengths >= first) & (self.wavelengths <= last)]


@dataclass(frozen=True)
class Task:
    """A function that computes something and reports its progress, and its size.

    The unit of size is the time of one wavelength of a curve without noise.
    """

    work: Callable[[Tick], object]
    size: float


def noisy(reflectance: np.ndarray, rays: int, seed: int) -> np.ndarray:
    """Reflectance as so many rays per wavelength would measure it: a ray returns or does not."""
    returned = np.random.default_rng(seed).binomial(rays, np.clip(reflectance, 0.0, 1.0))
    return returned / rays


def farthest(exact: Curve, walked: Curve) -> float:
    """Largest difference of a walked curve from one without noise, in its standard errors."""
    expected = np.interp(walked.wavelengths, exact.wavelengths, exact.reflectance)
    return float(np.max(np.abs(walked.reflectance - expected) / walked.standard_error))


def exact(stacks: Sequence[Stack], angle: float) -> np.ndarray:
    """Reflectance (W,) of stacks without noise, by adding their layers."""
    return solve([with_survival(stack) for stack in stacks], angle).total


def noise_free(
    specimen: Specimen,
    wavelengths: Iterable[float],
    angle: float,
    readings: Mapping[str, str] | None = None,
) -> Task:
    """A task that computes a curve without noise, with other readings of the thesis where given."""
    grid, model = np.asarray(wavelengths, dtype=float), Model(readings=readings or {})

    def work(tick: Tick) -> Curve:
        parts = []
        for part in np.split(grid, range(BATCH, grid.size, BATCH)):
            parts.append(
                exact([Stack.of(specimen, wavelength, model) for wavelength in part], angle)
            )
            tick(part.size)
        return Curve(grid, np.concatenate(parts), np.zeros(grid.size), 0)

    return Task(work, grid.size)


def walked(
    specimen: Specimen,
    wavelengths: Iterable[float],
    angle: float,
    effort: Effort,
) -> Task:
    """A task that computes a curve by random walk."""
    grid = np.asarray(wavelengths, dtype=float)

    def work(tick: Tick) -> Curve:
        light = spectrum(
            specimen,
            grid,
            angle=angle,
            rays=effort.rays,
            seed=effort.seed,
            threads=effort.threads,
            progress=lambda rays: tick(rays / RAYS_AS_LONG),
        )
        return Curve(grid, light.total, light.standard_error, effort.rays)

    return Task(work, grid.size * effort.rays / RAYS_AS_LONG)
