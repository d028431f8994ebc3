"""Paths that are shared between stacks, against walks of each stack's own.

Pearson's and Kolmogorov-Smirnov tests are at 1e-4 each, as are bounds of 3.9 standard errors: with
the 30 or so in here correct code fails for about one seed in 300. Seeds are fixed.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from hylios.adding.solver import solve
from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS, tanned
from hylios.tissue import Layer, Stack, complete_readings
from hylios.transport import reuse
from hylios.transport.counting import skin_stack
from hylios.transport.equivalent import (
    FIBRE_LENGTH,
    FIBRES_MET,
    GONE_THROUGH,
    LENGTH,
    TRIED,
    TRIED_LENGTH,
)
from hylios.transport.events import SUBSURFACE
from hylios.transport.paths import effective_sample_size, ready, trace_paths, weights
from hylios.transport.reuse import Profiles, allocated, needed_samples, profiles, skin_profiles
from hylios.transport.simulate import CHUNK, DISTANCE_EDGES, count, trace

LEVEL = 1e-4
STATES = (
    ((0.4, 0.4, 0.2), 1.0),
    ((0.46, 0.46, 0.24), 1.2),
    ((0.5, 0.5, 0.35), 1.35),
    ((0.35, 0.45, 0.15), 0.9),
)
"""Melanin of three layers and thickness, as a tan has them."""


def tans(name, wavelength, states=STATES):
    return [skin_stack(tanned(SPECIMENS[name], *each), wavelength) for each in states]


def exits(layers, rays, key):
    """Exits of a stack's own rays by distance."""
    return sum(
        count(layers, rays=min(CHUNK, rays - first), angle=8.0, key=(*key, first)).exits
        for first in range(0, rays, CHUNK)
    )


def assert_same_light(light, variance, counts, rays):
    """Chi squared of light by distance, with its variance, against counted rays'."""
    bins = np.digitize(np.cumsum(counts) - 0.5 * counts, np.linspace(0, counts.sum(), 13)[1:-1])
    light, variance, counts = (np.bincount(bins, each) for each in (light, variance, counts))
    misfit = np.sum((light - counts / rays) ** 2 / (variance + counts / rays**2))
    assert stats.chi2.sf(misfit, counts.size) > LEVEL


def assert_weights_give(paths, layers, rays, key):
    """The weighted paths leave as a stack's own rays do: how many, and where."""
    weight = weights(paths, layers)
    ratio = layers.layers[0].thickness / paths.layers.layers[0].thickness
    where = np.append(DISTANCE_EDGES, np.inf)
    light, squares = (
        np.histogram(paths.distance * ratio, where, weights=each)[0] / paths.launched**power
        for power, each in ((1, weight), (2, weight**2))
    )
    assert_same_light(light, squares, exits(layers, rays, key), rays)
    assert np.any(np.abs(weight - 1.0) > 0.01)


@pytest.mark.parametrize("name", ["S3", "S4"])
def test_paths_leave_where_other_rays_do(name):
    """The recording walk against the one that it follows."""
    layers = skin_stack(SPECIMENS[name], 620.0)
    paths = trace_paths(layers, rays=40_000, angle=45.0, key=(1,), threads=2)
    traced = trace(layers, rays=40_000, angle=45.0, key=(2,))
    back = traced.outcome == SUBSURFACE
    assert stats.ks_2samp(paths.distance, traced.distance[back]).pvalue > LEVEL
    table = [[paths.distance.size, 40_000 - paths.distance.size], [back.sum(), (~back).sum()]]
    assert stats.chi2_contingency(table).pvalue > LEVEL


@pytest.mark.parametrize("name", ["S1", "S4"])
def test_paths_weigh_1_where_they_were_walked(name):
    layers = skin_stack(SPECIMENS[name], 500.0)
    paths = trace_paths(layers, rays=3000, key=(3,))
    assert np.array_equal(weights(paths, layers), np.ones(paths.distance.size))


