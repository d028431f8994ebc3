"""A table for one scene: as near the model as the whole table, of fewer states, and no further."""

from dataclasses import replace

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
from lut_builder.reachable import choose_axes, reachable_states, reached_states, untanned_state
from lut_builder.request import ANGLE, pieces
from lut_builder.scene_axes import NEAR, farthest, laid_over
from lut_builder.settings import Settings

SKINS = {name: phototype(name).skin for name in ("I", "III", "VI")}
COLOURS = Settings(knots=(9, 3, 3, 2), colour_wavelengths=4, bands=(), profile_error=0.0)
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
    light = spectra(specimens, few.wavelengths, angle=ANGLE, nodes=COLOURS.nodes)
    return (light.surface + light.subsurface) @ few.weights.T


@pytest.fixture(scope="module")
def whole():
    return {name: build(skin, COLOURS) for name, skin in SKINS.items()}


CASES = [
    ("III", "once", "pchip", 0.40),
    ("VI", "two months", "linear", 0.50),
]
MORE_CASES = [
    ("III", "a week", "linear", 0.40),
    ("VI", "a week", "pchip", 0.60),
    ("III", "once", "linear", 0.27),
    ("III", "a week", "pchip", 0.45),
    ("III", "two months", "linear", 0.50),
    ("III", "two months", "pchip", 0.51),
    ("VI", "once", "linear", 0.33),
    ("VI", "once", "pchip", 0.45),
    ("VI", "a week", "linear", 0.45),
    ("VI", "two months", "pchip", 0.51),
]
"""Skin, sun, interpolation, and the share of the whole table's states that may be computed."""


@pytest.mark.parametrize(
    ("name", "sun", "interpolation", "most"),
    [*CASES, *(pytest.param(*case, marks=pytest.mark.slow) for case in MORE_CASES)],
)
def test_a_scene_s_table_is_as_near_the_model_of_fewer_states(
    whole, name, sun, interpolation, most
):
    skin, settings = SKINS[name], replace(COLOURS, interpolation=interpolation)
    reached = scene(skin, sun)
    part = build(skin, settings, reached=reached)
    full = replace(whole[name], interpolation=interpolation)
    assert part.provenance["states_computed"] <= most * full.provenance["states_computed"]
    states = some(reached, skin, 60)
    expected = colours(skin, states)
    own, other = (
        difference(table.plane("total_colour", states), expected) for table in (part, full)
    )
    assert own.mean() < other.mean()
    assert own.max() < other.max()
    assert part.holds(reached).all()


@pytest.mark.parametrize("knots", [(7, 2), (9, 3, 3, 2), (13,), (9, 1, 4)])
@pytest.mark.parametrize("sun", ["once", "a week"])
def test_a_scene_s_knots(knots, sun):
    """The untanned skin is one; none is farther from the next than a quarter more than in the
    whole table; and their states have the knots' coordinates."""
    skin = SKINS["III"]
    full, reached = choose_axes(skin, knots), scene(skin, sun)
    axes, states = laid_over(full, reached)
    assert np.abs(states.reshape(-1, 4) - untanned_state(skin)).max(axis=1).min() < 1e-12
    assert states.size <= full.knot_states().size
    assert axes.basis.T @ axes.basis == pytest.approx(np.eye(len(axes.knots)), abs=1e-12)
    several = [knots_of_axis for knots_of_axis in full.knots if len(knots_of_axis) > 1]
    for own, other in zip(axes.knots, several, strict=False):
        assert np.diff(own).max() <= 1.26 * np.diff(other).max()
    assert axes.coordinates(states) == pytest.approx(
        np.stack(np.meshgrid(*axes.knots, indexing="ij"), axis=-1), abs=1e-12
    )


@pytest.mark.parametrize("sun", ["once", "a week"])
def test_a_lookup_along_a_scene_s_axes_finds_what_lies_off_them(sun):
    """Nearly enough to leave an axis out; the states in the plane of the axes are farther."""
    skin = SKINS["III"]
    full, reached = choose_axes(skin, COLOURS.knots), scene(skin, sun)
    axes, states = laid_over(full, reached)
    assert len(axes.knots) == 3
    far = farthest(axes, states, reached, "linear") - NEAR
    assert far < NEAR
    assert farthest(axes, axes.knot_states(), reached, "linear") - NEAR > 2.0 * far


