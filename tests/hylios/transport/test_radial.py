"""The radial exitance against closed forms and diffusion theory.

Pearson's tests are at 1e-4; the seeds are fixed.
"""

import numpy as np
import pytest
from scipy.stats import chi2

from hylios.burley import burley_width, burley_width_error
from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS
from hylios.tissue import Layer, Stack
from hylios.transport.events import SUBSURFACE
from hylios.transport.radial import Rings, profile, radial_exitance
from hylios.transport.simulate import CHUNK, trace
from hylios.transport.tallies import stream_key

S3 = SPECIMENS["S3"]


def assert_counts(counts, expected):
    kept = expected > 20.0
    assert expected[kept].sum() > 0.95 * expected.sum()
    misfit = np.sum((counts - expected)[kept] ** 2 / expected[kept])
    assert chi2.sf(misfit, kept.sum()) > 1e-4


def test_integral_over_the_plane_is_the_subsurface_reflectance_of_the_same_rays():
    rays = CHUNK + 1000
    result = profile(S3, 633.0, rays=rays, seed=2, rings=Rings(largest=5.0), threads=2)
    layers, key = Stack.of(S3, 633.0), stream_key(2, 633.0)
    outcome = np.concatenate(
        [
            trace(layers, rays=size, key=(*key, first)).outcome
            for first, size in ((0, CHUNK), (CHUNK, 1000))
        ]
    )
    share = (outcome == SUBSURFACE).mean()
    assert result.beyond > 0.01
    plane = np.sum(result.exitance * result.area)
    assert plane + result.beyond == pytest.approx(share, rel=1e-12)
    assert result.subsurface == pytest.approx(share, rel=1e-12)
    within = np.sum(result.burley * result.area)
    assert 0.5 * share < within < share


def test_diffuse_floor_under_a_matched_clear_layer():
    """R = h^2 / (pi (h^2 + r^2)^2): within r lies the share r^2 / (h^2 + r^2)."""
    height = 0.5
    layers = Stack((Layer(0.1 * height, 1.0, 0.0),), lambertian_floor=True)
    result = radial_exitance(layers, rays=200_000, key=(2,))
    squared = result.edges**2
    expected = result.rays * np.diff(np.append(squared / (height**2 + squared), 1.0))
    assert_counts(result.counts, expected)


def test_light_scattered_once():
    """Straight down to z, Rayleigh's phase function, straight out, in a matched layer."""
    scattering, absorption, depth = 2.0, 0.5, 1.0
    layers = Stack((Layer(0.1 * depth, 1.0, 10.0 * absorption, rayleigh=10.0 * scattering),))
    result = radial_exitance(layers, rays=400_000, rings=Rings(smallest=0.05, count=40), key=(3,))
    z = (depth * (np.arange(2000) + 0.5) / 2000)[:, None]
    cosines = z / np.hypot(z, result.edges)
    shares = (np.arange(20) + 0.5) / 20
    steps = -np.diff(cosines)
    cosine = cosines[:, 1:, None] + steps[..., None] * shares
    phase = 3.0 / (16.0 * np.pi) * (1.0 + cosine**2)
    out = 2.0 * np.pi * steps * np.mean(phase * np.exp(-absorption * z[..., None] / cosine), axis=2)
    scattered = scattering * np.exp(-(scattering + absorption) * z) * depth / 2000
    expected = result.rays * np.sum(scattered * out, axis=0)
    assert_counts(result.counts[:-1], expected)


ABSORPTION, REDUCED = 0.01, 1.0


def dipole(distance):
    """Diffuse reflectance of a matched half-space, 1/mm^2.

    T. J. Farrell, M. S. Patterson and B. Wilson, Medical Physics 19, 879 (1992).
    """
    total = ABSORPTION + REDUCED
    attenuation = np.sqrt(3.0 * ABSORPTION * total)
    above = 4.0 / (3.0 * total)
    result = 0.0
    for depth in (1.0 / total, 1.0 / total + above):
        way = np.hypot(distance, depth)
        result += depth * (attenuation + 1.0 / way) * np.exp(-attenuation * way) / way**2
    return REDUCED / total / (4.0 * np.pi) * result


