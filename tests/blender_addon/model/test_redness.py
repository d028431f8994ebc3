"""Redness and the measured kinetics, from the doses to what a shader samples."""

from dataclasses import replace

import numpy as np
import pytest
from exposures import USUAL
from sampled import coordinates, looked_up

import hylios
from blender_addon.model import catalogue, curve, history, summary
from blender_addon.model.look import look
from blender_addon.model.response import holds_redness, response_of
from blender_addon.model.settings import TanSettings
from blender_addon.model.tan import history_of
from hylios.adding.colours import colours
from hylios.colour_difference import ciede2000, lab
from hylios.skin import whole_thickening
from hylios.sun.doses import joined, of_sed
from hylios.table import MinimalDoses, skin_of
from hylios.tanning import Exposures, states_at

TABLE = catalogue.table(catalogue.shipped_path("II"))
SKIN = skin_of(TABLE.provenance)
MINIMAL = {"mmd": SKIN.mmd, "med": SKIN.med}
DOSES = [(10, 3.0 * SKIN.med), (34, 2.0 * SKIN.med), (130, 2.0 * SKIN.med), (300, 4.0 * SKIN.med)]
SOON = np.r_[10:90, 130:190, 300:400, 400:1440:20]
"""Hours, most of them soon after a dose."""


def simulated(shares: np.ndarray, hours: np.ndarray, kinetics: str) -> np.ndarray:
    """States (N, 5) of places, each at an hour of its own."""
    response = response_of(TABLE, kinetics, True)
    exposures = Exposures(
        [hour for hour, _ in DOSES], shares[:, None] * np.array([dose for _, dose in DOSES])
    )
    times, which = np.unique(hours, return_inverse=True)
    states = states_at(
        exposures, response.melanin, times=times, erythema=response.erythema, **MINIMAL
    )
    return states[np.arange(len(shares)), which]


def over_time(kinetics: str, precision: history.Precision) -> history.History:
    response = response_of(TABLE, kinetics, True)
    return history.history(
        joined([of_sed(hour, dose) for hour, dose in DOSES]),
        response.melanin,
        first_day=0.0,
        last_day=60.0,
        precision=precision,
        erythema=response.erythema,
        **MINIMAL,
    )[0]


@pytest.mark.parametrize("precision", [history.FULL, history.DRAG])
@pytest.mark.parametrize("kinetics", ["thesis", "measured"])
def test_history_against_the_simulation_by_the_hour(kinetics, precision):
    """b of .01 is .05 CIEDE2000."""
    random = np.random.default_rng(1)
    shares, hours = random.random(300), random.choice(SOON, 300)
    seen = coordinates(over_time(kinetics, precision), shares, hours / 24.0)
    states = whole_thickening(simulated(shares, hours, kinetics))
    expected = np.log(np.stack([states[:, :3].sum(axis=1), *states[:, 3:].T], axis=1))
    error = np.abs(seen - expected)
    assert expected[:, 2].max() > 1.0
    assert error.mean() < 0.003
    assert np.all(np.quantile(error, 0.99, axis=0) < [0.012, 0.012, 0.02])


@pytest.mark.parametrize("kinetics", ["thesis", "measured"])
def test_what_a_shader_shows_against_solving_the_skin(kinetics):
    """Table, images and the thickness that the dermis lacks, all in one."""
    random = np.random.default_rng(2)
    shares, hours = random.random(16), np.sort(random.choice(SOON, 16))
    image = look(TABLE, MinimalDoses(**MINIMAL), kinetics)
    places = coordinates(over_time(kinetics, history.FULL), shares, hours / 24.0)
    shown = looked_up(image, image.colour, places)
    skin = replace(SKIN, kinetics=kinetics, thickening="epidermis")
    exact = colours(skin, simulated(shares, hours, kinetics)).subsurface
    error = ciede2000(lab(shown), lab(exact))
    assert error.mean() < 0.12
    assert error.max() < 0.25


def test_a_table_without_blood_shows_no_redness(former_path):
    former = catalogue.table(former_path)
    assert not holds_redness(former)
    axes = replace(TABLE.axes, knots=(*TABLE.axes.knots[:3], np.zeros(1)))
    assert holds_redness(TABLE) and not holds_redness(replace(TABLE, axes=axes))
    assert response_of(former, redness=True).erythema is None
    assert response_of(TABLE, redness=True).erythema == hylios.erythema(SKIN)
    assert response_of(TABLE).erythema is None


SUN = replace(USUAL, dose=3.0 * SKIN.med)
SETTINGS = TanSettings(
    table=catalogue.shipped_path("II"),
    own_doses=None,
    exposures=(SUN,),
    first_day=0.0,
    last_day=60.0,
    kinetics="measured",
    redness=True,
)


