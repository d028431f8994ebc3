"""Redness after ultraviolet against what was measured on people, row by row."""

import csv
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

import hylios
from hylios.adding import colours
from hylios.colour_difference import lab
from hylios.tanning import Burns, Exposures

MEASURED = Path(__file__).with_name("erythema_measured.csv")
TYPES = ("I", "II", "III", "IV", "V", "VI")
DOSES = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)
HOURS = (1, 4, 6, 8, 12, 24, 48, 72, 96, 192)
MJ_PER_MED = 30.0


def rows():
    lines = MEASURED.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


@lru_cache
def course(name, dose):
    """Change of L*a*b* at HOURS after a dose in MED, the tan included (T, 3)."""
    skin = replace(hylios.skin_type(name), thickening="epidermis")
    exposures = Exposures([0], [dose * skin.med])
    states = skin.states(exposures, (0, *HOURS), erythema=hylios.erythema(skin))
    seen = lab(colours(skin, states).total)
    return seen[1:] - seen[0]


def redness(name, dose, hour):
    return course(name, dose)[HOURS.index(hour), 1]


@lru_cache
def blood(dose, name="II"):
    """Blood by the hour for ten days after a dose in MED (T,)."""
    skin = hylios.skin_type(name)
    return skin.states(
        Exposures([0], [dose * skin.med]), np.arange(241), erythema=hylios.erythema(skin)
    )[:, 4]


def of_uvb(energy):
    return energy / MJ_PER_MED


def threshold():
    for name in TYPES[:4]:
        assert redness(name, 1.0, 24) == pytest.approx(2.5, abs=0.3)


def linear_in_log_dose():
    """The index of redness is the logarithm of reflectance in the red over that in the green."""
    for name in ("I", "II", "III"):
        skin = replace(hylios.skin_type(name), thickening="epidermis")
        exposures = Exposures([0], np.array([[1.0], [2.0], [4.0]]) * skin.med)
        states = skin.states(exposures, [24], erythema=hylios.erythema(skin))[:, 0]
        green, red = colours(skin, states, bands=[560.0, 650.0]).bands.T
        steps = np.diff(np.log(red / green))
        assert steps == pytest.approx(np.full(2, steps.mean()), rel=0.2)


def sigmoid():
    doses = 2.0 ** np.arange(-6.0, 7.0)
    steps = np.diff([blood(dose)[24] for dose in doses])
    steepest = int(steps.argmax())
    assert 0.5 <= doses[steepest] <= 4.0
    assert np.all(np.diff(steps[: steepest + 1]) > 0.0) and np.all(np.diff(steps[steepest:]) < 0.0)


def blood_volume():
    for name in TYPES:
        assert blood(1.0, name)[8:49:8].min() >= 1.3 and 1.5 <= blood(1.0, name)[24] <= 2.5
    assert blood(1.0)[8:49].min() >= 1.5


def fading():
    """Missed by .4: the rate of what is left is highest at 2.9 times the blood."""
    for dose in (4.0, 8.0):
        left = blood(dose)[30:]
        assert 1.5 < left[np.diff(np.log(left)).argmin()] < 3.0


def onset():
    for dose in (0.5, 1.0):
        assert redness("II", dose, 1) < 0.5
    assert redness("II", 1.0, 4) > 1.0 and redness("II", 2.0, 4) > 2.0


def peak_of_oxyhaemoglobin():
    sampled = np.array([4, 8, 24, 48, 192])
    for energy in (6.0, 15.0, 30.0, 60.0, 120.0):
        assert sampled[blood(of_uvb(energy))[sampled].argmax()] == 24


def peaks():
    hours = [int(blood(dose).argmax()) for dose in (0.25, 1.0, 2.0, 8.0)]
    assert np.all(np.diff(hours) > 0) and hours[0] >= 8 and hours[-1] <= 24


def persistence():
    for energy in (60.0, 120.0, 240.0):
        skin = hylios.skin_type("II")
        burnt, usual = (
            [*skin.untanned_melanin, 1.0, share] for share in (blood(of_uvb(energy))[192], 1.0)
        )
        seen = lab(colours(skin, np.array([burnt, usual])).total)[:, 1]
        assert seen[0] - seen[1] > 0.25
    assert redness("II", 8.0, 192) > 1.5


