"""What columns hold, by the names and units that people and instruments give them."""

import re
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass, field

from hylios.errors import InputError, shown


@dataclass(frozen=True)
class Quantity:
    """What a column holds.

    Attributes
    ----------
    name : str
        Of the column as this project writes it; such a column is in this project's unit.
    aliases : tuple of str
        Other names, in small letters, that a unit may stand beside.
    units : mapping of str to (float, float)
        What to multiply by and then divide by to come to this project's unit, by units as `unit`
        in `named` spells them; "" is for names without one.
    is_text : bool
        Whether its cells are text and not numbers.
    others : tuple of str
        In small letters, parts of words for what it may be mistaken for.
    is_exact : bool
        Whether a title that is its name goes before all others.
    may_lack : bool
        Whether cells may be empty, or say `NA`, `NaN` or `null`; they are nan.
    """

    name: str
    aliases: tuple[str, ...] = ()
    units: Mapping[str, tuple[float, float]] = field(default_factory=lambda: {"": (1.0, 1.0)})
    is_text: bool = False
    others: tuple[str, ...] = ()
    is_exact: bool = False
    may_lack: bool = False


SHARE = {"": (1.0, 1.0), "%": (1.0, 100.0)}

WAVELENGTH = Quantity(
    "wavelength_nm",
    ("wavelength", "wavelengths", "wave", "wvl", "wl", "lambda", "λ", "wellenlänge", "nm"),
    {"": (1.0, 1.0), "nm": (1.0, 1.0), "um": (1000.0, 1.0), "å": (1.0, 10.0)},
)
REFLECTANCE = Quantity(
    "total",
    ("total", "reflectance", "reflect", "refl", "r", "reflexionsgrad"),
    SHARE,
    others=("absorb", "extin", "transmi", "radian", "counts", "log(", "log 1", "wavenumber"),
)
STANDARD_ERROR = Quantity("standard_error", ("standard_error", "standard error"), SHARE)
IRRADIANCE = Quantity(
    "irradiance_w_m2_nm",
    ("irradiance", "spectral irradiance"),
    {
        "w/m2/nm": (1.0, 1.0),
        "mw/m2/nm": (1.0, 1000.0),
        "uw/cm2/nm": (1.0, 100.0),
        "mw/cm2/nm": (10.0, 1.0),
        "w/cm2/nm": (10000.0, 1.0),
    },
    others=("absorb", "transmi", "reflect", "radian", "counts", "mw", "uw", "µw", "wavenumber"),
)
TRANSMITTANCE = Quantity(
    "transmittance",
    ("transmittance", "transmission", "t"),
    SHARE,
    others=("absorb", "extin", "optical den", "reflect", "radian", "counts", "wavenumber"),
)
ABSORBANCE = Quantity(
    "absorbance", ("absorbance", "abs"), {"": (1.0, 1.0), "au": (1.0, 1.0), "mau": (1.0, 1000.0)}
)

SPELLINGS = {
    "percent": "%",
    "pct": "%",
    "prozent": "%",
    "nanometer": "nm",
    "nanometers": "nm",
    "nanometre": "nm",
    "nanometres": "nm",
    "micrometer": "um",
    "micrometers": "um",
    "micrometre": "um",
    "micrometres": "um",
    "micron": "um",
    "microns": "um",
    "angstrom": "å",
    "angstroms": "å",
    "ångström": "å",
}
"""Other spellings of units, in small letters."""

KNOWN_UNITS = {
    spelled
    for quantity in (WAVELENGTH, REFLECTANCE, IRRADIANCE, ABSORBANCE)
    for spelled in quantity.units
} - {""}


def named(title: str) -> tuple[str, str]:
    """Name and unit of a column's title such as `Wavelength [nm]`, `%R` or `total_percent`."""
    text = unicodedata.normalize("NFC", title).strip()
    bracketed = re.fullmatch(r"(.*?)\s*[(\[](.*)[)\]]", text)
    if bracketed:
        return _plain(bracketed[1]), unit(bracketed[2])
    name, separator, rest = text.partition("/")
    if separator and unit(rest) in KNOWN_UNITS:
        return _plain(name), unit(rest)
    if "%" in text:
        return _plain(text.replace("%", " ")), "%"
    for mark in "_ ":
        name, separator, last = text.rpartition(mark)
        if separator and unit(last) in KNOWN_UNITS:
            return _plain(name), unit(last)
    return _plain(text), ""


def unit(text: str) -> str:
    """A unit as `Quantity.units` spells it: `W m^-2 nm^-1` is `w/m2/nm`.

    Megawatts are left as they are: in small letters they would be milliwatts.
    """
    text = unicodedata.normalize("NFC", text).strip()
    if text.startswith("MW"):
        return text
    text = text.casefold().replace("µ", "u").replace("μ", "u")
    text = text.replace("²", "2").replace("⁻¹", "-1").replace("⁻2", "-2")
    text = re.sub(r"[\s·*.]*([a-z]+)\^?-(\d)", lambda part: f"/{part[1]}{part[2]}", text)
    text = re.sub(r"[\s^·*]", "", text).replace("nm1", "nm")
    text = re.sub(r"(\w+)/\(?(c?m2)/?nm\)?", r"\1/\2/nm", text)
    return SPELLINGS.get(text, text)


def _plain(text: str) -> str:
    return text.casefold().strip(" .,:_")


def place(titles: tuple[str, ...], quantity: Quantity) -> tuple[int, str] | None:
    """Where a quantity's column is among some titles, and in what unit; None if nowhere.

    A title that is the quantity's own name, in whatever letters, is in its own unit.

    Raises
    ------
    InputError
        If there are two such columns, one may be a colour's red, or the unit is none of the
        quantity's.
    """
    plain = [title.strip() for title in titles]
    split = [named(title) for title in titles]
    own = [number for number, title in enumerate(plain) if title == quantity.name]
    if quantity.is_exact and len(own) == 1:
        return own[0], next(iter(quantity.units))
    own = [n for n, title in enumerate(plain) if title.casefold() == quantity.name.casefold()]
    matches = [n for n, (name, _) in enumerate(split) if n in own or name in quantity.aliases]
    if not matches:
        return None
    if len(matches) > 1:
        twice = " and ".join(repr(shown(plain[number])) for number in matches[:2])
        raise InputError(f"the column {quantity.name} is there twice, as {twice}")
    match = matches[0]
    names = {name for name, _ in split}
    if split[match][0] == "r" != quantity.name.casefold() and {"g", "b"} <= names:
        raise InputError(f"the column {plain[match]!r} is beside G and B; it may be a colour's red")
    its_unit = next(iter(quantity.units)) if own else split[match][1]
    if its_unit not in quantity.units:
        raise InputError(
            f"the column {shown(plain[match])!r} is in {its_unit or 'no unit'}; allowed is "
            + ", ".join(f"{spelled or 'none'}" for spelled in quantity.units)
        )
    return match, its_unit
