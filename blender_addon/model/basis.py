"""Where a skin stands by day at points of several masks: a mean and a few shapes over time.

A point gets a share of the doses of every mask. Its coordinates (u, v, b; see `history`) are

    c(point, day) = mean(day) + sum of a_k(point) phi_k(day),  k = 1 to the rank

so a small image holds the mean and the phi_k, and others the coefficients a_k over the shares
(`grid`). A part of `ROWS` rows of days has its own shapes and coefficients, since a few tell all of
a few days; it begins with the row that ends the part before. There are as many parts whatever the
doses, so that their images keep their size; what is left over shows nothing.

What a shader computes, for red, green and blue, which are u, v and b, with T = ROWS P + 1 rows in P
parts:

1. `day` to the place of a row: y is the green of `places`, sampled linearly at
   x = (.5 + (STEPS) (day - first_day) / (last_day - first_day)) / (STEPS + 1), y = .5;
   the images hold their edge. The row is r = T y - .5.
2. the part p = floor(r / ROWS), P - 1 at most.
3. the mean: `rows` sampled at x = .5 / (rank + 1) and (r + p + .5) / (T + P - 1).
4. for every k: plus a_k of that part times `rows` sampled at x = (k + .5) / (rank + 1) there.

`shown` is the same in numpy.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError
from hylios.sun.doses import Doses
from hylios.tanning import ErythemaDynamics, Kinetics

from .course import WEIGHTS, Course, course_of
from .days import STEPS, texel_places
from .grid import counts_of_grid, knots_within, shares_of_grid
from .principal import Shapes, principal_shapes

MOST_MASKS = 8

ROWS = 16
"""From the first row of a part to the first one of the next."""

WANTED = {"mean": 0.002, "at 99 %": 0.01, "most": 0.03}
"""Errors of u with which a rank is enough. An error of .01 is .03 to .19 CIEDE2000, so these are
.03, .15 and .45 where it is seen best: as much again is left for what lies between knots."""

SAID = 0.05
"""An error of u that is said: no more than .7 CIEDE2000 is wanted."""

FINEST = 2.0**-9
"""Steps of coefficients, of which the largest are some 4: rounded so they take half the room in a
file, and the tan differs by .001 CIEDE2000."""

FREQUENT, TRAINING, WORST = 256, 1024, 256
"""Points that decide the shapes: the most frequent, all of those; and how many bad ones are added.
"""

SEED = 0


@dataclass(frozen=True)
class BasisPrecision:
    """How closely a basis is computed.

    Attributes
    ----------
    points : int
        Most points over the shares.
    tolerance : float
        Error of u between them that needs no more.
    steps : int
        Of a share, among which its knots are picked.
    others : int
        How many shares of the other masks are looked at then, beside none and all.
    rows : int
        Most hours.
    rounds : int
        Of `principal_shapes`.
    ranks : tuple of int
        Of which the least that is enough is taken, or else the last.
    """

    points: int
    tolerance: float
    steps: int
    others: int
    rows: int
    rounds: int
    ranks: tuple[int, ...]


FULL = BasisPrecision(30_000, 0.001, 256, 3, 192, 4, ranks=(3, 6, 9, 12))
"""For what stays in a file."""

DRAG = BasisPrecision(4_000, 0.004, 64, 1, 160, 1, ranks=(12,))
"""For a picture while somebody changes a setting."""


@dataclass(frozen=True, eq=False)
class Basis:
    """Coordinates of a skin over days and over the shares of several masks.

    Attributes
    ----------
    knots : tuple of (L,) arrays
        Of the share of every mask, from 0 to 1.
    coefficients : (P, N, rank) float32 array
        Of the parts, at all knots, as `shares_of_grid` has them.
    rows : (T + P - 1, 1 + rank, 3) float32 array
        Of all parts: u, v and b of the mean, and of the shapes, by day; the first row is that of
        the first day.
    places : (1, STEPS + 1, 3) float32 array
        Over even steps of the days, in green: the place among the rows.
    weights : (M,) array
        Of the masks' shares in the share of all doses, for melanin.
    error : float
        Largest error of u over points and rows, or what v's and b's mean for u.
    first_day, last_day : float
    """

    knots: tuple[NDArray[np.float64], ...]
    coefficients: NDArray[np.float32]
    rows: NDArray[np.float32]
    places: NDArray[np.float32]
    weights: NDArray[np.float64]
    error: float
    first_day: float
    last_day: float

    @property
    def rank(self) -> int:
        """Number of coefficients of a point."""
        return self.coefficients.shape[2]

    @property
    def parts(self) -> int:
        """Number of parts of the days."""
        return len(self.coefficients)


def rows_at(basis: Basis, days: NDArray) -> tuple[NDArray[np.float64], NDArray[np.int_]]:
    """The row of days (N,), and the part."""
    passed = (np.asarray(days) - basis.first_day) / (basis.last_day - basis.first_day)
    steps = np.arange(basis.places.shape[1])
    count = len(basis.rows) - basis.parts + 1
    row = np.interp(passed * steps[-1], steps, basis.places[0, :, 1]) * count - 0.5
    return row, np.clip((row // ROWS).astype(int), 0, basis.parts - 1)


def shown(basis: Basis, coefficients: NDArray, days: NDArray) -> NDArray[np.float64]:
    """u, v and b (N, 3) that a shader shows on days (N,), by their parts' coefficients (N, R)."""
    row, part = rows_at(basis, days)
    row = row + part
    below = np.clip(row.astype(int), 0, max(len(basis.rows) - 2, 0))
    above = np.minimum(below + 1, len(basis.rows) - 1)
    along = np.clip(row - below, 0.0, 1.0)[:, None, None]
    numbers = basis.rows[below] * (1.0 - along) + basis.rows[above] * along
    return numbers[:, 0] + np.einsum("nk,nkc->nc", coefficients, numbers[:, 1:])


