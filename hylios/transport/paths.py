"""Paths of rays through a stack, kept so that they serve for other stacks of the same geometry.

A tan changes how much light is absorbed, how many melanosomes it meets, and the thickness of all
layers by one factor. The density of a path is then that of `log_density`, linear in the sums that
`hylios.transport.path_sums` keeps. A path walked in one state serves for another with the ratio of
the two densities as its weight.

Stacks of other thickness are put into that in which paths were walked (`rescaled`). What is not
exact: melanosomes, which keep their size, lie more or less densely there; and see
`hylios.transport.path_sums`. With 1e6 rays neither shows: at 550 nm S4's light at .8 and 1.48 of
the thickness is its own walk's within their noise, .4 %; with coefficients only scaled, 3 % off.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hylios.errors import InputError, require_range
from hylios.tissue import Layer, Stack
from hylios.tissue.melanosome_encounters import encounters
from hylios.tissue.melanosome_survival import is_tabulated, survival_in_melanosome
from hylios.transport.equivalent import SUMS
from hylios.transport.generator import stream
from hylios.transport.melanosome_paths import with_survival
from hylios.transport.path_sums import record_paths
from hylios.transport.simulate import NO_END, arrival_along
from hylios.transport.stack_arrays import kernel_arguments

SQUEEZES = 4
"""Steps in which the amount of melanosomes met is kept when layers are squeezed."""

LEAST = 1e-300
"""Stands for 0 where a division or a logarithm needs more."""


@dataclass(frozen=True)
class Paths:
    """Ways through a stack that ended outside its surface after having been inside.

    Attributes
    ----------
    distance : (N,) array
        Between entry and exit, in mm.
    sums : (N, L, len(SUMS)) array
        Sums over each way in each layer (`hylios.transport.equivalent.SUMS`), lengths in cm.
    """

    distance: np.ndarray
    sums: np.ndarray

    @property
    def table(self) -> np.ndarray:
        """The sums with all layers side by side, (N, L x len(SUMS))."""
        return self.sums.reshape(len(self.sums), self.sums.shape[1] * self.sums.shape[2])


def effective_samples(total: np.ndarray, squares: np.ndarray) -> np.ndarray:
    """Effective sample sizes (...) from sums (...) of weights and of their squares.

    (sum of w)^2 / sum of w^2 (L. Kish 1965, "Survey Sampling"); 0 where all weights are 0.
    """
    return np.divide(total**2, squares, out=np.zeros_like(squares), where=np.asarray(squares) > 0)


def log_density(stack: Stack) -> np.ndarray:
    """Coefficients (L, len(SUMS)) of the logarithm of a path's density in a stack.

    The logarithm is their product with the path's sums, plus what does not change with the
    amounts of absorbers and scatterers.
    """

    def logarithm(number: float) -> float:
        return float(np.log(max(number, LEAST)))

    return np.array(
        [
            (
                -layer.absorption - layer.scattering,
                -layer.rayleigh,
                logarithm(layer.rayleigh),
                logarithm(layer.scattering),
                -layer.encounter,
                logarithm(layer.encounter),
                -layer.melanosome_depth if layer.encounter > 0.0 else 0.0,
            )
            for layer in stack.layers
        ]
    )


def rescaled(stack: Stack, thickness: float) -> Stack:
    """The stack squeezed to another thickness, in cm, with as much of everything in every layer.

    Lengths of paths scale with it. As melanosomes keep their size, more of them would have to be
    drawn again, and so fewer be met: their coefficient makes up for that
    (`hylios.tissue.melanosome_encounters`; for light that melanosomes hardly turn or absorb).
    """
    factor = total_thickness(stack) / thickness
    if factor == 1.0:
        return stack
    by_diameter = stack.readings["complex_melanosomes"] == "diameter"

    def squeezed(layer: Layer) -> Layer:
        result = replace(
            layer,
            thickness=layer.thickness / factor,
            absorption=layer.absorption * factor,
            encounter=layer.encounter * factor,
            rayleigh=layer.rayleigh * factor,
            scattering=layer.scattering * factor,
        )
        if layer.encounter == 0.0:
            return result
        met = _met(layer, by_diameter) * factor
        for _ in range(SQUEEZES):
            encounter = result.encounter * met / _met(result, by_diameter)
            result = replace(result, encounter=encounter)
        return result

    return replace(stack, layers=tuple(squeezed(layer) for layer in stack.layers))


def _met(layer: Layer, by_diameter: bool) -> float:
    """Coefficient, in 1/cm, with which light meets melanosomes that hardly change it."""
    rate, _, twice = encounters(layer, 1.0, by_diameter)
    return max(rate * (1.0 + twice), LEAST)


def walk_paths(stack: Stack, rays: int, angle: float, key: tuple[int, ...]) -> Paths:
    """Paths of rays from one stream of random numbers, of which the key is the name.

    Raises
    ------
    InputError
        If the angle of incidence, in degrees, lies outside 0 to 89.99.
    RuntimeError
        If a ray was lost: no way out and nothing that absorbs.
    """
    places = np.empty((rays, 2))
    sums = np.zeros((rays + 1, len(stack.layers), len(SUMS)))
    arguments = *kernel_arguments(stack), *arrival_along(angle), stream(*key)
    kept = record_paths(*arguments, rays, places, sums)
    if kept < 0:
        raise RuntimeError(NO_END)
    return Paths(10.0 * np.hypot(*places[:kept].T), sums[:kept])


def ready(stack: Stack) -> Stack:
    """The stack with survival in melanosomes; it is walked for what no table has.

    Raises
    ------
    InputError
        If a layer has no finite thickness.
    """
    for layer in stack.layers:
        require_range("thickness of a layer", layer.thickness, 0.0, 1e9, "cm")
    index, is_straight = stack.melanin_index, stack.readings["melanosome_entry"] != "refracted"
    layers = []
    for layer in stack.layers:
        if layer.encounter > 0.0 and layer.survival < 0.0:
            if not (is_straight and is_tabulated(layer, index)):
                return with_survival(stack)
            layer = replace(layer, survival=survival_in_melanosome(layer, index))
        layers.append(layer)
    return replace(stack, layers=tuple(layers))


def total_thickness(stack: Stack) -> float:
    """Thickness of all layers in cm."""
    return float(sum(layer.thickness for layer in stack.layers))


def require_alike(stacks: Sequence[Stack]) -> None:
    """Raise InputError where stacks differ in more than paths can be weighted for."""
    first = stacks[0]
    for stack in stacks[1:]:
        if len(stack.layers) != len(first.layers) or _surroundings(stack) != _surroundings(first):
            raise InputError(
                "stacks that share paths differ in layers, surroundings or readings; allowed are "
                "differences in absorption, amounts of scatterers, and one factor on thickness."
            )
        ratio = total_thickness(stack) / total_thickness(first)
        for own, other in zip(first.layers, stack.layers, strict=True):
            if abs(other.thickness - ratio * own.thickness) > 1e-9 * other.thickness:
                raise InputError(
                    f"a layer's thickness is {other.thickness:g} cm in one of the stacks that "
                    f"share paths; allowed there is {ratio * own.thickness:g} cm."
                )


def _surroundings(stack: Stack) -> tuple:
    """The parts of a stack that must be the same for paths to be shared."""
    return (
        stack.roughness,
        stack.lambertian_floor,
        stack.floor_reflectance,
        stack.index_above,
        stack.index_below,
        stack.melanin_index,
        stack.scattering_angle,
        tuple(sorted(stack.readings.items())),
        tuple(
            (layer.refractive_index, layer.anisotropy, layer.semi_minor, layer.complex_radius)
            for layer in stack.layers
        ),
    )
