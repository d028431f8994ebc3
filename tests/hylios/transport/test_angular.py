"""The BRDF against closed forms; where it is reciprocal and where not.

`assert_counts` is Pearson's test at 1e-4 over bins where 20 rays or more are expected; with all
comparisons of this file some 1 in 500 seeds fail by chance, and the seeds are fixed.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS
from hylios.tissue import Layer, Model, Stack
from hylios.transport.angular import angular_reflectance, brdf
from hylios.transport.events import SUBSURFACE, SURFACE
from hylios.transport.simulate import CHUNK, trace
from hylios.transport.tallies import stream_key

S3 = SPECIMENS["S3"]


def layer(thickness, index, **coefficients):
    return Layer(
        **{"thickness": thickness, "refractive_index": index, "absorption": 0.0} | coefficients
    )


def assert_counts(counts, expected):
    kept = expected > 20.0
    assert expected[kept].sum() > 0.9 * expected.sum()
    misfit = np.sum((counts - expected)[kept] ** 2 / expected[kept])
    assert chi2.sf(misfit, kept.sum()) > 1e-4


def fresnel(cosine, index):
    """Reflectance for unpolarised light that comes from outside."""
    beyond = np.sqrt(1.0 - (1.0 - cosine**2) / index**2)
    across = (cosine - index * beyond) / (cosine + index * beyond)
    along = (beyond - index * cosine) / (beyond + index * cosine)
    return 0.5 * (across**2 + along**2)


def over_bins(function, result, points=24):
    """Rays expected in each bin: the integral of f_r(cosine, azimuth) cos d omega, both sides."""
    shares = (np.arange(points) + 0.5) / points

    def inside(edges):
        steps = np.diff(edges)[:, None]
        return edges[:-1, None] + steps * shares, steps / points

    (polar, height), (azimuth, width) = (
        inside(np.radians(edges)) for edges in (result.polar_edges, result.azimuth_edges)
    )
    cosine, projected = np.cos(polar), np.cos(polar) * np.sin(polar) * height
    values = function(cosine[:, None, :, None], azimuth[None, :, None, :])
    summed = np.sum(values * projected[:, None, :, None] * width[None, :, None], axis=(2, 3))
    return 2.0 * result.rays * summed


def test_integral_over_the_hemisphere_is_the_reflectance_of_the_same_rays():
    rays = CHUNK + 1000
    result = brdf(S3, 550.0, angle=30.0, rays=rays, seed=3, threads=2)
    layers, key = Stack.of(S3, 550.0), stream_key(3, 550.0)
    outcome = np.concatenate(
        [
            trace(layers, rays=size, angle=30.0, key=(*key, first)).outcome
            for first, size in ((0, CHUNK), (CHUNK, 1000))
        ]
    )
    for values, ends in (
        (result.surface, [SURFACE]),
        (result.subsurface, [SUBSURFACE]),
        (result.total, [SURFACE, SUBSURFACE]),
    ):
        integral = np.sum(values * result.projected_solid_angle)
        assert integral == pytest.approx(np.isin(outcome, ends).mean(), rel=1e-12)
    assert result.projected_solid_angle.sum() == pytest.approx(np.pi)


def test_half_space_of_isotropic_scatterers_follows_chandrasekhar():
    """f_r = w / (4 pi) H(mu) H(mu_0) / (mu + mu_0); Radiative Transfer (1950), section 47."""
    albedo, incidence = 0.9, 60.0
    nodes, weights = np.polynomial.legendre.leggauss(64)
    nodes, weights = 0.5 * (nodes + 1.0), 0.5 * weights
    values = np.ones(64)

    def h(cosine):
        part = nodes * values * weights / (np.asarray(cosine)[..., None] + nodes)
        return 1.0 / (np.sqrt(1.0 - albedo) + 0.5 * albedo * part.sum(axis=-1))

    for _ in range(200):
        values = h(nodes)
    assert np.sum(weights * values) == pytest.approx(2.0 / albedo * (1.0 - np.sqrt(1.0 - albedo)))

    def reference(cosine, azimuth):
        coming = np.cos(np.radians(incidence))
        shape = h(cosine) * h(coming) / (cosine + coming)
        return albedo / (4.0 * np.pi) * shape + 0.0 * azimuth

    layers = Stack((layer(np.inf, 1.0, absorption=1.0, scattering=9.0),))
    result = angular_reflectance(layers, angle=incidence, rays=200_000, key=(2,))
    assert_counts(result.subsurface_counts, over_bins(reference, result))


@pytest.mark.parametrize("index", [1.0, 1.4])
def test_diffuse_floor_under_a_flat_clear_layer(index):
    """f_r = T(i) T(o) / (pi (1 - R)), R being Fresnel's over a diffuse sky: 1 / pi at index 1."""
    layers = Stack((layer(0.1, index),), lambertian_floor=True)
    result = angular_reflectance(layers, angle=50.0, rays=200_000, key=(3,))
    squared = (np.arange(100_000) + 0.5) / 100_000
    diffuse = np.mean(fresnel(np.sqrt(squared), index))
    into = 1.0 - fresnel(np.cos(np.radians(50.0)), index)

    def reference(cosine, azimuth):
        return into * (1.0 - fresnel(cosine, index)) / (np.pi * (1.0 - diffuse)) + 0.0 * azimuth

    assert_counts(result.subsurface_counts, over_bins(reference, result))


