"""Profiles from paths that are shared between stacks, against walks of each stack's own.

Pearson's tests are at 1e-4, as are bounds of 3.9 standard errors: with the 15 or so in here correct
code fails for about one seed in 600. Seeds are fixed.
"""

from dataclasses import replace

import numpy as np
import pytest
from path_weights import (
    LEVEL,
    STATES,
    assert_same_light,
    changed,
    exits,
    skin_stack,
    tans,
    walked,
)
from scipy import stats

from hylios.adding.solver import solve
from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS, tanned
from hylios.tissue import Layer, Stack
from hylios.transport import shared_profiles
from hylios.transport.equivalent import GONE_THROUGH, TRIED
from hylios.transport.shared_profiles import Profiles, needed_samples, profiles, skin_profiles
from hylios.transport.simulate import CHUNK, DISTANCE_EDGES


@pytest.mark.parametrize("name", ["S3", "S4"])
@pytest.mark.parametrize("wavelength", [365.0, 550.0, 1650.0])
def test_profiles_of_a_tan(name, wavelength):
    """Every state against its own rays, and its reflectance against the solver without noise.

    That is right to some 3e-4, and to 1 % of what comes out of S4.
    """
    stacks = tans(name, wavelength)
    error_limit = 0.01 if name == "S3" else 0.02
    pooled = profiles(stacks, error=error_limit, key=(11,), threads=2)
    needed = needed_samples(pooled.subsurface, error_limit)
    assert np.all(pooled.effective_sample_size >= needed)
    assert np.all(pooled.standard_error.max(axis=1) <= 0.5 / np.sqrt(needed))
    solved = solve(stacks, 8.0).subsurface
    error = np.hypot(pooled.subsurface_error, np.hypot(3e-4, 0.01 * solved))
    assert np.all(np.abs(pooled.subsurface - solved) < 3.9 * error)
    for number, stack in enumerate(stacks):
        rays = int(0.8 * needed[number] / solved[number])
        assert_same_light(
            pooled.light[number], pooled.squares[number], exits(stack, rays, (12,)), rays
        )


def test_dark_skin_s_profile_may_be_less_sure_by_what_the_eye_misses():
    """Where a share of the light is missing, lightness falls by 116 / 3 of the cube root of the
    light times that share: the same for all with their errors, and never more."""
    light = np.array([0.9, 0.3, 0.1, 0.03])
    error = 0.5 / np.sqrt(needed_samples(light, 0.01))
    assert error[:2] == pytest.approx(0.01)
    falls = 116.0 * (np.cbrt(light) - np.cbrt(light * (1.0 - error)))
    assert falls[1:] == pytest.approx(falls[1], rel=0.05)
    assert needed_samples(1e-9, 0.01) == pytest.approx(25.0)
    assert needed_samples(0.0, 0.1) == pytest.approx(25.0)


@pytest.mark.filterwarnings("error")
def test_a_channel_with_less_light_than_none_says_that_nothing_is_known():
    """A colour channel's weights have signs: noise can leave it less than nothing."""
    light = np.array([[0.2, -0.3, 0.05], [0.0, 0.0, 0.0], [0.1, 0.2, 0.1]])
    squares = np.array([[1e-2, 1e-2, 1e-3], [0.0, 0.0, 0.0], [1e-6, 1e-6, 1e-6]])
    pooled = Profiles(light, squares, np.ones(3, int), np.zeros(3, bool))
    assert pooled.standard_error[:2].tolist() == [[1.0] * 3] * 2 and not pooled.within[:2].any()
    assert pooled.within[2] == pytest.approx([0.25, 0.75, 1.0])
    assert 0.0 < pooled.standard_error[2].max() < 0.01


def test_rays_are_shared():
    """Close states need little more than the darkest of them alone."""
    melanin, factors = np.array([0.4, 0.4, 0.2]), np.linspace(0.9, 1.1, 12)
    stacks = tans("S3", 550.0, [(tuple(melanin * factor), 1.0) for factor in factors])
    pooled = profiles(stacks, error=0.01, key=(13,))
    alone = needed_samples(pooled.subsurface, 0.01) / pooled.subsurface
    assert pooled.rays.sum() < 1.5 * alone.max()
    assert not pooled.anew.any()


def test_standard_errors_are_those_of_repetitions():
    """Of 40 seeds: their variance over the mean estimate is within chi squared's bounds at 1e-4,
    for light within and for all light; the mean of `within` agrees with a count of many rays."""
    stacks = tans("S3", 500.0, STATES[:3])
    many = [profiles(stacks, error=0.05, key=(14, seed), threads=1) for seed in range(40)]
    places = np.argmin(np.abs(many[0].within - 0.5), axis=1)
    half = np.array([one.within[[0, 1, 2], places] for one in many])
    half_error = np.array([one.standard_error[[0, 1, 2], places] for one in many])
    light = np.array([one.subsurface for one in many])
    light_error = np.array([one.subsurface_error for one in many])
    low, high = stats.chi2.ppf([LEVEL / 2, 1 - LEVEL / 2], 39) / 39
    ratio = half.var(axis=0, ddof=1) / np.mean(half_error**2, axis=0)
    assert np.all((low < ratio) & (ratio < high))
    # strata and the known number of rays make it smaller than its error
    ratio = light.var(axis=0, ddof=1) / np.mean(light_error**2, axis=0)
    assert np.all((0.5 * low < ratio) & (ratio < high))
    for number, stack in enumerate(stacks):
        counts = exits(stack, 60_000, (15,))
        share = np.cumsum(counts)[places[number]] / counts.sum()
        error = np.hypot(half[:, number].std() / np.sqrt(40), 0.5 / np.sqrt(counts.sum()))
        assert abs(half[:, number].mean() - share) < 3.9 * error


