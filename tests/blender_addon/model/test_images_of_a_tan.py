"""What a table, doses and days lead to, as images."""

from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from exposures import USUAL
from sampled import colours, tan
from synthetic import smooth_table

from blender_addon.model import basis, catalogue, doses, history, schedule
from blender_addon.model import tan as tan_model
from blender_addon.model.settings import TanSettings, own_minimal_doses
from blender_addon.model.tan import tan_of
from hylios.errors import InputError
from hylios.skin import varied
from hylios.sun.doses import of_sed
from hylios.table import SkinTable, described_dynamics
from hylios.tanning import PIGMENTATIONS
from hylios.tanning.shares import retained

SPAN = {"mmd": 4.9, "med": 2.9, "first_day": 0.0, "last_day": 10.0}


def with_header(table, **changes):
    return replace(table, provenance={**table.provenance, **changes})


def darkest(table) -> float:
    return float(colours(tan(table, of_sed(0, 30.0), **SPAN)).min())


def test_the_dynamics_in_the_header_count(table):
    """As numbers where they are there, by the set's name where not."""
    usual = PIGMENTATIONS["intermediate"]
    spelt = with_header(table, melanin_dynamics=described_dynamics(usual), pigmentation="low")
    assert darkest(spelt) == darkest(table)
    less = varied(usual, {"basale_extra_production": 0.0, "spinosum_extra_production": 0.0})
    assert darkest(with_header(table, melanin_dynamics=described_dynamics(less))) > darkest(table)


def settings(path, **changes):
    exposure = replace(USUAL, unit="SUN")
    usual = {"own_doses": None, "exposures": (exposure,), "first_day": 3.0, "last_day": 10.0}
    return TanSettings(table=path, **{**usual, **changes})


def test_thickness_has_its_own_doses_and_the_med(table_path, monkeypatch):
    """Sun by a spectrum that counts more for melanin; only the days that are seen are simulated."""
    arguments = {}

    def recorded(exposures, dynamics, **more):
        arguments.update(more, exposures=exposures)
        return retained(exposures, dynamics, **more)

    monkeypatch.setattr(history, "retained", recorded)
    monkeypatch.setattr(doses, "of_sun", partial(doses.of_sun, tanning="parrish"))
    values = settings(table_path, own_doses=own_minimal_doses(6.0, 4.0))
    (exposure,) = values.exposures
    values = replace(values, exposures=(replace(exposure, latitude=41.25),))  # of no other test
    told = tan_of(values).history
    assert (arguments["mmd"], arguments["med"]) == (6.0, 4.0)
    assert (told.first_day, told.last_day, arguments["hours"]) == (3.0, 10.0, 240)
    whole = doses.of_exposure(values.exposures[0], 6.0, smooth_table().provenance)
    assert np.array_equal(arguments["exposures"].doses, whole.melanogenesis)
    assert np.array_equal(arguments["exposures"].thickening_doses, whole.thickening)
    assert np.all(whole.melanogenesis > 2.0 * whole.thickening)


def test_what_a_table_lacks_is_told_at_once_when_asked_again(table_path, monkeypatch):
    """Masks are simulated before that is clear, which takes seconds."""
    simulated = []

    def counted(*arguments, **more):
        simulated.append(arguments)
        return basis.basis(*arguments, **more)

    monkeypatch.setattr(tan_model, "basis", counted)
    monkeypatch.setattr(SkinTable, "holds", lambda _, states: np.zeros(len(states), bool))
    values = settings(table_path, exposures=(replace(USUAL, dose=3.125), USUAL))
    for _ in range(2):
        with pytest.raises(InputError, match="another schedule"):
            tan_model.basis_of(values, (0, 1), rough=True)
    assert len(simulated) == 1


def test_a_table_that_does_not_say_how_it_tans_is_refused(table):
    with pytest.raises(InputError, match="the table's pigmentation is 'none'"):
        darkest(with_header(table, pigmentation="none"))
    with pytest.raises(InputError, match="the table's melanin dynamics need the rates"):
        darkest(with_header(table, melanin_dynamics={"production": 1.0}))


@pytest.mark.parametrize(
    ("first_day", "last_day", "sentence"),
    [
        (5.0, 5.0, "last day is 5; allowed is more than the first day, 5, to 366"),
        (0.0, float("nan"), "last day is nan; allowed is 0 to 366"),
        (-1.0, 5.0, "first day is -1; allowed is 0 to 366"),
    ],
)
def test_days_out_of_order(first_day, last_day, sentence):
    with pytest.raises(InputError, match=sentence):
        settings(Path(), first_day=first_day, last_day=last_day)


@pytest.mark.parametrize("dose", [0.0, -1.0, float("nan"), 1e308])
def test_minimal_doses_by_hand_out_of_range(dose):
    with pytest.raises(InputError, match="minimal tanning dose is .* allowed is 0.1 to 1000"):
        own_minimal_doses(dose, 4.0)
    with pytest.raises(InputError, match="minimal burn dose is .* allowed is 0.1 to 1000"):
        own_minimal_doses(4.0, dose)


def test_text_of_a_header_cannot_break_a_schedule(table, tmp_path, monkeypatch):
    """Line breaks, terminal escapes, half a surrogate pair: all on a line that can be saved."""
    header = with_header(table, specimen="S3\n0,1e9,1e9\x1b[2J\ud800").provenance
    monkeypatch.setattr(catalogue, "provenance", lambda path: header)
    text = schedule.csv_text("Bo\ndy", settings(tmp_path / "absent.exr"))
    assert "# sun of Bo dy," in text and "# skin: S3 0,1e9,1e9 [2J\n" in text
    text.encode("utf-8")
