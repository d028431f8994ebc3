"""Optical layers of a specimen at one wavelength (chapter 4 and appendix A of the thesis).

A specimen and a wavelength give a `Stack`: what the solvers need to know of the skin, or of any
other pile of plane layers. Lengths in cm, coefficients in 1/cm.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hylios.errors import first_where, require_range
from hylios.skin.specimen import EPIDERMIS, Specimen, require_specimen
from hylios.tissue.absorbers import PARTS, absorbers
from hylios.tissue.melanosomes import melanosomes, scattering_angle
from hylios.tissue.model import Model
from hylios.tissue.readings import complete_readings

REFERENCE_NM = 1300.0
"""Wavelength at which the refractive indices of table 6.2 were measured."""

MOST_ABSORPTION = 1e20
"""Absorption coefficient in 1/cm up to which layers are made: beyond all matter, and such that
solvers can add up and multiply. Spectra of one's own may be anything."""

INDICES = 0.1, 10.0
"""Refractive indices with which layers are made."""

FIBRE_RADIUS, FIBRE_VOLUME, FIBRE_INDEX_RATIO = 100e-7, 0.22, 1.127
"""Connective fibres of the papillary dermis: radius in cm, volume fraction, eta (section 4.2.2)."""


@dataclass(frozen=True)
class Layer:
    """A plane layer at one wavelength: lengths in cm, coefficients in 1/cm.

    `encounter` is the attenuation coefficient of melanosomes or complexes (4.3), `semi_minor`
    and `semi_major` the melanosomes' half axes, `complex_radius` that of a complex or 0 where
    melanosomes are single, `melanin_absorption` the coefficient inside a melanosome. `rayleigh`
    and `scattering` (Henyey-Greenstein with mean cosine `anisotropy`) are scattering coefficients.
    `survival` is the probability of leaving one melanosome unabsorbed and `longest_path` the
    longest path inside that is to be expected; both follow from the rest and are filled in by
    `hylios.transport.melanosome_paths.with_survival`.
    """

    thickness: float
    refractive_index: float
    absorption: float
    encounter: float = 0.0
    semi_minor: float = 0.0
    semi_major: float = 0.0
    complex_radius: float = 0.0
    melanin_absorption: float = 0.0
    rayleigh: float = 0.0
    scattering: float = 0.0
    anisotropy: float = 0.0
    survival: float = -1.0
    longest_path: float = np.inf

    @property
    def melanosomes_across(self) -> float:
        """Melanosomes along the diameter of a complex, n_m of section 4.2.1; 0 if single."""
        return self.complex_radius / self.semi_minor if self.complex_radius > 0.0 else 0.0

    @property
    def melanosome_depth(self) -> float:
        """Optical depth of a melanosome, its survival being exp of less that; finite."""
        return -float(np.log(np.clip(self.survival, 1e-300, 1.0)))


