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

from hylios.errors import InputError, require_range, require_whole
from hylios.threads import in_order
from hylios.tissue import Layer, Stack
from hylios.tissue.melanosome_encounters import encounters
from hylios.tissue.melanosome_survival import is_tabulated, survival_in_melanosome
from hylios.transport.equivalent import SUMS
from hylios.transport.generator import stream
from hylios.transport.melanosome_paths import with_survival
from hylios.transport.path_sums import record_paths
from hylios.transport.simulate import CHUNK, MOST_RAYS, NO_END
from hylios.transport.stack_arrays import kernel_arguments

SQUEEZES = 4
"""Steps in which the amount of melanosomes met is kept when layers are squeezed."""

LEAST = 1e-300
"""In the place of 0 where it is divided by or its logarithm is taken."""


@dataclass(frozen=True)
class Paths:
    """Ways through a stack that ended outside its surface after having been inside.

    Attributes
    ----------
    layers : Stack
        What they were walked in.
    launched : int
        Rays, of which N took these ways.
    distance : (N,) array
        Between entry and exit, in mm.
    sums : (N, L, len(SUMS)) array
        Sums over each way in each layer (`hylios.transport.equivalent.SUMS`), lengths in cm.
    """

    layers: Stack
    launched: int
    distance: np.ndarray
    sums: np.ndarray

    @property
    def table(self) -> np.ndarray:
        """The sums with all layers side by side, (N, L x len(SUMS))."""
        return self.sums.reshape(len(self.sums), self.sums.shape[1] * self.sums.shape[2])


def trace_paths(
    layers: Stack,
    *,
    rays: int,
    angle: float = 0.0,
    key: tuple[int, ...] = (1,),
    threads: int | None = None,
) -> Paths:
    """Walk rays and keep the paths of those that come back from inside.

    The result does not depend on the number of threads. A path of skin takes some 350 bytes.

    Parameters
    ----------
    layers : Stack
        Of finite thickness.
    rays : int
    angle : float
        Of incidence, in degrees, 0 to 89.99.
    key : tuple of int
        Names the streams of random numbers.
    threads : int, optional
        All cores by default.

    Raises
    ------
    InputError
        If the angle or a number is out of range, or a layer has no finite thickness.
    RuntimeError
        If a ray was lost: no way out and nothing that absorbs.
    """
    rays = require_whole("number of rays", rays, 1, MOST_RAYS)
    layers = ready(layers)
    tasks = ((layers, min(CHUNK, rays - first), (*key, first)) for first in range(0, rays, CHUNK))
    parts = list(in_order(lambda task: recorded(task[0], task[1], angle, task[2]), tasks, threads))
    return Paths(
        layers=layers,
        launched=rays,
        distance=np.concatenate([each.distance for each in parts]),
        sums=np.concatenate([each.sums for each in parts]),
    )


def weights(paths: Paths, layers: Stack) -> np.ndarray:
    """Weight (N,) of each path in another stack: the ratio of its densities there and where walked.

    The sum of weights over `paths.launched` is the other's subsurface reflectance, and its exit
    distances are `paths.distance` times the ratio of thicknesses.

    Raises
    ------
    InputError
        If the stacks differ in more than absorption, amounts of what scatters, and one factor on
        all thicknesses, or the other has scatterers where the paths could meet none.
    """
    layers = ready(layers)
    require_alike([paths.layers, layers])
    for name in ("encounter", "rayleigh", "scattering"):
        for mine, other in zip(paths.layers.layers, layers.layers, strict=True):
            if getattr(mine, name) == 0.0 < getattr(other, name):
                raise InputError(
                    f"{name} is {getattr(other, name):g} /cm in a layer where paths were walked "
                    "with 0; allowed there is 0."
                )
    layers = rescaled(layers, total_thickness(paths.layers))
    change = log_density(layers) - log_density(paths.layers)
    return np.exp(paths.table @ change.ravel())


def effective_sample_size(weights: np.ndarray) -> float:
    """(sum of w)^2 / sum of w^2 (L. Kish 1965, "Survey Sampling"); 0 where all weights are 0."""
    weights = np.asarray(weights, dtype=float)
    return float(effective(weights.sum(), np.sum(weights**2)))


def effective(total: np.ndarray, squares: np.ndarray) -> np.ndarray:
    """Effective sample sizes (...) from sums (...) of weights and of their squares."""
    return np.divide(total**2, squares, out=np.zeros_like(squares), where=np.asarray(squares) > 0)


