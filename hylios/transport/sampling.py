"""The random distributions of chapter 4, each a function of a generator's state.

All are sampled exactly; where the thesis rejects from a uniform box, the same density is drawn
without the waste. Angles are in radians.
"""

import math

from numba import njit

from hylios.transport.generator import uniform
from hylios.transport.vectors import TWO_PI, about, unit


@njit
def free_path(state, coefficient):
    """Distance to the next event of a kind with the given coefficient; infinite for 0 (4.1)."""
    if coefficient <= 0.0:
        return math.inf
    return -math.log(1.0 - uniform(state)) / coefficient


@njit
def forward_angle(state, scale):
    """Polar angle of density proportional to exp(-x / scale) sin(x) on [0, pi) (algorithm 1).

    The product of exp(-x / scale) and x is a gamma density, kept with probability sin(x) / x.
    """
    while True:
        angle = -scale * math.log((1.0 - uniform(state)) * (1.0 - uniform(state)))
        if angle < math.pi and uniform(state) * angle <= math.sin(angle):
            return angle


@njit
def exponential_angle(state, mean):
    """Polar angle from an exponential distribution, cut at pi: the text beside algorithm 1."""
    while True:
        angle = -mean * math.log(1.0 - uniform(state))
        if angle < math.pi:
            return angle


@njit
def rayleigh_cosine(state):
    """Cosine of the polar angle of density (1 + cos^2) sin (algorithm 2), by inversion."""
    shifted = 4.0 * uniform(state) - 2.0
    root = (shifted + math.sqrt(shifted * shifted + 1.0)) ** (1.0 / 3.0)
    return root - 1.0 / root


@njit
def lambertian_cosine(state):
    """Cosine of the polar angle of the cosine distribution (section 4.2.1)."""
    return math.sqrt(1.0 - uniform(state))


@njit
def surface_slope_squared(state, roughness):
    """Squared tangent w of the polar angle of a rough surface's normal (4.8).

    In w, 4.8 is proportional to sqrt(1 + w) / (s^2 + w)^2. Since sqrt(1 + w) <= 1 + sqrt(w), it
    is drawn from a mixture of the two terms and kept with the ratio of the two sides.
    """
    squared = roughness * roughness
    plain = 1.0 / squared
    rooted = 0.5 * math.pi / roughness
    while True:
        if uniform(state) * (plain + rooted) < plain:
            drawn = uniform(state)
            slope = squared * drawn / (1.0 - drawn)
        else:
            # sqrt(w) / (s^2 + w)^2 is sin^2 of the angle whose tangent is sqrt(w) / s
            angle = 0.5 * math.pi * uniform(state)
            while uniform(state) > math.sin(angle) ** 2:
                angle = 0.5 * math.pi * uniform(state)
            slope = squared * math.tan(angle) ** 2
        if uniform(state) * (1.0 + math.sqrt(slope)) <= math.sqrt(1.0 + slope):
            return slope


@njit
def spheroid_cosine(state, aspect):
    """Cosine between a ray and the long axis of a prolate spheroid that it meets (4.5).

    4.5 times the measure sin(alpha), with chi_1 = pi a b seen from the side and chi_2 = pi a^2
    seen along the axis; `aspect` is a / b = chi_2 / chi_1. Linear in |cos|, so a mixture of two.
    """
    if uniform(state) * (1.0 + aspect) < 1.0:
        size = 1.0 - math.sqrt(uniform(state))
    else:
        size = math.sqrt(uniform(state))
    return size if uniform(state) < 0.5 else -size


@njit
def henyey_greenstein_cosine(state, anisotropy):
    """Cosine of the polar angle of the Henyey-Greenstein density (1941)."""
    if abs(anisotropy) < 1e-6:
        return 2.0 * uniform(state) - 1.0
    squared = anisotropy * anisotropy
    ratio = (1.0 - squared) / (1.0 - anisotropy + 2.0 * anisotropy * uniform(state))
    return (1.0 + squared - ratio * ratio) / (2.0 * anisotropy)


@njit
def turned(state, ray, cosine):
    """The unit vector at a polar angle of the given cosine from a unit vector, any azimuth."""
    sine = math.sqrt(max(0.0, 1.0 - cosine * cosine))
    return unit(about(ray, sine, cosine, TWO_PI * uniform(state)))