@pytest.mark.slow
def test_half_space_of_forward_scatterers_follows_diffusion_theory():
    """Far from the beam: 5 to 20 transport mean free paths, its level within 5 %.

    And its decay: the slope of the logarithm of the ratio is 0 to 3 standard errors, which are
    less than 5 % of the effective attenuation coefficient.
    """
    anisotropy = 0.9
    scatterer = Layer(
        np.inf,
        1.0,
        10.0 * ABSORPTION,
        scattering=10.0 * REDUCED / (1.0 - anisotropy),
        anisotropy=anisotropy,
    )
    result = radial_exitance(Stack((scatterer,)), rings=Rings(5.0, 20.0, 9), rays=300_000, key=(4,))
    shares = (np.arange(50) + 0.5) / 50
    inner, outer = result.edges[1:-1, None], result.edges[2:, None]
    expected = dipole(np.sqrt(inner**2 + (outer**2 - inner**2) * shares)).mean(axis=1)
    ratio = result.exitance[1:] / expected
    error = result.standard_error[1:] / result.exitance[1:]
    mean = np.average(ratio, weights=error**-2)
    assert abs(mean - 1.0) < 0.05
    middle = 0.5 * (inner + outer)[:, 0]
    fitted, covariance = np.polyfit(middle, np.log(ratio), 1, w=1.0 / error, cov="unscaled")
    slope_error = np.sqrt(covariance[0, 0])
    assert slope_error < 0.05 * np.sqrt(3.0 * ABSORPTION * (ABSORPTION + REDUCED))
    assert abs(fitted[0]) < 3.0 * slope_error


def test_burley_width_and_its_error_in_millimetres():
    """The error is the scatter over 40 samples, to 50 % (over 4 standard deviations)."""
    random = np.random.default_rng(5)
    edges = np.concatenate([[0.0], np.geomspace(0.01, 100.0, 60)])
    samples = [
        np.histogram(
            random.exponential(np.where(random.random(2000) < 0.25, 0.4, 1.2)),
            np.append(edges, np.inf),
        )[0]
        for _ in range(40)
    ]
    widths = [burley_width(edges, counts) for counts in samples]
    error = np.mean([burley_width_error(edges, counts) for counts in samples[:4]])
    assert np.mean(widths) == pytest.approx(0.4, rel=0.03)
    assert error == pytest.approx(np.std(widths, ddof=1), rel=0.5)
    with pytest.raises(InputError, match="a profile needs light"):
        burley_width_error(edges, np.zeros(61, int))


def test_threads_do_not_matter():
    one, two = (profile(S3, 633.0, rays=2 * CHUNK, threads=count) for count in (1, 2))
    assert np.array_equal(one.counts, two.counts)
    assert one.burley_width == two.burley_width
    assert one.burley_width_error == two.burley_width_error


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"count": 1}, "number of rings is 1"),
        ({"smallest": 0.0}, "smallest radius is 0 mm"),
        ({"smallest": 2.0, "largest": 1.0}, "largest radius is 1 mm"),
        ({"largest": np.inf}, "largest radius is inf mm"),
    ],
)
def test_rings_out_of_range_are_refused(arguments, sentence):
    with pytest.raises(InputError, match=sentence):
        Rings(**arguments)


def test_an_angle_out_of_range_is_refused():
    with pytest.raises(InputError, match="angle of incidence is -1"):
        profile(S3, 633.0, rays=10, angle=-1.0)


def test_a_profile_without_light_is_refused():
    black = Stack((Layer(1.0, 1.4, 1e6),))
    with pytest.raises(InputError, match="none of 100 rays came back"):
        _ = radial_exitance(black, rays=100).burley
