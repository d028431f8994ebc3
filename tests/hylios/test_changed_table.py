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
    "melanin": (0.5, 1.6),
    "blood": (0.5, 2.0),
    "thickness": (0.7, 1.4),
    "eumelanin": (0.6, 1.6),
    "pheomelanin": (0.5, 3.0),
}
TANS = 10


def drawn(random: np.random.Generator) -> Biology:
    factors = {name: float(np.exp(random.uniform(*np.log(span)))) for name, span in SPANS.items()}
    return Biology(**factors, oxygenation=random.uniform(-25.0, 25.0))


def tans(table, roots, blood=0.0):
    """States of a table's skin with so much melanin, as square roots, half as thick as they get."""
    skin = skin_of(table.provenance)
    sheet = spread_of(skin.dynamics, mmd=skin.mmd, med=skin.med)
    melanin = 2.0 * np.log(np.asarray(roots))
    return sheet.states(melanin, 0.5 * np.interp(melanin, sheet.least, sheet.thicknesses), blood)


def errors(table, biology: Biology, states: np.ndarray) -> np.ndarray:
    skin = skin_of(table.provenance)
    solved = colours(replace(skin, specimen=biology.of(skin.specimen)), states).subsurface
    told = changed_table(table, biology).plane("subsurface_colour", states)
    return ciede2000(lab(told), lab(solved))


@pytest.mark.parametrize("name", ["II", "III", "V"])
def test_tans_look_as_solved(name):
    table, random = read_table(TABLES / f"{name}.exr"), np.random.default_rng(ord(name[0]))
    most = np.exp(0.5 * (table.axes.knots[0][-1] - 0.97))
    off = np.array(
        [
            errors(table, drawn(random), tans(table, random.uniform(1.0, most, TANS)))
            for _ in range(3)
        ]
    )
    assert off.mean() < 0.05
    assert off.max() < 0.3


@pytest.mark.parametrize(
    ("roots", "blood", "most"),
    [((0.05, 0.2, 0.5, 0.8), 0.0, 0.6), ((2.0, 2.2, 2.4), 0.0, 0.6), ((1.0, 1.5), 1.2, 0.4)],
    ids=["pale", "freckles", "flush"],
)
def test_what_else_shows_is_near(roots, blood, most):
    table = read_table(TABLES / "III.exr")
    biology = Biology(melanin=1.3, blood=1.4, oxygenation=-10.0, thickness=0.9)
    assert errors(table, biology, tans(table, roots, blood)).max() < most


def test_more_melanin_is_another_place_on_the_table():
    table = read_table(TABLES / "III.exr")
    states = tans(table, [1.0, 1.3])
    more = changed_table(table, Biology(melanin=1.5)).lookup(states, ["near_share", "far_width"])
    moved = states * np.array([1.5, 1.5, 1.5, 1.0, 1.0])
    for name, plane in table.lookup(moved, ["near_share", "far_width"]).items():
        np.testing.assert_allclose(more[name], plane)


def test_oblique_colours_change_too():
    table = read_table(TABLES / "II.exr")
    skin, biology, states = skin_of(table.provenance), Biology(blood=2.0), tans(table, [1.0, 1.2])
    changed = replace(skin, specimen=biology.of(skin.specimen))
    solved = colours(changed, states, angle=60.0).subsurface
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
