"""What absorbs in each layer of skin, melanosomes aside (equation 4.2 and appendix A).

Coefficients in 1/cm.
"""

import numpy as np

from hylios.skin.specimen import EPIDERMIS, LAYERS, Specimen
from hylios.tissue.model import Model

HEMOGLOBIN_WEIGHT, BETA_CAROTENE_WEIGHT, BILIRUBIN_WEIGHT = 66500.0, 537.0, 585.0
"""Molar weights in g/mol (appendix A)."""

SOLID_MELANIN = 1400.0
"""Density of solid melanin in mg/mL, for the reading `colloidal_melanin = solid`."""

SPECTRA = (
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
"""Spectra of `hylios.spectra` that the layers of skin are made from."""

PARTS = LAYERS
"""Layers of a stack, from the surface down."""

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


def absorbers(
    specimen: Specimen,
    wavelength: float | np.ndarray,
    model: Model | None = None,
) -> dict[str, dict[str, np.ndarray]]:
    """What absorbs in each layer at wavelengths in nm, melanosomes aside.

    Returns
    -------
    dict
        For each of `PARTS`, the coefficient in 1/cm, of the wavelength's shape, of those of
        `ABSORBERS` that it holds. A layer of a `Stack` absorbs with their sum.

    Raises
    ------
    InputError
        If the wavelength lies outside the spectra.
    """
    model = model or Model()
    blood = blood_absorbers(specimen, wavelength, model)
    own = {
        "corneum": _corneum_absorbers(specimen, wavelength, model),
        **{part: _epidermal_absorbers(specimen, part, wavelength, model) for part in EPIDERMIS},
        **{
            part: {name: 0.01 * share * whole for name, whole in blood.items()}
            for part, share in (
                ("papillary", specimen.papillary_blood),
                ("reticular", specimen.reticular_blood),
            )
        },
    }
    return {
        part: {**_water_and_lipids(specimen, part, wavelength, model), **own[part]}
        for part in PARTS
    }


def melanin_coefficient(
    specimen: Specimen, wavelength: float | np.ndarray, model: Model
) -> np.ndarray:
    """Absorption coefficient of melanin as it is inside the melanosomes (A.1)."""
    decadic = (
        model.spectra["eumelanin"].at(wavelength) * specimen.eumelanin_concentration
        + model.spectra["pheomelanin"].at(wavelength) * specimen.pheomelanin_concentration
    )
    return decadic * np.log(10.0)


def blood_absorbers(
    specimen: Specimen, wavelength: float | np.ndarray, model: Model
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
    return {name: _molar(model, name, wavelength, *amount) for name, amount in held.items()}


def _molar(
    model: Model,
    name: str,
    wavelength: float | np.ndarray,
    concentration: float,
    weight: float,
) -> np.ndarray:
    """Absorption coefficient from a decadic molar extinction (A.2); mg/mL and g/mol."""
    return model.spectra[name].at(wavelength) * np.log(10.0) * concentration / weight


def _water_and_lipids(
    specimen: Specimen, part: str, wavelength: float | np.ndarray, model: Model
) -> dict[str, np.ndarray]:
    tissue = "epidermis" if part in EPIDERMIS else part
    return {
        name: 0.01 * model.spectra[name].at(wavelength) * getattr(specimen, f"{tissue}_{name}")
        for name in ("water", "lipids")
    }


def _corneum_absorbers(
    specimen: Specimen, wavelength: float | np.ndarray, model: Model
) -> dict[str, np.ndarray]:
    """Keratin, urocanic acid and beta-carotene.

    Keratin's spectrum is a coefficient already (the thesis scales its absorptance over 4 um by
    4e4; 4 um is 4e-4 cm, so 2.5e3). Urocanic acid is taken per concentration over 1 cm, where
    A.5 multiplies by what it calls a molar weight.
    """
    acid = (
        model.spectra["urocanic_acid"].at(wavelength)
        * np.log(10.0)
        * specimen.corneum_urocanic_acid
    )
    content = specimen.corneum_beta_carotene
    return {
        "keratin": model.spectra["keratin"].at(wavelength) * 0.01 * specimen.corneum_keratin,
        "urocanic_acid": acid,
        "beta_carotene": _molar(model, "beta_carotene", wavelength, content, BETA_CAROTENE_WEIGHT),
    }


def _epidermal_absorbers(
    specimen: Specimen,
    part: str,
    wavelength: float | np.ndarray,
    model: Model,
) -> dict[str, np.ndarray]:
    """Beta-carotene, DNA and colloidal melanin.

    DNA is taken per concentration over 1 cm (its density is the whole skin's, section 3.1
    places it in the epidermis). Colloidal melanin is as concentrated as that inside the
    melanosomes unless the reading says solid.
    """
    colloidal = 0.01 * getattr(specimen, f"{part}_colloidal_melanin")
    if model.readings["colloidal_melanin"] == "solid":
        held = specimen.eumelanin_concentration + specimen.pheomelanin_concentration
        colloidal *= np.where(held > 0.0, SOLID_MELANIN / np.maximum(held, 1e-300), 0.0)
    content = specimen.epidermis_beta_carotene
    return {
        "dna": model.spectra["dna"].at(wavelength) * specimen.skin_dna,
        "colloidal_melanin": colloidal * melanin_coefficient(specimen, wavelength, model),
        "beta_carotene": _molar(model, "beta_carotene", wavelength, content, BETA_CAROTENE_WEIGHT),
    }
