"""What rays meet in a stack, how they end, and the rules at the faces of its layers.

Both ways through the model of figure 4.3, `hylios.transport.printed` and
`hylios.transport.equivalent`, share these. z points into the skin, lengths are in cm.
"""

import math

from hylios.transport.compiling import part
from hylios.transport.generator import uniform
from hylios.transport.interfaces import meet_interface, meet_surface
from hylios.transport.melanosome import half_extent
from hylios.transport.sampling import lambertian_cosine, turned
from hylios.transport.stack_arrays import (
    ABOVE,
    ACROSS,
    BELOW,
    BOTTOM,
    COMPLEX_RADIUS,
    DIFFUSE_FLOOR,
    FLOOR_REFLECTANCE,
    INDEX,
    INNER_FRESNEL,
    MIRRORED,
    ROUGHNESS,
    SEMI_MAJOR,
    SEMI_MINOR,
    TOP,
)

SURFACE, SUBSURFACE, TRANSMITTED, ABSORBED, ABSORBED_IN_MELANOSOME, LOST = range(6)
"""How a ray ends. LOST after `MOST_EVENTS` events, or on a way without end or event."""

UNDECIDED = -1

MOST_EVENTS = 10_000_000
MOST_DRAWS = 1000
"""Tries to place a melanosome; one that does not fit into its layer at all lets the ray pass."""

INTERFACE, ABSORBER, FIBRES, SCATTERER, MELANOSOME = range(5)
"""What a ray meets next."""

UP = (0.0, 0.0, -1.0)


@part
def distance_to_face(layers, here, position, ray):
    """Distance along a ray to where it leaves its layer; infinite for a level one."""
    if ray[2] > 0.0:
        return (layers[here, BOTTOM] - position[2]) / ray[2]
    if ray[2] < 0.0:
        return (layers[here, TOP] - position[2]) / ray[2]
    return math.inf


@part
def at_face(layers, here, position, ray):
    """The place where a ray leaves its layer: on the face itself, not where rounding has put it."""
    return position[0], position[1], layers[here, BOTTOM] if ray[2] > 0.0 else layers[here, TOP]


@part
def half_axes(layers, here):
    """Half axes of the melanosomes in a layer: minor and major."""
    return layers[here, SEMI_MINOR], layers[here, SEMI_MAJOR]


@part
def meet_face(state, layers, surroundings, readings, here, ray):
    """What becomes of a ray at a face of layer `here`: its end or UNDECIDED, its layer, the ray."""
    down = ray[2] > 0.0
    index = layers[here, INDEX]
    beyond = here + 1 if down else here - 1
    if 0 <= beyond < layers.shape[0]:
        crossed = True
        if readings[INNER_FRESNEL]:
            crossed, ray = meet_interface(state, ray, index, layers[beyond, INDEX])
        return UNDECIDED, beyond if crossed else here, ray
    if not down:
        crossed, ray = meet_surface(state, ray, index, surroundings[ABOVE], surroundings[ROUGHNESS])
        return SUBSURFACE if crossed else UNDECIDED, here, ray
    if readings[DIFFUSE_FLOOR]:
        share = surroundings[FLOOR_REFLECTANCE]
        if share < 1.0 and uniform(state) >= share:
            return TRANSMITTED, here, ray
        return UNDECIDED, here, _leave_floor(state, ray, readings[MIRRORED])
    crossed, ray = meet_interface(state, ray, index, surroundings[BELOW])
    return TRANSMITTED if crossed else UNDECIDED, here, ray


@part
def _leave_floor(state, ray, mirrored):
    """Diffuse direction off the dermal floor, about its normal or about the mirrored ray."""
    if not mirrored:
        return turned(state, UP, lambertian_cosine(state))
    about = (ray[0], ray[1], -ray[2])
    ray = turned(state, about, lambertian_cosine(state))
    while ray[2] >= 0.0:
        ray = turned(state, about, lambertian_cosine(state))
    return ray


@part
def fits(layers, here, centre, axis):
    """Whether a melanosome or complex lies within its layer."""
    height = layers[here, COMPLEX_RADIUS]
    if height == 0.0:
        height = half_extent(axis, UP, half_axes(layers, here))
    return layers[here, TOP] <= centre[2] - height and centre[2] + height <= layers[here, BOTTOM]


@part
def melanosomes_met(layers, here, chord, by_diameter):
    """Melanosomes that a ray meets in a complex, given its chord in diameters."""
    return int(layers[here, ACROSS] * (1.0 if by_diameter else chord))
