"""The two ways through the model are one: as printed, and in exact equivalents.

Two samples of counts are compared by chi squared at a level of 1e-4 each: with the 22 fast cases
correct code fails for about one seed in 450, with the 4 slow ones for one in 2500. Seeds are fixed.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy import stats

from hylios.skin.specimen import SPECIMENS
from hylios.tissue import Layer, Model, Stack, complete_readings
from hylios.transport.events import SUBSURFACE
from hylios.transport.melanosome_paths import with_survival
from hylios.transport.simulate import count, spectrum, trace

LEVEL = 1e-4
VISIBLE = np.array([400.0, 460.0, 520.0, 580.0, 640.0, 700.0])


def by_fate(counts):
    """Counts by what became of the ray: left by which way, absorbed where."""
    return np.concatenate([counts.left, counts.absorbed.ravel()])


def p_value(first, second):
    """Of two samples of counts coming from one distribution; cells of few are put together."""
    few = first + second < 25
    first = np.append(first[~few], first[few].sum())
    second = np.append(second[~few], second[few].sum())
    kept = first + second > 0
    return stats.chi2_contingency([first[kept], second[kept]], correction=False).pvalue


def both_ways(layers, rays, angle=8.0):
    return [
        by_fate(count(layers, rays=rays, angle=angle, key=(5, way), as_printed=bool(way)))
        for way in (0, 1)
    ]


@cache
def spectra(name):
    """Of a specimen over the visible, in both ways."""
    return [
        spectrum(SPECIMENS[name], VISIBLE, rays=20_000, seed=3 + way, as_printed=bool(way))
        for way in (0, 1)
    ]


@pytest.mark.parametrize("name", ["S1", "S3", "S4"])
def test_fates_are_the_same_over_the_visible(name):
    ends = []
    for one in spectra(name):
        left = [one.surface, one.subsurface, one.transmittance]
        absorbed = [*one.absorbed.T, *one.absorbed_in_melanosomes.T]
        ends.append(np.rint(one.rays * np.array([*left, *absorbed]).sum(axis=1)).astype(int))
        assert ends[-1].sum() == one.rays * VISIBLE.size
    assert p_value(*ends) > LEVEL


@pytest.mark.parametrize("name", ["S1", "S3", "S4"])
def test_reflectance_is_the_same_wavelength_by_wavelength(name):
    """Within 3 standard errors: one of these 18 is not for 5 seeds in 100; the seed is fixed."""
    equivalent, printed = spectra(name)
    error = np.hypot(equivalent.standard_error, printed.standard_error)
    assert np.all(np.abs(equivalent.total - printed.total) < 3.0 * error)


@pytest.mark.parametrize(
    "readings",
    [
        {"complex_content": "packed"},
        {"complex_melanosomes": "diameter"},
        {"melanosome_entry": "refracted"},
        {"melanosome_scattering": "exponential"},
        {"rayleigh": "every_collision"},
        {"inner_fresnel": "off"},
        {"floor": "mirrored"},
    ],
    ids=lambda readings: next(iter(readings)),
)
def test_fates_are_the_same_in_every_reading(readings):
    layers = Stack.of(SPECIMENS["S3"], 500.0, Model(readings=readings))
    assert p_value(*both_ways(layers, 25_000)) > LEVEL


def crowded(arrangement):
    """S4 with 40 % melanosomes, pale ones, in every layer: most have to be drawn again."""
    return replace(
        SPECIMENS["S4"],
        **{f"{layer}_melanosomes": 40.0 for layer in ("basale", "spinosum", "granulosum")},
        melanosome_arrangement=arrangement,
        eumelanin_concentration=10.0,
    )


@pytest.mark.parametrize("arrangement", ["individual", "complexes", "compact_complexes"])
def test_fates_are_the_same_where_melanosomes_crowd(arrangement):
    assert p_value(*both_ways(Stack.of(crowded(arrangement), 500.0), 12_000)) > LEVEL


@pytest.mark.parametrize("angle", [0.0, 60.0, 89.0])
def test_fates_are_the_same_at_every_incidence(angle):
    assert p_value(*both_ways(Stack.of(SPECIMENS["S3"], 600.0), 25_000, angle)) > LEVEL


@pytest.mark.parametrize("radius", [0.0, 0.41e-4])
def test_fates_are_the_same_where_all_kinds_of_attenuators_share_a_layer(radius):
    layer = Layer(
        thickness=20e-4,
        refractive_index=1.4,
        absorption=40.0,
        encounter=4000.0,
        semi_minor=0.1e-4,
        semi_major=0.25e-4,
        complex_radius=radius,
        melanin_absorption=1000.0,
        rayleigh=500.0,
        scattering=2000.0,
        anisotropy=0.8,
    )
    for others in ({}, {"rayleigh": "every_collision"}):
        layers = Stack(
            (layer, replace(layer, refractive_index=1.5)),
            melanin_index=1.7,
            scattering_angle=0.2,
            readings=complete_readings(others),
        )
        assert p_value(*both_ways(layers, 25_000)) > LEVEL


@pytest.mark.parametrize("name", ["S3", "S4"])
def test_light_leaves_at_the_same_places_and_in_the_same_directions(name):
    """Kolmogorov-Smirnov at 1e-4 for each of distance and three components of direction."""
    layers = Stack.of(SPECIMENS[name], 620.0)
    equivalent, printed = (
        trace(layers, rays=30_000, angle=45.0, key=(6, way), as_printed=bool(way)) for way in (0, 1)
    )
    inside = [rays.outcome == SUBSURFACE for rays in (equivalent, printed)]
    for measure in (
        lambda rays: rays.distance,
        *(lambda r, i=i: r.direction[:, i] for i in range(3)),
    ):
        result = stats.ks_2samp(measure(equivalent)[inside[0]], measure(printed)[inside[1]])
        assert result.pvalue > LEVEL


@pytest.mark.parametrize("as_printed", [False, True])
def test_counted_rays_are_the_traced_ones(as_printed):
    layers = with_survival(Stack.of(SPECIMENS["S4"], 560.0))
    work = {"rays": 3_000, "angle": 30.0, "key": (8, 1), "as_printed": as_printed}
    counted, traced = count(layers, **work), trace(layers, **work)
    ends = np.bincount(traced.outcome, minlength=5)
    assert np.array_equal(counted.left, ends[:3])
    for kind, absorbed in enumerate(counted.absorbed):
        layer = traced.layer[traced.outcome == 3 + kind]
        assert np.array_equal(np.bincount(layer, minlength=6), absorbed)
    assert counted.exits.sum() == counted.left[SUBSURFACE]


def many(layers, rays, as_printed):
    """Counts of many rays, in two threads."""
    piece = 50_000

    def part(first):
        counted = count(
            layers, rays=piece, angle=8.0, key=(9 + as_printed, first), as_printed=as_printed
        )
        return by_fate(counted)

    with ThreadPoolExecutor(2) as pool:
        return sum(pool.map(part, range(0, rays, piece)))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["S3", "S4"])
def test_fates_of_ten_million_rays_are_the_same(name):
    layers = with_survival(Stack.of(SPECIMENS[name], 550.0))
    assert p_value(many(layers, 10**7, False), many(layers, 10**7, True)) > LEVEL


@pytest.mark.slow
@pytest.mark.parametrize("arrangement", ["individual", "complexes"])
def test_fates_of_half_a_million_rays_are_the_same_where_melanosomes_crowd(arrangement):
    layers = with_survival(Stack.of(crowded(arrangement), 500.0))
    assert p_value(many(layers, 5 * 10**5, False), many(layers, 5 * 10**5, True)) > LEVEL


@pytest.mark.slow
@pytest.mark.parametrize("name", ["S3", "S4"])
def test_spectra_are_the_same_wavelength_by_wavelength(name):
    """61 wavelengths, all within 3 standard errors: in 15 seeds of 100 one is not, and the seed is
    fixed. The squares of all add up to what chi squared has, at a level of 1e-4."""
    wavelengths = np.arange(400.0, 701.0, 5.0)
    equivalent = spectrum(SPECIMENS[name], wavelengths, rays=100_000, seed=5)
    printed = spectrum(SPECIMENS[name], wavelengths, rays=20_000, seed=6, as_printed=True)
    error = np.hypot(equivalent.standard_error, printed.standard_error)
    deviation = (equivalent.total - printed.total) / error
    assert np.abs(deviation).max() < 3.0
    assert (deviation**2).sum() < stats.chi2.isf(LEVEL, deviation.size)
