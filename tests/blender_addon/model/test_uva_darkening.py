"""Melanin that darkens at once, in what a shader samples, against the model by the hour."""

from dataclasses import replace
from datetime import date

import numpy as np
import pytest
from exposures import USUAL
from sampled import coordinates
from test_basis import seen

from blender_addon.model import catalogue
from blender_addon.model.basis import basis
from blender_addon.model.history import DRAG, FULL, history
from blender_addon.model.settings import TanSettings
from blender_addon.model.tan import history_of
from hylios.sun.action_spectra import Absorptance
from hylios.sun.doses import joined, of_sed, of_sun
from hylios.tanning import PIGMENTATIONS, Exposures, ImmediateDarkening, states_at

SKIN = {"mmd": 4.9, "med": 2.9}
MELANIN = PIGMENTATIONS["intermediate"]
START = date(2025, 6, 20)
FLAT = Absorptance([280.0, 400.0], [0.9, 0.7])
DAYS = [
    of_sun(date(2025, 6, day), 11, 15, 40.0, FLAT, start=START, cloud=cloud)
    for day, cloud in ((20, 0.3), (23, 0.0), (30, 0.9))
]
SUN = joined([*DAYS, of_sed(100, 6.0)])
"""Of the last dose no UVA is known."""


def expected(received, shares, hours, uva) -> np.ndarray:
    """u (N,) of one place after another, with shares (N, E) of the doses and UVA (E,)."""
    exposures = Exposures(received.hours, shares * received.melanogenesis)
    times, which = np.unique(hours, return_inverse=True)
    states = states_at(exposures, MELANIN, times=times, **SKIN)
    factor = ImmediateDarkening().factor(received.hours, shares * uva, times)
    own = np.arange(len(shares)), which
    return np.log(states[own][:, :3].sum(axis=1) * factor[own])


@pytest.mark.parametrize("precision", [FULL, DRAG])
def test_history_against_the_model_by_the_hour(precision):
    random = np.random.default_rng(1)
    shares = random.random(300)
    hours = random.choice(np.r_[8:120, 240:330, 330:700:10], 300)
    span = {"first_day": 0.0, "last_day": 30.0}
    told, states = history(SUN, MELANIN, precision=precision, darkens=True, **span, **SKIN)
    seen = coordinates(told, shares, hours / 24.0)[:, 0]
    wanted = expected(SUN, shares[:, None], hours, SUN.uva)
    error = np.abs(seen - wanted)
    assert error.mean() < 0.003
    assert np.quantile(error, 0.99) < 0.02
    plain, undarkened = history(SUN, MELANIN, precision=precision, **span, **SKIN)
    assert np.abs(coordinates(plain, shares, hours / 24.0)[:, 0] - wanted).max() > 0.1
    # What a table must hold is the tan.
    assert states[..., :3].sum(axis=-1).max() == pytest.approx(
        undarkened[..., :3].sum(axis=-1).max(), rel=0.01
    )


def test_a_basis_darkens_too():
    random = np.random.default_rng(2)
    shares = random.random((200, 2))
    received = [joined(DAYS[:2]), joined([DAYS[2], of_sed(100, 6.0)])]
    made, _ = basis(received, MELANIN, first_day=0.0, last_day=20.0, darkens=True, **SKIN)
    hours = random.choice(np.r_[8:120, 240:330], 200)
    both = joined(received)
    which = np.repeat([0, 1], [own.hours.size for own in received])
    told = seen(made, shares, hours / 24.0)[:, 0]
    error = np.abs(told - expected(both, shares[:, which], hours, both.uva))
    assert error.mean() < 0.004 and error.max() < 0.045


def test_it_is_off_unless_set_and_only_of_light_whose_uva_is_known():
    path = catalogue.shipped_path("III")
    settings = TanSettings(path, None, (replace(USUAL, unit="SUN"),), 0.0, 10.0)
    bare, day = np.ones(1), np.ones(1)
    plain = coordinates(history_of(settings), bare, day)
    dark = coordinates(history_of(replace(settings, darkening=True)), bare, day)
    assert 0.1 < dark[0, 0] - plain[0, 0] < 0.4
    unknown = replace(settings, exposures=(USUAL,))
    assert np.array_equal(
        history_of(replace(unknown, darkening=True)).coordinates,
        history_of(unknown).coordinates,
    )
