"""The walk of `hylios.transport.equivalent` with a record of what its probability is made of.

A ray's way through a stack is drawn from a density whose logarithm is linear in a few sums over
the way: lengths, and how often what was met. With these kept, the way can serve for other stacks
of the same geometry (`hylios.transport.paths`).

Two things differ from `equivalent`. Whether light leaves a melanosome whose place was drawn is
decided by the mean over all places, as for those whose place was not; and places of melanosomes
left behind unseen are recalled as if absorption had no say in them. Melanosomes that have to be
drawn again count among those tried, so that the density is right for these too.
"""

import math

from hylios.transport.compiling import kernel, part
from hylios.transport.equivalent import NONE, SEEN, UNSEEN, is_free, kind_met, out_of_touch
from hylios.transport.generator import uniform
from hylios.transport.interfaces import meet_surface
from hylios.transport.melanosome import drawn_body
from hylios.transport.sampling import (
    exponential_angle,
    forward_cosine,
    free_path,
    henyey_greenstein_cosine,
    rayleigh_cosine,
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
    MELANOSOME,
    MELANOSOME_DEPTH,
    MOST_DRAWS,
    MOST_EVENTS,
    RAYLEIGH,
    SCATTERER,
    SCATTERING,
    SEMI_MAJOR,
    SEMI_MINOR,
    SUBSURFACE,
    SURFACE,
    TOP,
    UNDECIDED,
    distance_to_face,
    fits,
    meet_face,
    melanosomes_met,
)

SUMS = (
    "length",
    "fibre_length",
    "fibres",
    "scatterers",
    "tried_length",
    "tried",
    "melanosomes",
)
"""Sums over a way in each layer.

Length in the reach of absorbers and scatterers, in cm; length in the reach of fibres (where they
scatter once per traversal, that before they do); how often fibres and scatterers turned it; length
in the reach of melanosomes or complexes; how many of them were tried, those drawn again counted
too; melanosomes gone through, of which a complex has several.

Where one was drawn again the reach of absorbers is the farthest distance that was tried: they
would have come first.
"""

(
    LENGTH,
    FIBRE_LENGTH,
    FIBRES_MET,
    SCATTERERS_MET,
    TRIED_LENGTH,
    TRIED,
    GONE_THROUGH,
) = range(len(SUMS))

CLEAR = (0.0, 1.0, 1.0, False, 0.0)
"""Optics of a melanosome that every ray survives."""


@kernel
def record_paths(sources):
    """The compiled kernel; its arguments are those of `record`."""

    def record(layers, surroundings, readings, sine, cosine, state, rays, places, sums):
        """Walk rays and keep those that leave through the surface after having been inside.

        Parameters
        ----------
        layers, surroundings, readings, sine, cosine, state
            As in `hylios.transport.kernels`.
        rays : int
        places : (rays, 2) float array, written
            x and y in cm where each ray kept left.
        sums : (rays, L, len(SUMS)) float array of zeros, written
            `SUMS` of each ray kept. The row after the last is not zeros.

        Returns
        -------
        int
            How many rays were kept; -1 if one was lost.
        """
        _ = sources  # makes the kernel a closure over it, see `compiling`
        kept = 0
        for _ray in range(rays):
            for layer in range(sums.shape[1]):
                for each in range(sums.shape[2]):
                    sums[kept, layer, each] = 0.0
            end, position = _walk(
                layers, surroundings, readings, (sine, 0.0, cosine), state, sums, kept
            )
            if end == LOST:
                return -1
            if end == SUBSURFACE:
                places[kept, 0], places[kept, 1] = position[0], position[1]
                kept += 1
        return kept

    return record