def test_the_curve_tells_redness_and_tan_apart():
    made = curve.curve_of(SETTINGS)
    without = curve.curve_of(replace(SETTINGS, redness=False))
    red = int(made.redness.argmax())
    assert 0.5 < made.days[red] < 1.5 and made.redness[red] > 4.0
    assert not without.redness.any()
    # The tan is that of the same melanin: without redness the thicker dermis adds a little.
    assert np.abs(made.lightness - without.lightness).max() < 0.6
    assert made.darkest_day == pytest.approx(without.darkest_day, abs=0.5)
    assert 4.0 < made.darkest_day < 8.0
    (burn,) = made.burns
    assert burn[0] < 0.5 and 2.0 < burn[1] < 8.0
    assert curve.words(made)[0] == f"Burnt on days 0-{burn[1]:.0f}"
    assert "Burnt" not in " ".join(curve.words(without))


def test_the_curve_names_several_burns_and_none_of_dark_skin():
    again = replace(SETTINGS, exposures=(SUN, replace(SUN, day=20.0, dose=6.0 * SKIN.med)))
    made = curve.curve_of(again)
    until, last = made.burns[0][1], made.burns[1][1]
    assert curve.words(made)[0] == f"Burnt on days 0-{until:.0f}, 20-{last:.0f}"
    often = replace(SETTINGS, exposures=tuple(replace(SUN, day=day) for day in (0.0, 15.0, 40.0)))
    assert curve.words(curve.curve_of(often))[0].startswith("Burnt 3 times, days 0-4")
    dark = replace(SETTINGS, table=catalogue.shipped_path("VI"))
    assert not curve.curve_of(dark).burns


def test_a_faint_tan_is_gone_and_not_half_gone_later():
    """On the darkest skin three quarters of a tanning dose are hardly seen."""
    faint = replace(SUN, unit="MMD", multiple=0.75)
    table = catalogue.shipped_path("VI")
    made = curve.curve_of(replace(SETTINGS, table=table, exposures=(faint,)))
    assert made.gone is not None and made.gone < made.half_gone
    assert curve.words(made)[-1] == f"gone by day {made.gone:.0f}"


def test_the_picture_has_a_red_line_where_skin_is_red():
    made = curve.curve_of(SETTINGS)
    pixels = curve.picture(made, made.colours)

    def drawn(colour: np.ndarray) -> int:
        return int(np.all(np.abs(pixels - colour) < 0.02, axis=2).sum())

    assert drawn(curve.LINE) > 100 and drawn(curve.RED_LINE) > 20
    red = np.abs(pixels - curve.RED_LINE.astype(np.float32)).sum(axis=2).argmin(axis=0)
    reddest = made.redness.argmax() / (len(made.days) - 1) * (curve.WIDTH - 1)
    assert red.max() == pytest.approx(red[int(reddest)], abs=3)  # rows count from below
    plain = curve.picture(curve.curve_of(replace(SETTINGS, redness=False)), made.colours)
    assert not np.all(np.abs(plain - curve.RED_LINE) < 0.02, axis=2).any()


def test_history_differs_by_kinetics_and_redness():
    thesis = replace(SETTINGS, kinetics="thesis", redness=False)
    first, red = history_of(thesis).coordinates, history_of(SETTINGS).coordinates
    assert not first[..., 2].any()
    assert red[..., 2].max() > 1.0
    assert history_of(thesis).coordinates is first


def test_the_words_say_when_skin_peels():
    """By the model from day 4 to 8 after the burn, and loose edges a day more."""
    burnt = replace(SETTINGS, exposures=(replace(SUN, dose=5.0 * SKIN.med),), peeling=True)
    assert curve.words(curve.curve_of(burnt))[1] == "Peels on days 4-9"
    little = replace(burnt, exposures=(replace(SUN, dose=2.5 * SKIN.med),))
    assert curve.words(curve.curve_of(little))[1] == "Burns too little to peel"
    off = replace(burnt, peeling=False)
    assert not any("eel" in line for line in curve.words(curve.curve_of(off)))


def test_doses_that_blister_are_said_by_the_day():
    """The sum of a day counts, and its own minimal dose."""
    half = replace(SUN, dose=2.1 * SKIN.med)
    two_days = replace(SETTINGS, exposures=(half, replace(half, day=3.0)))
    assert summary.of_blisters(two_days) == ()
    one_day = replace(SETTINGS, exposures=(replace(half, day=3.1), replace(half, day=3.4)))
    assert summary.of_blisters(one_day)[0] == "Above 4 burn doses on day 3:"
    hardy = MinimalDoses(mmd=2.0 * SKIN.mmd, med=2.0 * SKIN.med)
    assert summary.of_blisters(replace(one_day, own_doses=hardy)) == ()
    exact = replace(SETTINGS, exposures=(replace(SUN, dose=4.0 * SKIN.med),))
    assert summary.of_blisters(exact) == ()
