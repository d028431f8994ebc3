"""What happens where two refractive indices meet: Fresnel, refraction, the rough surface.

Rays and normals are unit vectors with z pointing into the skin.
"""

import math

from hylios.transport.compiling import part
from hylios.transport.generator import uniform
from hylios.transport.sampling import azimuth, surface_slope_squared
from hylios.transport.vectors import added, dot, scaled


@part
def fresnel(cosine, index_from, index_to):
    """Reflectance for unpolarised light and the cosine beyond; (1, 0) in total reflection."""
    ratio = index_from / index_to
    squared = ratio * ratio * (1.0 - cosine * cosine)
    if squared >= 1.0:
        return 1.0, 0.0
    beyond = math.sqrt(1.0 - squared)
    near, far = index_from * cosine, index_to * beyond
    across, of_across = near - far, near + far
    near, far = index_from * beyond, index_to * cosine
    along, of_along = near - far, near + far
    across, along, both = across * of_along, along * of_across, of_across * of_along
    return 0.5 * (across * across + along * along) / (both * both), beyond


@part
def refracted(ray, normal, cosine, beyond, ratio):
    """The ray beyond an interface (Snell); `normal` faces it, `ratio` is index from / index to."""
    return added(scaled(ray, ratio), ratio * cosine - beyond, normal)


FLAT = 1e-6
"""Roughness up to which a surface is taken as flat: its normals tilt by about as many radians."""


@part
def surface_normal(state, roughness):
    """A normal of the surface, pointing out of the skin (4.8); straight up where it is flat."""
    if roughness <= FLAT:
        return 0.0, 0.0, -1.0
    slope = surface_slope_squared(state, roughness)
    cosine = 1.0 / math.sqrt(1.0 + slope)
    sine = math.sqrt(slope) * cosine
    turn = azimuth(state)
    return sine * turn[0], sine * turn[1], -cosine


@part
def meet_surface(state, ray, index_from, index_to, roughness):
    """Reflection or refraction at the surface, from outside (z > 0) or from inside (z < 0).

    Returns whether the ray crossed, and its new direction. A facet that faces away from the ray,
    or would send it to the wrong side, is drawn again.
    """
    while True:
        normal = surface_normal(state, roughness)
        if ray[2] < 0.0:
            normal = scaled(normal, -1.0)
        cosine = -dot(ray, normal)
        if cosine <= 0.0:
            continue
        reflectance, beyond = fresnel(cosine, index_from, index_to)
        if uniform(state) < reflectance:
            mirrored = added(ray, 2.0 * cosine, normal)
            if mirrored[2] * ray[2] < 0.0:
                return False, mirrored
        else:
            passed = refracted(ray, normal, cosine, beyond, index_from / index_to)
            if passed[2] * ray[2] > 0.0:
                return True, passed


@part
def meet_interface(state, ray, index_from, index_to):
    """Reflection or refraction at a flat interface.

    Returns whether the ray crossed, and its new direction.
    """
    if index_from == index_to:
        return True, ray
    reflectance, beyond = fresnel(abs(ray[2]), index_from, index_to)
    if uniform(state) < reflectance:
        return False, (ray[0], ray[1], -ray[2])
    ratio = index_from / index_to
    return True, (ratio * ray[0], ratio * ray[1], math.copysign(beyond, ray[2]))
