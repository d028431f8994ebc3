"""Optical layers of a specimen at one wavelength (chapter 4 and appendix A of the thesis).

A specimen and a wavelength give a `Stack`: what `hylios.transport` needs to know of the skin, or
of any other pile of plane layers. Lengths in cm, coefficients in 1/cm.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from hylios.errors import InputError
from hylios.skin.specimen import EPIDERMIS, MELANOSOME_SCALE, Specimen
from hylios.spectra import Figures, figures

REFERENCE_NM = 1300.0
"""Wavelength at which the refractive indices of table 6.2 were measured."""

HEMOGLOBIN_WEIGHT, BETA_CAROTENE_WEIGHT, BILIRUBIN_WEIGHT = 66500.0, 537.0, 585.0
"""Molar weights in g/mol (appendix A)."""

FIBRE_RADIUS, FIBRE_VOLUME, FIBRE_INDEX_RATIO = 100e-7, 0.22, 1.127
"""Connective fibres of the papillary dermis: radius in cm, volume fraction, eta (section 4.2.2)."""

SOLID_MELANIN = 1400.0
"""Density of solid melanin in mg/mL, for the reading `colloidal_melanin = solid`."""

SCALE_ANGLE = 5.0
"""Parameter theta_0 of algorithm 1 in degrees (the thesis calls it the mean angle, which is near
twice as large); it falls to 0 from 780 to 1300 nm (4.2.1)."""

MOST_MELANOSOMES_MET = 2e4
"""How many melanosomes a ray may be expected to meet in one layer: some milliseconds' work."""

FIGURES = (
    "eumelanin",
    "pheomelanin",
    "oxyhemoglobin",
    "deoxyhemoglobin",
    "carboxyhemoglobin",
    "methemoglobin",
    "sulfhemoglobin",
    "bilirubin",
    "beta_carotene",
    "water",
    "water_refractive_index",
    "lipids",
    "keratin",
    "dna",
    "urocanic_acid",
)
"""Spectral figures that a stack is made from."""

PARTS = ("corneum", *EPIDERMIS, "papillary", "reticular")
"""Layers of a specimen, from the surface down."""

ABSORBERS = (
    "water",
    "lipids",
    "keratin",
    "urocanic_acid",
    "dna",
    "colloidal_melanin",
    "oxyhemoglobin",
    "deoxyhemoglobin",
    "carboxyhemoglobin",
    "methemoglobin",
    "sulfhemoglobin",
    "bilirubin",
    "beta_carotene",
)
"""What absorbs in the layers, melanosomes aside."""


@dataclass(frozen=True)
class Reading:
    """A choice that the thesis's text leaves open: what is taken, and what else can be."""

    choices: tuple[str, ...]
    what: str

    @property
    def default(self) -> str:
        """The first choice."""
        return self.choices[0]


READINGS: Mapping[str, Reading] = MappingProxyType(
    {
        "colloidal_melanin": Reading(
            ("as_in_melanosomes", "solid"), "concentration of melanin outside the melanosomes"
        ),
        "complex_content": Reading(
            ("printed", "packed"),
            "v in 4.3 for complexes: the melanosome content as it is, or the volume of the "
            "complexes that hold it with n_m melanosomes in each",
        ),
        "complex_melanosomes": Reading(
            ("chord", "diameter"), "melanosomes met in a complex: those along the chord, or n_m"
        ),
        "melanosome_entry": Reading(("straight", "refracted"), "direction inside a melanosome"),
        "melanosome_scattering": Reading(
            ("algorithm_1", "exponential"),
            "exp(-x) sin(x) as algorithm 1 has it (mean near 10 degrees), or an exponential of "
            "mean 5 degrees as the text says",
        ),
        "rayleigh": Reading(
            ("once_per_traversal", "every_collision"), "scattering in the papillary dermis"
        ),
        "rayleigh_denominator": Reading(
            ("printed", "plus_two"), "eta^2 + 1 in 4.7, or Rayleigh's eta^2 + 2"
        ),
        "inner_fresnel": Reading(
            ("on", "off"), "Fresnel reflection and refraction where two layers meet"
        ),
        "floor": Reading(
            ("normal", "mirrored"), "diffuse about the dermal floor's normal or the mirrored ray"
        ),
    }
)
"""Readings that move a specimen's reflectance by more than .01; the first choice is the default."""