@pytest.mark.parametrize("roughness", [0.0, 1e-3])
def test_a_nearly_flat_surface_is_a_mirror(roughness):
    rays, angle = 100_000, 62.0
    layers = Stack((layer(1.0, 1.5, absorption=1e6),), roughness=roughness)
    result = angular_reflectance(layers, angle=angle, polar_bins=45, rays=rays, key=(4,))
    expected = fresnel(np.cos(np.radians(angle)), 1.5)
    assert abs(result.surface_counts.sum() / rays - expected) < 4.0 * np.sqrt(expected / rays)
    row = int(angle / 2.0)  # the mirror's direction is the edge between this bin and the last
    assert result.surface_counts[row - 1 : row + 1, 0].sum() > 0.99 * result.surface_counts.sum()


ROUGHNESS, INDEX, ROUGH_RAYS = 0.3, 1.55, 1_600_000


def normal_density(cosine):
    """4.8 for a normal of the surface, per solid angle."""
    steep = (1.0 - cosine**2) + ROUGHNESS**2 * cosine**2
    grid = np.cos(0.5 * np.pi * (np.arange(20_000) + 0.5) / 20_000)
    shape = ((1.0 - grid**2) + ROUGHNESS**2 * grid**2) ** -2
    norm = np.sum(shape * np.sqrt(1.0 - grid**2)) * 0.5 * np.pi / 20_000 * 2.0 * np.pi
    return steep**-2 / norm


def kept_share(incidence):
    """Z: share of the drawn normals that face the ray and send it to the right side."""
    polar = 0.5 * np.pi * (np.arange(1000) + 0.5)[:, None] / 1000
    azimuth = np.pi * (np.arange(400) + 0.5) / 400
    up = np.cos(polar)
    facing = up * np.cos(incidence) - np.sin(polar) * np.cos(azimuth) * np.sin(incidence)
    seen = facing > 0.0
    cosine = np.where(seen, facing, 1.0)
    mirrored = 2.0 * cosine * up > np.cos(incidence)
    beyond = np.sqrt(1.0 - (1.0 - cosine**2) / INDEX**2)
    passed = np.cos(incidence) > (cosine - INDEX * beyond) * up
    reflectance = fresnel(cosine, INDEX)
    kept = seen * (reflectance * mirrored + (1.0 - reflectance) * passed)
    return (
        np.sum(normal_density(up) * kept * np.sin(polar)) * 0.5 * np.pi / 1000 * 2.0 * np.pi / 400
    )


def surface_brdf(incidence, cosine, azimuth):
    """p(h) F(h) / (4 (h i) cos(o) Z(i)): the facets as `meet_surface` draws them."""
    sine = np.sqrt(1.0 - cosine**2)
    along = 0.5 * (1.0 + np.cos(incidence) * cosine - np.sin(incidence) * sine * np.cos(azimuth))
    half = np.sqrt(along)  # cosine between the light and the facet's normal
    upright = (np.cos(incidence) + cosine) / (2.0 * half)
    share = normal_density(np.minimum(upright, 1.0)) * fresnel(half, INDEX)
    return share / (4.0 * half * cosine * kept_share(incidence))


@pytest.fixture(scope="module")
def rough():
    layers = Stack((layer(1.0, INDEX, absorption=1e6),), roughness=ROUGHNESS)
    return {
        angle: angular_reflectance(layers, angle=angle, rays=ROUGH_RAYS, key=(5, int(angle)))
        for angle in (22.5, 62.5)
    }


@pytest.mark.parametrize("angle", [22.5, 62.5])
def test_a_rough_surface_reflects_as_its_facets_are_drawn(rough, angle):
    expected = over_bins(
        lambda cosine, azimuth: surface_brdf(np.radians(angle), cosine, azimuth), rough[angle]
    )
    assert_counts(rough[angle].surface_counts, expected)


def test_the_rough_surface_is_not_reciprocal(rough):
    """f_r(i, o) cos(o) Z(i) is symmetric, not f_r: facets are drawn by 4.8, however seen."""
    counts = np.array([rough[22.5].surface_counts[12].sum(), rough[62.5].surface_counts[4].sum()])
    rings = rough[22.5].projected_solid_angle.sum(axis=1)[[12, 4]]
    measured = counts[0] / rings[0] / counts[1] * rings[1]
    low, high = np.radians([22.5, 62.5])
    expected = np.cos(low) / np.cos(high) * kept_share(high) / kept_share(low)
    error = measured * np.sqrt(np.sum(1.0 / counts))
    assert abs(measured - expected) < 3.0 * error
    assert measured - 1.0 > 10.0 * error


