"""The random walk as the thesis prints it: figure 4.3 with algorithms 1 and 2, loop by loop.

One distance is drawn for each attenuator, melanosomes are placed one by one, and every path in
them is walked, reflection by reflection. Drawn in another way than printed, because nothing else
can be told from the text: normals of the surface (4.8), orientations of melanosomes (4.5, with
the measure sin(alpha)), and one allowance of absorber for a whole path in a melanosome instead of
one for each of its chords, which is the same.
"""

import math

from hylios.transport.compiling import part
from hylios.transport.events import (
    ABSORBED,
    ABSORBED_IN_MELANOSOME,
    ABSORBER,
    FIBRES,
    INTERFACE,
    LOST,
    MELANOSOME,
    MOST_DRAWS,
    MOST_EVENTS,
    SCATTERER,
    SURFACE,
    UNDECIDED,
    UP,
    at_face,
    distance_to_face,
    fits,
    half_axes,
    meet_face,
    melanosomes_met,
)
from hylios.transport.generator import uniform
from hylios.transport.interfaces import meet_surface
from hylios.transport.melanosome import (
    drawn_body,
    overlap,
    survives_complex,
    survives_melanosome,
)
from hylios.transport.sampling import (
    exponential_angle,
    forward_cosine,
    free_path,
    henyey_greenstein_cosine,
    turned,
)
from hylios.transport.stack_arrays import (
    ABOVE,
    ABSORPTION,
    ANISOTROPY,
    BENT,
    BY_DIAMETER,
    COMPLEX_RADIUS,
    ENCOUNTER,
    EVERY_COLLISION,
    EXPONENTIAL,
    INDEX,
    MELANIN,
    MELANIN_INDEX,
    RAYLEIGH,
    ROUGHNESS,
    SCATTERING,
    SCATTERING_ANGLE,
)
from hylios.transport.vectors import added, dot

LEAST_SCALE = 1e-3
"""Parameter of algorithm 1 in radians, .06 degrees, below which its loop, of which a share near
the parameter is accepted, gives way to the equivalent: it would not end in time just below 1300 nm.
"""


@part
def algorithm_1(state, scale):
    """Polar angle of a melanosome's scattering, drawn from [0, pi) until accepted."""
    if scale < LEAST_SCALE:
        return math.acos(forward_cosine(state, scale))
    peak = math.atan(scale)
    most = 1.0 / scale * math.exp(-peak / scale) * math.sin(peak)
    while True:
        drawn = uniform(state)
        angle = math.pi * uniform(state)
        if most * drawn <= 1.0 / scale * math.exp(-angle / scale) * math.sin(angle):
            return angle


@part
def algorithm_2(state):
    """Polar angle of the connective fibres' scattering, drawn from [0, pi) until accepted."""
    while True:
        angle = math.pi * uniform(state)
        density = (1.0 + math.cos(angle) ** 2) * math.sin(angle)
        if uniform(state) <= 3.0 * math.sqrt(6.0) / 8.0 * density:
            return angle


@part
def walk_as_printed(layers, surroundings, readings, ray, state):
    """Walk one ray from its arrival at the surface to its end.

    Returns how it ended, the layer that absorbed it (-1 if none did), where, and its direction.
    """
    position = (0.0, 0.0, 0.0)
    crossed, ray = meet_surface(
        state, ray, surroundings[ABOVE], layers[0, INDEX], surroundings[ROUGHNESS]
    )
    if not crossed:
        return SURFACE, -1, position, ray
    here, fibres_ahead = 0, True
    before = (False, position, UP)
    for _ in range(MOST_EVENTS):
        distance, event = _next_event(state, layers, here, position, ray, fibres_ahead)
        distance, event, body = _melanosome_before(
            state, layers, here, position, ray, distance, event, before
        )
        if distance == math.inf:
            return LOST, here, position, ray
        position = added(position, distance, ray)
        if event == INTERFACE:
            fibres_ahead, before = True, (False, position, UP)
            position = at_face(layers, here, position, ray)
            end, here, ray = meet_face(state, layers, surroundings, readings, here, ray)
            if end != UNDECIDED:
                return end, -1, position, ray
        elif event == ABSORBER:
            return ABSORBED, here, position, ray
        elif event == MELANOSOME:
            axis, point, centre = body
            if not _survives(state, layers, here, surroundings, readings, ray, axis, point):
                return ABSORBED_IN_MELANOSOME, here, position, ray
            before = (True, centre, axis)
            ray = _turned_by_melanosome(state, ray, surroundings, readings)
        elif event == FIBRES:
            ray = turned(state, ray, math.cos(algorithm_2(state)))
            fibres_ahead = readings[EVERY_COLLISION]
        else:
            ray = turned(state, ray, henyey_greenstein_cosine(state, layers[here, ANISOTROPY]))
    return LOST, here, position, ray


@part
def _next_event(state, layers, here, position, ray, fibres_ahead):
    """Distance to and kind of the nearest event, melanosomes left aside (figure 4.3)."""
    distance, event = distance_to_face(layers, here, position, ray), INTERFACE
    path = free_path(state, layers[here, ABSORPTION])
    if path < distance:
        distance, event = path, ABSORBER
    if fibres_ahead:
        path = free_path(state, layers[here, RAYLEIGH])
        if path < distance:
            distance, event = path, FIBRES
    path = free_path(state, layers[here, SCATTERING])
    if path < distance:
        distance, event = path, SCATTERER
    return distance, event


@part
def _melanosome_before(state, layers, here, position, ray, distance, event, before):
    """The event, or a melanosome or complex that comes before it and has room (figure 4.3).

    `before` is whether one has been met in this traversal, its centre and its axis. Returns
    distance and kind, and the axis, point hit and centre of what was met.
    """
    axis, point, centre = UP, UP, position
    if layers[here, ENCOUNTER] > 0.0:
        axes, radius = half_axes(layers, here), layers[here, COMPLEX_RADIUS]
        met, met_centre, met_axis = before
        for _draw in range(MOST_DRAWS):
            path = free_path(state, layers[here, ENCOUNTER])
            if path >= distance:
                break
            axis, point, offset = drawn_body(state, ray, axes, radius)
            centre = added(added(position, path, ray), 1.0, offset)
            if fits(layers, here, centre, axis) and not (
                met and overlap(centre, axis, met_centre, met_axis, axes, radius)
            ):
                return path, MELANOSOME, (axis, point, centre)
    return distance, event, (axis, point, centre)


@part
def _survives(state, layers, here, surroundings, readings, ray, axis, point):
    """Whether a ray leaves a melanosome or complex unabsorbed."""
    axes, index = half_axes(layers, here), surroundings[MELANIN_INDEX]
    optics = (layers[here, MELANIN], index, layers[here, INDEX], readings[BENT], math.inf)
    if layers[here, COMPLEX_RADIUS] > 0.0:
        count = melanosomes_met(layers, here, -dot(point, ray), readings[BY_DIAMETER])
        return survives_complex(state, ray, count, axes, optics)
    return survives_melanosome(state, ray, axis, point, axes, optics)


@part
def _turned_by_melanosome(state, ray, surroundings, readings):
    scale = surroundings[SCATTERING_ANGLE]
    if scale <= 0.0:
        return ray
    if readings[EXPONENTIAL]:
        return turned(state, ray, math.cos(exponential_angle(state, scale)))
    return turned(state, ray, math.cos(algorithm_1(state, scale)))