@pytest.mark.parametrize("interpolation", ["linear", "pchip"])
def test_all_that_a_lookup_where_the_sun_leads_reads_is_computed(interpolation):
    """And with the linear table's knots, one less is too few."""
    skin, reached = SKINS["III"], scene(SKINS["III"], "once")
    request = requested(skin, replace(COLOURS, interpolation=interpolation), reached=reached)
    count = len(request.states)
    assert 0 < count == request.needed.sum()
    assert sum(piece.last - piece.first for piece in pieces(request)) == count
    table = build(skin, replace(COLOURS, interpolation=interpolation), reached=reached)
    random = np.random.default_rng(1)
    noise = random.random((*request.needed.shape, 3))
    expected = table.plane("total_colour", reached)

    def changed(where: np.ndarray) -> bool:
        other = table.planes["total_colour"] + np.where(where[..., None], noise, 0.0)
        colour = replace(table, planes={"total_colour": other}).plane("total_colour", reached)
        return not np.array_equal(colour, expected)

    assert not changed(~request.needed)
    if interpolation == "linear":
        assert not request.needed.all()
        for place in np.argwhere(request.needed)[::9]:
            one = np.zeros(request.needed.shape, bool)
            one[tuple(place)] = True
            assert changed(one)


def test_a_scene_s_table_holds_no_more_than_it_should():
    """Of the states of other suns it holds some: these are as near the model as its own are, and
    the rest it says it does not hold, be they beyond its knots, off its axes or not computed."""
    skin = SKINS["III"]
    reached = scene(skin, "a week")
    table = from_stored(to_stored(build(skin, COLOURS, reached=reached), half=True))
    assert table.holds(reached).all()
    others = some(reachable_states(skin, 60, seed=8), skin, 400)
    held = table.holds(others)
    assert 0.02 < held.mean() < 0.6
    off = difference(table.plane("total_colour", others), colours(skin, others))
    assert off[held].max() < 0.2 and off[~held].max() > 1.0
    for shape in ((), (2, 3)):
        assert table.holds(np.broadcast_to(reached[0], (*shape, 4))).shape == shape
    darkest = reached[reached[:, :3].sum(axis=1).argmax()]
    for number in range(4):
        assert not table.holds(darkest * np.where(np.arange(4) == number, 1.5, 1.0))
    states = check(table, count=5, seed=3).states
    assert table.holds(states).all()


def test_a_table_for_any_sun_holds_all(whole):
    assert "state" not in whole["III"].planes
    assert whole["III"].holds(reachable_states(SKINS["III"], 5, seed=8)).all()


@pytest.mark.parametrize("name", ["I", "III"])
def test_a_scene_without_sun_is_one_state(name, tmp_path):
    skin = SKINS[name]
    reached = reached_states(skin, NO_SUN, 30.0)
    table = from_stored(to_stored(build(skin, COLOURS, reached=reached)))
    assert (table.axes.shape, table.provenance["states_computed"]) == ((1,), 1)
    untanned = untanned_state(skin)
    assert table.holds(untanned) and not table.holds(untanned * 1.05)
    colour = table.plane("total_colour", untanned[None])
    assert colour == pytest.approx(colours(skin, untanned[None]), abs=1e-6)


def test_a_scene_of_skin_that_makes_no_melanin_in_the_sun(whole):
    """It thickens only: one axis, and no sheet to lie on."""
    skin = SKINS["I"]
    reached = scene(skin, "two months")
    table = build(skin, COLOURS, reached=reached)
    assert len(table.axes.shape) == 1 and table.holds(reached).all()
    states = some(reached, skin, 20)
    assert table.plane("total_colour", states) == pytest.approx(
        whole["I"].plane("total_colour", states), abs=2e-4
    )


def test_a_scene_beyond_what_the_whole_table_spans_is_spanned():
    skin = SKINS["III"]
    full, usual = choose_axes(skin, COLOURS.knots), scene(SKINS["III"], "a week")
    reached = full.untanned * (usual / full.untanned) ** 1.5
    axes, _ = laid_over(full, reached)
    highest = axes.coordinates(reached)[:, 0].max()
    assert highest == pytest.approx(axes.knots[0][-1]) and highest > full.knots[0][-1]
    assert np.diff(axes.knots[0]).max() <= 1.26 * np.diff(full.knots[0]).max()
