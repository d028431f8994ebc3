"""The melanosomes of a layer of the epidermis: size, number, absorption (section 4.2.1)."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from hylios.errors import InputError, first_where
from hylios.skin.specimen import MELANOSOME_SCALE, Specimen
from hylios.tissue.absorbers import melanin_coefficient
from hylios.tissue.model import Model

SCALE_ANGLE = 5.0
"""Parameter theta_0 of algorithm 1 in degrees (the thesis calls it the mean angle, which is near
twice as large); it falls to 0 from 780 to 1300 nm (4.2.1)."""

MOST_MELANOSOMES_MET = 2e4
"""How many melanosomes a ray may be expected to meet in one layer: some milliseconds' work."""

COMPLEX_RADIUS = {"individual": 0.0, "complexes": 2.0, "compact_complexes": 1.0}
"""Radius of a complex in half major axes of its melanosomes; 0 where melanosomes are single."""


@dataclass(frozen=True)
class Melanosomes:
    """Melanosomes of a layer at one wavelength: lengths in cm, coefficients in 1/cm.

    Attributes
    ----------
    encounter : float
        Attenuation coefficient of melanosomes or complexes (4.3).
    semi_minor, semi_major : float
        Half axes.
    complex_radius : float
        0 where melanosomes are single.
    melanin_absorption : float
        Absorption coefficient inside a melanosome (A.1).
    """

    encounter: float
    semi_minor: float
    semi_major: float
    complex_radius: float
    melanin_absorption: float


def melanosomes(
    specimen: Specimen, part: str, wavelength: float, model: Model, absorption: Any
) -> Melanosomes:
    """The melanosomes of a layer, single or in complexes.

    Parameters
    ----------
    part : str
        One of `hylios.skin.specimen.EPIDERMIS`.
    wavelength : float
        nm.
    absorption : float
        Coefficient in 1/cm of the layer's absorbers around the melanosomes.

    Raises
    ------
    InputError
        If the layer is too thin for its melanosomes, or so thick, full and clear that a ray would
        hardly ever end.
    """
    scale = MELANOSOME_SCALE[part] * 1e-4
    semi_minor = 0.5 * scale * specimen.melanosome_minor_axis
    semi_major = 0.5 * scale * specimen.melanosome_major_axis
    radius = COMPLEX_RADIUS[specimen.melanosome_arrangement] * semi_major
    content = 0.01 * getattr(specimen, f"{part}_melanosomes")
    in_complexes = COMPLEX_RADIUS[specimen.melanosome_arrangement] > 0.0
    if in_complexes and model.readings["complex_content"] == "packed":
        filled = (radius / semi_minor) * semi_minor**2 * semi_major / radius**3
        content = np.minimum(content / filled, 1.0)
    thickness = getattr(specimen, f"{part}_thickness")
    thinnest = 2.0 * (radius if in_complexes else semi_minor)
    crowded = (content > 0.0) & (thickness < thinnest)
    if np.any(crowded):
        thickness, thinnest = first_where(crowded, thickness, thinnest)
        raise InputError(
            f"{part}_thickness is {thickness:g} cm; allowed with melanosomes in that layer is the "
            f"size of one, {thinnest:g} cm, or more."
        )
    encounter = encounter_coefficient(
        content, semi_minor, semi_major, radius if in_complexes else 0.0
    )
    inside: Any = melanin_coefficient(specimen, wavelength, model)
    _require_end(part, thickness, encounter, absorption + np.minimum(encounter, content * inside))
    return Melanosomes(encounter, semi_minor, semi_major, radius, inside)


def encounter_coefficient(
    volume_fraction: float, semi_minor: float, semi_major: float, complex_radius: float
) -> float:
    """Attenuation coefficient in 1/cm of melanosomes with half axes in cm (4.3, 4.4).

    With a radius above 0, in cm, that of complexes.
    """
    if np.any(complex_radius > 0.0):
        surface_to_volume = 3.0 / complex_radius
    else:
        eccentricity = np.sqrt(1.0 - (semi_minor / semi_major) ** 2)
        arc: Any = np.where(
            eccentricity > 0.0, np.arcsin(eccentricity) / np.maximum(eccentricity, 1e-300), 1.0
        )
        surface_to_volume = 1.5 / semi_minor * (semi_minor / semi_major + arc)
    return surface_to_volume * volume_fraction / 4.0


def scattering_angle(wavelength: float) -> float:
    """Parameter theta_0 of algorithm 1 in radians: 5 degrees, falling to 0 from 780 to 1300 nm."""
    fade = np.clip((1300.0 - wavelength) / (1300.0 - 780.0), 0.0, 1.0)
    return np.radians(SCALE_ANGLE) * fade


def _require_end(part: str, thickness: float, encounter: float, lost: float) -> None:
    """Raise InputError where a ray would meet too many melanosomes before it ends.

    A diffuse ray's mean path in a clear slab over a white floor is 4 n^2, here 8, times the
    slab's thickness, however much it scatters; absorption, about `lost` per cm, shortens it.
    """
    met = encounter / np.maximum(lost, 1.0 / (8.0 * thickness))
    endless = met > MOST_MELANOSOMES_MET
    if np.any(endless):
        thickness, met = first_where(endless, thickness, met)
        raise InputError(
            f"{part}_thickness is {thickness:g} cm, where a ray would meet about {met:.1g} "
            f"melanosomes before it ends; allowed is up to {MOST_MELANOSOMES_MET:g}."
        )
