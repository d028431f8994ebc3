"""Light meeting a melanosome, a prolate spheroid, or a spherical complex of them (4.2.1).

A spheroid is handled as the image of the unit ball, stretched along its long axis: rays evenly
spread over its projection are evenly spread over the ball's. Its half axes are a pair (minor,
major), in cm; a complex has a radius instead.
"""

import math

from hylios.transport.compiling import part
from hylios.transport.generator import uniform
from hylios.transport.interfaces import fresnel, refracted
from hylios.transport.sampling import (
    azimuth,
    free_path,
    in_disc,
    lambertian_cosine,
    spheroid_cosine,
    turned,
)
from hylios.transport.vectors import about, added, cross, dot, nearly_unit, scaled, stretched, unit


@part
def drawn_complex(state, ray, radius):
    """A complex that a ray hits: the point hit on the unit ball, and where from it the centre lies.

    The point is evenly spread over the ball's projection.
    """
    x, y, squared = in_disc(state)
    point = about(ray, 1.0, -math.sqrt(1.0 - squared), (x, y))
    return point, scaled(point, -radius)


@part
def drawn_melanosome(state, ray, half_axes):
    """A melanosome that a ray hits, turned by 4.5 and 4.6 and hit evenly over its projection.

    Returns as `placed_melanosome`.
    """
    cosine = spheroid_cosine(uniform(state), half_axes[0] / half_axes[1])
    x, y, _ = in_disc(state)
    return placed_melanosome(ray, half_axes, cosine, azimuth(state), x, y)


@part
def placed_melanosome(ray, half_axes, cosine, turn, x, y):
    """A melanosome whose long axis lies at a polar angle and azimuth from a ray that hits it.

    Where it is hit is given as the place (x, y) in the projection of the unit ball of which it is
    the stretched image. Returns its long axis, the point hit on that ball, and where from the
    point hit the centre lies.
    """
    minor, major = half_axes
    sine = math.sqrt(1.0 - cosine * cosine)
    level = nearly_unit(about(ray, 1.0, 0.0, turn))
    # right-handed: the long axis, at right angles to it in the plane of the ray, and sideways
    axis = added(scaled(ray, cosine), sine, level)
    upright = added(scaled(ray, sine), -cosine, level)
    sideways = cross(axis, upright)
    on_axis, on_upright = cosine / major, sine / minor
    shrunk = 1.0 / math.sqrt(on_axis * on_axis + on_upright * on_upright)
    on_axis, on_upright = on_axis * shrunk, on_upright * shrunk
    depth = math.sqrt(1.0 - x * x - y * y)
    along, up = -depth * on_axis - x * on_upright, x * on_axis - depth * on_upright
    point = added(added(scaled(axis, along), up, upright), y, sideways)
    offset = added(added(scaled(axis, -major * along), -minor * up, upright), -minor * y, sideways)
    return axis, point, offset


@part
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
        point = nearly_unit(added(point, chord, on_unit))
        normal = unit(stretched(point, axis, shrink[0], shrink[1]))
        cosine = dot(ray, normal)
        reflectance, _ = fresnel(min(max(cosine, 0.0), 1.0), inside, outside)
        if uniform(state) >= reflectance:
            return path
        mirrored = added(ray, -2.0 * cosine, normal)
        ray = turned(state, mirrored, lambertian_cosine(state))
        while dot(ray, normal) >= 0.0:
            ray = turned(state, mirrored, lambertian_cosine(state))


@part
def survives_melanosome(state, ray, axis, point, half_axes, optics):
    """Whether a ray that enters a spheroid at a point of the unit ball leaves it unabsorbed.

    `optics` is the coefficient of melanin in there, the refractive indices inside and outside,
    whether rays are refracted as they enter, and a length that no path exceeds: where melanin
    allows more, the path need not be walked. What it allows is drawn once: drawing it anew for
    every chord, as the thesis does, is the same, for it has no memory.
    """
    absorption, inside, outside, bent, longest = optics
    free = free_path(state, absorption)
    return free >= longest or free >= path_in_melanosome(
        state, ray, axis, point, half_axes, free, inside, outside, bent
    )


@part
def survives_complex(state, ray, count, half_axes, optics):
    """Whether a ray leaves `count` melanosomes of a complex, each turned anew, unabsorbed."""
    for _ in range(count):
        axis, point, _ = drawn_melanosome(state, ray, half_axes)
        if not survives_melanosome(state, ray, axis, point, half_axes, optics):
            return False
    return True


@part
def drawn_body(state, ray, half_axes, radius):
    """A complex that a ray hits, or a melanosome where the radius is 0, as `drawn_melanosome`."""
    if radius > 0.0:
        point, offset = drawn_complex(state, ray, radius)
        return ray, point, offset
    return drawn_melanosome(state, ray, half_axes)


@part
def half_extent(axis, along, half_axes):
    """Half the extent of a spheroid along a vector, times the vector's length."""
    part = dot(axis, along)
    minor, major = half_axes
    added_by_axis = (major * major - minor * minor) * part * part
    return math.sqrt(minor * minor * dot(along, along) + added_by_axis)


@part
def overlap(centre, axis, other_centre, other_axis, half_axes, radius):
    """Whether two complexes of a radius, or two melanosomes where it is 0, overlap.

    Spheroids count as overlapping when their extents along the line between their centres meet:
    exact for spheres, a little strict for others.
    """
    between = added(centre, -1.0, other_centre)
    squared = dot(between, between)
    largest = max(radius, half_axes[1])
    if squared >= 4.0 * largest * largest:
        return False
    if radius > 0.0 or squared == 0.0:
        return True
    reach = half_extent(axis, between, half_axes) + half_extent(other_axis, between, half_axes)
    return squared < reach
