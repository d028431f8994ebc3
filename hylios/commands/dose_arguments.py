"""Exposures of a skin as the commands `tan` and `dose` take them."""

import argparse
import sys
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path

import numpy as np

from hylios.commands.shell import (
    add_skin_arguments,
    add_tanning_arguments,
    chosen_skin,
    chosen_tanning_skin,
    note_estimates,
    number,
)
from hylios.errors import InputError, require_range
from hylios.readers.spectrum import read_irradiance, read_transmittance
from hylios.readers.text import name_of
from hylios.skin import Skin
from hylios.spectra import Spectra, published_spectra
from hylios.sun.action_spectra import (
    FIRST_NM,
    LAST_NM,
    MELANOGENESIS,
    TANNING_ACTIONS,
    USUAL_TANNING,
    Absorptance,
)
from hylios.sun.doses import (
    Doses,
    joined,
    of_sed,
    of_spectrum,
    of_sun,
    of_uv_index,
)
from hylios.sun.protection import (
    GLASS,
    NOMINAL_AMOUNT,
    Protection,
    clothing,
    layered,
    sunscreen,
    sunscreen_film,
    water,
    window,
)
from hylios.sun.sky import ClearSky
from hylios.sun.surroundings import GROUNDS, ground_albedo
from hylios.tanning import (
    TYPICAL_PIGMENTATION,
    minimal_erythema_dose,
    minimal_melanogenesis_dose,
)
from hylios.tissue import SPECTRA, Model

USUAL_SKY = ClearSky()
SKY = {
    "ozone": ("DU", "ozone column in Dobson units"),
    "altitude": ("M", "metres above the sea"),
    "aerosol": ("DEPTH", "optical depth of the aerosol at 500 nm"),
    "albedo": ("SHARE", "share of ultraviolet that the ground reflects; snow 0.8"),
}
"""Options that say what the air is like: `ClearSky`'s names, with their units and meaning."""

EXPOSURES = """\
Exposures of all kinds can be given together, and every kind repeatedly. Hours count from the
beginning. Doses in SED, in MMD or by UV index act as they are. Doses of the sun or of a spectrum
are weighed by action spectra and the specimen's absorptance. The sun shines on level skin.
"""


@dataclass(frozen=True)
class SkinInLight:
    """A skin that tans, and the model by which light reaches it."""

    skin: Skin
    model: Model


def add_skin_in_light_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that `skin_in_light` reads."""
    add_tanning_arguments(parser)
    add_skin_arguments(parser)


def skin_in_light(arguments: argparse.Namespace) -> SkinInLight:
    """The skin that the arguments ask for, and the model of light.

    Where nothing is said of the specimen, minimal doses are those typical of the tanning set.

    Raises
    ------
    InputError
        If one of them cannot be used.
    """
    _, model = chosen_skin(arguments)
    skin = chosen_tanning_skin(arguments)
    if arguments.skin is None and arguments.specimen is None and not arguments.set:
        typical = TYPICAL_PIGMENTATION[skin.pigmentation]
        mmd = minimal_melanogenesis_dose(typical) if arguments.mmd is None else arguments.mmd
        med = minimal_erythema_dose(typical) if arguments.med is None else arguments.med
        skin = replace(skin, mmd=mmd, med=med)
    return SkinInLight(skin, model)


def add_exposure_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that `chosen_doses` reads."""
    exposures = parser.add_argument_group("exposures", EXPOSURES)
    for option, metavar, help_text in (
        ("--dose", "HOUR:AMOUNT", "dose in SED, such as 30 or 30SED, or in MMD, such as 2.5MMD"),
        ("--uv-index", "HOUR:INDEX:HOURS", "hours at a UV index; an hour at index 1 is 0.9 SED"),
        ("--spectrum", "HOUR:FILE:SECONDS", "lamp: CSV of wavelength_nm,irradiance_w_m2_nm"),
        ("--sun", "DATE:FROM-TO", "hours of a day such as 2025-06-21:10-16:30; needs --latitude"),
    ):
        exposures.add_argument(option, action="append", default=[], metavar=metavar, help=help_text)
    exposures.add_argument(
        "--tanning-action",
        choices=TANNING_ACTIONS,
        help="by which action spectrum light tans: erythema (the usual: it tans as it burns) or "
        "parrish (the thesis's, PROVISIONAL), nearer for lamps of UVA, and the usual where "
        "melanogenesis_action is your own",
    )
    sun = parser.add_argument_group("sun")
    sun.add_argument(
        "--start", metavar="DATE", help="day whose midnight is hour 0 (default: the first --sun)"
    )
    for option, metavar, help_text in (
        ("--latitude", "DEGREES", "latitude, north positive; --sun is in solar time, noon at 12"),
        (
            "--longitude",
            "DEGREES",
            "longitude, east positive; --sun is then in the time of a clock",
        ),
        ("--utc-offset", "HOURS", "of that clock, daylight saving included (default: 0)"),
    ):
        sun.add_argument(option, type=float, metavar=metavar, help=help_text)
    for name, (metavar, help_text) in SKY.items():
        usual = f"{help_text} ({getattr(USUAL_SKY, name):g})"
        sun.add_argument(f"--{name}", type=float, metavar=metavar, help=usual)
    grounds = ", ".join(f"{name} {ground.albedo:g}" for name, ground in GROUNDS.items())
    sun.add_argument("--ground", choices=GROUNDS, help=f"in place of --albedo: {grounds}")
    sun.add_argument(
        "--cloud",
        type=float,
        metavar="SHARE",
        help="of the sky that clouds cover (0); half of it leaves 0.84, all of it 0.31",
    )
    _add_protection_arguments(parser)