def test_scattering_once_in_a_traversal_is_not_reciprocal():
    """mu / (mu_i mu_o) P / (4 pi) times the integral over depth, where only the way in is thinned.

    P is Rayleigh's 3/4 (1 + cos^2); the layer is deep, so the integral is that of an exponential.
    """
    scattering, absorption = 20.0, 1.0
    layers = Stack((layer(5.0, 1.0, absorption=absorption, rayleigh=scattering),))

    def reference(incidence):
        coming = np.cos(np.radians(incidence))

        def value(cosine, azimuth):
            across = np.sqrt((1.0 - cosine**2) * (1.0 - coming**2)) * np.cos(azimuth)
            phase = 0.75 * (1.0 + (across - cosine * coming) ** 2) / (4.0 * np.pi)
            thinned = (scattering + absorption) / coming + absorption / cosine
            return scattering * phase / (coming * cosine) / thinned

        return value

    results = {}
    for angle in (12.5, 72.5):
        results[angle] = angular_reflectance(layers, angle=angle, rays=200_000, key=(6, int(angle)))
        expected = over_bins(reference(angle), results[angle])
        assert_counts(results[angle].subsurface_counts, expected)
    there = results[12.5].subsurface[14].mean()
    back = results[72.5].subsurface[2].mean()
    assert there > 2.0 * back


def ratio(layers, rays=60_000):
    """Subsurface f_r from 15 to 75 degrees over that from 75 to 15, and its standard error."""
    both_ways = [
        angular_reflectance(
            layers, angle=angle, polar_bins=9, azimuth_bins=1, rays=rays, key=(7, angle)
        )
        for angle in (15, 75)
    ]
    counts = np.array([both_ways[0].subsurface_counts[7, 0], both_ways[1].subsurface_counts[1, 0]])
    rings = both_ways[0].projected_solid_angle[[7, 1], 0]
    value = counts[0] / rings[0] / counts[1] * rings[1]
    return value, value * np.sqrt(np.sum(1.0 / counts))


def test_skin_is_reciprocal_under_a_flat_surface_with_rayleigh_at_every_collision():
    every = Stack.of(S3, 550.0, Model(readings={"rayleigh": "every_collision"}))
    value, error = ratio(replace(every, roughness=0.0))
    assert abs(value - 1.0) < 3.0 * error


def test_skin_as_the_thesis_has_it_is_not_reciprocal():
    """1.449 with a standard error of 0.020 where it was measured with 600,000 rays."""
    value, error = ratio(Stack.of(S3, 550.0))
    assert abs(value - 1.449) < 3.0 * np.hypot(error, 0.020)
    assert value - 1.0 > 4.0 * error


def test_threads_do_not_matter_and_azimuths_are_folded():
    one = brdf(S3, 550.0, rays=2 * CHUNK, threads=1)
    two = brdf(S3, 550.0, rays=2 * CHUNK, threads=2)
    assert np.array_equal(one.surface_counts, two.surface_counts)
    assert np.array_equal(one.subsurface_counts, two.subsurface_counts)
    assert one.azimuth_edges[-1] == 180.0
    assert one.surface_counts[:, 0].sum() > 10 * one.surface_counts[:, -1].sum()


def test_standard_error_is_the_scatter_between_seeds():
    """Mean square of 12 bins over 30 seeds; within 30 % (5 standard deviations of that mean)."""
    layers = Stack((layer(0.1, 1.0),), lambertian_floor=True)
    runs = [
        angular_reflectance(
            layers, angle=0.0, polar_bins=3, azimuth_bins=4, rays=500, key=(8, seed)
        )
        for seed in range(30)
    ]
    scatter = np.var([run.total for run in runs], axis=0, ddof=1)
    predicted = np.mean([run.standard_error**2 for run in runs], axis=0)
    assert np.mean(scatter / predicted) == pytest.approx(1.0, abs=0.36)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"polar_bins": 0}, "number of polar bins is 0"),
        ({"azimuth_bins": 1001}, "number of azimuth bins is 1001"),
        ({"rays": 0}, "number of rays is 0"),
        ({"angle": 90.0}, "angle of incidence is 90"),
        ({"seed": -1}, "seed is -1"),
        ({"threads": -1}, "number of threads is -1"),
    ],
)
def test_bad_input_is_refused(arguments, sentence):
    with pytest.raises(InputError, match=sentence):
        brdf(S3, 550.0, **{"rays": 10} | arguments)
