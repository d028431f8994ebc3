"""The 144 specimens of appendix D: S3 with other melanin, blood, water and lipids."""

from dataclasses import replace
from itertools import product

import numpy as np

from hylios.skin.specimen import EPIDERMIS, SPECIMENS, Specimen, with_values

TYPES = ("S3", "S4")
"""Specimens whose melanin and blood are varied."""

LEVELS = (0.75, 1.25)
"""Melanin and blood relative to the type's."""

WATER = tuple(np.linspace(0.75, 1.25, 4))
LIPIDS = (0.75, 1.0, 1.25)
"""Water in every layer, and lipids below the stratum corneum, relative to table 6.2."""

WATERY = ("corneum", "epidermis", "papillary", "reticular")
FATTY = WATERY[1:]


def database() -> dict[str, Specimen]:
    """The 144 specimens: N1 to N96 melanotic, N97 to N144 without melanin.

    The thesis prints ranges, not the grid, but their ends are 0.75 times values of S3 and 1.25
    times values of S4 (eumelanin 24 = 0.75 x 32 and 62.5 = 1.25 x 50; so too pheomelanin and
    blood), and of table 6.2 (water 26.25 = 0.75 x 35 and 93.75 = 1.25 x 75; lipids 11.32 = 0.75
    x 15.1, and 0.25, read as 25 % = 1.25 x 20). So here S3, with its own melanin and blood or
    S4's, has melanin and blood at 2 levels, water at 4, lipids at 3: 96 specimens, of which 48
    are left without melanin. How many levels each has is a guess. Wettest, water and lipids
    together fill more than the dermis, which the thesis's own ranges do not exclude.
    """
    grid = list(product(TYPES, LEVELS, WATER, LIPIDS))
    skins = [
        with_melanin(mixed(*mixture), mixture[0], level) for level in LEVELS for mixture in grid
    ]
    skins += [amelanotic(mixed(*mixture)) for mixture in grid]
    return {f"N{number}": replace(skin, name=f"N{number}") for number, skin in enumerate(skins, 1)}


def mixed(kind: str, blood: float, water: float, lipids: float) -> Specimen:
    """S3 with a type's blood times a factor, and its own water and lipids times theirs."""
    start = SPECIMENS["S3"]
    values = {
        f"{layer}_blood": blood * getattr(SPECIMENS[kind], f"{layer}_blood")
        for layer in ("papillary", "reticular")
    }
    values |= {f"{layer}_water": water * getattr(start, f"{layer}_water") for layer in WATERY}
    values |= {f"{layer}_lipids": lipids * getattr(start, f"{layer}_lipids") for layer in FATTY}
    return with_values(start, values, allow_unphysical=True)


def with_melanin(skin: Specimen, kind: str, level: float) -> Specimen:
    """The specimen with a type's concentrations of melanin times a factor."""
    names = ("eumelanin_concentration", "pheomelanin_concentration")
    values = {name: level * getattr(SPECIMENS[kind], name) for name in names}
    return with_values(skin, values, allow_unphysical=True)


def amelanotic(skin: Specimen) -> Specimen:
    """The specimen without melanin."""
    kinds = ("melanosomes", "colloidal_melanin")
    values = {f"{layer}_{kind}": 0.0 for layer in EPIDERMIS for kind in kinds}
    return with_values(skin, values, allow_unphysical=True)


def subsets(spectra: np.ndarray) -> dict[str, np.ndarray]:
    """Rows of a matrix (144, W) by subset."""
    melanotic = len(spectra) * 2 // 3
    return {"melanotic": spectra[:melanotic], "amelanotic": spectra[melanotic:], "all": spectra}
