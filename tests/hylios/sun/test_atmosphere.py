"""Light through layers of air against what is exact."""

import numpy as np
import pytest

from hylios.sun.atmosphere import (
    AEROSOL_KM,
    Depths,
    aerosol_above,
    air_above,
    ozone_above,
    passage,
)

NONE = np.zeros(3)
DEPTHS = np.array([0.01, 0.3, 1.2])
PLACE, WEIGHT = np.polynomial.legendre.leggauss(16)
COSINES, WEIGHTS = 0.5 * (1.0 + PLACE), 0.5 * WEIGHT


@pytest.mark.parametrize("kilometres", [0.0, 3.0])
def test_no_light_is_lost_where_nothing_absorbs(kilometres):
    """Of light from all the sky, what does not come down goes up: by reciprocity what air sends
    back of light from below is the rest of what it lets through."""
    through = passage(Depths(DEPTHS, NONE, 0.5 * DEPTHS, 0.5 * DEPTHS), kilometres)
    passed = through.at(np.repeat(COSINES[:, None], 3, axis=1))
    down = 2.0 * (WEIGHTS * COSINES) @ passed
    assert down + through.returned == pytest.approx(np.ones(3), abs=2e-3)
    assert np.all(np.diff(down) < 0.0)


def test_thin_air_scatters_half_of_it_down():
    """Rayleigh's scattering is the same forwards and backwards: e^-x + (1 - e^-x) / 2 to first
    order, x the slant depth."""
    depth = np.array([1e-3, 2e-3, 4e-3])
    through = passage(Depths(depth, NONE, NONE, NONE), 0.0)
    for cosine in (0.3, 0.6, 1.0):
        slant = depth / cosine
        expected = 0.5 * (1.0 + np.exp(-slant))
        assert np.all(np.abs(through.at(np.full(3, cosine)) - expected) < 0.02 * slant)


def test_ozone_alone_dims_as_beer_and_lambert():
    through = passage(Depths(NONE, DEPTHS, NONE, NONE), 0.0)
    for cosine in (0.5, 0.8, 1.0):
        expected = np.exp(-DEPTHS / cosine)
        assert through.at(np.full(3, cosine)) == pytest.approx(expected, rel=1e-6)
    assert through.returned == pytest.approx(NONE, abs=1e-12)


def test_where_air_ozone_and_aerosol_lie():
    """The US standard atmosphere: 540.2, 265.0, 55.3 and 12.0 of 1013.25 hPa; ozone's middle at
    22 km and a tenth of it below 12 km."""
    air = [air_above(height) * 1013.25 for height in (0.0, 5.0, 10.0, 20.0, 30.0)]
    assert air == pytest.approx([1013.25, 540.2, 265.0, 55.3, 12.0], rel=0.09)
    assert air[:3] == pytest.approx([1013.25, 540.2, 265.0], rel=3e-3)
    assert air_above(50.0) == ozone_above(50.0) == 0.0
    assert ozone_above(-0.4) == ozone_above(0.0) == 1.0
    assert 0.45 < ozone_above(22.5) < 0.55
    assert 0.87 < ozone_above(12.0) < 0.92
    assert aerosol_above(AEROSOL_KM) == pytest.approx(np.exp(-1.0))
