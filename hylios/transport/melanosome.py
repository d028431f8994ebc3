"""Light meeting a melanosome, a prolate spheroid, or a spherical complex of them (4.2.1).

A spheroid is handled as the image of the unit ball, stretched along its long axis: rays evenly
spread over its projection are evenly spread over the ball's. Its half axes are a pair (minor,
major), in cm; a complex has a radius instead.
"""

import math

from numba import njit

from hylios.transport.generator import uniform
from hylios.transport.interfaces import fresnel, refracted
from hylios.transport.sampling import free_path, lambertian_cosine, spheroid_cosine, turned
from hylios.transport.vectors import TWO_PI, about, added, dot, length, scaled, stretched, unit


@njit
def long_axis(state, ray, half_axes):
    """Direction of the long axis of a spheroid that a ray meets (4.5, 4.6)."""
    return turned(state, ray, spheroid_cosine(state, half_axes[0] / half_axes[1]))


@njit
def facing_point(state, ray):
    """A point of the unit ball's surface that faces a ray, evenly spread over its projection."""
    squared = uniform(state)
    return about(ray, math.sqrt(squared), -math.sqrt(1.0 - squared), TWO_PI * uniform(state))


@njit
def on_ball(ray, axis, half_axes):
    """Direction of a ray in the frame in which the spheroid is the unit ball."""
    return unit(stretched(ray, axis, 1.0 / half_axes[0], 1.0 / half_axes[1]))


@njit
def path_in_melanosome(state, ray, axis, point, half_axes, free, inside, outside, bent):
    """Length of a ray's path through a spheroid that it enters at a point of the unit ball.

    Ends where the path would exceed `free`, the length that the absorber allows. `inside` and
    `outside` are refractive indices. The ray goes in straight on, or refracted if `bent`; where
    it is reflected inside, its direction is spread by the cosine distribution until it points
    inwards.
    """
    shrink = (1.0 / half_axes[0], 1.0 / half_axes[1])
    if bent:
        normal = unit(stretched(point, axis, shrink[0], shrink[1]))
        cosine = max(0.0, -dot(ray, normal))
        reflectance, beyond = fresnel(cosine, outside, inside)
        if reflectance < 1.0:
            ray = unit(refracted(ray, normal, cosine, beyond, outside / inside))
    path = 0.0
    while True:
        on_unit = stretched(ray, axis, shrink[0], shrink[1])
        chord = -2.0 * dot(point, on_unit) / dot(on_unit, on_unit)
        path += chord
        if path > free:
            return path
        point = unit(added(point, chord, on_unit))
        normal = unit(stretched(point, axis, shrink[0], shrink[1]))
        cosine = dot(ray, normal)
        reflectance, _ = fresnel(min(max(cosine, 0.0), 1.0), inside, outside)
        if uniform(state) >= reflectance:
            return path
        mirrored = added(ray, -2.0 * cosine, normal)
        ray = turned(state, mirrored, lambertian_cosine(state))
        while dot(ray, normal) >= 0.0:
            ray = turned(state, mirrored, lambertian_cosine(state))


@njit
def survives_melanosome(state, ray, axis, point, half_axes, absorption, inside, outside, bent):
    """Whether a ray that enters a spheroid at a point of the unit ball leaves it unabsorbed.

    `absorption` is the coefficient of melanin in there. The length that it allows is drawn once:
    drawing it anew for every chord, as the thesis does, is the same, for it has no memory.
    """
    free = free_path(state, absorption)
    return free >= path_in_melanosome(
        state, ray, axis, point, half_axes, free, inside, outside, bent
    )


@njit
def survives_complex(state, ray, count, half_axes, absorption, inside, outside, bent):
    """Whether a ray leaves `count` melanosomes of a complex, each turned anew, unabsorbed."""
    for _ in range(count):
        axis = long_axis(state, ray, half_axes)
        point = facing_point(state, on_ball(ray, axis, half_axes))
        if not survives_melanosome(
            state, ray, axis, point, half_axes, absorption, inside, outside, bent
        ):
            return False
    return True


@njit
def half_extent(axis, along, half_axes):
    """Half the extent of a spheroid along a unit vector."""
    part = dot(axis, along)
    minor, major = half_axes
    return math.sqrt(minor * minor * (1.0 - part * part) + major * major * part * part)


@njit
def overlap(centre, axis, other_centre, other_axis, half_axes, radius):
    """Whether two complexes of a radius, or two melanosomes where it is 0, overlap.

    Spheroids count as overlapping when their extents along the line between their centres meet:
    exact for spheres, a little strict for others.
    """
    between = added(centre, -1.0, other_centre)
    apart = length(between)
    if apart >= 2.0 * max(radius, half_axes[1]):
        return False
    if radius > 0.0 or apart == 0.0:
        return True
    line = scaled(between, 1.0 / apart)
    reach = half_extent(axis, line, half_axes) + half_extent(other_axis, line, half_axes)
    return apart < reach
