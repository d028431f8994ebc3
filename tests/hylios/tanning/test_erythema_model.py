"""The model of redness against a plain loop, its limits and itself."""

from dataclasses import replace

import numpy as np
import pytest

import hylios
from hylios.adding import colours
from hylios.colour_difference import ciede2000, lab
from hylios.errors import InputError
from hylios.skin import whole_thickening
from hylios.tanning import (
    LARGEST_DOSE,
    PIGMENTATIONS,
    Burns,
    ErythemaDynamics,
    Exposures,
    simulate,
    simulate_in_parts,
    states_at,
)
from hylios.tanning.shares import retained, states_of_shares

SKIN = {"mmd": 4.9, "med": 2.9}
REDDENING = ErythemaDynamics(sensitivity=0.9, melanin_shield=0.6, thickness_shield=0.1)
LOW = PIGMENTATIONS["low"]


def schedule(seed, count=12, histories=3, days=20):
    random = np.random.default_rng(seed)
    hours = random.integers(0, 24 * days, count)
    return Exposures(hours, random.uniform(0.0, 12.0, (histories, count)))


def by_the_letter(exposures, states, own):
    """Blood of one history by the hour, from its states by the hour, in a loop."""
    energy = rate = early = late = kept = risen = 0.0
    blood = []
    for hour, state in enumerate(states):
        kept, risen = own.protection_decay * kept, own.protection_rise * risen
        acting = max(kept - risen, 0.0) ** own.protection_exponent
        reached = acting / (acting + own.protection_constant**own.protection_exponent)
        shield = own.most_protection**reached * np.exp(
            own.melanin_shield * (state[:3].sum() - 1.0) + own.thickness_shield * (state[3] - 1.0)
        )
        dose = exposures.doses[exposures.hours == hour].sum() / SKIN["med"]
        kept, risen = kept + dose, risen + dose
        energy = dose / shield + own.energy_decay * energy
        rate = (1.0 - own.rate_decay) * energy + own.rate_decay * rate
        early = (1.0 - own.early_decay) * rate + own.early_decay * early
        late = (1.0 - own.late_decay) * rate + own.late_decay * late
        y = own.sensitivity * (
            early / own.early_constant + (late / own.late_constant) ** own.late_exponent
        )
        blood.append(1.0 + own.added_blood * y / (1.0 + y))
    blood[0] = 1.0
    return np.array(blood)


def test_against_a_plain_loop():
    exposures, times = schedule(1, histories=1), np.arange(24 * 22)
    states = states_at(exposures, LOW, times=times, erythema=REDDENING, **SKIN)[0]
    one = Exposures(exposures.hours, exposures.doses[0])
    assert states[:, 4] == pytest.approx(by_the_letter(one, states, REDDENING), abs=1e-9)


def test_the_thesis_s_states_are_what_they_were():
    exposures, times = schedule(2), np.linspace(0.0, 480.0, 77)
    usual = states_at(exposures, LOW, times=times, **SKIN)
    reddened = states_at(exposures, LOW, times=times, erythema=REDDENING, **SKIN)
    assert usual.shape == (3, 77, 4) and reddened.shape == (3, 77, 5)
    assert np.array_equal(reddened[..., :4], usual)


def test_without_sun_there_is_no_redness():
    nothing = states_at(Exposures(), LOW, times=[0, 5, 8760], erythema=REDDENING, **SKIN)
    none = Exposures([0, 30], [0.0, 0.0])
    assert np.all(nothing[:, 4] == 1.0)
    assert np.all(states_at(none, LOW, times=[0, 99], erythema=REDDENING, **SKIN)[:, 4] == 1.0)
    assert states_at(none, LOW, times=[], erythema=REDDENING, **SKIN).shape == (0, 5)


def test_a_history_of_a_batch_is_that_history_alone():
    exposures, times = schedule(3, count=40, histories=7), np.arange(0.0, 500.0, 2.5)
    together = states_at(exposures, LOW, times=times, erythema=REDDENING, **SKIN)
    for own, doses in zip(together, exposures.doses, strict=True):
        alone = Exposures(exposures.hours, doses)
        assert np.array_equal(states_at(alone, LOW, times=times, erythema=REDDENING, **SKIN), own)


def test_parts_and_steps():
    exposures = Exposures([0, 30, 31, 200], [5.0, 3.0, 3.0, 20.0])
    usual = {"hours": 300, "erythema": REDDENING, **SKIN}
    for step in (0.25, 1, 6):
        whole = simulate(exposures, LOW, step=step, **usual)
        parts = list(simulate_in_parts(exposures, LOW, step=step, rows=31, **usual))
        assert np.array_equal(np.concatenate([part.states for part in parts]), whole.states)
        assert whole.states.shape[1] == 5 and whole.blood is not None
    hourly = simulate(exposures, LOW, **usual).blood
    fine = simulate(exposures, LOW, step=0.5, **usual).blood
    assert fine[::2] == pytest.approx(hourly, abs=1e-12)
    assert fine[1::2] == pytest.approx(0.5 * (hourly[1:] + hourly[:-1]), abs=1e-12)
    coarse = simulate(exposures, LOW, step=6, **usual).blood
    assert coarse == pytest.approx(hourly[::6], abs=0.02)


def test_a_state_is_the_same_whichever_times_are_told_with_it():
    exposures = schedule(8)

    def told(times):
        return states_at(exposures, LOW, times=times, erythema=REDDENING, **SKIN)

    whole = told(np.arange(480.0))
    assert np.array_equal(told(np.arange(0.0, 480.0, 0.5))[:, ::2], whole)
    assert np.array_equal(told(np.arange(480.0)[::-1])[:, ::-1], whole)
    assert np.allclose(told([77.0, 3.0, 3.0]), whole[:, [77, 3, 3]], rtol=1e-12)
    assert np.allclose(told(24.0 * np.arange(20)), whole[:, ::24], rtol=1e-12)


