"""A table with another biology is nearly that of the changed skin."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import blender_addon
from hylios.adding import colours
from hylios.changed_table import changed_table
from hylios.colour_difference import ciede2000, lab
from hylios.errors import InputError
from hylios.skin.biology import Biology
from hylios.table import read_table, skin_of
from hylios.tanning.spread import spread_of

TABLES = Path(blender_addon.__file__).parent / "tables"
SPANS = {
    "melanin": (0.5, 2.0),
    "blood": (0.3, 3.0),
    "thickness": (0.7, 1.4),
    "eumelanin": (0.5, 1.5),
    "pheomelanin": (0.5, 4.0),
}
"""Where the sliders of the add-on end."""

TANS = 10

WAVELENGTHS = 16
"""Of solved colours, which miss a whole spectrum's by .013 CIEDE2000, as those of tables."""


def drawn(random: np.random.Generator) -> Biology:
    factors = {name: float(np.exp(random.uniform(*np.log(span)))) for name, span in SPANS.items()}
    return Biology(**factors, oxygenation=random.uniform(-40.0, 25.0))


def tans(table, roots, blood=0.0, part=0.5, kinetics="thesis"):
    """States with so much melanin, as square roots; a part as thick as they get."""
    skin = replace(skin_of(table.provenance), kinetics=kinetics)
    sheet = spread_of(skin.melanin_kinetics, mmd=skin.mmd, med=skin.med)
    melanin = 2.0 * np.log(np.asarray(roots))
    thickness = part * np.interp(melanin, sheet.least, sheet.thicknesses)
    return sheet.states(melanin, thickness, blood)


def errors(table, biology: Biology, states: np.ndarray, **how) -> np.ndarray:
    skin = skin_of(table.provenance)
    changed = replace(skin, specimen=biology.of(skin.specimen))
    solved = colours(changed, states, count=WAVELENGTHS).subsurface
    told = changed_table(table, biology, **how).plane("subsurface_colour", states)
    return ciede2000(lab(told), lab(solved))


@pytest.mark.parametrize("name", ["II", "IV", "V", "VI"])
def test_tans_look_as_solved_while_sliders_are_dragged(name):
    table, random = read_table(TABLES / f"{name}.exr"), np.random.default_rng(len(name))
    most = np.exp(0.5 * (table.axes.knots[0][-1] - 0.97))
    off = []
    for _ in range(3):
        states = tans(table, random.uniform(1.0, most, TANS), part=random.uniform(size=TANS))
        off.append(errors(table, drawn(random), states, rough=True))
    assert np.mean(off) < 0.05
    assert np.max(off) < 0.3


@pytest.mark.parametrize("name", ["III", "V"])
def test_tans_by_the_measured_kinetics_look_as_solved(name):
    table, random = read_table(TABLES / f"{name}.exr"), np.random.default_rng(5)
    states = tans(table, [1.03, 1.1, 1.2, 1.3], part=0.6, kinetics="measured")
    off = [errors(table, drawn(random), states, kinetics="measured") for _ in range(2)]
    assert np.mean(off) < 0.05
    assert np.max(off) < 0.3


def test_tans_at_rest_are_those_while_sliders_are_dragged():
    table = read_table(TABLES / "V.exr")
    states = tans(table, [1.0, 1.2, 1.4])
    rough, exact = (
        changed_table(table, Biology(blood=2.0), rough=rough).plane("total_colour", states)
        for rough in (True, False)
    )
    np.testing.assert_allclose(rough, exact, rtol=1e-9)


@pytest.mark.parametrize("rough", [True, False])
def test_states_with_several_amounts_of_blood_are_as_one_by_one(rough):
    biology = Biology(melanin=0.7, blood=1.6)
    changed = changed_table(read_table(TABLES / "III.exr"), biology, rough=rough)
    some, amounts = tans(changed, [0.6, 1.0, 1.0, 1.4, 2.3]), np.array([0.5, 1.0, 3.0, 12.0])
    together = changed.lookup(some, ["total_colour", "near_share"], amounts)
    for column, amount in enumerate(amounts):
        some[:, 4] = amount
        for name, plane in changed.lookup(some, list(together)).items():
            np.testing.assert_allclose(together[name][:, column], plane, rtol=1e-12)


def test_melanin_that_fills_a_layer_bends_no_tan():
    table = read_table(TABLES / "VI.exr")
    skin = skin_of(table.provenance)
    biology = Biology(melanin=1.3, thickness=0.8)
    states = tans(table, np.linspace(1.15, 1.4, 8))
    changed = replace(skin, specimen=biology.of(skin.specimen))
    assert any(changed.overfull(state) for state in states)
    assert errors(table, biology, states).max() < 0.2


@pytest.mark.parametrize(
    ("roots", "blood", "most"),
    [
        ((0.05, 0.2, 0.5), 0.0, 0.6),
        ((0.6, 0.7, 0.8, 0.9), 0.0, 0.2),
        ((2.0, 2.2, 2.4), 0.0, 0.6),
        ((1.0, 1.5), 1.2, 0.4),
    ],
    ids=["palest", "pale", "freckles", "flush"],
)
def test_what_else_shows_is_near(roots, blood, most):
    table = read_table(TABLES / "III.exr")
    biology = Biology(melanin=1.3, blood=1.4, oxygenation=-10.0, thickness=0.9)
    assert errors(table, biology, tans(table, roots, blood)).max() < most


def test_more_melanin_is_another_place_on_the_table():
    table = read_table(TABLES / "III.exr")
    states = tans(table, [1.0, 1.3])
    more = changed_table(table, Biology(melanin=1.5)).lookup(states, ["near_share", "far_width"])
    places = table.axes.coordinates(states) + [np.log(1.5), 0.0, 0.0, 0.0]
    moved = table.axes.states(places)
    for name, plane in table.lookup(moved, ["near_share", "far_width"]).items():
        np.testing.assert_allclose(more[name], plane)


def test_oblique_colours_change_too():
    table = read_table(TABLES / "II.exr")
    skin, biology, states = skin_of(table.provenance), Biology(blood=2.0), tans(table, [1.0, 1.2])
    changed = replace(skin, specimen=biology.of(skin.specimen))
    solved = colours(changed, states, count=WAVELENGTHS, angle=60.0).subsurface
    told = changed_table(table, biology).plane("subsurface_colour_60", states)
    assert ciede2000(lab(told), lab(solved)).max() < 0.15


def test_nothing_changed_is_the_table_itself():
    table = read_table(TABLES / "I.exr")
    assert changed_table(table, Biology()) is table


def test_a_table_of_own_spectra_is_refused():
    table = read_table(TABLES / "III.exr")
    own = replace(table, provenance={**table.provenance, "own_figures": {"water": "mine.csv"}})
    with pytest.raises(InputError, match="spectra of one's own"):
        changed_table(own, Biology(blood=2.0))
