"""A stack as the kernels take it: an array of layers, and tuples of what surrounds them."""

import numpy as np

from hylios.tissue import Stack

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

ROUGHNESS, ABOVE, BELOW, MELANIN_INDEX, SCATTERING_ANGLE, FLOOR_REFLECTANCE = range(6)
"""Places in the surroundings: of the surface's roughness, the refractive indices outside and in
melanosomes, the angle by which these scatter, and the share that a diffuse floor reflects."""

(
    DIFFUSE_FLOOR,
    BY_DIAMETER,
    BENT,
    EXPONENTIAL,
    EVERY_COLLISION,
    INNER_FRESNEL,
    MIRRORED,
) = range(7)
"""Places in the readings, of what is true or not; the first is whether the lower face reflects
diffusely, the others are choices of `hylios.tissue.READINGS`."""


def kernel_arguments(stack: Stack) -> tuple[np.ndarray, tuple[float, ...], tuple[bool, ...]]:
    """Layers (L, columns), surroundings and readings of a stack."""
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
    choices = stack.readings
    readings = (
        stack.lambertian_floor,
        choices["complex_melanosomes"] == "diameter",
        choices["melanosome_entry"] == "refracted",
        choices["melanosome_scattering"] == "exponential",
        choices["rayleigh"] == "every_collision",
        choices["inner_fresnel"] == "on",
        choices["floor"] == "mirrored",
    )
    return np.array(rows, dtype=float), surroundings, readings
