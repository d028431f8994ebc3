"""Places of several masks against simulating every place by the hour."""

from dataclasses import replace

import numpy as np
import pytest
from sampled import looked_up

from blender_addon.model import catalogue
from blender_addon.model.basis import DRAG, FULL, MOST_MASKS, basis, rows_at, shown
from blender_addon.model.grid import (
    coefficients_at,
    images_of,
    knots_within,
    places_among,
    shares_of_grid,
)
from blender_addon.model.look import look
from blender_addon.model.response import response_of
from hylios.colour_difference import ciede2000, lab
from hylios.errors import InputError
from hylios.skin import whole_thickening
from hylios.sun.doses import joined, of_sed
from hylios.table import MinimalDoses
from hylios.tanning import Exposures, states_at

SKIN = {"mmd": 4.9, "med": 2.9}
TABLE = catalogue.table(catalogue.shipped_path("III"))
LOOK = look(TABLE, MinimalDoses(**SKIN))
THESIS, MEASURED = response_of(TABLE), response_of(TABLE, "measured", redness=True)

ERRORS = {"mean": 0.05, "at 99 %": 0.3, "most": 0.7}
"""CIEDE2000."""

FEW = replace(FULL, points=3000, steps=64)
"""For what is right with any number of points."""


def doses(random, masks: int, days: float, count: int = 4):
    return [
        joined(
            [
                of_sed(int(hour), float(random.uniform(2.0, 50.0)))
                for hour in random.integers(0, int(20 * days), count)
            ]
        )
        for _ in range(masks)
    ]


def points(random, count: int, masks: int) -> np.ndarray:
    """Bare or covered by any mask; a third are in the soft edge of one."""
    shares = (random.random((count, masks)) < 0.5).astype(float)
    soft = np.flatnonzero(random.random(count) < 0.33)
    shares[soft, random.integers(0, masks, soft.size)] = random.random(soft.size)
    return shares


def in_faces(random, count: int, masks: int) -> np.ndarray:
    """In faces at whose corners up to two masks differ, which one edge of a mask crosses."""
    corners = np.repeat(points(random, count, masks)[None], 3, axis=0)
    for mask in random.integers(0, masks, (2, count)):
        corners[1:, np.arange(count), mask] = random.integers(0, 2, (2, count))
    inside = np.einsum("cnm,nc->nm", corners, random.dirichlet(np.ones(3), count))
    return np.clip(inside, 0.0, 1.0)


def simulated(received, shares, hours, response=THESIS) -> np.ndarray:
    """u, v and b (N, 3), of one place after another."""
    when = np.concatenate([own.hours for own in received])
    mask = np.repeat(np.arange(len(received)), [own.hours.size for own in received])
    whole, thickening = (
        np.concatenate([getattr(own, name) for own in received])
        for name in ("melanogenesis", "thickening")
    )
    times, which = np.unique(hours, return_inverse=True)
    exposures = Exposures(when, shares[:, mask] * whole, shares[:, mask] * thickening)
    how = {"times": times, "erythema": response.erythema, **SKIN}
    states = states_at(exposures, response.melanin, **how)[np.arange(len(shares)), which]
    states = states if response.erythema is None else whole_thickening(states)
    told = np.zeros((len(shares), 3))
    told[:, 0], told[:, 1] = np.log(states[:, :3].sum(axis=1)), np.log(states[:, 3])
    if states.shape[1] > 4:
        told[:, 2] = np.log(states[:, 4])
    return told


def of(received, days=30.0, first_day=0.0, precision=FEW, response=THESIS):
    span = {"first_day": first_day, "last_day": days, "erythema": response.erythema}
    return basis(received, response.melanin, precision=precision, **span, **SKIN)[0]


def seen(made, shares: np.ndarray, days) -> np.ndarray:
    """u, v and b (N, 3) that a shader shows at shares (N, M) on days (N,)."""
    days = np.broadcast_to(days, len(shares))
    coefficients = coefficients_at(
        images_of(made.coefficients),
        places_among(made.knots, made.weights),
        shares,
        rows_at(made, days)[1],
        made.parts,
    )
    return shown(made, coefficients, days)


def errors(made, received, shares, hours, response=THESIS) -> np.ndarray:
    """CIEDE2000 (N,)."""
    shown_at, exact = (
        lab(looked_up(LOOK, LOOK.colour, coordinates))
        for coordinates in (
            seen(made, shares, hours / 24.0),
            simulated(received, shares, hours, response),
        )
    )
    return ciede2000(shown_at, exact)


SLOW = [pytest.param(5, seed, marks=pytest.mark.slow) for seed in range(50, 56)]


@pytest.mark.parametrize(("masks", "seed"), [(2, 20), *SLOW])
def test_random_schedules_of_people(masks, seed):
    """As tans were measured, with redness, against the simulation by the hour."""
    random = np.random.default_rng(seed)
    received = doses(random, masks, 30.0)
    made = of(received, precision=FULL, response=MEASURED)
    hours = random.integers(0, 720, 150 * masks)
    shares = points(random, len(hours), masks), in_faces(random, len(hours), masks)
    error, inside = (errors(made, received, own, hours, MEASURED) for own in shares)
    assert error.mean() < ERRORS["mean"] and np.quantile(error, 0.99) < ERRORS["at 99 %"]
    assert np.quantile(inside, 0.95) < ERRORS["at 99 %"]
    assert max(error.max(), inside.max()) < ERRORS["most"]


