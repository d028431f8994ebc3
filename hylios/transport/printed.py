"""The random walk as the thesis prints it: figure 4.3 with algorithms 1 and 2, loop by loop.

One distance is drawn for each attenuator, melanosomes are placed one by one, and every path in
them is walked, reflection by reflection. Drawn in another way than printed, because nothing else
can be told from the text: normals of the surface (4.8), orientations of melanosomes (4.5, with
the measure sin(alpha)), and one allowance of absorber for a whole path in a melanosome instead of
one for each of its chords, which is the same.
"""

import math

from hylios.transport.compiling import part
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
from hylios.transport.vectors import added, dot
from hylios.transport.walk import (
    ABSORBED,
    ABSORBED_IN_MELANOSOME,
    ABSORBER,
    ABSORPTION,
    ANISOTROPY,
    BOTTOM,
    COMPLEX_RADIUS,
    ENCOUNTER,
    FIBRES,
    INDEX,
    INTERFACE,
    LOST,
    MELANIN,
    MELANOSOME,
    MOST_DRAWS,
    MOST_EVENTS,
    RAYLEIGH,
    SCATTERER,
    SCATTERING,
    SEMI_MAJOR,
    SEMI_MINOR,
    SURFACE,
    TOP,
    UNDECIDED,
    UP,
    distance_to_face,
    fits,
    meet_face,
    melanosomes_met,
)

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
    """One ray from its arrival at the surface to its end.

    Returns how it ended, the layer that absorbed it (-1 if none did), where, and its direction.
    """
    roughness, above, _, melanin_index, scale, _ = surroundings
    _, by_diameter, bent, exponential, every, _, _ = readings
    position = (0.0, 0.0, 0.0)
    crossed, ray = meet_surface(state, ray, above, layers[0, INDEX], roughness)
    if not crossed:
        return SURFACE, -1, position, ray

    here, fibres_ahead = 0, True
    met, met_centre, met_axis = False, position, UP
    for _ in range(MOST_EVENTS):
        half_axes = (layers[here, SEMI_MINOR], layers[here, SEMI_MAJOR])
        distance, event = _next_event(state, layers, here, position, ray, fibres_ahead)
        axis, point, centre = UP, UP, position
        if layers[here, ENCOUNTER] > 0.0:
            for _draw in range(MOST_DRAWS):
                path = free_path(state, layers[here, ENCOUNTER])
                if path >= distance:
                    break
                axis, point, offset = drawn_body(
                    state, ray, half_axes, layers[here, COMPLEX_RADIUS]
                )
                centre = added(added(position, path, ray), 1.0, offset)
                if fits(layers, here, centre, axis) and not (
                    met
                    and overlap(
                        centre, axis, met_centre, met_axis, half_axes, layers[here, COMPLEX_RADIUS]
                    )
                ):
                    distance, event = path, MELANOSOME
                    break

        if distance == math.inf:
            return LOST, here, position, ray
        position = added(position, distance, ray)
        if event == ABSORBER:
            return ABSORBED, here, position, ray
        if event == FIBRES:
            ray = turned(state, ray, math.cos(algorithm_2(state)))
            fibres_ahead = every
        elif event == SCATTERER:
            ray = turned(state, ray, henyey_greenstein_cosine(state, layers[here, ANISOTROPY]))
        elif event == MELANOSOME:
            optics = (layers[here, MELANIN], melanin_index, layers[here, INDEX], bent, math.inf)
            if layers[here, COMPLEX_RADIUS] > 0.0:
                count = melanosomes_met(layers, here, -dot(point, ray), by_diameter)
                survived = survives_complex(state, ray, count, half_axes, optics)
            else:
                survived = survives_melanosome(state, ray, axis, point, half_axes, optics)
            if not survived:
                return ABSORBED_IN_MELANOSOME, here, position, ray
            met, met_centre, met_axis = True, centre, axis
            if scale > 0.0:
                polar = (
                    exponential_angle(state, scale) if exponential else algorithm_1(state, scale)
                )
                ray = turned(state, ray, math.cos(polar))
        else:
            fibres_ahead, met = True, False
            # at the face itself, not where rounding has put the ray
            face = layers[here, BOTTOM] if ray[2] > 0.0 else layers[here, TOP]
            position = (position[0], position[1], face)
            end, here, ray = meet_face(state, layers, surroundings, readings, here, ray)
            if end != UNDECIDED:
                return end, -1, position, ray
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
