"""The tanning model against the thesis, its limits and itself."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS, tanned
from hylios.tanning import (
    LARGEST_DOSE,
    PIGMENTATIONS,
    Exposures,
    MelaninDynamics,
    ThicknessDynamics,
    hill,
    minimal_erythema_dose,
    minimal_melanogenesis_dose,
    simulate,
    simulate_in_parts,
    states_at,
)


def one_dose(dose, pigmentation="intermediate", hours=720, mmd=2.89, med=1.7):
    return simulate(
        Exposures([0], [dose]), PIGMENTATIONS[pigmentation], mmd=mmd, med=med, hours=hours
    )


@pytest.mark.parametrize("name", list(PIGMENTATIONS))
def test_steady_states_of_table_6_4_sum_to_one(name):
    assert PIGMENTATIONS[name].steady_state().sum() == pytest.approx(1.0, abs=3e-4)


@pytest.mark.parametrize(
    ("name", "total"), [("low", 1.098), ("intermediate", 1.097), ("high", 1.096)]
)
def test_one_mmd_raises_melanin_by_a_tenth_in_a_week(name, total):
    """Figure B.1: about 10 % on day 7 after 1 MMD."""
    history = simulate(Exposures([0], [1.0]), PIGMENTATIONS[name], mmd=1.0, med=1.0, hours=168)
    assert history.total[168] == pytest.approx(total, abs=6e-4)


def test_a_day_at_the_beach():
    """Figure 6.29: 30 SED, intermediate set: fast rise, broad top near day 10, slow fading."""
    history = one_dose(30.0)
    assert history.total.max() == pytest.approx(1.90, abs=0.005)
    assert 9.0 <= history.hours[history.total.argmax()] / 24.0 <= 10.5
    assert history.total[-1] == pytest.approx(1.33, abs=0.005)


@pytest.mark.parametrize("name", list(PIGMENTATIONS))
def test_no_dose_no_change_for_a_year(name):
    history = simulate(Exposures(), PIGMENTATIONS[name], mmd=2.89, med=1.7, hours=8760)
    assert np.abs(history.total - 1.0).max() < 1e-12
    assert np.abs(history.melanin - history.melanin[0]).max() < 1e-12
    assert np.abs(history.thickness - 1.0).max() < 1e-12


def test_photoaddition():
    """Figure 6.21: small doses on successive days add to nearly the response of one large dose,
    while each alone does little."""
    dynamics = PIGMENTATIONS["low"]
    settings_ = {"mmd": 2.89, "med": 1.7, "hours": 960}
    large = simulate(Exposures([0], [10.0]), dynamics, **settings_).total.max() - 1.0
    days = 24 * np.arange(4)
    small = simulate(Exposures(days, np.full(4, 2.5)), dynamics, **settings_).total.max() - 1.0
    alone = simulate(Exposures([0], [2.5]), dynamics, **settings_).total.max() - 1.0
    assert alone == 0.0
    third = simulate(Exposures([0], [3.4]), dynamics, **settings_).total.max() - 1.0
    thirds = simulate(Exposures([0, 24, 48], np.full(3, 3.4)), dynamics, **settings_).total.max()
    assert third < 0.75 * large
    assert thirds - 1.0 == pytest.approx(large, rel=0.15)
    assert 0.4 * large < small < large


def test_the_threshold_is_one_mmd():
    below = one_dose(0.999 * 2.89).total
    at = one_dose(2.89).total
    assert np.abs(below - 1.0).max() < 1e-12
    assert at.max() > 1.09


def test_hour_by_hour_by_hand():
    """The first hours after 2 MMD and 2 MED, written out from 5.5 to 5.12 and 5.21 to 5.27."""
    dynamics = PIGMENTATIONS["intermediate"]
    history = simulate(Exposures([0], [2.0]), dynamics, mmd=1.0, med=1.0, hours=2)
    energy, rate, signal = 2.0, 2.0, 2.0
    response = signal**0.7 / (signal**0.7 + 500.0**0.7)
    steady = dynamics.steady_state()
    moved = (0.0250 * response + 0.0051) * steady[0]
    energy *= 0.98
    rate = energy + rate * 0.99
    signal = rate + signal * 0.985
    response = signal**0.7 / (signal**0.7 + 500.0**0.7)
    basale = 0.0075 * response + 0.0080 + 0.99 * (steady[0] - moved)
    assert history.melanin[1, 0] == pytest.approx(basale / steady.sum(), rel=1e-12)

    rate = 2.0 * 0.985 + 2.0 * 0.2
    signal = rate + 2.0 * 0.98
    made = 0.1 + 0.025 * signal / (signal + 20.0)
    assert history.thickness[1] == pytest.approx((made + 0.9) / 1.0, rel=1e-12)


def test_thickness_is_bounded_by_its_parameters():
    """The Hill factor is at most 1: 5.27 cannot pass (production + extra) / (1 - decay)."""
    days = 24 * np.arange(60)
    history = simulate(
        Exposures(days, np.full(60, 1e6)), PIGMENTATIONS["low"], mmd=1.0, med=1.0, hours=1440
    )
    model = ThicknessDynamics()
    bound = (model.production + model.extra_production) / model.production
    assert history.thickness.max() <= bound + 1e-12
    assert bound == pytest.approx(1.25)


def by_the_letter(doses, dynamics, growing, mmd, med):
    """Equations 5.4 to 5.12 and 5.20 to 5.27, hour by hour in plain numbers; states (T, 4)."""
    melanin, thickness = dynamics.steady_state().tolist(), growing.steady_state()
    start = sum(melanin), thickness
    chains, response, states = {dynamics: (0.0, 0.0, 0.0), growing: (0.0, 0.0, 0.0)}, {}, []
    leaving = None
    for hour, dose in enumerate(doses):
        for chain, least in ((dynamics, mmd), (growing, med)):
            energy, rate, signal = chains[chain]
            energy = dose / least + energy * chain.energy_decay
            rate = (energy if energy >= 1.0 else 0.0) + rate * chain.signal_rate_decay
            signal = rate + signal * chain.signal_decay
            chains[chain] = energy, rate, signal
            power = signal**chain.hill_exponent
            response[chain] = power / (power + chain.hill_constant**chain.hill_exponent)
        if hour:
            before = list(melanin)
            for layer in range(3):
                made = response[dynamics] * dynamics.extra_production[layer]
                melanin[layer] = made + dynamics.production[layer]
                kept = dynamics.melanin_decay * (1.0 - leaving[layer])
                melanin[layer] += kept * before[layer]
                if layer:
                    melanin[layer] += leaving[layer - 1] * before[layer - 1]
            made = response[growing] * growing.extra_production + growing.production
            thickness = made + thickness * growing.cell_decay
        rates = zip(dynamics.extra_transfer, dynamics.transfer, strict=True)
        leaving = [response[dynamics] * extra + usual for extra, usual in rates]
        states.append([*(content / start[0] for content in melanin), thickness / start[1]])
    return np.array(states)


@pytest.mark.parametrize("name", list(PIGMENTATIONS))
@pytest.mark.parametrize("hours", [1, 23, 24, 25, 700, 14_000])
def test_the_equations_to_the_letter(name, hours):
    """However time is cut into blocks: to rounding."""
    random = np.random.default_rng(5)
    when = random.integers(0, hours + 1, 12)
    doses = random.uniform(0.5, 30.0, 12)
    by_hour = np.bincount(when, doses, hours + 1)
    expected = by_the_letter(by_hour, PIGMENTATIONS[name], ThicknessDynamics(), 2.89, 1.7)
    history = simulate(Exposures(when, doses), PIGMENTATIONS[name], mmd=2.89, med=1.7, hours=hours)
    assert np.array_equal(history.hours, np.arange(hours + 1))
    assert np.allclose(history.states, expected, rtol=1e-12, atol=0.0)


@settings(max_examples=30)
@given(
    rates=st.lists(st.floats(0.0, 0.5), min_size=12, max_size=12),
    decays=st.lists(st.floats(0.0, 0.999), min_size=4, max_size=4),
    exponent=st.floats(0.01, 20.0),
    constant=st.floats(1e-6, 1e6),
    dose=st.sampled_from([0.0, 1.0, 30.0, LARGEST_DOSE]),
)
def test_any_parameters_give_what_the_equations_say(rates, decays, exponent, constant, dose):
    parts = zip(*[iter(rates)] * 3, strict=True)
    production, transfer, extra_production, extra_transfer = (tuple(part) for part in parts)
    dynamics = MelaninDynamics(
        (0.01, *production[1:]), transfer, extra_production, extra_transfer, *decays
    )
    dynamics = replace(dynamics, hill_exponent=exponent, hill_constant=constant)
    states = simulate(Exposures([3], [dose]), dynamics, mmd=1.0, med=1.0, hours=60).states
    assert np.all(np.isfinite(states)) and np.all(states >= 0.0)
    signal = np.float64(dose) ** exponent
    if np.isfinite(signal * 60.0**exponent):
        doses = np.zeros(61)
        doses[3] = dose
        with np.errstate(all="ignore"):
            expected = by_the_letter(doses, dynamics, ThicknessDynamics(), 1.0, 1.0)
        if np.all(np.isfinite(expected)):
            assert np.allclose(states, expected, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("name", list(PIGMENTATIONS))
def test_a_century_after_a_dose_the_skin_is_as_before(name):
    exposures = Exposures([0], [30.0])
    times = [0.0, 24.0 * 366.0 * 100.0]
    states = states_at(exposures, PIGMENTATIONS[name], times=times, mmd=2.89, med=1.7)
    assert np.allclose(states[1], states[0], rtol=1e-12)


def test_a_thousand_exposures():
    """A dose every day for nearly three years: a steady tan, as the equations say."""
    hours = 24 * np.arange(1000)
    doses = np.zeros(24_001)
    doses[hours] = 10.0
    dynamics = PIGMENTATIONS["intermediate"]
    history = simulate(
        Exposures(hours, np.full(1000, 10.0)), dynamics, mmd=2.89, med=1.7, hours=24_000
    )
    expected = by_the_letter(doses, dynamics, ThicknessDynamics(), 2.89, 1.7)
    assert np.allclose(history.states, expected, rtol=1e-11)
    days = history.total[:24_000].reshape(1000, 24)
    assert np.abs(days[900] - days[901]).max() < 1e-9


@pytest.mark.parametrize("dose", [0.0, 1e-300, 2.8])
def test_a_dose_below_the_threshold_leaves_exactly_the_start(dose):
    states = states_at(
        Exposures([0], [dose], [0.0]),
        PIGMENTATIONS["low"],
        times=np.arange(1000),
        mmd=2.89,
        med=1.7,
    )
    steady = PIGMENTATIONS["low"].steady_state()
    assert np.all(states == np.append(steady / steady.sum(), 1.0))


def test_the_response_saturates():
    """At 1e6 SED and more the Hill factor is all but 1: ten thousand times as much adds nothing."""
    settings_ = {"mmd": 2.89, "med": 1.7, "hours": 720}
    most = simulate(Exposures([0], [1e12]), PIGMENTATIONS["low"], **settings_).total
    much = simulate(Exposures([0], [1e8]), PIGMENTATIONS["low"], **settings_).total
    assert np.abs(most - much)[:480].max() < 0.02
    bound = PIGMENTATIONS["low"]
    full = replace(
        bound,
        production=(bound.production[0] + bound.extra_production[0], 0.0, 0.0),
        transfer=tuple(np.add(bound.transfer, bound.extra_transfer)),
    )
    assert most[480] == pytest.approx(full.steady_state().sum(), rel=0.05)


def test_two_doses_in_one_hour_are_one_dose():
    dynamics = PIGMENTATIONS["low"]
    two = simulate(Exposures([5, 5], [4.0, 6.0]), dynamics, mmd=2.89, med=1.7, hours=200)
    one = simulate(Exposures([5], [10.0]), dynamics, mmd=2.89, med=1.7, hours=200)
    assert np.array_equal(two.melanin, one.melanin)


def test_a_later_dose_changes_nothing_before_it():
    dynamics = PIGMENTATIONS["low"]
    early = simulate(Exposures([0], [10.0]), dynamics, mmd=2.89, med=1.7, hours=100)
    both = simulate(Exposures([100, 0], [9.0, 10.0]), dynamics, mmd=2.89, med=1.7, hours=200)
    assert np.array_equal(both.melanin[:100], early.melanin[:100])
    late = simulate(Exposures([0, 500], [10.0, 9.0]), dynamics, mmd=2.89, med=1.7, hours=100)
    assert np.array_equal(late.melanin, early.melanin)


@settings(max_examples=40)
@given(
    doses=st.lists(st.sampled_from([0.0, 1e-300, 1e-3, 1.0, 30.0, 1e6, LARGEST_DOSE]), max_size=20),
    name=st.sampled_from(list(PIGMENTATIONS)),
)
def test_extreme_doses_give_bounded_states(doses, name):
    history = simulate(
        Exposures(np.arange(len(doses)), doses), PIGMENTATIONS[name], mmd=2.89, med=1.7, hours=100
    )
    assert np.all(np.isfinite(history.states))
    assert np.all(history.states >= 0)
    assert history.thickness.max() <= 1.25 + 1e-12


def test_hill_from_nothing_to_everything():
    signal = np.array([0.0, 1e-300, 500.0, 1e300])
    assert np.allclose(hill(signal, 500.0, 0.7), [0.0, 0.0, 0.5, 1.0], atol=1e-15)


def test_minimal_doses():
    """Equations 3.1 and 3.2 at the ends of their range, by hand."""
    assert minimal_erythema_dose(0.013) == pytest.approx(2.4193, abs=1e-3)
    assert minimal_melanogenesis_dose(0.43) == pytest.approx(39.155, abs=1e-2)
    with pytest.raises(InputError, match="pigmentation level is 0.5; allowed is 0.013 to 0.43"):
        minimal_erythema_dose(0.5)


@pytest.mark.parametrize("name", list(SPECIMENS))
def test_a_state_scales_melanin_and_thickness(name):
    """5.16: the total of melanin times thickness follows the state, whatever the thickness."""
    usual = SPECIMENS[name]
    state = np.array([0.5, 0.9, 0.3])
    changed = tanned(usual, state, 1.2)
    before = usual.melanin @ usual.epidermal_thickness
    after = changed.melanin @ changed.epidermal_thickness
    assert after == pytest.approx(before * state.sum())
    assert changed.papillary_thickness == pytest.approx(1.2 * usual.papillary_thickness)
    inside = 0.01 * usual.basale_melanosomes / usual.melanin[0]
    assert 0.01 * changed.basale_melanosomes / changed.melanin[0] == pytest.approx(inside)


def test_melanin_never_fills_more_than_its_layer():
    full = tanned(SPECIMENS["S4"], np.array([4.0, 0.1, 0.1]), 1.0)
    assert full.melanin[0] == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("exposures", "sentence"),
    [
        (lambda: Exposures([-1], [1.0]), "an hour of exposure is"),
        (lambda: Exposures([0.5], [1.0]), "an hour of exposure is"),
        (lambda: Exposures([np.inf], [1.0]), "an hour of exposure is"),
        (lambda: Exposures([1e19], [1.0]), "an hour of exposure is"),
        (lambda: Exposures([0], [1.0], [1.0, 2.0]), "the last axis must match"),
        (lambda: Exposures([0], [-1.0]), "a dose is negative"),
        (lambda: Exposures([0], [np.nan]), "a dose is negative, not finite or too large"),
        (lambda: Exposures([0], [1e308]), "allowed is 0 to 1e\\+12 SED"),
        (lambda: Exposures([0, 1], [1.0]), "the last axis must match"),
        (lambda: Exposures(0, [1.0]), r"hours of exposure have shape \(\); expected one row"),
        (lambda: Exposures(["noon"], [1.0]), "hours of exposure are .*expected an array of numb"),
        (lambda: Exposures([0, 1], [[1.0], [1.0, 2.0]]), "doses are .* expected an array of numb"),
        (lambda: Exposures(np.arange(-1, 10**5), np.ones(10**5 + 1)), "^.{,60}$"),
    ],
)
def test_bad_exposures_are_named(exposures, sentence):
    with pytest.raises(InputError, match=sentence):
        exposures()


def test_bad_minimal_dose_is_named():
    with pytest.raises(InputError, match="MMD is 0 SED; allowed is"):
        simulate(Exposures(), PIGMENTATIONS["low"], mmd=0.0, med=1.0, hours=1)
    for none in ("2", None, [1.0, 2.0]):
        with pytest.raises(InputError, match="MED is .*; expected a number"):
            simulate(Exposures(), PIGMENTATIONS["low"], mmd=1.0, med=none, hours=1)
    with pytest.raises(InputError, match="number of hours is '10'; expected a number"):
        simulate(Exposures(), PIGMENTATIONS["low"], mmd=1.0, med=1.0, hours="10")


def test_doses_are_kept_as_they_were_checked():
    given = np.array([1.0])
    exposures = Exposures([0], given)
    given[0] = -1.0
    assert exposures.doses[0] == 1.0


def test_bad_dynamics_are_named():
    with pytest.raises(InputError, match="melanin_decay is 1; allowed is"):
        replace(PIGMENTATIONS["low"], melanin_decay=1.0)
    with pytest.raises(InputError, match="production rate of melanin is -1"):
        replace(PIGMENTATIONS["low"], production=(-1.0, 0.0, 0.0))
    with pytest.raises(InputError, match="transfer with extra transfer is 1.1; allowed is 0 to 1"):
        replace(PIGMENTATIONS["low"], transfer=(0.6, 0, 0), extra_transfer=(0.5, 0, 0))
    with pytest.raises(InputError, match="melanin production is 0 in every layer"):
        replace(PIGMENTATIONS["low"], production=(0.0, 0.0, 0.0))


def test_a_dose_for_the_thickness_of_its_own():
    """Only the thickness follows it."""
    dynamics = PIGMENTATIONS["low"]
    usual = simulate(Exposures([0], [10.0]), dynamics, mmd=2.89, med=1.7, hours=100)
    thin = simulate(Exposures([0], [10.0], [0.0]), dynamics, mmd=2.89, med=1.7, hours=100)
    assert np.array_equal(thin.melanin, usual.melanin)
    assert np.all(thin.thickness == thin.thickness[0])


@pytest.mark.parametrize(("hours", "step"), [(0, 1), (1, 24), (500, 1), (500, 7), (30, 1 / 60)])
def test_parts_of_a_history_are_the_history_to_the_last_bit(hours, step):
    skin = {"melanin": PIGMENTATIONS["high"], "mmd": 3.0, "med": 2.0, "hours": hours, "step": step}
    exposures = Exposures([0, 20, 480], [30.0, 9.0, 4.0], [25.0, 8.0, 4.0])
    whole = simulate(exposures, **skin)
    parts = list(simulate_in_parts(exposures, **skin, rows=100))
    assert max(part.hours.size for part in parts) <= 100
    for name in ("hours", "melanin", "thickness"):
        joined = np.concatenate([getattr(part, name) for part in parts])
        assert np.array_equal(joined, getattr(whole, name))


def test_minutes_of_ten_years_need_little_memory():
    """5.3 million rows, of which the states alone would have 170 MB."""
    exposures = Exposures([0], [30.0])
    parts = simulate_in_parts(
        exposures, PIGMENTATIONS["low"], mmd=3.0, med=2.0, hours=24 * 3653, step=1 / 60
    )
    tracemalloc.start()
    rows = sum(part.hours.size for part in parts)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert rows == 24 * 3653 * 60 + 1
    assert peak < 40e6
