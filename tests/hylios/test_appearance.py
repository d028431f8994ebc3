"""Colour, diffusion profile and table, against references and themselves."""

import json

import numpy as np
import pytest

from hylios import colour
from hylios.errors import InputError
from hylios.profile import burley_share_within, burley_width
from hylios.table import PLANES, SkinTable, StateAxes, from_pixels, to_pixels
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
    found = colour.lab(colour.linear_rec709(np.arange(400.0, 701.0, 10.0), reflectance))
    assert found == pytest.approx([65.86, 5.81, 15.01], abs=0.3)


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


@pytest.fixture
def table():
    random = np.random.default_rng(0)
    basis = np.linalg.qr(random.normal(size=(4, 3)))[0]
    knots = (np.array([-1.0, 0.0, 1.0, 2.0]), np.array([0.0, 1.0]), np.array([-1.0, 0.0, 0.5]))
    axes = StateAxes(np.array([0.5, 0.3, 0.2, 1.0]), basis, knots)
    values = random.random((*axes.shape, len(PLANES), 3)).astype(np.float32).astype(float)
    return SkinTable(axes, values, {"specimen": "S3", "rays": 7})


def test_table_gives_its_values_at_the_knots(table):
    states = table.axes.knot_states()
    assert np.allclose(table.lookup(states), table.values, atol=1e-12)
    assert np.allclose(table.plane("profile_width", states), table.values[..., 3, :], atol=1e-12)


def test_table_is_linear_between_knots_and_held_beyond_them(table):
    inside = table.lookup(table.axes.states(np.array([0.5, 0.0, 0.0])))
    assert np.allclose(inside, 0.5 * (table.values[1, 0, 1] + table.values[2, 0, 1]))
    beyond = table.lookup(table.axes.states(np.array([9.0, 0.0, -9.0])))
    assert np.allclose(beyond, table.values[3, 0, 0])


def test_table_survives_its_pixels(table):
    again = from_pixels(*to_pixels(table))
    assert np.array_equal(again.values, table.values)
    assert again.provenance == table.provenance
    assert np.array_equal(again.axes.basis, table.axes.basis)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda header: header.pop("checksum"), "incomplete"),
        (lambda header: header.update(format="other"), "not a skin tan table"),
        (lambda header: header.update(format_version=99), "format version 99"),
        (lambda header: header.update(planes=["x"]), "planes are"),
        (lambda header: header["axes"]["knots"].append([0.0]), "axes are not"),
        (lambda header: header["axes"]["knots"][0].reverse(), "axes are not"),
        (lambda header: header["axes"]["knots"][0].pop(), "its header describes"),
        (lambda header: header["axes"]["untanned"].pop(), "axes are not"),
        (lambda header: header.update(checksum="0"), "does not match the checksum"),
        (lambda header: header["provenance"].update(rays=8), "does not match the checksum"),
        (lambda header: header["axes"]["untanned"].reverse(), "does not match the checksum"),
    ],
)
def test_a_header_that_does_not_fit_is_refused(table, change, sentence):
    pixels, text = to_pixels(table)
    header = json.loads(text)
    change(header)
    with pytest.raises(InputError, match=sentence):
        from_pixels(pixels, json.dumps(header))


def test_changed_pixels_are_refused(table):
    pixels, text = to_pixels(table)
    pixels[2, 1, 0] += 1e-3
    with pytest.raises(InputError, match="checksum"):
        from_pixels(pixels, text)
    with pytest.raises(InputError, match="not JSON"):
        from_pixels(pixels, "{")


@pytest.mark.parametrize("melanin", [0.0, -1.0, np.nan, np.inf])
def test_a_state_that_is_none_is_refused(table, melanin):
    with pytest.raises(InputError, match="not above 0 and finite"):
        table.lookup(np.array([melanin, 0.3, 0.2, 1.0]))


@pytest.mark.parametrize("wavelengths", [[700.0, 400.0], [400.0, 400.0], [400.0, np.nan], []])
def test_colour_needs_ascending_wavelengths(wavelengths):
    with pytest.raises(InputError, match="must be a list of ascending numbers"):
        colour.rec709_weights(np.array(wavelengths))