def readings(chosen: Mapping[str, str] | None = None) -> Mapping[str, str]:
    """All readings by name, the defaults where nothing else is chosen.

    Raises
    ------
    InputError
        If there is no such reading or no such choice.
    """
    result = {name: reading.default for name, reading in READINGS.items()}
    for name, choice in (chosen or {}).items():
        if name not in READINGS:
            raise InputError(f"there is no reading {name!r}; there are {', '.join(READINGS)}.")
        if choice not in READINGS[name].choices:
            allowed = ", ".join(READINGS[name].choices)
            raise InputError(f"reading {name} is {choice!r}; allowed is {allowed}.")
        result[name] = choice
    return MappingProxyType(result)


@dataclass(frozen=True)
class Layer:
    """A plane layer at one wavelength: lengths in cm, coefficients in 1/cm.

    `encounter` is the attenuation coefficient of melanosomes or complexes (4.3), `semi_minor`
    and `semi_major` the melanosomes' half axes, `complex_radius` that of a complex or 0 where
    melanosomes are single, `melanin_absorption` the coefficient inside a melanosome. `rayleigh`
    and `scattering` (Henyey-Greenstein with mean cosine `anisotropy`) are scattering coefficients.
    `survival` is the probability of leaving one melanosome unabsorbed and `longest_path` the
    longest path inside that is to be expected; both follow from the rest and are filled in by
    `hylios.transport.survival.with_survival`.
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
    readings: Mapping[str, str] = field(default_factory=readings)


def stack(
    specimen: Specimen,
    wavelength: float,
    *,
    known: Figures | None = None,
    chosen: Mapping[str, str] | None = None,
) -> Stack:
    """The six layers of a specimen at one wavelength in nm.

    Raises
    ------
    InputError
        If the wavelength lies outside the figures, a reading is unknown, or a layer is too thin
        for the melanosomes in it, or so thick, full and clear that a ray would hardly ever end.
    """
    known = known or figures()
    decided = readings(chosen)
    absorption = {
        part: float(sum(each.values()))
        for part, each in absorbers(specimen, wavelength, known=known, chosen=chosen).items()
    }
    layers = (
        Layer(
            thickness=specimen.corneum_thickness,
            refractive_index=refractive_index(specimen, "corneum", wavelength, known),
            absorption=absorption["corneum"],
        ),
        *(
            _epidermal_layer(specimen, part, wavelength, known, decided, absorption[part])
            for part in EPIDERMIS
        ),
        Layer(
            thickness=specimen.papillary_thickness,
            refractive_index=refractive_index(specimen, "papillary", wavelength, known),
            absorption=absorption["papillary"],
            rayleigh=rayleigh_coefficient(wavelength, decided["rayleigh_denominator"]),
        ),
        Layer(
            thickness=specimen.reticular_thickness,
            refractive_index=refractive_index(specimen, "reticular", wavelength, known),
            absorption=absorption["reticular"],
        ),
    )
    return Stack(
        layers=layers,
        roughness=specimen.surface_fold_aspect_ratio,
        lambertian_floor=True,
        floor_reflectance=0.01 * specimen.hypodermis_reflectance,
        melanin_index=specimen.melanin_refractive_index,
        scattering_angle=scattering_angle(wavelength),
        readings=decided,
    )


def absorbers(
    specimen: Specimen,
    wavelength: float | np.ndarray,
    *,
    known: Figures | None = None,
    chosen: Mapping[str, str] | None = None,
) -> dict[str, dict[str, np.ndarray]]:
    """What absorbs in each layer at wavelengths in nm, melanosomes aside.

    Returns
    -------
    dict
        For each of `PARTS`, the coefficient in 1/cm, of the wavelength's shape, of those of
        `ABSORBERS` that it holds. A layer of a `stack` absorbs with their sum.

    Raises
    ------
    InputError
        If the wavelength lies outside the figures or a reading is unknown.
    """
    known = known or figures()
    decided = readings(chosen)
    blood = blood_absorbers(specimen, wavelength, known)
    own = {
        "corneum": _corneum_absorbers(specimen, wavelength, known),
        **{
            part: _epidermal_absorbers(specimen, part, wavelength, known, decided)
            for part in EPIDERMIS
        },
        **{
            part: {name: 0.01 * share * each for name, each in blood.items()}
            for part, share in (
                ("papillary", specimen.papillary_blood),
                ("reticular", specimen.reticular_blood),
            )
        },
    }
    return {
        part: {**_water_and_lipids(specimen, part, wavelength, known), **own[part]}
        for part in PARTS
    }


def refractive_index(specimen: Specimen, part: str, wavelength: float, known: Figures) -> float:
    """Refractive index of a tissue by the law of Gladstone and Dale (appendix A).

    The index is the volume-weighted mean of water's and of the dry matter's; that of the dry
    matter follows from table 6.2 at 1300 nm and is the same at every wavelength.
    """
    water = 0.01 * getattr(specimen, f"{part}_water")
    index = known["water_refractive_index"]
    change = index.at(wavelength) - index.at(REFERENCE_NM)
    return float(getattr(specimen, f"{part}_refractive_index") + water * change)


def melanin_coefficient(
    specimen: Specimen, wavelength: float | np.ndarray, known: Figures
) -> np.ndarray:
    """Absorption coefficient of melanin as it is inside the melanosomes (A.1)."""
    decadic = (
        known["eumelanin"].at(wavelength) * specimen.eumelanin_concentration
        + known["pheomelanin"].at(wavelength) * specimen.pheomelanin_concentration
    )
    return decadic * np.log(10.0)


def rayleigh_coefficient(wavelength: float, denominator: str = "printed") -> float:
    """Scattering coefficient of the connective fibres (4.7; Rayleigh himself has eta^2 + 2)."""
    added = 1.0 if denominator == "printed" else 2.0
    squared = FIBRE_INDEX_RATIO**2
    contrast = ((squared - 1.0) / (squared + added)) ** 2
    fibre_volume = 4.0 / 3.0 * np.pi * FIBRE_RADIUS**3
    length = wavelength * 1e-7
    strength = 128.0 * np.pi**5 * FIBRE_RADIUS**6 * FIBRE_VOLUME / (3.0 * length**4)
    return float(strength / fibre_volume * contrast)


def scattering_angle(wavelength: float) -> float:
    """Parameter theta_0 of algorithm 1 in radians: 5 degrees, falling to 0 from 780 to 1300 nm."""
    fade = np.clip((1300.0 - wavelength) / (1300.0 - 780.0), 0.0, 1.0)
    return float(np.radians(SCALE_ANGLE) * fade)


def encounter_coefficient(
    volume_fraction: float, semi_minor: float, semi_major: float, complex_radius: float
) -> float:
    """Attenuation coefficient in 1/cm of melanosomes with half axes in cm (4.3, 4.4).

    With a radius above 0, in cm, that of complexes.
    """
    if complex_radius > 0.0:
        surface_to_volume = 3.0 / complex_radius
    else:
        eccentricity = np.sqrt(1.0 - (semi_minor / semi_major) ** 2)
        arc = np.arcsin(eccentricity) / eccentricity if eccentricity > 0.0 else 1.0
        surface_to_volume = 1.5 / semi_minor * (semi_minor / semi_major + arc)
    return float(surface_to_volume * volume_fraction / 4.0)


def _molar(
    known: Figures,
    name: str,
    wavelength: float | np.ndarray,
    concentration: float,
    weight: float,
) -> np.ndarray:
    """Absorption coefficient from a decadic molar extinction (A.2); mg/mL and g/mol."""
    return known[name].at(wavelength) * np.log(10.0) * concentration / weight


def blood_absorbers(
    specimen: Specimen, wavelength: float | np.ndarray, known: Figures
) -> dict[str, np.ndarray]:
    """Absorption coefficients in 1/cm of what is in whole blood: the bracket of 4.2.

    The thesis prints the volume fraction of sulfhemoglobin beside the coefficient of
    carboxyhemoglobin; each absorber has its own here.
    """
    oxygenated = 0.01 * specimen.oxygenated_blood
    hemoglobins = {
        "oxyhemoglobin": specimen.hemoglobin * oxygenated,
        "deoxyhemoglobin": specimen.hemoglobin * (1.0 - oxygenated),
        "carboxyhemoglobin": specimen.carboxyhemoglobin,
        "methemoglobin": specimen.methemoglobin,
        "sulfhemoglobin": specimen.sulfhemoglobin,
    }
    held = {name: (content, HEMOGLOBIN_WEIGHT) for name, content in hemoglobins.items()}
    held["beta_carotene"] = (specimen.blood_beta_carotene, BETA_CAROTENE_WEIGHT)
    held["bilirubin"] = (specimen.blood_bilirubin, BILIRUBIN_WEIGHT)
    return {name: _molar(known, name, wavelength, *each) for name, each in held.items()}


def blood_coefficient(specimen: Specimen, wavelength: float, known: Figures) -> float:
    """Absorption coefficient of whole blood in 1/cm: the sum of `blood_absorbers`."""
    return float(sum(blood_absorbers(specimen, wavelength, known).values()))


def _water_and_lipids(
    specimen: Specimen, part: str, wavelength: float | np.ndarray, known: Figures
) -> dict[str, np.ndarray]:
    tissue = "epidermis" if part in EPIDERMIS else part
    return {
        name: 0.01 * known[name].at(wavelength) * getattr(specimen, f"{tissue}_{name}")
        for name in ("water", "lipids")
    }


def _corneum_absorbers(
    specimen: Specimen, wavelength: float | np.ndarray, known: Figures
) -> dict[str, np.ndarray]:
    """Keratin, urocanic acid and beta-carotene.

    Keratin's figure is a coefficient already (the thesis scales its absorptance over 4 um by
    4e4; 4 um is 4e-4 cm, so 2.5e3). Urocanic acid is taken per concentration over 1 cm, where
    A.5 multiplies by what it calls a molar weight.
    """
    acid = known["urocanic_acid"].at(wavelength) * np.log(10.0) * specimen.corneum_urocanic_acid
    content = specimen.corneum_beta_carotene
    return {
        "keratin": known["keratin"].at(wavelength) * 0.01 * specimen.corneum_keratin,
        "urocanic_acid": acid,
        "beta_carotene": _molar(known, "beta_carotene", wavelength, content, BETA_CAROTENE_WEIGHT),
    }


def _epidermal_absorbers(
    specimen: Specimen,
    part: str,
    wavelength: float | np.ndarray,
    known: Figures,
    decided: Mapping[str, str],
) -> dict[str, np.ndarray]:
    """Beta-carotene, DNA and colloidal melanin.

    DNA is taken per concentration over 1 cm (its density is the whole skin's, section 3.1
    places it in the epidermis). Colloidal melanin is as concentrated as that inside the
    melanosomes unless the reading says solid.
    """
    colloidal = 0.01 * getattr(specimen, f"{part}_colloidal_melanin")
    if decided["colloidal_melanin"] == "solid":
        held = specimen.eumelanin_concentration + specimen.pheomelanin_concentration
        colloidal *= SOLID_MELANIN / held if held > 0 else 0.0
    content = specimen.epidermis_beta_carotene
    return {
        "dna": known["dna"].at(wavelength) * specimen.skin_dna,
        "colloidal_melanin": colloidal * melanin_coefficient(specimen, wavelength, known),
        "beta_carotene": _molar(known, "beta_carotene", wavelength, content, BETA_CAROTENE_WEIGHT),
    }


def _epidermal_layer(
    specimen: Specimen,
    part: str,
    wavelength: float,
    known: Figures,
    decided: Mapping[str, str],
    absorption: float,
) -> Layer:
    """A layer with its melanosomes, single or in complexes."""
    scale = MELANOSOME_SCALE[part] * 1e-4
    semi_minor = 0.5 * scale * specimen.melanosome_minor_axis
    semi_major = 0.5 * scale * specimen.melanosome_major_axis
    radius = {"individual": 0.0, "complexes": 2.0, "compact_complexes": 1.0}[
        specimen.melanosome_arrangement
    ] * semi_major
    content = 0.01 * getattr(specimen, f"{part}_melanosomes")
    if radius > 0.0 and decided["complex_content"] == "packed":
        filled = (radius / semi_minor) * semi_minor**2 * semi_major / radius**3
        content = min(content / filled, 1.0)
    thickness = getattr(specimen, f"{part}_thickness")
    thinnest = 2.0 * (radius or semi_minor)
    if content > 0.0 and thickness < thinnest:
        raise InputError(
            f"{part}_thickness is {thickness:g} cm; allowed with melanosomes in that layer is the "
            f"size of one, {thinnest:g} cm, or more."
        )
    encounter = encounter_coefficient(content, semi_minor, semi_major, radius)
    inside = float(melanin_coefficient(specimen, wavelength, known))
    _require_end(part, thickness, encounter, absorption + min(encounter, content * inside))
    return Layer(
        thickness=thickness,
        refractive_index=refractive_index(specimen, "epidermis", wavelength, known),
        absorption=absorption,
        encounter=encounter,
        semi_minor=semi_minor,
        semi_major=semi_major,
        complex_radius=radius,
        melanin_absorption=inside,
    )


def _require_end(part: str, thickness: float, encounter: float, lost: float) -> None:
    """Raise InputError where a ray would meet too many melanosomes before it ends.

    A diffuse ray's mean path in a clear slab over a white floor is 4 n^2, here 8, times the
    slab's thickness, however much it scatters; absorption, about `lost` per cm, shortens it.
    """
    met = encounter * (1.0 / lost if lost * 8.0 * thickness > 1.0 else 8.0 * thickness)
    if met > MOST_MELANOSOMES_MET:
        raise InputError(
            f"{part}_thickness is {thickness:g} cm, where a ray would meet about {met:.1g} "
            f"melanosomes before it ends; allowed is up to {MOST_MELANOSOMES_MET:g}."
        )
