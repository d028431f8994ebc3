"""Colour and diffusion profile, against references and themselves."""

import numpy as np
import pytest

from hylios.burley import burley_share_within, burley_width
from hylios.errors import InputError
from hylios.lab import colour
from hylios.transport.simulate import DISTANCE_EDGES

WAVELENGTHS = np.arange(400.0, 701.0, 20.0)


def test_white_is_white_and_grey_is_grey():
    white = colour.linear_rec709(WAVELENGTHS, np.ones(WAVELENGTHS.size))
    assert np.allclose(white, 1.0)
    assert np.allclose(colour.lab(white), [100.0, 0.0, 0.0], atol=1e-6)
    grey = colour.lab(np.full(3, 0.18418651851244416))  # CIE: Y of L* = 50
    assert np.allclose(grey, [50.0, 0.0, 0.0], atol=1e-3)


def test_measured_skin_has_its_measured_colour():
    """The class "light" of inner arms (International Skin Spectra Archive): its own spectrum gives
    the L*a*b* that was published beside it, to what differing white points and steps may do."""
    percent = (
        "0.1684,0.1730,0.1768,0.1871,0.2124,0.2468,0.2735,0.2889,0.2997,0.3097,0.3204,0.3290,"
        "0.3307,0.3254,0.3202,0.3221,0.3287,0.3311,0.3436,0.3824,0.4248,0.4512,0.4661,0.4756,"
        "0.4823,0.4872,0.4916,0.4959,0.4999,0.5034,0.5052"
    )
    reflectance = np.array(percent.split(","), dtype=float)
    lab = colour.lab(colour.linear_rec709(np.arange(400.0, 701.0, 10.0), reflectance))
    assert lab == pytest.approx([65.86, 5.81, 15.01], abs=0.3)


def test_srgb_of_half_grey():
    assert np.round(255 * colour.srgb(np.array([0.0, 0.2140411, 1.0]))).tolist() == [0, 127, 255]


def test_difference_in_lightness_alone_is_that_of_ciede2000():
    """Delta L over S_L = 1 + 0.015 (L - 50)^2 / sqrt(20 + (L - 50)^2), L the mean."""
    first = np.array([0.3, 0.3, 0.3])
    assert colour.difference(first, first) == 0.0
    lighter, darker = colour.lab(first), colour.lab(first * 0.95)
    step = lighter[0] - darker[0]
    middle = 0.5 * (lighter[0] + darker[0])
    weight = 1 + 0.015 * (middle - 50) ** 2 / np.sqrt(20 + (middle - 50) ** 2)
    assert colour.difference(first, first * 0.95) == pytest.approx(step / weight, rel=1e-4)


@pytest.mark.parametrize("width", [0.01, 0.3, 5.0])
def test_burley_width_is_found_again(width):
    """From the exact shares in each bin, and from 20,000 drawn distances."""
    ends = np.append(DISTANCE_EDGES[1:], np.inf)
    shares = np.diff(burley_share_within(np.append(0.0, ends), width))
    assert burley_width(DISTANCE_EDGES, shares) == pytest.approx(width, rel=1e-3)
    random = np.random.default_rng(8)
    scale = np.where(random.random(20_000) < 0.25, width, 3.0 * width)
    drawn = random.exponential(scale)
    counts = np.histogram(drawn, np.append(DISTANCE_EDGES, np.inf))[0]
    assert burley_width(DISTANCE_EDGES, counts) == pytest.approx(width, rel=0.03)


def test_burley_has_the_mean_distance_of_its_paper():
    """2.5 d: a quarter of the light at mean d, three quarters at mean 3 d."""
    distance = np.linspace(0.0, 80.0, 400_001)
    assert np.sum(1.0 - burley_share_within(distance, 1.0)) * 2e-4 == pytest.approx(2.5, rel=1e-3)


@pytest.mark.parametrize("weights", [np.zeros(4), np.array([1.0, -1.0, 1.0, 1.0])])
def test_a_profile_without_light_is_refused(weights):
    with pytest.raises(InputError, match="a profile needs light"):
        burley_width(np.array([0.0, 0.1, 0.2, 0.3]), weights)


@pytest.mark.parametrize("wavelengths", [[700.0, 400.0], [400.0, 400.0], [400.0, np.nan], []])
def test_colour_needs_ascending_wavelengths(wavelengths):
    with pytest.raises(InputError, match="must be a list of ascending numbers"):
        colour.rec709_weights(np.array(wavelengths))