@dataclass(frozen=True)
class Stack:
    """Plane layers at one wavelength, from the surface down.

    Attributes
    ----------
    layers : tuple of Layer
    roughness : float
        Parameter s of the surface's normals (4.8); 0 is flat.
    lambertian_floor : bool
        Whether the lower face reflects diffusely; else light meets `index_below` there.
    floor_reflectance : float
        Share of the light that a Lambertian floor reflects, at every angle; the rest is lost.
    melanin_index : float
        Refractive index inside melanosomes.
    scattering_angle : float
        Parameter theta_0 of algorithm 1 in radians.
    """

    layers: tuple[Layer, ...]
    roughness: float = 0.0
    lambertian_floor: bool = False
    floor_reflectance: float = 1.0
    index_above: float = 1.0
    index_below: float = 1.0
    melanin_index: float = 1.0
    scattering_angle: float = 0.0
    readings: Mapping[str, str] = field(default_factory=complete_readings)

    @classmethod
    def of(cls, specimen: Specimen, wavelength: float, model: Model | None = None) -> "Stack":
        """The six layers of a specimen at one wavelength in nm.

        Raises
        ------
        InputError
            If that is no specimen, the wavelength lies outside the spectra, an absorption
            coefficient or refractive index that follows from them is out of range, or a layer is
            too thin for the melanosomes in it, or so thick, full and clear that a ray would hardly
            ever end.
        """
        return cls.of_alike(require_specimen(specimen), wavelength, model or Model())

    @classmethod
    def of_alike(cls, specimen: Specimen, wavelength: float, model: Model) -> "Stack":
        """As `of`; the specimen's numbers and the wavelength may be arrays that broadcast."""
        absorption: dict[str, Any] = {
            part: sum(coefficients.values())
            for part, coefficients in absorbers(specimen, wavelength, model).items()
        }
        return cls(
            layers=tuple(
                _layer(specimen, part, wavelength, model, absorption[part]) for part in PARTS
            ),
            roughness=specimen.surface_fold_aspect_ratio,
            lambertian_floor=True,
            floor_reflectance=0.01 * specimen.hypodermis_reflectance,
            melanin_index=specimen.melanin_refractive_index,
            scattering_angle=scattering_angle(wavelength),
            readings=model.readings,
        )


def _layer(
    specimen: Specimen, part: str, wavelength: float, model: Model, absorption: Any
) -> Layer:
    scatterers: dict[str, Any] = {}
    if part in EPIDERMIS:
        scatterers = vars(melanosomes(specimen, part, wavelength, model, absorption))
    elif part == "papillary":
        denominator = model.readings["rayleigh_denominator"]
        scatterers = {"rayleigh": rayleigh_coefficient(wavelength, denominator)}
    index: Any = refractive_index(specimen, part, wavelength, model)
    inside = scatterers.get("melanin_absorption", 0.0)
    fits = (absorption <= MOST_ABSORPTION) & (inside <= MOST_ABSORPTION)
    fits = fits & (index >= INDICES[0]) & (index <= INDICES[1])
    if not np.all(fits):
        absorption, inside, index = first_where(~fits, absorption, inside, index)
        require_range(f"absorption coefficient of {part}", absorption, 0.0, MOST_ABSORPTION, "1/cm")
        require_range("absorption coefficient of melanin", inside, 0.0, MOST_ABSORPTION, "1/cm")
        require_range(f"refractive index of {part}", index, *INDICES)
    return Layer(
        thickness=getattr(specimen, f"{part}_thickness"),
        refractive_index=index,
        absorption=absorption,
        **scatterers,
    )


def refractive_index(specimen: Specimen, part: str, wavelength: float, model: Model) -> float:
    """Refractive index of one of `PARTS` by the law of Gladstone and Dale (appendix A).

    The index is the volume-weighted mean of water's and of the dry matter's; that of the dry
    matter follows from table 6.2 at 1300 nm and is the same at every wavelength.
    """
    tissue = "epidermis" if part in EPIDERMIS else part
    water = 0.01 * getattr(specimen, f"{tissue}_water")
    index = model.spectra["water_refractive_index"]
    change = index.at(wavelength) - index.at(REFERENCE_NM)
    return getattr(specimen, f"{tissue}_refractive_index") + water * change


def rayleigh_coefficient(wavelength: float, denominator: str = "printed") -> float:
    """Scattering coefficient of the connective fibres (4.7; Rayleigh himself has eta^2 + 2)."""
    added = 1.0 if denominator == "printed" else 2.0
    squared = FIBRE_INDEX_RATIO**2
    contrast = ((squared - 1.0) / (squared + added)) ** 2
    fibre_volume = 4.0 / 3.0 * np.pi * FIBRE_RADIUS**3
    length = wavelength * 1e-7
    strength = 128.0 * np.pi**5 * FIBRE_RADIUS**6 * FIBRE_VOLUME / (3.0 * length**4)
    return strength / fibre_volume * contrast