def basis(
    received: Sequence[Doses],
    melanin: Kinetics,
    *,
    mmd: float,
    med: float,
    first_day: float,
    last_day: float,
    precision: BasisPrecision = FULL,
    erythema: ErythemaDynamics | None = None,
    darkens: bool = False,
) -> tuple[Basis, NDArray[np.floating]]:
    """Simulate points over the shares of several masks; the basis, and states that some lead to.

    Parameters
    ----------
    received : sequence of Doses
        On bare skin, by mask: at most `MOST_MASKS`.
    melanin, mmd, med, first_day, last_day, erythema, darkens
        As in `history`.

    Raises
    ------
    InputError
        If there are too many masks, or minimal doses or days are out of range.
    """
    masks = len(received)
    if not 1 <= masks <= MOST_MASKS:
        raise InputError(
            f"times in the sun have {masks} masks; allowed are 1 to {MOST_MASKS} different ones on "
            "a mesh."
        )
    random = np.random.default_rng(SEED)
    course = course_of(
        received,
        melanin,
        (mmd, med),
        (first_day, last_day),
        precision.rows,
        erythema,
        darkens=darkens,
    )
    knots = knots_of(course, masks, precision, random)
    shares = shares_of_grid(knots)
    counts = counts_of_grid(shares)
    order = np.argsort(-counts, kind="stable")
    often, others = order[:FREQUENT], order[FREQUENT:]
    training = np.append(often, random.permutation(others)[: TRAINING - FREQUENT])
    curves = course.seen(shares)
    parts = parts_of(curves.reshape(len(curves), -1, len(course.hours)))
    shapes, coefficients, error = _shapes(parts, counts, training, precision)
    given = np.zeros((-(-precision.rows // ROWS), *coefficients.shape[1:]), np.float32)
    given[: len(coefficients)] = FINEST * np.round(coefficients / FINEST)
    days = first_day, last_day
    made = put_together(course, course.hours, days, knots, shapes, given, error)
    return made, course.states(shares[often])


def put_together(
    course: Course,
    hours: NDArray,
    days: tuple[float, float],
    knots: tuple[NDArray[np.float64], ...],
    shapes: Sequence[Shapes],
    coefficients: NDArray[np.float32],
    error: float,
) -> Basis:
    """A basis of shapes of some parts, and coefficients (P, N, rank) of all.

    Parameters
    ----------
    hours : (T,) array
        Those of the rows.
    days : pair of float
        The first and the last.
    """
    parts, (first_day, last_day) = len(coefficients), days
    places = np.zeros((1, STEPS + 1, 3), np.float32)
    even = 24.0 * np.linspace(first_day, last_day, STEPS + 1)
    places[0, :, 1] = texel_places(even, hours, ROWS * parts + 1)
    doses = course.exposures.doses.sum(axis=1)
    weights = np.asarray(doses / max(doses.sum(), 1e-30), float)
    rows = _rows(shapes, course.numbers, parts)
    return Basis(knots, coefficients, rows, places, weights, error, first_day, last_day)


def knots_of(
    course: Course, masks: int, precision: BasisPrecision, random: np.random.Generator
) -> tuple[NDArray[np.float64], ...]:
    """Knots of the share of every mask, by how the tan bends over it beside others' shares."""
    across = np.linspace(0.0, 1.0, precision.steps + 1)
    beside = np.concatenate(
        [
            np.zeros((1, masks)),
            np.ones((1, masks)),
            random.integers(0, 2, (precision.others, masks)).astype(float),
        ]
    )
    lines = []
    for mask in range(masks):
        shares = np.repeat(beside[None], len(across), axis=0)
        shares[..., mask] = across[:, None]
        lines.append(course.seen(shares.reshape(-1, masks)).reshape(len(across), -1))
    return knots_within(across, lines, precision.points, precision.tolerance)


def parts_of(curves: NDArray[np.float32]) -> list[NDArray[np.float32]]:
    """Parts of the hours of curves (N, numbers, hours), as curves (N, numbers times hours)."""
    starts = range(0, max(curves.shape[2] - 1, 1), ROWS)
    return [curves[:, :, a : a + ROWS + 1].reshape(len(curves), -1) for a in starts]


def _rows(shapes: Sequence[Shapes], numbers: int, parts: int) -> NDArray[np.float32]:
    """The means and shapes (T + P - 1, 1 + rank, 3) of so many parts, of as many numbers."""
    rows = np.zeros((parts, ROWS + 1, 1 + len(shapes[0].shapes), 3), np.float32)
    for part, own in zip(rows, shapes, strict=False):
        lines = np.concatenate([own.mean[None], own.shapes])
        told = lines.reshape(len(lines), numbers, -1).transpose(2, 0, 1) / WEIGHTS[:numbers]
        part[: len(told), :, :numbers] = told
        part[len(told) :] = part[len(told) - 1]
    return rows.reshape(-1, *rows.shape[2:])


def _shapes(
    parts: list[NDArray[np.float32]],
    counts: NDArray[np.float64],
    those: NDArray[np.int_],
    precision: BasisPrecision,
) -> tuple[list[Shapes], NDArray[np.float32], float]:
    """Shapes of parts of the least rank that is enough; coefficients (P, N, rank); the largest
    error.

    Parameters
    ----------
    those : int array
        Points that decide the shapes.
    """
    *first, last = precision.ranks
    for rank in first:
        shapes = [_fitted(own, counts, those, rank, precision) for own in parts]
        # What does not suffice for the curves it was fitted to does not for all.
        left = [_left(own, curves[those])[1] for own, curves in zip(shapes, parts, strict=True)]
        if _is_enough(left, counts[those]):
            shapes, coefficients, errors = _of_all(shapes, parts, counts, those, precision)
            if _is_enough(errors, counts):
                return shapes, coefficients, float(max(own.max() for own in errors))
    shapes = [_fitted(own, counts, those, last, precision) for own in parts]
    shapes, coefficients, errors = _of_all(shapes, parts, counts, those, precision)
    return shapes, coefficients, float(max(own.max() for own in errors))


def _of_all(
    shapes: list[Shapes],
    parts: list[NDArray[np.float32]],
    counts: NDArray[np.float64],
    those: NDArray[np.int_],
    precision: BasisPrecision,
) -> tuple[list[Shapes], NDArray[np.float32], list[NDArray[np.float32]]]:
    """Shapes fitted once more with the worst curves; coefficients and errors of all."""
    fitted, coefficients, errors = [], [], []
    for own, curves in zip(shapes, parts, strict=True):
        best, (given, left) = own, _left(own, curves)
        worst = left.max(axis=1)
        if worst.max() > WANTED["most"] and len(curves) > len(those):
            harder = np.union1d(those, np.argsort(-worst)[:WORST])
            best = _fitted(curves, counts, harder, len(own.shapes), precision)
            given, left = _left(best, curves)
        fitted.append(best)
        coefficients.append(given)
        errors.append(left)
    return fitted, np.stack(coefficients), errors


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


def _is_enough(errors: Sequence[NDArray], counts: NDArray) -> bool:
    """Whether errors (N, K) of parts are small enough for points that count so much."""
    worst = np.max([own.max(axis=1) for own in errors], axis=0)
    means = np.mean([own.mean(axis=1) for own in errors], axis=0)
    order = np.argsort(worst)
    passed = np.cumsum(counts[order]) / counts.sum()
    usual = worst[order][np.searchsorted(passed, 0.99)]
    return bool(
        np.average(means, weights=counts) <= WANTED["mean"]
        and usual <= WANTED["at 99 %"]
        and worst.max() <= WANTED["most"]
    )
