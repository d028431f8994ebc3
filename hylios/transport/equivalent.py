"""The random walk of figure 4.3 without waste: the same distributions as printed, sampled exactly.

- One optical depth is drawn for all attenuators together and spent across layers, then which of
  them it is; distances have no memory, so this is what the nearest of one distance each would be.
  So is the optical depth of melanin that a ray can bear, spent in the melanosomes that it meets.
- Algorithms 1 and 2 and azimuths are drawn without their loops (`hylios.transport.sampling`).
- A melanosome's place and orientation are drawn only where they could matter: where the layer's
  face or the melanosome before is near enough to touch. Elsewhere the probability of leaving it
  unabsorbed is that over all places, tabulated (`hylios.transport.survival`). Where a melanosome
  left behind unseen turns out to matter for the next, its place is drawn then, from those in which
  the ray survived.
- Where a melanosome is drawn again, the other attenuators keep the distances that they had, as in
  the walk as printed: all beyond the first melanosome.
- A path in a melanosome whose place was drawn is walked only where melanin allows a ray less than
  the longest path of the table.

Each is exact but for the table, whose chance of absorption is right to some 4e-4 of itself, and
for the one path in two million that is longer than its longest. Measured at 550 nm with 1e7 rays
either way, neither S3 nor S4 differs from the walk as printed in how rays end (chi squared).
"""

import math

from hylios.transport.compiling import part
from hylios.transport.generator import uniform
from hylios.transport.interfaces import meet_surface
from hylios.transport.melanosome import drawn_body, overlap, survives_melanosome
from hylios.transport.sampling import (
    azimuth,
    exponential_angle,
    forward_cosine,
    free_path,
    henyey_greenstein_cosine,
    rayleigh_cosine,
    turned,
)
from hylios.transport.vectors import about, added, dot
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
    LONGEST_PATH,
    LOST,
    MELANIN,
    MELANOSOME,
    MELANOSOME_DEPTH,
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
    distance_to_face,
    fits,
    meet_face,
    melanosomes_met,
)

NONE, UNSEEN, SEEN = range(3)
"""What is known of the melanosome or complex met before in this traversal of a layer. It is kept
as a tuple: this, where it was hit, along which ray and chord, its centre and its axis."""


@part
def walk_equivalent(layers, surroundings, readings, ray, state):
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
    before = (NONE, position, ray, 1.0, position, ray)
    depth, melanin_depth = free_path(state, 1.0), free_path(state, 1.0)
    for _ in range(MOST_EVENTS):
        others = layers[here, ABSORPTION] + layers[here, SCATTERING]
        if fibres_ahead:
            others += layers[here, RAYLEIGH]
        total = others + layers[here, ENCOUNTER]
        face = distance_to_face(layers, here, position, ray)
        half_axes = (layers[here, SEMI_MINOR], layers[here, SEMI_MAJOR])
        optics = (
            layers[here, MELANIN],
            melanin_index,
            layers[here, INDEX],
            bent,
            layers[here, LONGEST_PATH],
        )
        seen, axis, point, centre = False, ray, ray, position
        if depth < total * face:
            distance = depth / total
            depth = free_path(state, 1.0)
            event = kind_met(layers, here, total * uniform(state))
            if event == MELANOSOME and not out_of_touch(
                layers, here, added(position, distance, ray), before
            ):
                seen = True
                distance, event, axis, point, centre, before = _placed(
                    state, layers, here, position, ray, distance, face, others, before, optics
                )
        else:
            distance, event = face, INTERFACE
            depth -= total * face

        if distance == math.inf:
            return LOST, here, position, ray
        position = added(position, distance, ray)
        if event == INTERFACE:
            fibres_ahead, before = True, (NONE, position, ray, 1.0, position, ray)
            # at the face itself, not where rounding has put the ray
            face = layers[here, BOTTOM] if ray[2] > 0.0 else layers[here, TOP]
            position = (position[0], position[1], face)
            end, here, ray = meet_face(state, layers, surroundings, readings, here, ray)
            if end != UNDECIDED:
                return end, -1, position, ray
        elif event == ABSORBER:
            return ABSORBED, here, position, ray
        elif event == MELANOSOME:
            chord, survived = 1.0, True
            if layers[here, COMPLEX_RADIUS] > 0.0:
                chord = -dot(point, ray) if seen else math.sqrt(1.0 - uniform(state))
                count = melanosomes_met(layers, here, chord, by_diameter)
                melanin_depth -= count * layers[here, MELANOSOME_DEPTH]
            elif seen:
                survived = survives_melanosome(state, ray, axis, point, half_axes, optics)
            else:
                melanin_depth -= layers[here, MELANOSOME_DEPTH]
            if melanin_depth < 0.0 or not survived:
                return ABSORBED_IN_MELANOSOME, here, position, ray
            before = (SEEN if seen else UNSEEN, position, ray, chord, centre, axis)
            if scale > 0.0:
                if exponential:
                    cosine = math.cos(exponential_angle(state, scale))
                else:
                    cosine = forward_cosine(state, scale)
                ray = turned(state, ray, cosine)
        elif event == FIBRES:
            ray = turned(state, ray, rayleigh_cosine(state))
            fibres_ahead = every
        else:
            ray = turned(state, ray, henyey_greenstein_cosine(state, layers[here, ANISOTROPY]))
    return LOST, here, position, ray