def test_lengths_of_paths_over_a_diffuse_floor():
    """Down h and up to distance r: h + hypot(h, r); with absorption the weight is Lambert's."""
    height = 0.05
    clear = Stack((Layer(0.4 * height, 1.0, 0.0), Layer(0.6 * height, 1.0, 0.0)))
    clear = replace(clear, lambertian_floor=True)
    paths = trace_paths(clear, rays=5000, key=(4,))
    length = height + np.hypot(height, 0.1 * paths.distance)
    assert paths.sums[:, :, LENGTH].sum(axis=1) == pytest.approx(length, rel=1e-9)
    assert paths.sums[:, 0, LENGTH] == pytest.approx(0.4 * length, rel=1e-9)
    dyed = replace(clear, layers=tuple(replace(each, absorption=30.0) for each in clear.layers))
    assert weights(paths, dyed) == pytest.approx(np.exp(-30.0 * length), rel=1e-9)
    thick = replace(dyed, layers=tuple(replace(e, thickness=2 * e.thickness) for e in dyed.layers))
    assert weights(paths, thick) == pytest.approx(np.exp(-60.0 * length), rel=1e-9)


def test_what_is_kept_of_a_skin():
    layers = skin_stack(SPECIMENS["S3"], 500.0)
    sums = trace_paths(layers, rays=2000, key=(5,)).sums
    melanosomes = np.array([each.encounter > 0.0 for each in layers.layers])
    assert not sums[:, ~melanosomes][:, :, [TRIED, GONE_THROUGH]].any()
    assert np.all(sums[:, melanosomes][:, :, TRIED].sum(axis=0) > 0)
    assert not sums[:, [0, 1, 2, 3, 5], FIBRES_MET].any()
    deep = sums[:, 5, LENGTH] > 0.0
    assert deep.any()
    assert np.all(sums[deep, 4, LENGTH] > (2.0 - 1e-9) * layers.layers[4].thickness)
    assert np.all(sums[:, 4, FIBRE_LENGTH] <= sums[:, 4, LENGTH])
    assert np.all(sums[:, :, TRIED_LENGTH] >= sums[:, :, LENGTH] * (1 - 1e-12))
    assert np.array_equal(sums[:, :, [TRIED, GONE_THROUGH]] % 1.0, np.zeros((len(sums), 6, 2)))


def changed(layers, number, **factors):
    """The stack with coefficients of one layer multiplied."""
    many = list(layers.layers)
    each = many[number]
    many[number] = replace(each, **{name: getattr(each, name) * f for name, f in factors.items()})
    return replace(layers, layers=tuple(many))


@pytest.mark.parametrize(
    ("name", "wavelength", "number", "factors"),
    [
        ("S3", 550.0, 5, {"absorption": 2.0}),
        ("S3", 365.0, 3, {"encounter": 1.3}),
        ("S3", 550.0, 3, {"encounter": 0.7}),
        ("S3", 550.0, 3, {"survival": 0.97}),
        ("S3", 550.0, 4, {"rayleigh": 1.5}),
        ("S3", 1650.0, 4, {"absorption": 0.5}),
        ("S4", 550.0, 1, {"encounter": 1.3}),
        ("S4", 550.0, 2, {"encounter": 0.7}),
        ("S4", 640.0, 3, {"survival": 0.95}),
        ("S4", 1650.0, 4, {"absorption": 0.5}),
    ],
)
def test_weighted_paths_are_another_stacks(name, wavelength, number, factors):
    layers = skin_stack(SPECIMENS[name], wavelength)
    other = changed(layers, number, **factors)
    if "survival" in factors:  # the walk itself looks into melanosomes: as much darker in there
        wanted, held = other.layers[number].survival, layers.layers[number]
        part = np.log(wanted) / np.log(held.survival)
        other = changed(layers, number, melanin_absorption=part)
        other = ready(changed(other, number, survival=-1.0 / held.survival))
    paths = trace_paths(layers, rays=40_000, angle=8.0, key=(6,), threads=2)
    assert_weights_give(paths, other, 40_000, (7,))


