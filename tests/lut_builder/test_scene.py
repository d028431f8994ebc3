"""A table for one scene: as near the model as the whole table, of fewer states, and no further."""

import numpy as np
import pytest

from hylios.adding import spectra
from hylios.lab.colour import difference
from hylios.quadrature import skin_quadrature
from hylios.skin.phototypes import phototype
from hylios.table import from_stored, to_stored
from hylios.tanning import Exposures
from lut_builder.assemble import build, requested
from lut_builder.check import check
from lut_builder.reachable import reachable_states, reached_states, untanned_state
from lut_builder.request import ANGLE, WATER, pieces
from lut_builder.settings import Settings

SKINS = {name: phototype(name).skin for name in ("I", "III", "VI")}
COLOURS = Settings(knots=(16, 3, 4, 2), colour_wavelengths=4, bands=(), profile_error=0.0)
NO_SUN = Exposures([], [])


def scene(skin, name: str) -> np.ndarray:
    """States (N, 4) of one exposure, of a week of them, or of irregular ones over two months."""
    if name == "once":
        return reached_states(skin, Exposures([12], [2.0 * skin.mmd]), 10.0)
    if name == "a week":
        return reached_states(skin, Exposures(12 + 24 * np.arange(7), np.full(7, skin.mmd)), 30.0)
    random = np.random.default_rng(5)
    hours = np.sort(random.choice(58 * 24, 14, replace=False))
    return reached_states(skin, Exposures(hours, skin.mmd * random.uniform(0.5, 5.0, 14)), 60.0)


def some(states: np.ndarray, skin, count: int) -> np.ndarray:
    tanned = np.abs(np.log(states / untanned_state(skin))).max(axis=1) > 1e-3
    return np.random.default_rng(3).choice(states[tanned], count, replace=False)


def colours(skin, states: np.ndarray) -> np.ndarray:
    """From the wavelengths of `COLOURS`: what a table differs by is its interpolation's error."""
    few = skin_quadrature(COLOURS.colour_wavelengths)
    specimens = [skin.at(state) for state in states]
    films = (None, WATER)  # whose nodes the table's solutions have
    light = spectra(specimens, few.wavelengths, angle=ANGLE, nodes=COLOURS.nodes, film=films)
    return (light.surface + light.subsurface)[0] @ few.weights.T


CASES = [("III", "once", 0.2), ("VI", "two months", 0.4)]
MORE_CASES = [("III", "two months", 0.35), ("VI", "a week", 0.4), ("I", "a week", 0.1)]
"""Skin, sun, and the share of the whole table's states that may be computed, for both kinetics."""


@pytest.mark.parametrize(
    ("name", "sun", "most"),
    [*CASES, *(pytest.param(*case, marks=pytest.mark.slow) for case in MORE_CASES)],
)
def test_a_scene_s_table_is_near_the_model_of_fewer_states(name, sun, most):
    skin = SKINS[name]
    reached = scene(skin, sun)
    table = from_stored(to_stored(build(skin, COLOURS, reached=reached)))
    told = table.provenance
    assert told["states_computed"] <= most * told["states_for_any_sun"]
    states = some(reached, skin, 60)
    apart = difference(table.plane("total_colour", states), colours(skin, states))
    assert apart.mean() < 0.08 and apart.max() < 0.25
    assert table.holds(reached).all()


def test_all_of_a_scene_s_states_are_computed():
    skin, reached = SKINS["III"], scene(SKINS["III"], "once")
    request = requested(skin, COLOURS, reached=reached)
    count = len(request.states)
    assert 0 < count == np.prod(request.axes.shape) < request.whole
    assert sum(piece.last - piece.first for piece in pieces(request)) == count


def test_a_scene_s_table_holds_no_more_than_it_should():
    """Of the states of other suns it holds some; beyond its knots, and of other blood, none."""
    skin = SKINS["III"]
    reached = scene(skin, "a week")
    table = from_stored(to_stored(build(skin, COLOURS, reached=reached), half=True))
    assert table.holds(reached).all()
    others = some(reachable_states(skin, 60, seed=8), skin, 400)
    held = table.holds(others)
    assert 0.02 < held.mean() < 0.9
    off = difference(table.plane("total_colour", others), colours(skin, others))
    assert off[held].max() < 0.3 and off[~held].max() > 1.0
    for shape in ((), (2, 3)):
        assert table.holds(np.broadcast_to(reached[0], (*shape, 4))).shape == shape
    darkest = reached[reached[:, :3].sum(axis=1).argmax()]
    for change in ([1.5, 1.5, 1.5, 1.0], [1.0, 1.0, 1.0, 1.5], [3.0, 1.0, 0.2, 1.0]):
        assert not table.holds(darkest * change)
    assert not table.holds([*darkest, 2.0])
    checked = check(table, count=5, seed=3).states
    assert table.holds(checked).all() and checked[:, 4].max() == 1.0


def test_a_table_for_any_sun_holds_all():
    table = build(SKINS["III"], Settings((3, 2), 4, bands=(), profile_error=0.0))
    assert not table.axes.bounded
    assert table.holds(3.0 * reachable_states(SKINS["III"], 5, seed=8)).all()


@pytest.mark.parametrize("name", ["I", "III"])
def test_a_scene_without_sun_is_one_state(name):
    skin = SKINS[name]
    reached = reached_states(skin, NO_SUN, 30.0)
    table = from_stored(to_stored(build(skin, COLOURS, reached=reached)))
    assert (table.axes.shape, table.provenance["states_computed"]) == ((1, 1, 1, 1), 1)
    untanned = untanned_state(skin)
    assert table.holds(untanned) and not table.holds(untanned * 1.05)
    colour = table.plane("total_colour", untanned[None])
    assert colour == pytest.approx(colours(skin, untanned[None]), abs=1e-6)


def test_a_scene_of_skin_that_makes_no_melanin_in_the_sun():
    """It thickens only."""
    skin = SKINS["I"]
    reached = scene(skin, "two months")
    table = build(skin, COLOURS, reached=reached)
    assert table.axes.shape == (1, 3, 1, 1) and table.holds(reached).all()
    states = some(reached, skin, 20)
    assert table.plane("total_colour", states) == pytest.approx(colours(skin, states), abs=2e-4)