def _add_protection_arguments(parser: argparse.ArgumentParser) -> None:
    over = parser.add_argument_group("protection", "What covers the skin at all exposures.")
    over.add_argument("--spf", type=float, help="a sunscreen's factor at 2 mg/cm^2; grey")
    over.add_argument(
        "--sunscreen",
        type=Path,
        metavar="FILE",
        help="a sunscreen at 2 mg/cm^2 as CSV of wavelength_nm,transmittance (or absorbance), 290 "
        "to 400 nm",
    )
    over.add_argument(
        "--sunscreen-amount",
        type=float,
        metavar="MG",
        help="mg/cm^2 of sunscreen (default: 2); people apply 0.5 to 1",
    )
    over.add_argument("--upf", type=float, help="the protection factor of cloth; grey")

    over.add_argument("--glass", choices=GLASS, help="a pane between; window: most of the UVA")
    over.add_argument("--water", type=float, metavar="M", help="metres of water over the skin")


def chosen_doses(arguments: argparse.Namespace, of: SkinInLight) -> Doses:
    """The doses that the arguments ask for; says on standard error which spectra are estimates.

    Raises
    ------
    InputError
        If one of them cannot be used.
    """
    over = _protection(arguments)
    tanning = _tanning(arguments, of.model.spectra)
    parts = [of_sed(*_dose(text, of.skin.mmd), over) for text in arguments.dose]
    parts += [of_uv_index(*_uv_index(text), over) for text in arguments.uv_index]
    _require_place(arguments)
    if arguments.sun or arguments.spectrum:
        from hylios.adding.absorptance import tabulated  # the light model: only for a spectrum

        absorptance = tabulated(of.skin.specimen, model=of.model)
        parts += [
            of_spectrum(*_spectrum(text), absorptance, over, of.model.spectra, tanning)
            for text in arguments.spectrum
        ]
        parts += _of_sun(arguments, absorptance, over, of.model.spectra, tanning)
    doses = joined(parts)
    doses.exposures()  # whatever cannot be used is refused before anything is said
    if arguments.sun or arguments.spectrum:
        light = np.arange(FIRST_NM, LAST_NM + 1.0)
        note_estimates(of.model, light, (*SPECTRA, TANNING_ACTIONS[tanning]))
    return doses


def _require_place(arguments: argparse.Namespace) -> None:
    """Raise InputError where options of the sun are missing, or there without it."""
    if not arguments.sun:
        for option in ("start", "latitude", "longitude", "utc_offset", *SKY, "ground", "cloud"):
            if getattr(arguments, option) is not None:
                raise InputError(f"--{option.replace('_', '-')} is given without --sun.")
    elif arguments.latitude is None:
        raise InputError("--sun needs --latitude, in degrees, north positive.")
    elif arguments.utc_offset is not None and arguments.longitude is None:
        raise InputError("--utc-offset is given without --longitude.")


def _tanning(arguments: argparse.Namespace, spectra: Spectra) -> str:
    """Name of the action spectrum of tanning; a user's own one wants to be used."""
    if arguments.tanning_action is not None:
        return arguments.tanning_action
    is_own = spectra[MELANOGENESIS] is not published_spectra()[MELANOGENESIS]
    return "parrish" if is_own else USUAL_TANNING


def _of_sun(
    arguments: argparse.Namespace,
    absorptance: Absorptance,
    over: Protection,
    spectra: Spectra,
    tanning: str,
) -> list[Doses]:
    """The doses of each `--sun`."""
    suns = [_sun(text) for text in arguments.sun]
    start = (
        _date(arguments.start) if arguments.start else min((day for day, *_ in suns), default=None)
    )
    air = {name: getattr(arguments, name) for name in SKY}
    if arguments.ground is not None:
        if arguments.albedo is not None:
            raise InputError("the ground is given as --ground and as --albedo; give only one.")
        air["albedo"] = ground_albedo(arguments.ground)
    sky = ClearSky(**{name: value for name, value in air.items() if value is not None})
    return [
        of_sun(
            day,
            first,
            last,
            arguments.latitude,
            absorptance,
            start=start,
            longitude=arguments.longitude,
            utc_offset=arguments.utc_offset or 0.0,
            sky=sky,
            cloud=arguments.cloud or 0.0,
            protection=over,
            spectra=spectra,
            tanning=tanning,
        )
        for day, first, last in suns
    ]


