"""The random walk of figure 4.3: one ray at a time through plane layers.

Arrays in, arrays out: `walk` traces rays and writes for each how it ended, where and in which
direction; nothing is tallied here. z points into the skin, lengths are in cm.
"""

import math

import numpy as np
from numba import njit

from hylios.tissue import Stack
from hylios.transport.compiling import kernel
from hylios.transport.generator import uniform
from hylios.transport.interfaces import meet_interface, meet_surface
from hylios.transport.melanosome import (
    facing_point,
    half_extent,
    long_axis,
    on_ball,
    overlap,
    survives_complex,
    survives_melanosome,
)
from hylios.transport.sampling import (
    exponential_angle,
    forward_angle,
    free_path,
    henyey_greenstein_cosine,
    lambertian_cosine,
    rayleigh_cosine,
    turned,
)
from hylios.transport.vectors import added, dot, stretched

SURFACE, SUBSURFACE, TRANSMITTED, ABSORBED, ABSORBED_IN_MELANOSOME, LOST = range(6)
"""How a ray ends. LOST after `MOST_EVENTS` events, which nothing that absorbs or leaks reaches."""

MOST_EVENTS = 10_000_000
MOST_DRAWS = 1000
"""Tries to place a melanosome; one that does not fit into its layer at all lets the ray pass."""

COLUMNS = (
    "top",
    "bottom",
    "refractive_index",
    "absorption",
    "encounter",
    "semi_minor",
    "semi_major",
    "complex_radius",
    "melanin_absorption",
    "rayleigh",
    "scattering",
    "anisotropy",
    "survival",
)
(
    TOP,
    BOTTOM,
    INDEX,
    ABSORPTION,
    ENCOUNTER,
    SEMI_MINOR,
    SEMI_MAJOR,
    COMPLEX_RADIUS,
    MELANIN,
    RAYLEIGH,
    SCATTERING,
    ANISOTROPY,
    SURVIVAL,
) = range(len(COLUMNS))


def kernel_arguments(stack: Stack) -> tuple[np.ndarray, tuple[float, ...], tuple[bool, ...]]:
    """A stack as `walk` takes it: layers (L, columns), surroundings, readings."""
    bottoms = np.cumsum([layer.thickness for layer in stack.layers])
    tops = np.concatenate([[0.0], bottoms[:-1]])
    rows = [
        [top, bottom, *(getattr(layer, name) for name in COLUMNS[2:])]
        for top, bottom, layer in zip(tops, bottoms, stack.layers, strict=True)
    ]
    surroundings = (
        stack.roughness,
        stack.index_above,
        stack.index_below,
        stack.melanin_index,
        stack.scattering_angle,
    )
    chosen = stack.readings
    readings = (
        stack.lambertian_floor,
        chosen["complex_melanosomes"] == "diameter",
        chosen["melanosome_entry"] == "refracted",
        chosen["melanosome_scattering"] == "exponential",
        chosen["rayleigh"] == "every_collision",
        chosen["inner_fresnel"] == "on",
        chosen["floor"] == "mirrored",
    )
    return np.array(rows, dtype=float), surroundings, readings


INTERFACE, ABSORBER, FIBRES, SCATTERER, MELANOSOME = range(5)
"""What a ray meets next."""

UP = (0.0, 0.0, -1.0)


@njit
def _walk_one(layers, surroundings, readings, ray, state):
    roughness, above, below, melanin_index, angle = surroundings
    floor, by_diameter, bent, exponential, every, optical, mirrored = readings
    position = (0.0, 0.0, 0.0)
    crossed, ray = meet_surface(state, ray, above, layers[0, INDEX], roughness)
    if not crossed:
        return SURFACE, -1, position, ray

    here, last = 0, layers.shape[0] - 1
    fibres_ahead = True
    met, met_centre, met_axis = False, position, UP
    for _ in range(MOST_EVENTS):
        layer = layers[here]
        face = _distance_to_face(layer, position, ray)
        distance, event = _next_event(state, layer, face, fibres_ahead)
        half_axes = (layer[SEMI_MINOR], layer[SEMI_MAJOR])
        axis, point, centre = UP, UP, position
        if layer[ENCOUNTER] > 0.0:
            for _draw in range(MOST_DRAWS):
                path = free_path(state, layer[ENCOUNTER])
                if path >= distance:
                    break
                axis, point, centre = _melanosome(
                    state, added(position, path, ray), ray, half_axes, layer[COMPLEX_RADIUS]
                )
                if _fits(layer, centre, axis, half_axes) and not (
                    met
                    and overlap(
                        centre, axis, met_centre, met_axis, half_axes, layer[COMPLEX_RADIUS]
                    )
                ):
                    distance, event = path, MELANOSOME
                    break

        position = added(position, distance, ray)
        if event == ABSORBER:
            return ABSORBED, here, position, ray
        if event == FIBRES:
            ray = turned(state, ray, rayleigh_cosine(state))
            fibres_ahead = every
        elif event == SCATTERER:
            ray = turned(state, ray, henyey_greenstein_cosine(state, layer[ANISOTROPY]))
        elif event == MELANOSOME:
            if layer[COMPLEX_RADIUS] > 0.0:
                across = 1.0 if by_diameter else -dot(point, ray)
                count = int(across * layer[COMPLEX_RADIUS] / layer[SEMI_MINOR])
            else:
                count = 1
            if layer[SURVIVAL] >= 0.0:
                survived = uniform(state) < layer[SURVIVAL] ** count
            elif layer[COMPLEX_RADIUS] > 0.0:
                survived = survives_complex(
                    state, ray, count, half_axes, layer[MELANIN], melanin_index, layer[INDEX], bent
                )
            else:
                survived = survives_melanosome(
                    state,
                    ray,
                    axis,
                    point,
                    half_axes,
                    layer[MELANIN],
                    melanin_index,
                    layer[INDEX],
                    bent,
                )
            if not survived:
                return ABSORBED_IN_MELANOSOME, here, position, ray
            met, met_centre, met_axis = True, centre, axis
            if angle > 0.0:
                polar = (
                    exponential_angle(state, angle) if exponential else forward_angle(state, angle)
                )
                ray = turned(state, ray, math.cos(polar))
        else:
            fibres_ahead, met = True, False
            down = ray[2] > 0.0
            # at the face itself, not where rounding has put the ray
            position = (position[0], position[1], layer[BOTTOM] if down else layer[TOP])
            beyond = here + 1 if down else here - 1
            if 0 <= beyond <= last:
                crossed = True
                if optical:
                    crossed, ray = meet_interface(state, ray, layer[INDEX], layers[beyond, INDEX])
                here = beyond if crossed else here
            elif not down:
                crossed, ray = meet_surface(state, ray, layer[INDEX], above, roughness)
                if crossed:
                    return SUBSURFACE, -1, position, ray
            elif floor:
                ray = _leave_floor(state, ray, mirrored)
            else:
                crossed, ray = meet_interface(state, ray, layer[INDEX], below)
                if crossed:
                    return TRANSMITTED, -1, position, ray
    return LOST, here, position, ray