@part
def _walk(layers, surroundings, readings, ray, state, sums, row):
    """One ray from its arrival at the surface to its end: how it ended, and where."""
    roughness, above, _, _, scale, _ = surroundings
    _, by_diameter, _, exponential, every, _, _ = readings
    position = (0.0, 0.0, 0.0)
    crossed, ray = meet_surface(state, ray, above, layers[0, INDEX], roughness)
    if not crossed:
        return SURFACE, position

    here, fibres_ahead = 0, True
    before = (NONE, position, ray, 1.0, position, ray)
    depth, melanin_depth = free_path(state, 1.0), free_path(state, 1.0)
    for _ in range(MOST_EVENTS):
        others = layers[here, ABSORPTION] + layers[here, SCATTERING]
        if fibres_ahead:
            others += layers[here, RAYLEIGH]
        total = others + layers[here, ENCOUNTER]
        face = distance_to_face(layers, here, position, ray)
        seen, axis, point, centre = False, ray, ray, position
        if depth < total * face:
            distance = depth / total
            depth = free_path(state, 1.0)
            event = kind_met(layers, here, total * uniform(state))
            reach, tried_length = distance, distance
            if event == MELANOSOME:
                sums[row, here, TRIED] += 1.0
                if not out_of_touch(layers, here, added(position, distance, ray), before):
                    seen = True
                    distance, event, axis, point, centre, before, reach, tried_length, again = (
                        _placed(state, layers, here, position, ray, distance, face, others, before)
                    )
                    sums[row, here, TRIED] += again
        else:
            distance, event = face, INTERFACE
            depth -= total * face
            reach, tried_length = face, face

        if distance == math.inf:
            return LOST, position
        sums[row, here, LENGTH] += reach
        sums[row, here, TRIED_LENGTH] += tried_length
        if fibres_ahead:
            sums[row, here, FIBRE_LENGTH] += reach
        position = added(position, distance, ray)
        if event == INTERFACE:
            fibres_ahead, before = True, (NONE, position, ray, 1.0, position, ray)
            # at the face itself, not where rounding has put the ray
            face = layers[here, BOTTOM] if ray[2] > 0.0 else layers[here, TOP]
            position = (position[0], position[1], face)
            end, here, ray = meet_face(state, layers, surroundings, readings, here, ray)
            if end != UNDECIDED:
                return end, position
        elif event == ABSORBER:
            return ABSORBED, position
        elif event == MELANOSOME:
            chord, count = 1.0, 1
            if layers[here, COMPLEX_RADIUS] > 0.0:
                chord = -dot(point, ray) if seen else math.sqrt(1.0 - uniform(state))
                count = melanosomes_met(layers, here, chord, by_diameter)
            sums[row, here, GONE_THROUGH] += count
            melanin_depth -= count * layers[here, MELANOSOME_DEPTH]
            if melanin_depth < 0.0:
                return ABSORBED_IN_MELANOSOME, position
            before = (SEEN if seen else UNSEEN, position, ray, chord, centre, axis)
            if scale > 0.0:
                if exponential:
                    cosine = math.cos(exponential_angle(state, scale))
                else:
                    cosine = forward_cosine(state, scale)
                ray = turned(state, ray, cosine)
        elif event == FIBRES:
            sums[row, here, FIBRES_MET] += 1.0
            ray = turned(state, ray, rayleigh_cosine(state))
            fibres_ahead = every
        elif event == SCATTERER:
            sums[row, here, SCATTERERS_MET] += 1.0
            ray = turned(state, ray, henyey_greenstein_cosine(state, layers[here, ANISOTROPY]))
    return LOST, position


@part
def _placed(state, layers, here, position, ray, distance, face, others, before):
    """A melanosome or complex first tried at a distance, and drawn again until it has room.

    As in `hylios.transport.equivalent`. Returns also the farthest distance tried, the sum of all,
    and how often one was drawn again within reach.
    """
    half_axes = (layers[here, SEMI_MINOR], layers[here, SEMI_MAJOR])
    path, other, farthest, tried_length, again = distance, -1.0, distance, distance, 0
    axis, point, centre = ray, ray, position
    for _ in range(MOST_DRAWS):
        axis, point, offset = drawn_body(state, ray, half_axes, layers[here, COMPLEX_RADIUS])
        centre = added(added(position, path, ray), 1.0, offset)
        if fits(layers, here, centre, axis):
            free, before = is_free(state, layers, here, centre, axis, before, CLEAR)
            if free:
                return (
                    path,
                    MELANOSOME,
                    axis,
                    point,
                    centre,
                    before,
                    farthest,
                    tried_length,
                    again,
                )
        if other < 0.0:
            other = distance + free_path(state, others)
        path = free_path(state, layers[here, ENCOUNTER])
        if path >= min(face, other):
            break
        farthest, tried_length, again = max(farthest, path), tried_length + path, again + 1
    reach = min(face, other)
    tried_length += reach
    if face <= other:
        return face, INTERFACE, axis, point, centre, before, reach, tried_length, again
    event = kind_met(layers, here, layers[here, ENCOUNTER] + others * uniform(state))
    return other, event, axis, point, centre, before, reach, tried_length, again
