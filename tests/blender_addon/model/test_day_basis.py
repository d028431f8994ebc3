"""The day that shows while somebody changes a setting, against simulating every place."""

from dataclasses import replace

import numpy as np
import pytest
from test_basis import MEASURED, SKIN, THESIS, doses, errors, points

from blender_addon.model import day_basis
from blender_addon.model.basis import FULL, basis
from blender_addon.model.room import Room, images_in, room_for, room_in
from hylios.sun.doses import of_sed

ROOM = Room(32_768, 12, 12)


def of(received, day: float, *, first_day=0.0, last_day=30.0, response=THESIS, room=ROOM):
    span = {"first_day": first_day, "last_day": last_day, "erythema": response.erythema}
    return day_basis.day_basis(received, response.melanin, day, room, **span, **SKIN)[0]


@pytest.mark.parametrize("masks", [4, 5])
def test_the_day_that_shows_is_right(masks):
    """While dragging .15 at 99 % is asked; other days are rough."""
    random = np.random.default_rng(masks)
    received, shares = doses(random, masks, 30.0), points(random, 200, masks)
    made = of(received, 13.0, response=MEASURED)
    error = errors(made, received, shares, np.full(200, 13 * 24), MEASURED)
    assert error.mean() < 0.05 and np.quantile(error, 0.99) < 0.15
    others = errors(made, received, shares, random.integers(0, 720, 200), MEASURED)
    assert others.mean() < 0.15 and np.quantile(others, 0.99) < 0.7


@pytest.mark.parametrize("day", [0.0, 3.3, 5.0, 7.37, 11.07, 99.0])
def test_any_day_of_any_span(day, monkeypatch):
    monkeypatch.setattr(day_basis, "DAY", replace(day_basis.DAY, points=900))
    received, shares = [of_sed(5, 20.0), of_sed(100, 9.0)], points(np.random.default_rng(7), 40, 2)
    made = of(received, day, first_day=3.3, last_day=11.07)
    shown = np.full(40, round(24.0 * min(max(day, 3.3), 11.07)))
    assert errors(made, received, shares, shown).max() < 0.3


def test_it_goes_into_the_images_of_an_exact_one():
    """Of a few hours too."""
    received = [of_sed(5, 20.0), of_sed(0, 20.0)]
    few = replace(FULL, points=500, steps=32, rows=96)
    exact, _ = basis(received, THESIS.melanin, first_day=0.0, last_day=0.5, precision=few, **SKIN)
    room = room_for(exact)
    sizes = {role: own.shape[1::-1] for role, own in images_in(exact, room).items()}
    assert room_in(sizes["rows"], sizes["grid_0"]) == room and room.holds(exact)
    made = of(received, 0.3, last_day=0.5, room=room)
    assert room.holds(made) and not Room(1, room.parts, room.rank).holds(made)
    assert {role: own.shape[1::-1] for role, own in images_in(made, room).items()} == sizes