@pytest.mark.parametrize(("name", "wavelength"), [("S3", 365.0), ("S3", 1650.0), ("S4", 550.0)])
@pytest.mark.parametrize("thickness", [0.8, 1.45])
def test_layers_of_another_thickness(name, wavelength, thickness):
    """Here melanosomes of the same size lie in thinner layers: not exact."""
    thin, thick = tans(name, wavelength, [(STATES[0][0], 1.0), (STATES[0][0], thickness)])
    paths = trace_paths(thin, rays=60_000, angle=8.0, key=(8,), threads=2)
    assert_weights_give(paths, thick, 60_000, (9,))


@pytest.mark.slow
def test_light_of_melanosomes_in_layers_of_another_thickness():
    """The walk's own coefficients, only scaled, miss this light by 3 %."""
    thin, thick = tans("S4", 550.0, [(STATES[0][0], 0.8), (STATES[0][0], 1.45)])
    rays = 1_000_000
    weight = weights(trace_paths(thin, rays=rays, angle=8.0, key=(18,)), thick)
    light = exits(thick, rays, (19,)).sum() / rays
    error = np.sqrt(np.sum(weight**2) / rays**2 + light / rays)
    assert error < 0.007 * light
    assert abs(weight.sum() / rays - light) < 3.9 * error


@pytest.mark.parametrize("radius", [0.0, 0.41e-4])
def test_all_that_scatters_at_once_conserves_light(radius):
    """Without absorption, over a white floor, what is not reflected comes back: its share is 1
    in every stack, also by the weights of another's paths."""
    layer = Layer(
        thickness=10e-4,
        refractive_index=1.0,
        absorption=0.0,
        encounter=3000.0,
        semi_minor=0.1e-4,
        semi_major=0.25e-4,
        complex_radius=radius,
        rayleigh=300.0,
        scattering=500.0,
        anisotropy=0.8,
        survival=1.0,
    )
    for others in ({}, {"rayleigh": "every_collision"}):
        layers = Stack(
            (layer, replace(layer, thickness=5e-4)),
            lambertian_floor=True,
            scattering_angle=0.2,
            readings=complete_readings(others),
        )
        paths = trace_paths(layers, rays=20_000, key=(10,))
        assert paths.distance.size == 20_000
        for factors in ({"encounter": 1.1}, {"rayleigh": 0.8}, {"scattering": 1.15}):
            weight = weights(paths, changed(layers, 0, **factors))
            assert abs(weight.mean() - 1.0) < 3.9 * weight.std() / np.sqrt(weight.size)
            assert weight.std() > 0.1


