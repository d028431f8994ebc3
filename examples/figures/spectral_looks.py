"""What skin looks like at one wavelength, or in the visible, as numbers for a shader. No Blender.

Rendered without the add-on and its tables, which hold colours: here each picture's skin is solved
at its own wavelength.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hylios.adding import spectrum
from hylios.near_far import near_share_and_far_width
from hylios.quadrature import skin_quadrature
from hylios.skin.specimen import EPIDERMIS, SPECIMENS, Specimen
from hylios.spectra import published_spectra
from hylios.sun.protection import sunscreen
from hylios.transport.simulate import DISTANCE_EDGES
from hylios.transport.simulate import spectrum as walked

VISIBLE = 0.0
"""Stands for a colour in place of a wavelength."""

SPOTS = np.linspace(0.0, np.log(4.0), 6)
"""Logarithm of melanin in freckles and moles, as a multiple of the skin's around them. ASSUMED."""

COUNT, RAYS, ANGLE = 8, 100_000, 8.0

SUNSCREEN_FACTOR, SUNSCREEN_AMOUNT = 30.0, 1.0
"""SPF, and mg/cm^2 as people apply it. ASSUMED."""

WATER_MILLIMETRES = 0.5
"""Of drops on the skin. ASSUMED."""


@dataclass(frozen=True)
class Look:
    """Numbers of a shader; arrays are linear Rec.709, or three times the same at a wavelength.

    Attributes
    ----------
    colours : (K, 3) array
        Light that has been inside, at each of `SPOTS`.
    near : (3,) array
        Share of it that leaves where it came in.
    width : (3,) array
        Of Burley's profile of the rest, in mm.
    roughness : float
        Of the surface.
    sunscreen, water : float
        Share of light that crosses a film twice.
    """

    colours: np.ndarray
    near: np.ndarray
    width: np.ndarray
    roughness: float
    sunscreen: float
    water: float

    @property
    def described(self) -> dict:
        """The numbers as what JSON holds."""
        return {name: np.asarray(value).tolist() for name, value in vars(self).items()}


def with_melanin(share: float, water: float = 1.0) -> Specimen:
    """S3 with so much melanin in its epidermis, and water in all layers times a factor."""
    light = SPECIMENS["S3"]
    more = share / light.pigmentation
    melanin = {
        f"{layer}_{form}": more * getattr(light, f"{layer}_{form}")
        for layer in EPIDERMIS
        for form in ("melanosomes", "colloidal_melanin")
    }
    layers = ("corneum", "epidermis", "papillary", "reticular")
    wet = {f"{layer}_water": water * getattr(light, f"{layer}_water") for layer in layers}
    return replace(light, **melanin, **wet)


def look(
    skin: Specimen, nm: float, *, spotted: bool, seed: int, threads: int | None = None
) -> Look:
    """The look of a skin at a wavelength in nm, or in the visible where that is `VISIBLE`.

    Without spots the colours are all the skin's own.
    """
    wavelengths, weights = _colour(nm)
    colours = [
        spectrum(darker, wavelengths, angle=ANGLE).subsurface @ weights.T
        for darker in ([_darker(skin, np.exp(spot)) for spot in SPOTS] if spotted else [skin])
    ]
    light = walked(skin, wavelengths, angle=ANGLE, rays=RAYS, seed=seed, threads=threads)
    near, width = near_share_and_far_width(DISTANCE_EDGES, weights @ light.exit_counts / light.rays)
    absorption = published_spectra()["water"]
    film = np.interp(nm, absorption.wavelengths, absorption.values) if nm else 0.0
    ultraviolet = 0.0 < nm <= 400.0
    screen = sunscreen(SUNSCREEN_FACTOR, SUNSCREEN_AMOUNT).at(np.array([nm]))[0]
    return Look(
        colours=np.broadcast_to(colours, (SPOTS.size, 3)),
        near=near,
        width=width,
        roughness=float(np.sqrt(skin.surface_fold_aspect_ratio)),
        sunscreen=float(screen**2) if ultraviolet else 1.0,
        water=float(np.exp(-2.0 * film * 0.1 * WATER_MILLIMETRES)),
    )


def _colour(nm: float) -> tuple[Sequence[float] | np.ndarray, np.ndarray]:
    """Wavelengths, and the weights (3, W) that make a colour of them."""
    if nm == VISIBLE:
        visible = skin_quadrature(COUNT)
        return visible.wavelengths, visible.weights
    return [nm], np.ones((3, 1))


def _darker(skin: Specimen, more: float) -> Specimen:
    """A skin with a multiple of its melanin."""
    return replace(
        skin,
        **{
            f"{layer}_{form}": more * getattr(skin, f"{layer}_{form}")
            for layer in EPIDERMIS
            for form in ("melanosomes", "colloidal_melanin")
        },
    )
