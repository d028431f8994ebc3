"""What both ways of walking share: how rays end, how a stack is laid out, the rules at a face.

z points into the skin, lengths are in cm. The two ways through the same model, figure 4.3, are
`hylios.transport.printed` and `hylios.transport.equivalent`.
"""

import math

import numpy as np

from hylios.tissue import Stack
from hylios.transport.compiling import part
from hylios.transport.generator import uniform
from hylios.transport.interfaces import meet_interface, meet_surface
from hylios.transport.melanosome import half_extent
from hylios.transport.sampling import lambertian_cosine, turned

SURFACE, SUBSURFACE, TRANSMITTED, ABSORBED, ABSORBED_IN_MELANOSOME, LOST = range(6)
"""How a ray ends. LOST after `MOST_EVENTS` events, or on a way without end or event."""

UNDECIDED = -1

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
    "melanosomes_across",
    "melanosome_depth",
    "longest_path",
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
    ACROSS,
    MELANOSOME_DEPTH,
    LONGEST_PATH,
) = range(len(COLUMNS))

INTERFACE, ABSORBER, FIBRES, SCATTERER, MELANOSOME = range(5)
"""What a ray meets next."""

UP = (0.0, 0.0, -1.0)


def kernel_arguments(stack: Stack) -> tuple[np.ndarray, tuple[float, ...], tuple[bool, ...]]:
    """A stack as the kernels take it: layers (L, columns), surroundings, readings."""
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
        stack.floor_reflectance,
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


@part
def distance_to_face(layers, here, position, ray):
    """Distance along a ray to where it leaves its layer; infinite for a level one."""
    if ray[2] > 0.0:
        return (layers[here, BOTTOM] - position[2]) / ray[2]
    if ray[2] < 0.0:
        return (layers[here, TOP] - position[2]) / ray[2]
    return math.inf


@part
def meet_face(state, layers, surroundings, readings, here, ray):
    """What becomes of a ray at a face of layer `here`: its end or UNDECIDED, its layer, the ray."""
    roughness, above, below, _, _, floor_reflectance = surroundings
    floor, _, _, _, _, optical, mirrored = readings
    down = ray[2] > 0.0
    index = layers[here, INDEX]
    beyond = here + 1 if down else here - 1
    if 0 <= beyond < layers.shape[0]:
        crossed = True
        if optical:
            crossed, ray = meet_interface(state, ray, index, layers[beyond, INDEX])
        return UNDECIDED, beyond if crossed else here, ray
    if not down:
        crossed, ray = meet_surface(state, ray, index, above, roughness)
        return SUBSURFACE if crossed else UNDECIDED, here, ray
    if floor:
        if floor_reflectance < 1.0 and uniform(state) >= floor_reflectance:
            return TRANSMITTED, here, ray
        return UNDECIDED, here, _leave_floor(state, ray, mirrored)
    crossed, ray = meet_interface(state, ray, index, below)
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
        height = half_extent(axis, UP, (layers[here, SEMI_MINOR], layers[here, SEMI_MAJOR]))
    return layers[here, TOP] <= centre[2] - height and centre[2] + height <= layers[here, BOTTOM]


@part
def melanosomes_met(layers, here, chord, by_diameter):
    """Melanosomes that a ray meets in a complex, given its chord in diameters."""
    return int(layers[here, ACROSS] * (1.0 if by_diameter else chord))
