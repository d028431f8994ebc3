"""Melanin and blood told from painted colours, and how well such places tan."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sampled import bilinear, looked_up

from blender_addon.model import catalogue
from blender_addon.model.look import look, untanned_colour
from blender_addon.model.own_colour import SLOPE, START, offsets
from hylios.adding import spectra
from hylios.colour_difference import ciede2000, lab
from hylios.quadrature import skin_quadrature
from hylios.skin.biology import Biology
from hylios.table import melanin_dynamics, minimal_doses, skin_of
from hylios.tanning import Exposures, simulate

PAGE = Path(__file__).parents[3] / "docs" / "research.md"
TYPES = ("II", "III", "IV", "V", "VI")
MELANIN, BLOOD, DOSES = (0.5, 0.7, 1.4, 2.0, 2.6), (1.0, 2.0, 4.0), (0.0, 4.0, 8.0)
"""Over those of the skin; tanning doses of one time in the sun."""


def of_skin(name: str):
    """The look of a shipped skin, and the table that it is of."""
    table = catalogue.table(catalogue.shipped_path(name))
    return look(table, minimal_doses(table.provenance)), table


def estimates(shown, colours) -> np.ndarray:
    """Logarithms of melanin and blood (N, 2) of colours (N, 3), as the shader tells them."""
    red, green = np.log(colours / untanned_colour(shown))[:, :2].T
    x, y = START[0] + SLOPE[0] * red, START[1] + SLOPE[1] * (green - red)
    melanin, blood, _ = bilinear(offsets(shown), x, y).T
    return np.stack([np.log(melanin), blood], axis=1)


def lit_states(table) -> np.ndarray:
    """States (doses, 4) of the skin on the day on which the largest dose shows most."""
    minimal = minimal_doses(table.provenance)
    doses = Exposures(hours=np.array([0]), doses=minimal.mmd * np.array(DOSES)[:, None])
    states = simulate(
        doses,
        melanin_dynamics(table.provenance),
        mmd=minimal.mmd,
        med=minimal.med,
        hours=24 * 20,
    ).states[:, ::24]
    return states[:, states[-1, :, :3].sum(-1).argmax()]


def solved(table, states, melanin: float, blood: float) -> np.ndarray:
    """Colours (doses, 3) of skin with other melanin and added blood, by the light model itself."""
    skin = skin_of(table.provenance)
    own = replace(skin, specimen=Biology(melanin=melanin).of(skin.specimen))
    quadrature = skin_quadrature(8)
    places = [own.at(np.append(state, blood)) for state in states]
    return spectra(places, quadrature.wavelengths).subsurface @ quadrature.weights.T


def differences(name: str, skins) -> tuple[np.ndarray, np.ndarray]:
    """CIEDE2000 of tanned skins to the model's: by their own colour, and as all skin tans."""
    shown, table = of_skin(name)
    states = lit_states(table)
    u, v = np.log(states[:, :3].sum(-1)), np.log(states[:, 3])
    plain = looked_up(shown, shown.colour, np.stack([u, v, 0.0 * u], axis=1))
    usual = untanned_colour(shown)
    by_own, as_all = [], []
    base = solved(table, states[:1], 1.0, 1.0)[0]
    for melanin, blood in skins:
        exact = solved(table, states, melanin, blood)
        du, db = estimates(shown, exact[:1] / base * usual)[0]
        own = looked_up(shown, shown.colour, np.stack([u + du, v, 0.0 * u + db], axis=1))
        for ratio, kept in ((own / own[0], by_own), (plain / plain[0], as_all)):
            kept += ciede2000(lab(exact[0] * ratio), lab(exact))[1:].tolist()
    return np.array(by_own), np.array(as_all)


@pytest.mark.parametrize("name", ["II", "V"])
def test_melanin_of_the_look_s_own_colours_and_how_they_tan(name):
    """To 2.5 % of melanin, and to 1 % of the colour after a tan that adds half of it."""
    shown, _ = of_skin(name)
    u, b = (part.ravel() for part in np.meshgrid(np.linspace(-1.5, 0.9, 9), [0.0, 0.5, 1.2]))
    places = np.stack([u, 0.0 * u, b], axis=1)
    told = np.insert(estimates(shown, looked_up(shown, shown.colour, places)), 1, 0.0, axis=1)
    assert told[:, 0] == pytest.approx(u, abs=0.025)
    own, wanted = (
        looked_up(shown, shown.colour, state + [np.log(1.5), 0.0, 0.0])
        / looked_up(shown, shown.colour, state)
        for state in (told, places)
    )
    assert own == pytest.approx(wanted, rel=0.01)


def test_the_usual_colour_is_that_of_the_skin_exactly():
    for name in TYPES:
        shown, _ = of_skin(name)
        assert estimates(shown, untanned_colour(shown)[None]) == pytest.approx(
            np.zeros((1, 2)), abs=1e-6
        )


def test_dark_places_are_told_where_tans_reach_the_end_of_the_look_too():
    """Up to the root of the most melanin that it holds."""
    shown, _ = of_skin("III")
    slower = offsets(replace(shown, most_tan=2.5))
    assert slower[..., 0].max() == pytest.approx(shown.melanin[1], rel=0.05)


def test_colours_of_no_skin_are_held_without_a_jump():
    for name in TYPES:
        image = offsets(of_skin(name)[0])
        assert np.isfinite(image).all() and (image >= 0.0).all()
        assert np.diff(image[..., 0], axis=1).max() <= 0.05
        assert np.abs(np.diff(image[..., 0], axis=0)).max() < 0.5


def test_dark_and_red_places_tan_nearer_to_the_model_than_as_all_skin():
    by_own, as_all = differences("III", [(0.5, 1.0), (2.0, 1.0), (1.4, 4.0)])
    assert by_own.max() < 0.8
    assert as_all.reshape(3, -1).max(axis=1).min() > 2.0


@pytest.mark.slow
def test_figures_of_the_researcher_s_page():
    """As the table there has them, of skins with other melanin and blood, and after two doses."""
    skins = [(melanin, blood) for melanin in MELANIN for blood in BLOOD]
    lines = []
    for name in TYPES:
        told = [f"{values.mean():.1f} | {values.max():.1f}" for values in differences(name, skins)]
        lines.append(f"| {name} | {told[0]} | {told[1]} |")
        print(lines[-1])
    text = PAGE.read_text(encoding="utf-8")
    assert [line for line in lines if line not in text] == []
