"""Where a skin stands by day at points of several masks: a mean and a few shapes over time.

A point gets a share of the doses of every mask. Its coordinates (u, v, b; see `history`) are

    c(point, day) = mean(day) + sum of a_k(point) phi_k(day),  k = 1 to the rank

so a small image holds the mean and the phi_k, and either a mesh the coefficients a_k, four to a
colour attribute, or another image, over the shares themselves (`grid`). Attributes are interpolated
across a face; a tan then runs straight from one point to the next, where the model has jumps.

What a shader computes, for red, green and blue, which are u, v and b:

1. `day` to the place of a row: y is the green of `places`, sampled linearly at
   x = (.5 + (STEPS) (day - first_day) / (last_day - first_day)) / (STEPS + 1), y = .5;
   the images hold their edge.
2. the mean: `rows` sampled at x = .5 / (rank + 1) and that y.
3. for every k: plus a_k times `rows` sampled at x = (k + .5) / (rank + 1) and that y. Of a mesh a_1
   to a_4 are red, green, blue and alpha of the first attribute, and so on.

`shown` is the same in numpy.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, as_numbers
from hylios.sun.doses import Doses
from hylios.tanning import Burns, ErythemaDynamics, Exposures, Kinetics
from hylios.tanning.shares import Energies, retained

from .darkening import Uva
from .days import STEPS, darkened_coordinates, hours_to_simulate, states_seen, texel_places
from .distinct import distinct
from .principal import Shapes, principal_shapes

MOST_MASKS = 8

RANKS = (4, 8, 12, 16)
"""Numbers of coefficients that a point may have: they come four to an attribute."""

WEIGHTS = np.array([1.0, 0.35, 0.7], np.float32)
"""What errors of u, v and b mean for what is seen."""

WANTED = {"mean": 0.003, "at 99 %": 0.017, "most": 0.039}
"""Errors of u with which a rank is enough. An error of .01 is .03 to .19 CIEDE2000, so these are
.05, .3 and .7 where it is seen best."""

TRAINING, WORST = 1024, 256
"""Points that decide the shapes, and how many bad ones are added."""

CHUNK = 256
"""Points that are simulated at once; of more the numbers do not fit near the processor."""


@dataclass(frozen=True)
class BasisPrecision:
    """How closely a basis is computed.

    Attributes
    ----------
    levels, most : int
        Of `distinct`.
    rows : int
        Most hours.
    rounds : int
        Of `principal_shapes`.
    ranks : tuple of int
        Of which the least that is enough is taken, or else the last.
    """

    levels: int
    most: int
    rows: int
    rounds: int
    ranks: tuple[int, ...] = RANKS


FULL = BasisPrecision(127, 60_000, 128, 4)
"""For what stays in a file."""

DRAG = BasisPrecision(6, 6_000, 80, 1, ranks=(12,))
"""For a picture while somebody changes a setting."""


@dataclass(frozen=True, eq=False)
class Basis:
    """Coordinates of a skin over days at points with shares of several masks.

    Attributes
    ----------
    differing : (U, rank) float32 array
        Coefficients of points that differ.
    point : (N,) int array
        Which of those a point has.
    rows : (T, 1 + rank, 3) float32 array
        u, v and b of the mean, and of the shapes, by day; the first row is that of the first day.
    places : (1, STEPS + 1, 3) float32 array
        Over even steps of the days, in green: the place among the rows.
    weights : (M,) array
        Of the masks' shares in the share of all doses, for melanin.
    error : float
        Largest error of u over points and rows, or what v's and b's mean for u.
    first_day, last_day : float
    """

    differing: NDArray[np.float32]
    point: NDArray[np.int_]
    rows: NDArray[np.float32]
    places: NDArray[np.float32]
    weights: NDArray[np.float64]
    error: float
    first_day: float
    last_day: float

    @property
    def rank(self) -> int:
        """Number of coefficients of a point."""
        return self.differing.shape[1]

    @property
    def coefficients(self) -> NDArray[np.float32]:
        """Of all points, (N, rank)."""
        return self.differing[self.point]


def shown(basis: Basis, coefficients: NDArray, days: NDArray) -> NDArray[np.float64]:
    """u, v and b (N, 3) that a shader shows with coefficients (N, rank) on days (N,)."""
    passed = (np.asarray(days) - basis.first_day) / (basis.last_day - basis.first_day)
    steps = np.arange(basis.places.shape[1])
    row = np.interp(passed * steps[-1], steps, basis.places[0, :, 1]) * len(basis.rows) - 0.5
    below = np.clip(row.astype(int), 0, max(len(basis.rows) - 2, 0))
    above = np.minimum(below + 1, len(basis.rows) - 1)
    part = np.clip(row - below, 0.0, 1.0)[:, None, None]
    numbers = basis.rows[below] * (1.0 - part) + basis.rows[above] * part
    return numbers[:, 0] + np.einsum("nk,nkc->nc", coefficients, numbers[:, 1:])


def basis(
    received: Sequence[Doses],
    shares: ArrayLike,
    melanin: Kinetics,
    *,
    mmd: float,
    med: float,
    first_day: float,
    last_day: float,
    counts: NDArray[np.int_] | None = None,
    precision: BasisPrecision = FULL,
    erythema: ErythemaDynamics | None = None,
    darkens: bool = False,
) -> tuple[Basis, NDArray[np.floating]]:
    """Simulate points of several masks; the basis, and states that some lead through.

    Parameters
    ----------
    received : sequence of Doses
        On bare skin, by mask: at most `MOST_MASKS`.
    shares : (N, M) array
        0 to 1, of the doses of every mask.
    melanin, mmd, med, first_day, last_day, erythema, darkens
        As in `history`.
    counts : (N,) int array, optional
        How often the points are there.

    Raises
    ------
    InputError
        If there are too many masks, or shares, minimal doses or days are out of range.
    """
    given = _checked(shares, len(received))
    first, end = int(24.0 * first_day), int(np.ceil(24.0 * last_day))
    exposures = _of_masks(received)
    energies = retained(exposures, melanin, mmd=mmd, med=med, hours=end)
    told_apart = {"levels": precision.levels, "most": precision.most}
    vectors, often, point = distinct(given, energies, exposures.hours, counts=counts, **told_apart)
    few = np.append(vectors[:7], np.ones((1, len(received))), axis=0)
    burns = None if erythema is None else Burns.of(exposures, erythema, med)
    uva = Uva.of(received) if darkens else None
    rows = precision.rows
    marks = hours_to_simulate(energies, few, exposures, (first, end), rows, 3, burns, uva)
    curves, states = _simulated(energies, vectors, marks, first, (burns, uva))
    hours = marks[marks >= first]
    shapes, coefficients, error = _shapes(curves, often, precision)
    places = np.zeros((1, STEPS + 1, 3), np.float32)
    days = 24.0 * np.linspace(first_day, last_day, STEPS + 1)
    places[0, :, 1] = texel_places(days, hours, len(hours))
    rows = np.zeros((len(hours), 1 + coefficients.shape[1], 3), np.float32)
    lines = np.concatenate([shapes.mean[None], shapes.shapes])
    told = lines.shape[1] // len(hours)
    by_number = lines.reshape(len(lines), told, len(hours)).transpose(2, 0, 1)
    rows[..., :told] = by_number / WEIGHTS[:told]
    doses = exposures.doses.sum(axis=1)
    weights = doses / max(doses.sum(), 1e-30)
    return Basis(coefficients, point, rows, places, weights, error, first_day, last_day), states


def _checked(shares: ArrayLike, masks: int) -> NDArray[np.float64]:
    if not 1 <= masks <= MOST_MASKS:
        raise InputError(
            f"times in the sun have {masks} masks; allowed are 1 to {MOST_MASKS} different ones on "
            "a mesh."
        )
    given = as_numbers("shares", shares)
    if given.ndim != 2 or given.shape[1] != masks or not len(given):
        raise InputError(f"shares have shape {given.shape}; expected (points, {masks} masks).")
    if not np.all((given >= 0.0) & (given <= 1.0)):
        raise InputError("a share is out of range; allowed is 0 to 1.")
    return given


def _of_masks(received: Sequence[Doses]) -> Exposures:
    """The doses of all masks, a row for every mask (M, E)."""
    hours = np.concatenate([own.hours for own in received])
    ends = np.cumsum([own.hours.size for own in received])
    melanogenesis, thickening = np.zeros((2, len(received), hours.size))
    for mask, (own, end) in enumerate(zip(received, ends, strict=True)):
        those = slice(end - own.hours.size, end)
        melanogenesis[mask, those], thickening[mask, those] = own.melanogenesis, own.thickening
    return Exposures(hours, melanogenesis, thickening)


def _simulated(
    energies: Energies,
    vectors: NDArray[np.float64],
    marks: NDArray[np.int_],
    first: int,
    at_once: tuple[Burns | None, Uva | None],
) -> tuple[NDArray[np.float32], NDArray[np.floating]]:
    """u, v and where skin reddens b of points (U, 2 T or 3 T), as they count; states of some."""
    told, (burns, uva) = marks >= first, at_once
    numbers = 2 if burns is None else 3
    curves = np.empty((len(vectors), numbers, np.count_nonzero(told)), np.float32)
    kept = np.zeros(0)
    for start in range(0, len(vectors), CHUNK):
        part = vectors[start : start + CHUNK]
        states = states_seen(energies, part, marks, np.float32, burns)[told]
        seen = darkened_coordinates(states, uva, part, marks[told])[..., :numbers]
        seen *= WEIGHTS[:numbers]
        curves[start : start + CHUNK] = np.moveaxis(seen, (1, 2), (0, 1))
        kept = kept if start else states
    return curves.reshape(len(vectors), -1), kept


def _shapes(
    curves: NDArray[np.float32], counts: NDArray[np.float64], precision: BasisPrecision
) -> tuple[Shapes, NDArray[np.float32], float]:
    """Shapes of the least rank that is enough; coefficients (U, rank); the largest error."""
    those = np.arange(min(TRAINING, len(curves)))
    *first, last = precision.ranks
    for rank in first:
        shapes = _fitted(curves, counts, those, rank, precision)
        # What does not suffice for the curves it was fitted to does not for all.
        if _is_enough(_left(shapes, curves[those])[1], counts[those]):
            shapes, coefficients, errors = _of_all(shapes, curves, counts, precision)
            if _is_enough(errors, counts):
                return shapes, coefficients, float(errors.max())
    shapes = _fitted(curves, counts, those, last, precision)
    shapes, coefficients, errors = _of_all(shapes, curves, counts, precision)
    return shapes, coefficients, float(errors.max())


def _of_all(
    shapes: Shapes,
    curves: NDArray[np.float32],
    counts: NDArray[np.float64],
    precision: BasisPrecision,
) -> tuple[Shapes, NDArray[np.float32], NDArray[np.float32]]:
    """Shapes fitted once more with the worst curves; coefficients and errors of all."""
    coefficients, errors = _left(shapes, curves)
    worst = errors.max(axis=1)
    if worst.max() <= WANTED["most"] or len(curves) <= TRAINING:
        return shapes, coefficients, errors
    those = np.union1d(np.arange(TRAINING), np.argsort(-worst)[:WORST])
    shapes = _fitted(curves, counts, those, len(shapes.shapes), precision)
    return shapes, *_left(shapes, curves)


def _fitted(
    curves: NDArray[np.float32],
    counts: NDArray[np.float64],
    those: NDArray[np.int_],
    rank: int,
    precision: BasisPrecision,
) -> Shapes:
    """Shapes of some curves."""
    weights = np.asarray(counts[those] ** 0.25, float)
    return principal_shapes(curves[those], rank, weights, precision.rounds)


def _left(
    shapes: Shapes, curves: NDArray[np.float32]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Coefficients of curves, and the errors that are left."""
    coefficients = shapes.coefficients(curves)
    return coefficients, np.abs(shapes.curves(coefficients) - curves)


def _is_enough(errors: NDArray, counts: NDArray) -> bool:
    worst = errors.max(axis=1)
    mean = np.average(errors.mean(axis=1), weights=counts)
    order = np.argsort(worst)
    passed = np.cumsum(counts[order]) / counts.sum()
    usual = worst[order][np.searchsorted(passed, 0.99)]
    return bool(
        mean <= WANTED["mean"] and usual <= WANTED["at 99 %"] and worst.max() <= WANTED["most"]
    )