def test_a_later_exposure_changes_nothing_before_it():
    early, both = Exposures([5], [9.0]), Exposures([300, 5], [9.0, 9.0])
    times = np.arange(300)
    told = [
        states_at(own, LOW, times=times, erythema=REDDENING, **SKIN)[:, 4] for own in (early, both)
    ]
    assert told[0] == pytest.approx(told[1], abs=1e-12)


@pytest.mark.parametrize("kinds", [1, 3])
def test_places_with_shares(kinds):
    random = np.random.default_rng(kinds)
    exposures = schedule(4, histories=kinds)
    shares = random.random((9, kinds))
    received = Exposures(exposures.hours, shares @ exposures.doses)
    energies = retained(exposures, LOW, hours=500, **SKIN)
    burns = Burns.of(exposures, REDDENING, SKIN["med"])
    begun = np.unique(exposures.hours)
    uneven = np.unique([0, *begun, *(begun + 1), *(begun + 9), *np.arange(3, 500, 11)])
    for marks in (np.arange(500), uneven[uneven < 500]):
        expected = states_at(received, LOW, times=marks, erythema=REDDENING, **SKIN)
        for dtype, bound in ((np.float64, 3e-3), (np.float32, 3.1e-3)):
            states = states_of_shares(energies, shares, marks, dtype, burns)
            assert states.dtype == dtype and states.shape == (len(marks), 9, 5)
            within = 1e-9 if dtype == np.float64 and len(marks) == 500 else bound
            assert np.abs(states[..., 4].T - expected[..., 4]).max() < within


def test_the_largest_doses():
    for med in (1e-6, 1e6):
        states = states_at(
            Exposures([0, 1], [LARGEST_DOSE, LARGEST_DOSE]),
            LOW,
            times=np.arange(100),
            mmd=1.0,
            med=med,
            erythema=REDDENING,
        )
        assert np.all((states[:, 4] >= 1.0) & (states[:, 4] <= 1.0 + REDDENING.added_blood))


def test_the_shield_is_that_of_the_epidermis():
    """More melanin, and more in dark skin; thickness adds what keratin and DNA absorb."""
    own = [hylios.erythema(hylios.skin_type(name)) for name in ("I", "II", "III", "IV", "V", "VI")]
    assert np.all(np.diff([one.melanin_shield for one in own]) > 0.0)
    assert all(0.02 < one.thickness_shield < 0.5 for one in own)
    assert own[1].shield(2.0, 1.0) == pytest.approx(np.exp(own[1].melanin_shield))


def test_only_the_epidermis_thickens():
    skin = hylios.skin_type("III")
    state = [*(1.2 * skin.untanned_melanin), 1.2, 2.0]
    whole, upper = skin.at(state), replace(skin, thickening="epidermis").at(state)
    assert whole.papillary_thickness == pytest.approx(1.2 * skin.specimen.papillary_thickness)
    own = ("papillary_thickness", "reticular_thickness")
    assert upper == replace(whole, **{name: getattr(skin.specimen, name) for name in own})
    with pytest.raises(InputError, match="thickening is 'dermis'; allowed is skin, epidermis"):
        replace(skin, thickening="dermis")


@pytest.mark.parametrize("name", ["I", "III", "VI"])
def test_one_table_holds_both_ways_of_thickening(name):
    skin = hylios.skin_type(name)
    reddening = hylios.erythema(skin)
    times = [8, 24, 72, 168, 240]
    states = [
        skin.states(Exposures(days, np.full(len(days), dose * skin.med)), times, erythema=reddening)
        for days, dose in (([0], 4.0), ([0, 24, 48, 72], 2.0))
    ]
    states = np.concatenate(states)
    thick = replace(skin, thickening="epidermis")
    exact = lab(colours(thick, states).total)
    alike = ciede2000(exact, lab(colours(skin, whole_thickening(states)).total))
    assert alike.mean() < 0.1 and alike.max() < 0.2
    assert np.all(whole_thickening(states[:, :4])[:, 3:] == 1.0)
    with pytest.raises(InputError, match="shape"):
        whole_thickening(states[:, :3])
    if name == "I":
        assert ciede2000(exact, lab(colours(skin, states).total)).max() > 0.5


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"late_decay": 1.0}, "late_decay of redness is 1"),
        ({"late_decay": 0.77}, "allowed are four that differ by 0.001"),
        ({"protection_rise": 0.999}, "protection_rise is 0.999; allowed is 0 to 0.998"),
        ({"early_constant": 0.0}, "early_constant is 0 MED"),
        ({"added_blood": 12.0}, "added_blood is 12; allowed is 0 to 11"),
        ({"sensitivity": float("nan")}, "sensitivity of redness is nan"),
        ({"most_protection": 0.5}, "most_protection is 0.5; allowed is 1 to 1000"),
        ({"melanin_shield": -1.0}, "melanin_shield is -1; allowed is 0 to 1000"),
    ],
)
def test_parameters_out_of_range_are_refused(change, said):
    with pytest.raises(InputError, match=said):
        ErythemaDynamics(**change)


def test_what_is_no_skin_and_no_dynamics_is_refused():
    with pytest.raises(InputError, match="the skin is 'II'; expected a Skin"):
        hylios.erythema("II")
    with pytest.raises(InputError, match="erythema is 'True'; expected ErythemaDynamics"):
        states_at(Exposures([0], [1.0]), LOW, times=[1], erythema=True, **SKIN)
