"""Fitzpatrick's skin types I to VI: untanned specimens fitted to people, and how they tan.

`types.toml` says what was decided and which of it is a guess, `inner_arm.csv` is what people's skin
reflects, and `fitted.toml` is what `hylios.lab.phototype_fits` made of both. numpy only.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import Any

import numpy as np

from hylios.errors import InputError
from hylios.packaged import texts_of
from hylios.skin.skin import Skin
from hylios.skin.specimen import EPIDERMIS, SPECIMENS, Specimen, specimen_of

PHOTOTYPES = ("I", "II", "III", "IV", "V", "VI")
"""Names of Fitzpatrick's skin types, from very light to dark, as `skin_type` takes them."""

_MELANIN = [
    f"{layer}_{form}" for layer in EPIDERMIS for form in ("melanosomes", "colloidal_melanin")
]


@dataclass(frozen=True, eq=False)
class People:
    """Mean reflectance of the inner arms of a class of people.

    Attributes
    ----------
    name : str
        From very_light to dark.
    subjects : int
    wavelengths, reflectance : (31,) arrays
        nm, and 0 to 1, surface included.
    """

    name: str
    subjects: int
    wavelengths: np.ndarray
    reflectance: np.ndarray


@dataclass(frozen=True, eq=False)
class Phototype:
    """A skin type.

    Attributes
    ----------
    skin : Skin
        Its specimen has the type's name.
    tanning : mapping
        What differs from the tanning set, as `hylios.skin.varied` takes it.
    people : People
        The class that stands for it.
    rmse, ciede2000 : float
        By which the specimen misses the class's mean, 400 to 700 nm.
    guesses : tuple of str
    """

    skin: Skin
    tanning: Mapping[str, float]
    people: People
    rmse: float
    ciede2000: float
    guesses: tuple[str, ...]


def phototype(name: str) -> Phototype:
    """A skin type by its name, I to VI.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    if not isinstance(name, str) or name not in PHOTOTYPES:
        raise InputError(
            f"there is no skin type {str(name)[:60]!r}; there are {', '.join(PHOTOTYPES)}."
        )
    return _phototype(name)


@cache
def _phototype(name: str) -> Phototype:
    decided, fitted = _read("types.toml")[name], dict(_read("fitted.toml")[name])
    misfit = {key: fitted.pop(key) for key in ("rmse", "ciede2000")}
    begun = start(name)
    more = 0.01 * fitted.pop("melanin") / begun.pigmentation
    melanin = {field: more * getattr(begun, field) for field in _MELANIN}
    tanning = MappingProxyType(decided.get("tanning", {}))
    return Phototype(
        skin=Skin.of(
            specimen_of({**asdict(begun), **melanin, **fitted}),
            decided["pigmentation"],
            tanning=tanning,
        ),
        tanning=tanning,
        people=people(name),
        guesses=tuple(decided["guesses"]),
        **misfit,
    )


def skin_type(name: str, *, kinetics: str = "thesis") -> Skin:
    """The skin of one of Fitzpatrick's types, I to VI, fitted to people.

    Parameters
    ----------
    kinetics : str
        How its melanin follows the sun: "thesis", or "measured" in people
        (`hylios.tanning.KINETICS`).

    Raises
    ------
    InputError
        If there is no type or no kinetics of that name.

    Examples
    --------
    >>> import hylios
    >>> skin = hylios.skin_type("III")
    >>> print(f"tans from {skin.mmd:.1f} SED, reddens from {skin.med:.1f} SED")
    tans from 5.7 SED, reddens from 3.3 SED
    """
    return replace(phototype(name).skin, kinetics=kinetics)


def start(name: str) -> Specimen:
    """Where a type's fit starts: melanin lies as the tanning set's steady state (5.13)."""
    types = _read("types.toml")
    common, decided = dict(types["start"]), types[name]
    usual = SPECIMENS[common.pop("base")]
    values = {**asdict(usual), **common, **decided.get("specimen", {}), "name": name}
    skin = Skin.of(specimen_of(values), decided["pigmentation"], tanning=decided.get("tanning", {}))
    return skin.at(skin.untanned_state)


def people(name: str) -> People:
    """The people whose inner arms stand for a type."""
    rows = texts_of(__name__, "inner_arm.csv")
    (row,) = (people for people in rows if people["class"] == _read("types.toml")[name]["people"])
    columns = [column for column in row if column.startswith("R")]
    return People(
        name=row["class"],
        subjects=int(row["subjects"]),
        wavelengths=np.array([float(column[1:]) for column in columns]),
        reflectance=np.array([float(row[column]) for column in columns]),
    )


@cache
def specimens() -> Mapping[str, Specimen]:
    """Every specimen that has a name: S1 to S4 of table 6.1, and the six types'."""
    types = {name: phototype(name).skin.specimen for name in PHOTOTYPES}
    return MappingProxyType({**SPECIMENS, **types})


def named_specimen(name: str) -> Specimen:
    """A specimen of skin without a tan, by name: S1 to S4 of table 6.1, or a skin type, I to VI.

    `dataclasses.replace` varies it; `skin_type` gives a type with the way it tans.

    Raises
    ------
    InputError
        If there is none of that name.

    Examples
    --------
    >>> import hylios
    >>> hylios.specimen("S3").papillary_blood
    0.3
    """
    if not isinstance(name, str) or name not in specimens():
        raise InputError(
            f"there is no specimen {str(name)[:60]!r}; there are {', '.join(specimens())}."
        )
    return specimens()[name]


@cache
def _read(name: str) -> Mapping[str, Any]:
    return tomllib.loads((files(__name__) / name).read_text(encoding="utf-8"))