SLOWER = [pytest.param(masks, masks, marks=pytest.mark.slow) for masks in (2, 3, 4, 5, 8)]


@pytest.mark.parametrize(("masks", "seed"), [(3, 30), *SLOWER])
def test_random_schedules_by_the_thesis(masks, seed):
    """Its tans jump where a dose just reaches a threshold; beside a jump they are less right."""
    random = np.random.default_rng(seed)
    received = doses(random, masks, 30.0)
    made = of(received, precision=replace(FULL, points=8000, rows=96) if seed == 30 else FULL)
    hours = random.integers(0, 720, 300)
    shares = points(random, 300, masks), in_faces(random, 300, masks)
    error, inside = (errors(made, received, own, hours) for own in shares)
    assert error.mean() < ERRORS["mean"] and np.quantile(error, 0.99) < ERRORS["at 99 %"]
    assert np.quantile(inside, 0.95) < ERRORS["at 99 %"]


def test_dragging_is_coarser():
    random = np.random.default_rng(4)
    received, shares = doses(random, 4, 30.0), points(random, 400, 4)
    made = of(received, precision=DRAG)
    error = errors(made, received, shares, random.integers(0, 720, 400))
    assert len(made.coefficients[0]) <= DRAG.points and (made.rank,) == DRAG.ranks
    assert error.mean() < ERRORS["mean"] and np.quantile(error, 0.99) < 0.4


def test_knots_lie_where_a_tan_bends():
    """Most of them at the doses that just tan; where nothing changes there are the ends alone."""
    across = np.linspace(0.0, 1.0, 101)
    lines = [np.where(across > 0.3, 1.0, 0.0)[:, None], np.zeros((101, 1)), across[:, None] ** 2]
    step, even, square = knots_within(across, lines, 1000, 0.001)
    assert step == pytest.approx([0.0, 0.3, 0.31, 1.0]) and even == pytest.approx([0.0, 1.0])
    assert 12 < len(square) < 40
    few = knots_within(across, lines, 60, 0.001)
    assert np.prod([len(own) for own in few]) <= 60 and len(few[0]) == 4


@pytest.mark.parametrize("masks", [2, 3, 8])
def test_what_runs_straight_is_exact(masks):
    """Between knots that lie unevenly, and of the part that is wanted."""
    random = np.random.default_rng(masks)
    knots = [np.array([0.0, 0.25, 1.0]), *[np.array([0.0, 0.5, 1.0])] * (masks - 1)]
    slopes = random.normal(size=(masks, 3))
    own = shares_of_grid(knots) @ slopes
    shares = random.integers(0, 1025, (50, masks)) / 1024.0
    part, weights = random.integers(0, 2, 50), random.random(masks)
    images = images_of(np.stack([own, own + 1.0]), 3000 if masks == 2 else 0)
    places = places_among(knots, weights)
    given = coefficients_at(images, places, shares, part, 2)
    assert given == pytest.approx(shares @ slopes + part[:, None], abs=1e-5)
    assert places[masks:, 0].ravel()[:masks] == pytest.approx(weights)


@pytest.mark.parametrize(("first_day", "last_day"), [(0.0, 12.0), (3.3, 11.07)])
def test_first_and_last_day_within_an_hour(first_day, last_day):
    received = [joined([of_sed(5, 20.0), of_sed(100, 9.0)]), of_sed(50, 20.0)]
    shares = points(np.random.default_rng(7), 40, 2)
    made = of(received, last_day, first_day)
    for day in (first_day, 7.0, last_day):
        error = errors(made, received, shares, np.full(40, 24.0 * day))
        assert error.max() < ERRORS["at 99 %"]


def test_a_span_of_hours():
    """Fewer rows than a part has."""
    received = [of_sed(5, 20.0), of_sed(0, 20.0)]
    made = of(received, 0.5)
    shares = points(np.random.default_rng(8), 40, 2)
    assert made.parts == FEW.rows // 16
    assert errors(made, received, shares, np.full(40, 8.0)).max() < ERRORS["at 99 %"]


def test_the_share_is_that_of_all_doses():
    made = of([of_sed(0, 30.0), of_sed(24, 10.0)], 5.0)
    assert made.weights == pytest.approx([0.75, 0.25])


def test_without_sun_nothing_changes():
    made = of([joined([]), joined([])], 5.0)
    assert seen(made, np.eye(2), 3.0) == pytest.approx(np.zeros((2, 3)), abs=1e-6)
    assert not made.weights.any() and made.rank == FEW.ranks[0] and made.error < 1e-6


@pytest.mark.parametrize("masks", [0, MOST_MASKS + 1])
def test_too_many_masks_are_named(masks):
    said = f"times in the sun have {masks} masks; allowed are 1 to 8 different"
    with pytest.raises(InputError, match=said):
        of([of_sed(0, 9.0)] * masks)