def log_density(layers: Stack) -> np.ndarray:
    """Coefficients (L, len(SUMS)) of the logarithm of a path's density in a stack.

    The logarithm is their product with the path's sums, plus what does not change with the
    amounts of absorbers and scatterers.
    """

    def logarithm(number: float) -> float:
        return float(np.log(max(number, LEAST)))

    return np.array(
        [
            (
                -each.absorption - each.scattering,
                -each.rayleigh,
                logarithm(each.rayleigh),
                logarithm(each.scattering),
                -each.encounter,
                logarithm(each.encounter),
                -each.melanosome_depth if each.encounter > 0.0 else 0.0,
            )
            for each in layers.layers
        ]
    )


def rescaled(layers: Stack, thickness: float) -> Stack:
    """The stack squeezed to another thickness, in cm, with as much of everything in every layer.

    Lengths of paths scale with it. As melanosomes keep their size, more of them would have to be
    drawn again, and so fewer be met: their coefficient makes up for that
    (`hylios.tissue.melanosome_encounters`; for light that melanosomes hardly turn or absorb).
    """
    factor = total_thickness(layers) / thickness
    if factor == 1.0:
        return layers
    by_diameter = layers.readings["complex_melanosomes"] == "diameter"

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

    return replace(layers, layers=tuple(squeezed(each) for each in layers.layers))


def _met(layer: Layer, by_diameter: bool) -> float:
    """Coefficient, in 1/cm, with which light meets melanosomes that hardly change it."""
    rate, _, twice = encounters(layer, 1.0, by_diameter)
    return max(rate * (1.0 + twice), LEAST)


def recorded(layers: Stack, rays: int, angle: float, key: tuple[int, ...]) -> Paths:
    """Paths of rays from one stream of random numbers."""
    require_range("angle of incidence", angle, 0.0, 89.99, "degrees")
    places = np.empty((rays, 2))
    sums = np.zeros((rays + 1, len(layers.layers), len(SUMS)))
    arrival = float(np.sin(np.radians(angle))), float(np.cos(np.radians(angle)))
    kept = record_paths(*kernel_arguments(layers), *arrival, stream(*key), rays, places, sums)
    if kept < 0:
        raise RuntimeError(NO_END)
    return Paths(layers, rays, 10.0 * np.hypot(*places[:kept].T), sums[:kept])


def ready(layers: Stack) -> Stack:
    """The stack with survival in melanosomes; paths are walked for what no table has.

    Raises
    ------
    InputError
        If a layer has no finite thickness.
    """
    for each in layers.layers:
        require_range("thickness of a layer", each.thickness, 0.0, 1e9, "cm")
    index, is_straight = layers.melanin_index, layers.readings["melanosome_entry"] != "refracted"
    missing = [each for each in layers.layers if each.encounter > 0.0 and each.survival < 0.0]
    if not (is_straight and all(is_tabulated(each, index) for each in missing)):
        return with_survival(layers)
    return replace(
        layers,
        layers=tuple(
            replace(each, survival=survival_in_melanosome(each, index)) if each in missing else each
            for each in layers.layers
        ),
    )


def total_thickness(layers: Stack) -> float:
    """In cm."""
    return float(sum(each.thickness for each in layers.layers))


def require_alike(stacks: Sequence[Stack]) -> None:
    """Raise InputError where stacks differ in more than paths can be weighted for."""
    first = stacks[0]
    for each in stacks[1:]:
        if len(each.layers) != len(first.layers) or _surroundings(each) != _surroundings(first):
            raise InputError(
                "stacks that share paths differ in layers, surroundings or readings; allowed are "
                "differences in absorption, amounts of scatterers, and one factor on thickness."
            )
        ratio = total_thickness(each) / total_thickness(first)
        for own, other in zip(first.layers, each.layers, strict=True):
            if abs(other.thickness - ratio * own.thickness) > 1e-9 * other.thickness:
                raise InputError(
                    f"a layer's thickness is {other.thickness:g} cm in one of the stacks that "
                    f"share paths; allowed there is {ratio * own.thickness:g} cm."
                )


def _surroundings(layers: Stack) -> tuple:
    """What of a stack must be the same for paths to be shared."""
    return (
        layers.roughness,
        layers.lambertian_floor,
        layers.floor_reflectance,
        layers.index_above,
        layers.index_below,
        layers.melanin_index,
        layers.scattering_angle,
        tuple(sorted(layers.readings.items())),
        tuple(
            (each.refractive_index, each.anisotropy, each.semi_minor, each.complex_radius)
            for each in layers.layers
        ),
    )