@njit
def _distance_to_face(layer, position, ray):
    if ray[2] > 0.0:
        return (layer[BOTTOM] - position[2]) / ray[2]
    if ray[2] < 0.0:
        return (layer[TOP] - position[2]) / ray[2]
    return math.inf


@njit
def _next_event(state, layer, face, fibres_ahead):
    """Distance to and kind of the nearest event, melanosomes left aside (figure 4.3)."""
    distance, event = face, INTERFACE
    path = free_path(state, layer[ABSORPTION])
    if path < distance:
        distance, event = path, ABSORBER
    if fibres_ahead:
        path = free_path(state, layer[RAYLEIGH])
        if path < distance:
            distance, event = path, FIBRES
    path = free_path(state, layer[SCATTERING])
    if path < distance:
        distance, event = path, SCATTERER
    return distance, event


@njit
def _melanosome(state, hit, ray, half_axes, radius):
    """A melanosome or complex that a ray hits: its long axis, the point hit, and its centre.

    The point is on the unit ball of which the body is the stretched image.
    """
    if radius > 0.0:
        point = facing_point(state, ray)
        return UP, point, added(hit, -radius, point)
    axis = long_axis(state, ray, half_axes)
    point = facing_point(state, on_ball(ray, axis, half_axes))
    return axis, point, added(hit, -1.0, stretched(point, axis, half_axes[0], half_axes[1]))


@njit
def _fits(layer, centre, axis, half_axes):
    """Whether a melanosome or complex lies within its layer."""
    height = layer[COMPLEX_RADIUS]
    if height == 0.0:
        height = half_extent(axis, UP, half_axes)
    return layer[TOP] <= centre[2] - height and centre[2] + height <= layer[BOTTOM]


@njit
def _leave_floor(state, ray, mirrored):
    """Diffuse direction off the dermal floor, about its normal or about the mirrored ray."""
    if not mirrored:
        return turned(state, UP, lambertian_cosine(state))
    about = (ray[0], ray[1], -ray[2])
    ray = turned(state, about, lambertian_cosine(state))
    while ray[2] >= 0.0:
        ray = turned(state, about, lambertian_cosine(state))
    return ray


@kernel
def walk(sources):
    """The compiled kernel; its arguments and results are those of `trace`."""

    def trace(
        layers, surroundings, readings, sine, cosine, state, outcome, end_layer, place, direction
    ):
        """Trace one ray for each element of `outcome`.

        Parameters
        ----------
        layers, surroundings, readings
            From `kernel_arguments`.
        sine, cosine : float
            Of the angle of incidence; light arrives at the origin along (sine, 0, cosine).
        state : (4,) uint64 array
            Of the generator; advanced.
        outcome : (N,) int8 array, written
            How the ray ended.
        end_layer : (N,) int8 array, written
            Layer in which it was absorbed; -1 if it was not.
        place : (N, 2) float array, written
            x and y in cm where it ended.
        direction : (N, 3) float array, written
            Its direction at the end.
        """
        _ = sources  # makes the kernel a closure over it, see `compiling`
        for index in range(outcome.size):
            end, layer, position, ray = _walk_one(
                layers, surroundings, readings, (sine, 0.0, cosine), state
            )
            outcome[index], end_layer[index] = end, layer
            place[index, 0], place[index, 1] = position[0], position[1]
            direction[index, 0], direction[index, 1], direction[index, 2] = ray

    return trace
