"""A basis for a picture while somebody changes a setting: one day exactly, the others roughly.

Who drags looks at one frame. So the day of that frame has a part of the days for itself, in which
the coefficients are its coordinates; knots lie where they bend on that day. Of other days points
at few knots are simulated at few hours, and few shapes tell them.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hylios.sun.doses import Doses
from hylios.tanning import ErythemaDynamics, Kinetics

from .basis import (
    ROWS,
    SEED,
    Basis,
    BasisPrecision,
    knots_of,
    parts_of,
    put_together,
)
from .course import WEIGHTS, Course, course_of
from .days import STEPS
from .grid import counts_of_grid, shares_of_grid
from .principal import Shapes, principal_shapes
from .room import Room

DAY = BasisPrecision(16_000, 0.001, 64, 1, 96, 0, ranks=(6,))
"""Of the day that shows."""

OTHERS = BasisPrecision(2_000, 0.004, 32, 1, 144, 0, ranks=(6,))
"""Of the other days."""

ZONE = 2.0
"""Steps of the days on both sides of the one that shows for which it stands."""

NEITHER = 3
"""Parts that other days leave free: one for the day that shows, and two that they fill partly."""

SOME = 256
"""Points whose states are told."""


def day_basis(
    received: Sequence[Doses],
    melanin: Kinetics,
    day: float,
    room: Room,
    *,
    mmd: float,
    med: float,
    first_day: float,
    last_day: float,
    erythema: ErythemaDynamics | None = None,
    darkens: bool = False,
) -> tuple[Basis, NDArray[np.floating]]:
    """As `basis.basis`, exactly on one day alone.

    Parameters
    ----------
    day : float
        Where it is before the first or after the last one, that one is taken.
    room : Room
        In which it is shown: more than `NEITHER` parts.

    Raises
    ------
    InputError
        If minimal doses or days are out of range.
    """

    def course(days: tuple[float, float], rows: int) -> Course:
        return course_of(received, melanin, (mmd, med), days, rows, erythema, darkens=darkens)

    masks, random = len(received), np.random.default_rng(SEED)
    hour = 24.0 * min(max(day, first_day), last_day)
    shown = course((hour / 24.0, hour / 24.0), DAY.rows)
    precision = replace(DAY, points=min(DAY.points, room.points))
    knots = knots_of(shown, masks, precision, random)
    others = course((first_day, last_day), min(OTHERS.rows, ROWS * (room.parts - NEITHER)))
    few = knots_of(others, masks, OTHERS, random)
    shares = shares_of_grid(few)
    rank = min(room.rank, *OTHERS.ranks)
    around = ZONE * 24.0 * (last_day - first_day) / STEPS
    before = _hours(others.hours, hour - around, up_to=True)
    after = _hours(others.hours, hour + around, up_to=False)
    exact = _on(shown, shares_of_grid(knots), hour)
    curves, weights = others.seen(shares), counts_of_grid(shares) ** 0.25
    parts = [
        *_roughly(_at(others, curves, before), weights, rank),
        (_itself(shown.numbers, rank), np.pad(exact, ((0, 0), (0, rank - exact.shape[1])))),
        *_roughly(_at(others, curves, after), weights, rank),
    ]
    of_day = (len(before) - 1) // ROWS
    told = [
        own if number == of_day else _between_knots(own, few, knots)
        for number, (_, own) in enumerate(parts)
    ]
    within = np.linspace(before[-1], after[0], ROWS + 1)[1:-1]
    hours, shapes = np.concatenate([before, within, after]), [own for own, _ in parts]
    coefficients = np.pad(told, ((0, room.parts - len(told)), (0, 0), (0, 0)))
    made = put_together(others, hours, (first_day, last_day), knots, shapes, coefficients, 0.0)
    return made, others.states(shares[:: max(len(shares) // SOME, 1)])


def _hours(hours: NDArray[np.int_], end: float, *, up_to: bool) -> NDArray[np.float64]:
    """Some hours up to an end, or from it on, which fill whole parts."""
    inside = np.asarray(hours[hours < end] if up_to else hours[hours > end], float)
    if not inside.size:
        return np.array([end])
    more = -len(inside) % ROWS + 1
    if up_to:
        return np.append(inside, np.linspace(inside[-1], end, more + 1)[1:])
    return np.append(np.linspace(end, inside[0], more + 1)[:-1], inside)


def _itself(numbers: int, rank: int) -> Shapes:
    """Shapes whose first coefficients are the coordinates, on all days of a part."""
    by_number = np.eye(rank, numbers) * WEIGHTS[:numbers]
    shapes = np.repeat(by_number, ROWS + 1, axis=1)
    return Shapes(np.zeros(shapes.shape[1]), shapes, np.linalg.pinv(shapes))


def _on(course: Course, shares: NDArray[np.float64], hour: float) -> NDArray[np.float32]:
    """u, v and b (N, 3) of points with shares (N, M) at an hour, told by the hours around it."""
    told = np.zeros((len(shares), 3), np.float32)
    told[:, : course.numbers] = _at(course, course.seen(shares), np.array([hour]))[..., 0]
    told[:, : course.numbers] /= WEIGHTS[: course.numbers]
    return told


def _at(course: Course, curves: NDArray[np.float32], hours: NDArray) -> NDArray[np.float32]:
    """Curves (N, numbers, T) at some hours, straight between those that a course tells."""
    by_hour = _straight(course.hours, hours)
    return curves.reshape(len(curves), -1, len(by_hour)) @ by_hour


def _straight(places: NDArray, wanted: NDArray) -> NDArray[np.float32]:
    """Weights (P, W) of numbers at some places, straight from one to the next, at wanted ones."""
    return np.stack([np.interp(wanted, places, one) for one in np.eye(len(places))]).astype(
        np.float32
    )


def _roughly(
    curves: NDArray[np.float32], weights: NDArray[np.float64], rank: int
) -> list[tuple[Shapes, NDArray[np.float32]]]:
    """Shapes of the parts of some hours, and coefficients (N, rank) of curves (N, numbers, T)."""
    told = []
    for part in parts_of(curves) if curves.shape[2] > 1 else ():
        shapes = principal_shapes(part, rank, weights, 0)
        told.append((shapes, shapes.coefficients(part)))
    return told


def _between_knots(
    values: NDArray[np.float32],
    few: Sequence[NDArray[np.float64]],
    knots: Sequence[NDArray[np.float64]],
) -> NDArray[np.float32]:
    """Numbers (N, K) at all knots, of such (F, K) at few ones: straight from one to the next."""
    told = values.reshape(*map(len, few), -1)
    for axis, (own, wanted) in enumerate(zip(few, knots, strict=True)):
        told = np.moveaxis(np.tensordot(told, _straight(own, wanted), (axis, 0)), -1, axis)
    return told.reshape(-1, values.shape[1])
