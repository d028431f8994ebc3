"""What a simplification costs in colour and buys in time."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from examples.simplifications.light import (
    ANGLE,
    GRID,
    noise,
    reflectances,
    seconds,
    stacks,
    walk_seconds,
)
from examples.simplifications.skins import measured
from examples.simplifications.variants import Variant, whole
from hylios.lab import colour
from hylios.quadrature import Quadrature
from hylios.skin.specimen import SPECIMENS, Specimen

EVEN = np.arange(400.0, 701.0, 5.0)
"""Wavelengths of the full model, nm."""

COARSE = EVEN[::4]
"""Wavelengths at which variants of the model are timed."""

RAYS = 100_000
"""Per wavelength, for the column of noise."""

DRAWS = 20
"""Repeated simulations of a skin, with other random numbers."""

Progress = Callable[[], object]
"""Called when a piece of work has ended."""


@dataclass(frozen=True)
class Effort:
    """How much is walked to measure times.

    `rays` per skin and wavelength of a variant; `rounds` of the same work, of which the least time
    counts: that which other work on the machine disturbed least.
    """

    rays: int = 1500
    rounds: int = 7


@dataclass(frozen=True)
class Truth:
    """Skins and their colours by the full model without noise.

    Attributes
    ----------
    skins : list of S Specimen
        S1 to S4, then their tans.
    reflectance : (S, len(GRID)) array
    colours : (S, 3) array, linear Rec.709
    """

    skins: list[Specimen]
    reflectance: np.ndarray
    colours: np.ndarray

    def differences(self, colours: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """CIEDE2000 of other colours (..., S, 3) on S1 to S4 (..., 4), and on the tans."""
        apart = colour.difference(np.broadcast_to(self.colours, colours.shape), colours)
        return apart[..., : len(SPECIMENS)], apart[..., len(SPECIMENS) :]

    def at(self, wavelengths: np.ndarray) -> np.ndarray:
        """Reflectance (S, W) at some wavelengths of `GRID`."""
        return self.reflectance[:, np.searchsorted(GRID, wavelengths)]


@dataclass(frozen=True)
class Case:
    """A variant of the model, and the angle of incidence in degrees."""

    what: str
    variant: Variant
    angle: float = ANGLE


@dataclass(frozen=True)
class Row:
    """A simplification: CIEDE2000 on S1 to S4 and on their tans, noise, relative times.

    `noise` is root mean square CIEDE2000 with `RAYS` rays per wavelength; `walk` the time of the
    random walk with as many rays per wavelength, `walk_same_noise` with as many as give the full
    model's noise, `solver` that of the solver without noise; None where there is none.
    """

    what: str
    specimens: np.ndarray
    tans: np.ndarray
    noise: float | None
    walk: float | None
    walk_same_noise: float | None
    solver: float | None


def truth() -> Truth:
    """The full model on every skin."""
    specimens, tans = measured()
    skins = [*specimens, *tans]
    reflectance = reflectances(skins, GRID, whole)
    return Truth(skins, reflectance, colour.linear_rec709(GRID, reflectance))


def even(step: int) -> Quadrature:
    """One wavelength in `step` of the full model's, and its weights."""
    return Quadrature(EVEN[::step], colour.rec709_weights(EVEN[::step]))