def oxygenation():
    skin = hylios.skin_type("II")
    usual, burnt = (skin.at([*skin.untanned_melanin, 1.0, share]) for share in (1.0, 3.0))
    whole = np.array([usual.papillary_blood, burnt.papillary_blood])
    oxygenated = 0.01 * whole * np.array([usual.oxygenated_blood, burnt.oxygenated_blood])
    assert np.diff(whole - oxygenated)[0] == pytest.approx(0.03 * np.diff(whole)[0])


def narrowband_peak():
    for dose in (1.0, 2.0):
        assert redness("II", dose, 12) > 0.9 * course("II", dose)[:, 1].max()


def slope():
    slopes = [(redness("II", 4.0, hour) - redness("II", 1.0, hour)) / 2.0 for hour in (8, 24, 48)]
    assert slopes == pytest.approx([np.mean(slopes)] * 3, rel=0.1)


def narrowband_peak_at_2_med():
    assert redness("II", 2.0, 24) == course("II", 2.0)[:, 1].max()


def course_of_type_iii():
    told = course("III", 2.0)
    assert redness("III", 2.0, 6) > 2.0 * redness("III", 2.0, 1)
    assert redness("III", 2.0, 6) > 0.6 * told[:, 1].max()
    assert told[:, 0].argmin() == HOURS.index(24)


def colour_on_day_1():
    for name in TYPES[:4]:
        for dose in (1.0, 2.0, 4.0):
            lightness, red, yellow = course(name, dose)[HOURS.index(24)]
            assert lightness < -0.5 and red > 1.0 and yellow < -0.1


def flow_after_four_days():
    for energy in (133.0, 240.0, 400.0):
        assert blood(of_uvb(energy))[96] > 1.5


def risen_med(days, doses, day):
    """What the MED of type III has risen to at a day of a course with doses in MED."""
    skin = hylios.skin_type("III")
    dynamics = hylios.erythema(skin)
    course = Exposures(24 * np.array(days), skin.med * np.array(doses))
    state = skin.states(course, [24.0 * day])[0]
    tested = Exposures([*course.hours, 24 * day], [*course.doses, 0.0])
    burns = Burns.of(tested, dynamics, skin.med)
    risen = dynamics.protection(burns.hours, burns.doses.T)[-1, 0]
    return risen * dynamics.shield(state[:3].sum(), state[3])


COURSE = np.repeat([1 / 3, 2 / 3, 1.0], 4)


def adaptation_after_6():
    assert risen_med(np.arange(6), COURSE[:6], 6) == pytest.approx(1.5, rel=0.25)


def adaptation_after_12():
    assert risen_med(np.arange(12), COURSE, 12) == pytest.approx(3.2, rel=0.25)


def darker_skin():
    steps = [redness(name, 4.0, 24) - redness(name, 1.0, 24) for name in TYPES]
    assert np.all(np.diff(steps) < 0.0)
    assert np.all(np.diff([redness(name, 2.0, 24) for name in TYPES]) < 0.0)


HELD = {
    "threshold": threshold,
    "linear in log dose": linear_in_log_dose,
    "sigmoid": sigmoid,
    "blood volume": blood_volume,
    "fading": fading,
    "onset": onset,
    "peak of oxyhaemoglobin": peak_of_oxyhaemoglobin,
    "peak of small doses": peaks,
    "peak of large doses": peaks,
    "persistence": persistence,
    "oxygenation": oxygenation,
    "narrowband peak": narrowband_peak,
    "slope": slope,
    "narrowband peak at 2 MED": narrowband_peak_at_2_med,
    "course of type III": course_of_type_iii,
    "colour on day 1": colour_on_day_1,
    "flow after four days": flow_after_four_days,
    "adaptation after 6": adaptation_after_6,
    "adaptation after 12": adaptation_after_12,
    "darker skin": darker_skin,
}


@pytest.mark.parametrize("case", [row["case"] for row in rows() if "not held" not in row["model"]])
def test_as_measured(case):
    HELD[case]()