def _protection(arguments: argparse.Namespace) -> Protection:
    amount = NOMINAL_AMOUNT if arguments.sunscreen_amount is None else arguments.sunscreen_amount
    layers = []
    if arguments.spf is not None and arguments.sunscreen is not None:
        raise InputError("a sunscreen is given as --spf and as --sunscreen; give only one.")
    if arguments.spf is not None:
        layers.append(sunscreen(arguments.spf, amount))
    elif arguments.sunscreen is not None:
        film = sunscreen_film(*read_transmittance(arguments.sunscreen), amount)
        passed = film.of_sunlight()
        spf = f"{1.0 / passed:.3g}" if passed > 0.0 else "infinite"
        name = name_of(arguments.sunscreen)
        print(f"note: {name} at {amount:g} mg/cm^2 is an SPF of {spf}", file=sys.stderr)
        layers.append(film)
    elif arguments.sunscreen_amount is not None:
        raise InputError("--sunscreen-amount is given without --spf or --sunscreen.")
    if arguments.upf is not None:
        layers.append(clothing(arguments.upf))
    if arguments.glass is not None:
        layers.append(window(arguments.glass))
    if arguments.water is not None:
        layers.append(water(arguments.water))
    return layered(layers)


def _parts(text: str, count: int, what: str, expected: str) -> list[str]:
    parts = text.split(":")
    if len(parts) < count or not all(parts):
        raise InputError(f"{what} is {text!r}; expected {expected}.")
    return [parts[0], ":".join(parts[1 : len(parts) - count + 2]), *parts[len(parts) - count + 2 :]]


def _dose(text: str, mmd: float) -> tuple[float, float]:
    """Hour and SED of HOUR:AMOUNT."""
    hour, amount = _parts(text, 2, "a dose", "HOUR:SED, such as 0:30, or HOUR:MULTIPLE and MMD")
    unit = mmd if amount.upper().endswith("MMD") else 1.0
    if amount.upper().endswith(("MMD", "SED")):
        amount = amount[:-3]
    return number(hour, "hour of a dose"), unit * number(amount, "dose")


def _uv_index(text: str) -> tuple[float, float, float]:
    """Hour, index and duration of HOUR:INDEX:HOURS."""
    hour, index, duration = _parts(text, 3, "an exposure by UV index", "HOUR:INDEX:HOURS")
    return (
        number(hour, "hour of a dose"),
        number(index, "UV index"),
        number(duration, "duration"),
    )


def _spectrum(text: str) -> tuple[float, np.ndarray, np.ndarray, float]:
    """Hour, wavelengths, irradiance and seconds of HOUR:FILE:SECONDS."""
    hour, path, seconds = _parts(text, 3, "a spectral exposure", "HOUR:FILE:SECONDS")
    wavelengths, irradiance = read_irradiance(Path(path))
    first, last = wavelengths[[0, -1]]
    if last < FIRST_NM or first > LAST_NM:
        raise InputError(
            f"{name_of(Path(path))} has light at {first:g} to {last:g} nm; none of it lies in "
            f"{FIRST_NM:g} to {LAST_NM:g} nm, which count: are they in another unit?"
        )
    return (
        number(hour, "hour of a dose"),
        wavelengths,
        irradiance,
        number(seconds, "time of exposure"),
    )


def _sun(text: str) -> tuple[date, float, float]:
    """Day and hours of DATE:FROM-TO."""
    day, hours = _parts(text, 2, "sun", "DATE:FROM-TO, such as 2025-06-21:10-16")
    first, separator, last = hours.partition("-")
    if not separator:
        raise InputError(f"sun is {text!r}; expected DATE:FROM-TO, such as 2025-06-21:10-16.")
    return _date(day), _clock(first), _clock(last)


def _date(text: str) -> date:
    try:
        return date.fromisoformat(text)
    except ValueError as error:
        raise InputError(f"a date is {text!r}; expected YEAR-MONTH-DAY, as 2025-06-21.") from error


def _clock(text: str) -> float:
    """Hours of a text such as 10, 10.5 or 10:30."""
    hour, separator, minute = text.partition(":")
    minutes = number(minute, "minute of sun") if separator else 0.0
    require_range("minute of sun", minutes, 0.0, 59.999)
    return number(hour, "hour of sun") + minutes / 60.0
