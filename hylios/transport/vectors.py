"""Vectors of three numbers as tuples, which the compiler keeps in registers."""

import math

from numba import njit

TWO_PI = 2.0 * math.pi


@njit
def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@njit
def added(a, scale, b):
    """a + scale b."""
    return a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]


@njit
def scaled(a, scale):
    return a[0] * scale, a[1] * scale, a[2] * scale


@njit
def length(a):
    return math.sqrt(dot(a, a))


@njit
def unit(a):
    """The vector at length 1."""
    return scaled(a, 1.0 / length(a))


@njit
def about(a, across, along, azimuth):
    """along a + a vector of length `across` at right angles to the unit vector a.

    The frame is that of Duff et al. 2017, "Building an orthonormal basis, revisited".
    """
    x, y, z = a
    sign = 1.0 if z >= 0.0 else -1.0
    p = -1.0 / (sign + z)
    q = x * y * p
    c, s = across * math.cos(azimuth), across * math.sin(azimuth)
    return (
        along * x + c * (1.0 + sign * x * x * p) + s * q,
        along * y + c * sign * q + s * (sign + y * y * p),
        along * z - c * sign * x - s * y,
    )


@njit
def stretched(a, axis, across, along):
    """The vector with its part along the unit vector `axis` scaled by one, the rest by another."""
    return added(scaled(a, across), (along - across) * dot(axis, a), axis)
