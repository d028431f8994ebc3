"""Vectors of three numbers as tuples, which the compiler keeps in registers."""

import math

from hylios.transport.compiling import part


@part
def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@part
def added(a, scale, b):
    """a + scale b."""
    return a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]


@part
def scaled(a, scale):
    return a[0] * scale, a[1] * scale, a[2] * scale


@part
def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@part
def unit(a):
    """The vector at length 1."""
    return scaled(a, 1.0 / math.sqrt(dot(a, a)))


@part
def nearly_unit(a):
    """A vector that has left length 1 by rounding only, back at it (one step of Newton's)."""
    return scaled(a, 1.5 - 0.5 * dot(a, a))


@part
def about(a, across, along, turn):
    """along a + a vector of length `across` at right angles to the unit vector a.

    `turn` is the cosine and sine of its azimuth, in the frame of Duff et al. 2017, "Building an
    orthonormal basis, revisited".
    """
    x, y, z = a
    sign = 1.0 if z >= 0.0 else -1.0
    p = -1.0 / (sign + z)
    q = x * y * p
    c, s = across * turn[0], across * turn[1]
    return (
        along * x + c * (1.0 + sign * x * x * p) + s * q,
        along * y + c * sign * q + s * (sign + y * y * p),
        along * z - c * sign * x - s * y,
    )


@part
def stretched(a, axis, across, along):
    """The vector with its part along the unit vector `axis` scaled by one, the rest by another."""
    return added(scaled(a, across), (along - across) * dot(axis, a), axis)
