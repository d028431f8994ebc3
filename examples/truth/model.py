"""What the light model says of the skins on the stages, without the add-on and its tables."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from examples.simplifications.edge import crossing
from examples.truth.shots import SUNNED
from hylios.adding import solve, spectrum
from hylios.adding.redness import erythema
from hylios.quadrature import MOST, skin_quadrature
from hylios.skin import Skin
from hylios.skin.phototypes import PHOTOTYPES, skin_type
from hylios.skin.specimen import SPECIMENS, Specimen
from hylios.tanning import Exposures
from hylios.tissue import Stack
from hylios.transport.angular import AngularReflectance, angular_reflectance
from hylios.transport.simulate import spectrum as walked

SEED = 1
WALKED = 8
"""Wavelengths that make a colour where rays walk."""

GREEN_NM = 550.0


@dataclass(frozen=True)
class Albedo:
    """Directional-hemispherical reflectance at A angles, linear Rec.709 (A, 3)."""

    subsurface: np.ndarray
    total: np.ndarray


@cache
def skin(name: str) -> Skin:
    """The skin of one of the add-on's tables: a type or one of S1 to S4."""
    return skin_type(name) if name in PHOTOTYPES else Skin.of(SPECIMENS[name])


def specimen(name: str, tan: str, blood: float = 1.0) -> Specimen:
    """A skin with one of `SUNNED` and so many times its blood; what is added is arterial.

    A dermis that reddens does not thicken (`hylios.skin.skin.THICKENED`).
    """
    own, seen = skin(name), SUNNED[tan]
    times = [24.0 * seen.day]
    if seen.burns:
        own = replace(own, kinetics="measured", thickening="epidermis")
        burn = Exposures([0], [seen.multiple * own.med])
        state = own.states(burn, times, erythema=erythema(own))[0]
        return own.at([*state[:4], blood * state[4]])
    state = own.states(Exposures([0], [seen.multiple * own.mmd]), times)[0]
    return own.at([*state[:4], blood])


def albedo(of: Specimen, angles: Sequence[float], film: float | None = None) -> Albedo:
    """Colours of a specimen's reflectance at angles in degrees, under a film of that index or none.

    What a camera sees at an angle under even light is the reflectance at that angle of incidence,
    by reciprocity, which the model keeps but for what `hylios.transport.angular` says.
    """
    colour = skin_quadrature(MOST)
    light = spectrum(of, colour.wavelengths, angle=list(angles), film=film)
    return Albedo(light.subsurface @ colour.weights.T, light.total @ colour.weights.T)


def lit_edge(of: Specimen, places: np.ndarray, rays: int) -> np.ndarray:
    """Light (N, 3) out of skin that is lit from above where places (N,) in mm are positive.

    By random walk; a white diffuser would be 1 where it is lit.
    """
    colour = skin_quadrature(WALKED)
    light = walked(of, colour.wavelengths, angle=0.0, rays=rays, seed=SEED)
    beyond = crossing(light, np.abs(places))
    lit = places[:, None] > 0.0
    return np.where(lit, light.subsurface - beyond, beyond) @ colour.weights.T


def slab(of: Specimen, millimetres: float) -> np.ndarray:
    """Light (3,) through two skins back to back without a hypodermis, so thick in all.

    Both have all their layers, the reticular dermis between them filling what is left. The face
    behind is flat.

    Raises
    ------
    InputError
        If the other layers alone are thicker.
    """
    colour = skin_quadrature(MOST)
    stacks = [_slab(Stack.of(of, nm), 0.1 * millimetres) for nm in colour.wavelengths]
    return colour.weights @ solve(stacks, 0.0).transmittance


def _slab(stack: Stack, thickness: float) -> Stack:
    *outer, reticular = stack.layers
    between = thickness - 2.0 * sum(layer.thickness for layer in outer)
    layers = (*outer, replace(reticular, thickness=between), *reversed(outer))
    return replace(stack, layers=layers, lambertian_floor=False)


def gloss(of: Specimen, angle: float, rays: int, bins: tuple[int, int]) -> AngularReflectance:
    """The BRDF of a specimen's surface at an angle of incidence in degrees.

    What enters is swallowed at once, so that only the surface takes time.
    """
    stack = Stack.of(of, GREEN_NM)
    black = replace(stack.layers[0], absorption=1e8)
    return angular_reflectance(
        replace(stack, layers=(black,)),
        angle=angle,
        polar_bins=bins[0],
        azimuth_bins=bins[1],
        rays=rays,
        key=(SEED,),
    )