@part
def kind_met(layers, here, drawn):
    """Which attenuator it is, for a number from 0 to the sum of their coefficients."""
    drawn -= layers[here, ENCOUNTER]
    if drawn < 0.0:
        return MELANOSOME
    drawn -= layers[here, ABSORPTION]
    if drawn < 0.0:
        return ABSORBER
    drawn -= layers[here, SCATTERING]
    return SCATTERER if drawn < 0.0 else FIBRES


@part
def out_of_touch(layers, here, hit, before):
    """Whether what is hit there can neither cross a face nor overlap what was met before.

    Nothing reaches further than the size of a body from where it is hit.
    """
    size = 2.0 * max(layers[here, SEMI_MAJOR], layers[here, COMPLEX_RADIUS])
    if hit[2] - layers[here, TOP] < size or layers[here, BOTTOM] - hit[2] < size:
        return False
    between = added(hit, -1.0, before[1])
    return before[0] == NONE or dot(between, between) >= 4.0 * size * size


@part
def _placed(state, layers, here, position, ray, distance, face, others, before, optics):
    """A melanosome or complex first tried at a distance, and drawn again until it has room.

    Returns distance and kind of the event, which is another's where that comes first; axis, point
    hit and centre of what was placed; and what is known by now of the one met before.
    """
    half_axes = (layers[here, SEMI_MINOR], layers[here, SEMI_MAJOR])
    path, other = distance, -1.0
    axis, point, centre = ray, ray, position
    for _ in range(MOST_DRAWS):
        axis, point, offset = drawn_body(state, ray, half_axes, layers[here, COMPLEX_RADIUS])
        centre = added(added(position, path, ray), 1.0, offset)
        if fits(layers, here, centre, axis):
            free, before = is_free(state, layers, here, centre, axis, before, optics)
            if free:
                return path, MELANOSOME, axis, point, centre, before
        if other < 0.0:
            other = distance + free_path(state, others)
        path = free_path(state, layers[here, ENCOUNTER])
        if path >= min(face, other):
            break
    if face <= other:
        return face, INTERFACE, axis, point, centre, before
    event = kind_met(layers, here, layers[here, ENCOUNTER] + others * uniform(state))
    return other, event, axis, point, centre, before


@part
def is_free(state, layers, here, centre, axis, before, optics):
    """Whether a body does not overlap the one met before, and what is known of that by now."""
    known, hit, ray, chord, before_centre, before_axis = before
    half_axes, radius = (
        (layers[here, SEMI_MINOR], layers[here, SEMI_MAJOR]),
        layers[here, COMPLEX_RADIUS],
    )
    between = added(centre, -1.0, hit)
    size = 3.0 * max(radius, half_axes[1])
    if known == NONE or dot(between, between) >= size * size:
        return True, before
    if known == UNSEEN:
        before_axis, before_centre = _recalled(state, hit, ray, chord, half_axes, radius, optics)
        before = (SEEN, hit, ray, chord, before_centre, before_axis)
    return not overlap(centre, axis, before_centre, before_axis, half_axes, radius), before


@part
def _recalled(state, hit, ray, chord, half_axes, radius, optics):
    """Axis and centre of what a ray met at `hit` and survived, its place not drawn then."""
    if radius > 0.0:
        point = about(ray, math.sqrt(max(0.0, 1.0 - chord * chord)), -chord, azimuth(state))
        return ray, added(hit, -radius, point)
    while True:
        axis, point, offset = drawn_body(state, ray, half_axes, radius)
        if survives_melanosome(state, ray, axis, point, half_axes, optics):
            return axis, added(hit, 1.0, offset)