def wavelength_rows(
    truth: Truth,
    choices: Sequence[tuple[str, Quadrature]],
    effort: Effort,
    progress: Progress,
) -> list[Row]:
    """Rows of choices of wavelengths out of `EVEN`, all of which are the first choice."""
    timed = list(SPECIMENS.values())
    layers = stacks(timed, EVEN, whole)
    rounds = []
    for _ in range(effort.rounds):
        rounds.append(walk_seconds(layers, effort.rays // 3))
        progress()
    walked = np.min(rounds, axis=0).reshape(len(timed), -1)
    cases = [(whole, quadrature.wavelengths, ANGLE) for _, quadrature in choices]
    solver = _solver_seconds(timed, cases, effort.rounds)
    progress()
    rows = []
    for (what, quadrature), solving in zip(choices, solver / solver[0], strict=True):
        walk = walked[:, np.searchsorted(EVEN, quadrature.wavelengths)].sum(axis=1)
        relative = float(np.mean(walk / walked.sum(axis=1)))
        reflectance = truth.at(quadrature.wavelengths)
        chance = noise(quadrature.weights, reflectance, truth.colours, RAYS)
        more = (chance / _full_noise(truth)) ** 2
        differences = truth.differences(reflectance @ quadrature.weights.T)
        rows.append(Row(what, *differences, chance, relative, relative * more, float(solving)))
    return rows


def gauss_rows(truth: Truth, choices: Sequence[tuple[str, Quadrature]]) -> list[Row]:
    """Rows of wavelengths between those of `GRID`, which reflectance is interpolated to."""
    rows = []
    for what, quadrature in choices:
        reflectance = np.array(
            [np.interp(quadrature.wavelengths, GRID, r) for r in truth.reflectance]
        )
        chance = noise(quadrature.weights, reflectance, truth.colours, RAYS)
        differences = truth.differences(reflectance @ quadrature.weights.T)
        rows.append(Row(what, *differences, chance, None, None, None))
    return rows


def variant_rows(
    truth: Truth, cases: Sequence[Case], effort: Effort, progress: Progress
) -> list[Row]:
    """Rows of variants of the model; times are relative to the model as it is."""
    everything = [Case("", whole), *cases]
    timed = list(SPECIMENS.values())
    layers = [stacks(timed, COARSE, case.variant) for case in everything]
    rounds = []
    for _ in range(effort.rounds):
        pairs = zip(everything, layers, strict=True)
        rounds.append([walk_seconds(some, effort.rays, case.angle) for case, some in pairs])
        progress()
    walk = np.min(rounds, axis=0).reshape(len(everything), len(timed), -1).sum(axis=-1)
    relative = (walk / walk[0]).mean(axis=1)
    work = [(case.variant, COARSE, case.angle) for case in everything]
    solver = _solver_seconds(timed, work, effort.rounds)
    weights = colour.rec709_weights(GRID)
    rows = []
    for case, walking, solving in zip(cases, relative[1:], solver[1:] / solver[0], strict=True):
        reflectance = reflectances(truth.skins, GRID, case.variant, case.angle)
        progress()
        seen = reflectance[:, np.searchsorted(GRID, EVEN)]
        chance = noise(colour.rec709_weights(EVEN), seen, truth.colours, RAYS)
        more = (chance / _full_noise(truth)) ** 2
        differences = truth.differences(reflectance @ weights.T)
        rows.append(Row(case.what, *differences, chance, walking, walking * more, float(solving)))
    return rows


def ray_rows(truth: Truth, counts: Sequence[int]) -> list[Row]:
    """Rows of simulations with fewer rays per wavelength: their chance is drawn, not walked.

    How many rays of N come back is binomial; the walk only says with which probability.
    """
    random = np.random.default_rng(1)
    weights = colour.rec709_weights(EVEN)
    reflectance = truth.at(EVEN)
    rows = []
    for rays in counts:
        drawn = random.binomial(rays, reflectance, (DRAWS, *reflectance.shape)) / rays
        chance = noise(weights, reflectance, truth.colours, rays)
        differences = truth.differences(drawn @ weights.T)
        what = f"{rays:,} rays per wavelength"
        rows.append(Row(what, *differences, chance, rays / RAYS, 1.0, None))
    return rows


def solver_over_walk(effort: Effort) -> float:
    """Time of the solver without noise relative to the walk's with `RAYS` rays per wavelength."""
    skins = list(SPECIMENS.values())
    layers = stacks(skins, COARSE, whole)
    rounds = [walk_seconds(layers, effort.rays) for _ in range(effort.rounds)]
    walk = np.min(rounds, axis=0).sum() / effort.rays * RAYS
    (solver,) = _solver_seconds(skins, [(whole, COARSE, ANGLE)], effort.rounds)
    return float(solver / walk)


def walked_difference(truth: Truth, light: np.ndarray) -> float:
    """Mean CIEDE2000 on S1 to S4 between the walk's reflectance (4, len(EVEN)) and the truth."""
    walked = colour.linear_rec709(EVEN, light)
    return float(colour.difference(truth.colours[: len(light)], walked).mean())


def _full_noise(truth: Truth) -> float:
    return noise(colour.rec709_weights(EVEN), truth.at(EVEN), truth.colours, RAYS)


def _solver_seconds(
    skins: Sequence[Specimen],
    work: Sequence[tuple[Variant, np.ndarray, float]],
    rounds: int,
) -> np.ndarray:
    """Least processor time of the solver without noise for each piece of work.

    Making the layers counts; a first round, in which it prepares what all skins share, does not.
    """
    times = [
        [seconds(lambda case=case: reflectances(skins, case[1], case[0], case[2])) for case in work]
        for _ in range(rounds + 1)
    ]
    return np.min(times[1:], axis=0)