@pytest.mark.parametrize("name", ["S3", "S4"])
@pytest.mark.parametrize("wavelength", [365.0, 550.0, 1650.0])
def test_profiles_of_a_tan(name, wavelength):
    """Every state against its own rays, and its reflectance against the solver without noise.

    That is right to some 3e-4, and to 1 % of what comes out of S4.
    """
    stacks = tans(name, wavelength)
    asked = 0.01 if name == "S3" else 0.02
    found = profiles(stacks, error=asked, key=(11,), threads=2)
    needed = needed_samples(found.subsurface, asked)
    assert np.all(found.effective_sample_size >= needed)
    assert np.all(found.standard_error.max(axis=1) <= 0.5 / np.sqrt(needed))
    solved = solve(stacks, 8.0).subsurface
    error = np.hypot(found.subsurface_error, np.hypot(3e-4, 0.01 * solved))
    assert np.all(np.abs(found.subsurface - solved) < 3.9 * error)
    for number, layers in enumerate(stacks):
        rays = int(0.8 * needed[number] / solved[number])
        assert_same_light(
            found.light[number], found.squares[number], exits(layers, rays, (12,)), rays
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
    found = Profiles(light, squares, np.ones(3, int), np.zeros(3, bool))
    assert found.standard_error[:2].tolist() == [[1.0] * 3] * 2 and not found.within[:2].any()
    assert found.within[2] == pytest.approx([0.25, 0.75, 1.0])
    assert 0.0 < found.standard_error[2].max() < 0.01


def test_rays_are_shared():
    """Close states need little more than the darkest of them alone."""
    melanin, factors = np.array([0.4, 0.4, 0.2]), np.linspace(0.9, 1.1, 12)
    stacks = tans("S3", 550.0, [(tuple(melanin * each), 1.0) for each in factors])
    found = profiles(stacks, error=0.01, key=(13,))
    alone = needed_samples(found.subsurface, 0.01) / found.subsurface
    assert found.rays.sum() < 1.5 * alone.max()
    assert not found.anew.any()


def test_standard_errors_are_those_of_repetitions():
    """Of 40 seeds: their variance over the mean estimate is within chi squared's bounds at 1e-4,
    for light within and for all light; the mean of `within` agrees with a count of many rays."""
    stacks = tans("S3", 500.0, STATES[:3])
    many = [profiles(stacks, error=0.05, key=(14, seed), threads=1) for seed in range(40)]
    places = np.argmin(np.abs(many[0].within - 0.5), axis=1)
    half = np.array([each.within[[0, 1, 2], places] for each in many])
    half_error = np.array([each.standard_error[[0, 1, 2], places] for each in many])
    light = np.array([each.subsurface for each in many])
    light_error = np.array([each.subsurface_error for each in many])
    low, high = stats.chi2.ppf([LEVEL / 2, 1 - LEVEL / 2], 39) / 39
    ratio = half.var(axis=0, ddof=1) / np.mean(half_error**2, axis=0)
    assert np.all((low < ratio) & (ratio < high))
    # strata and the known number of rays make it smaller than its error
    ratio = light.var(axis=0, ddof=1) / np.mean(light_error**2, axis=0)
    assert np.all((0.5 * low < ratio) & (ratio < high))
    for number, layers in enumerate(stacks):
        counts = exits(layers, 60_000, (15,))
        share = np.cumsum(counts)[places[number]] / counts.sum()
        error = np.hypot(half[:, number].std() / np.sqrt(40), 0.5 / np.sqrt(counts.sum()))
        assert abs(half[:, number].mean() - share) < 3.9 * error


def test_threads_do_not_matter_and_seeds_do():
    stacks = tans("S4", 640.0, STATES[:2])
    one, two = (profiles(stacks, error=0.03, threads=each) for each in (1, 2))
    for name in ("light", "squares", "rays", "anew"):
        assert np.array_equal(getattr(one, name), getattr(two, name))
    other = profiles(stacks, error=0.03, key=(2,))
    assert not np.any(other.subsurface == one.subsurface)
    layers = skin_stack(SPECIMENS["S3"], 550.0)
    first, second = (trace_paths(layers, rays=CHUNK + 999, threads=each) for each in (1, 2))
    assert np.array_equal(first.distance, second.distance)
    assert np.array_equal(first.sums, second.sums)


def test_skin_profiles_are_those_of_its_stacks_one_by_one():
    specimens = [tanned(SPECIMENS["S3"], *each) for each in STATES[:2]]
    both = skin_profiles(specimens, [1650.0, 600.0], error=0.05, seed=7)
    (alone,) = skin_profiles(specimens, [600.0], error=0.05, seed=7)
    assert np.array_equal(both[1].light, alone.light)
    assert not np.array_equal(both[0].light, both[1].light)


def test_what_falls_short_is_simulated_anew(monkeypatch):
    """With rays in the first state only, one far away cannot be had from them."""
    far = [((0.4, 0.4, 0.2), 1.0), ((2.5, 2.5, 2.0), 1.0)]
    stacks = tans("S4", 600.0, far)
    monkeypatch.setattr(reuse, "allocated", lambda *_: np.array([30_000, 0]))
    found = profiles(stacks, error=0.03, key=(16,), threads=2)
    assert found.anew.tolist() == [False, True]
    assert np.all(found.effective_sample_size >= needed_samples(found.subsurface, 0.03))
    rays = int(found.rays[1])
    assert found.light[1] * rays == pytest.approx(np.round(found.light[1] * rays), abs=1e-6)
    assert_same_light(found.light[1], found.squares[1], exits(stacks[1], 60_000, (17,)), 60_000)


def test_more_states_than_share_paths(monkeypatch):
    stacks = tans("S3", 600.0)
    monkeypatch.setattr(reuse, "TOGETHER", 3)
    found = profiles(stacks, error=0.05)
    assert found.light.shape == (4, DISTANCE_EDGES.size)
    monkeypatch.setattr(reuse, "TOGETHER", 96)
    first = profiles(stacks[:3], error=0.05)
    assert np.array_equal(found.light[:3], first.light)


def test_skin_without_melanin():
    names = [
        f"{layer}_{what}"
        for layer in ("granulosum", "spinosum", "basale")
        for what in ("melanosomes", "colloidal_melanin")
    ]
    pale = replace(SPECIMENS["S4"], **dict.fromkeys(names, 0.0))
    stacks = [skin_stack(tanned(pale, (0.4, 0.4, 0.2), each), 500.0) for each in (1.0, 1.3)]
    paths = trace_paths(stacks[0], rays=1000)
    assert not paths.sums[:, :, [TRIED, GONE_THROUGH]].any()
    found = profiles(stacks, error=0.02)
    solved = solve(stacks, 8.0).subsurface
    assert np.all(np.abs(found.subsurface - solved) < 3.9 * found.subsurface_error + 5e-4)
    tan = skin_stack(SPECIMENS["S4"], 500.0)
    with pytest.raises(InputError, match="encounter is .* in a layer where paths were walked"):
        weights(paths, tan)
    both = profiles([stacks[0], tan], error=0.05)
    assert np.all(both.effective_sample_size >= needed_samples(both.subsurface, 0.05))


def test_skin_without_light():
    """Nothing comes out: no profile, no endless simulation."""
    black = Stack((Layer(1.0, 1.4, 1e6),))
    found = profiles([black, changed(black, 0, absorption=2.0)], error=0.1)
    assert not found.light.any()
    assert not found.effective_sample_size.any()
    assert not found.within.any()
    assert np.all(np.isfinite(found.standard_error))


def test_rays_allocated_to_states_with_nothing_in_common():
    """Each needs its own limit over its share of light."""
    share = np.array([0.5, 0.2, 0.05])
    densities = np.repeat(np.diag(share) / 1000, 1000, axis=0)
    rays = allocated(densities, densities, np.full(densities.shape[1], 100.0))
    assert rays == pytest.approx([200, 500, 2000], rel=0.02)


def test_rays_allocated_to_states_that_are_alike():
    """Ten states of the same density need no more than one, 100 / .4 rays."""
    densities = np.full((1000, 10), 0.4 / 1000)
    assert 250 <= allocated(densities, densities, np.full(densities.shape[1], 100.0)).sum() <= 260


def test_effective_sample_size():
    assert effective_sample_size(np.full(7, 0.3)) == pytest.approx(7.0)
    assert effective_sample_size(np.array([0.0, 5.0, 0.0])) == pytest.approx(1.0)
    assert effective_sample_size(np.array([1.0, 3.0])) == pytest.approx(1.6)
    assert effective_sample_size(np.zeros(3)) == 0.0


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"roughness": 0.3}, "stacks that share paths differ"),
        ({"scattering_angle": 0.1}, "stacks that share paths differ"),
        ({"floor_reflectance": 0.5}, "stacks that share paths differ"),
    ],
)
def test_stacks_that_cannot_share_paths_are_refused(change, sentence):
    layers = skin_stack(SPECIMENS["S3"], 500.0)
    with pytest.raises(InputError, match=sentence):
        profiles([layers, replace(layers, **change)])
    with pytest.raises(InputError, match="a layer's thickness is"):
        profiles([layers, changed(layers, 2, thickness=1.1)])


def test_bad_input_is_refused():
    layers = skin_stack(SPECIMENS["S3"], 500.0)
    with pytest.raises(InputError, match="error of a profile is 0"):
        profiles([layers], error=0.0)
    with pytest.raises(InputError, match="profiles need at least 1 stack"):
        profiles([])
    with pytest.raises(InputError, match="angle of incidence is 90"):
        profiles([layers], angle=90.0)
    with pytest.raises(InputError, match="number of rays is 0"):
        trace_paths(layers, rays=0)
    with pytest.raises(InputError, match="thickness of a layer is inf"):
        trace_paths(Stack((Layer(np.inf, 1.0, 1.0),)), rays=10)
    with pytest.raises(InputError, match="number of threads is 2000"):
        profiles([layers], threads=2000)