def test_threads_do_not_matter_and_seeds_do():
    stacks = tans("S4", 640.0, STATES[:2])
    one, two = (profiles(stacks, error=0.03, threads=count) for count in (1, 2))
    for name in ("light", "squares", "rays", "anew"):
        assert np.array_equal(getattr(one, name), getattr(two, name))
    other = profiles(stacks, error=0.03, key=(2,))
    assert not np.any(other.subsurface == one.subsurface)
    stack = skin_stack(SPECIMENS["S3"], 550.0)
    first, second = (
        walked(stack, rays=CHUNK + 999, key=(1,), threads=count).paths for count in (1, 2)
    )
    assert np.array_equal(first.distance, second.distance)
    assert np.array_equal(first.sums, second.sums)


def test_skin_profiles_are_those_of_its_stacks_one_by_one():
    specimens = [tanned(SPECIMENS["S3"], *state) for state in STATES[:2]]
    both = skin_profiles(specimens, [1650.0, 600.0], error=0.05, seed=7)
    (alone,) = skin_profiles(specimens, [600.0], error=0.05, seed=7)
    assert np.array_equal(both[1].light, alone.light)
    assert not np.array_equal(both[0].light, both[1].light)


def test_what_falls_short_is_simulated_anew(monkeypatch):
    """With rays in the first state only, one far away cannot be had from them."""
    far = [((0.4, 0.4, 0.2), 1.0), ((2.5, 2.5, 2.0), 1.0)]
    stacks = tans("S4", 600.0, far)
    monkeypatch.setattr(shared_profiles, "allocate_rays", lambda *_: np.array([30_000, 0]))
    pooled = profiles(stacks, error=0.03, key=(16,), threads=2)
    assert pooled.anew.tolist() == [False, True]
    assert np.all(pooled.effective_sample_size >= needed_samples(pooled.subsurface, 0.03))
    rays = int(pooled.rays[1])
    assert pooled.light[1] * rays == pytest.approx(np.round(pooled.light[1] * rays), abs=1e-6)
    assert_same_light(pooled.light[1], pooled.squares[1], exits(stacks[1], 60_000, (17,)), 60_000)


def test_more_states_than_share_paths(monkeypatch):
    stacks = tans("S3", 600.0)
    monkeypatch.setattr(shared_profiles, "TOGETHER", 3)
    pooled = profiles(stacks, error=0.05)
    assert pooled.light.shape == (4, DISTANCE_EDGES.size)
    monkeypatch.setattr(shared_profiles, "TOGETHER", 96)
    first = profiles(stacks[:3], error=0.05)
    assert np.array_equal(pooled.light[:3], first.light)


def test_skin_without_melanin():
    names = [
        f"{layer}_{what}"
        for layer in ("granulosum", "spinosum", "basale")
        for what in ("melanosomes", "colloidal_melanin")
    ]
    pale = replace(SPECIMENS["S4"], **dict.fromkeys(names, 0.0))
    stacks = [
        skin_stack(tanned(pale, (0.4, 0.4, 0.2), thickness), 500.0) for thickness in (1.0, 1.3)
    ]
    paths = walked(stacks[0], rays=1000, key=(1,)).paths
    assert not paths.sums[:, :, [TRIED, GONE_THROUGH]].any()
    pooled = profiles(stacks, error=0.02)
    solved = solve(stacks, 8.0).subsurface
    assert np.all(np.abs(pooled.subsurface - solved) < 3.9 * pooled.subsurface_error + 5e-4)
    tan = skin_stack(SPECIMENS["S4"], 500.0)
    both = profiles([stacks[0], tan], error=0.05)
    assert np.all(both.effective_sample_size >= needed_samples(both.subsurface, 0.05))


def test_skin_without_light():
    """Nothing comes out: no profile, no endless simulation."""
    black = Stack((Layer(1.0, 1.4, 1e6),))
    pooled = profiles([black, changed(black, 0, absorption=2.0)], error=0.1)
    assert not pooled.light.any()
    assert not pooled.effective_sample_size.any()
    assert not pooled.within.any()
    assert np.all(np.isfinite(pooled.standard_error))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"roughness": 0.3}, "stacks that share paths differ"),
        ({"scattering_angle": 0.1}, "stacks that share paths differ"),
        ({"floor_reflectance": 0.5}, "stacks that share paths differ"),
    ],
)
def test_stacks_that_cannot_share_paths_are_refused(change, sentence):
    stack = skin_stack(SPECIMENS["S3"], 500.0)
    with pytest.raises(InputError, match=sentence):
        profiles([stack, replace(stack, **change)])
    with pytest.raises(InputError, match="a layer's thickness is"):
        profiles([stack, changed(stack, 2, thickness=1.1)])


def test_bad_input_is_refused():
    stack = skin_stack(SPECIMENS["S3"], 500.0)
    with pytest.raises(InputError, match="error of a profile is 0"):
        profiles([stack], error=0.0)
    with pytest.raises(InputError, match="profiles need at least 1 stack"):
        profiles([])
    with pytest.raises(InputError, match="angle of incidence is 90"):
        profiles([stack], angle=90.0)
    with pytest.raises(InputError, match="number of threads is 2000"):
        profiles([stack], threads=2000)
