"""The random distributions of chapter 4, each a function of a generator's state.

All are sampled exactly; where the thesis rejects from a uniform box, the same density is drawn
without the waste. Angles are in radians.
"""

import math

from hylios.transport.compiling import part
from hylios.transport.generator import uniform
from hylios.transport.vectors import about, nearly_unit


@part
def in_disc(state):
    """A point of the unit disc other than its centre, evenly spread, and its squared radius."""
    while True:
        x, y = 2.0 * uniform(state) - 1.0, 2.0 * uniform(state) - 1.0
        squared = x * x + y * y
        if 0.0 < squared < 1.0:
            return x, y, squared


@part
def azimuth(state):
    """Cosine and sine of an angle from all round: twice that of a point in the disc."""
    x, y, squared = in_disc(state)
    return (x * x - y * y) / squared, 2.0 * x * y / squared


@part
def free_path(state, coefficient):
    """Distance to the next event of a kind with the given coefficient; infinite for 0 (4.1)."""
    if coefficient <= 0.0:
        return math.inf
    return -math.log(1.0 - uniform(state)) / coefficient


@part
def forward_cosine(state, scale):
    """Cosine of a polar angle of density exp(-x / scale) sin(x) on [0, pi) (algorithm 1).

    In y = 2 sin(x / 2), for which cos(x) = 1 - y^2 / 2, it is y exp(-x / scale) on [0, 2): a gamma
    density, kept with probability exp(-(x - y) / scale). Since x - y <= y^3 / 20 up to y = 1, the
    arc sine is mostly spared.
    """
    while True:
        y = -scale * math.log((1.0 - uniform(state)) * (1.0 - uniform(state)))
        drawn = scale * uniform(state)
        if y < 1.0 and drawn <= scale - 0.05 * y * y * y:
            return 1.0 - 0.5 * y * y
        if y < 2.0 and drawn <= scale * math.exp((y - 2.0 * math.asin(0.5 * y)) / scale):
            return 1.0 - 0.5 * y * y


@part
def exponential_angle(state, mean):
    """Polar angle from an exponential distribution, cut at pi: the text beside algorithm 1."""
    while True:
        angle = -mean * math.log(1.0 - uniform(state))
        if angle < math.pi:
            return angle


@part
def rayleigh_cosine(state):
    """Cosine x of the polar angle of density (1 + cos^2) sin (algorithm 2).

    1 + x^2 on [-1, 1] is three parts of 1 and one of 3 x^2, the largest of three numbers' density.
    """
    size = uniform(state)
    if uniform(state) < 0.25:
        size = max(size, uniform(state), uniform(state))
    return size if uniform(state) < 0.5 else -size


@part
def lambertian_cosine(state):
    """Cosine of the polar angle of the cosine distribution (section 4.2.1)."""
    return math.sqrt(1.0 - uniform(state))


@part
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
            # sqrt(w) / (s^2 + w)^2 is sin^2 of the angle whose tangent is sqrt(w) / s, which is
            # the density of the arc cosine of a coordinate in the disc
            cosine = 0.0
            while cosine == 0.0:
                cosine, _, _ = in_disc(state)
            slope = squared * (1.0 / (cosine * cosine) - 1.0)
        if uniform(state) * (1.0 + math.sqrt(slope)) <= math.sqrt(1.0 + slope):
            return slope


@part
def spheroid_cosine(drawn, aspect):
    """Cosine between a ray and the long axis of a prolate spheroid that it meets (4.5), inverted.

    4.5 times the measure sin(alpha), with chi_1 = pi a b seen from the side and chi_2 = pi a^2
    seen along the axis; `aspect` is a / b = chi_2 / chi_1. Of the axis's two ends it is the one
    ahead; `drawn` is a number evenly spread from 0 to 1.
    """
    return (1.0 + aspect) * drawn / (1.0 + math.sqrt(1.0 - (1.0 - aspect * aspect) * drawn))


@part
def henyey_greenstein_cosine(state, anisotropy):
    """Cosine of the polar angle of the Henyey-Greenstein density (1941)."""
    if abs(anisotropy) < 1e-6:
        return 2.0 * uniform(state) - 1.0
    squared = anisotropy * anisotropy
    ratio = (1.0 - squared) / (1.0 - anisotropy + 2.0 * anisotropy * uniform(state))
    return (1.0 + squared - ratio * ratio) / (2.0 * anisotropy)


@part
def turned(state, ray, cosine):
    """The unit vector at a polar angle of the given cosine from a unit vector, any azimuth."""
    sine = math.sqrt(max(0.0, 1.0 - cosine * cosine))
    return nearly_unit(about(ray, sine, cosine, azimuth(state)))
