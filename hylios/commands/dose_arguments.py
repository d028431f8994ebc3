"""Exposures of a skin as the commands `tan` and `dose` take them."""

import argparse
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from hylios.commands import dose_notes
from hylios.commands.skin_arguments import (
    add_skin_arguments,
    add_tanning_arguments,
    chosen_skin,
    chosen_tanning_skin,
)
from hylios.commands.sun_arguments import add_sun_arguments, asked_sun
from hylios.commands.texts import number
from hylios.errors import InputError
from hylios.history import read_schedule
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
)
from hylios.sun.doses import (
    Doses,
    joined,
    of_sed,
    of_spectrum,
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
from hylios.tanning import (
    TYPICAL_PIGMENTATION,
    minimal_erythema_dose,
    minimal_melanogenesis_dose,
)
from hylios.tissue import Model

EXPOSURES = """\
Exposures of all kinds can be given together, and every kind but --weather repeatedly. Hours count
from the beginning. Doses in SED, MMD, MED or by UV index act as they are. Doses of the sun or of a
spectrum are weighed by action spectra and the specimen's absorptance. The sun shines on level skin.
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
        (
            "--dose",
            "HOUR:AMOUNT",
            "dose in SED, such as 30 or 30SED, in MMD or in MED: 2.5MMD, 2MED",
        ),
        ("--uv-index", "HOUR:INDEX:HOURS", "hours at a UV index; an hour at index 1 is 0.9 SED"),
        ("--spectrum", "HOUR:FILE:SECONDS", "lamp: CSV of wavelength_nm,irradiance_w_m2_nm"),
    ):
        exposures.add_argument(option, action="append", default=[], metavar=metavar, help=help_text)
    exposures.add_argument(
        "--tanning-action",
        choices=TANNING_ACTIONS,
        help="by which action spectrum light tans: erythema (the usual: it tans as it burns) or "
        "parrish (the thesis's, PROVISIONAL), nearer for lamps of UVA, and the usual where "
        "melanogenesis_action is your own",
    )
    exposures.add_argument(
        "--schedule",
        type=Path,
        action="append",
        default=[],
        metavar="FILE",
        help="doses that `hylios dose` prints; - for standard input",
    )
    add_sun_arguments(parser)
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
    """The doses that the arguments ask for; says on standard error what of them is an estimate.

    Raises
    ------
    InputError
        If one of them cannot be used.
    """
    over = _protection(arguments)
    tanning = _tanning(arguments, of.model.spectra)
    parts = [of_sed(*_dose(text, of.skin), over) for text in arguments.dose]
    parts += [of_uv_index(*_uv_index(text), over) for text in arguments.uv_index]
    parts += [_scheduled(path, over) for path in arguments.schedule]
    sun = asked_sun(arguments)
    absorptance = None
    has_spectrum = sun.has_spectrum or bool(arguments.spectrum)
    if has_spectrum:
        from hylios.adding.absorptance import tabulated  # the light model: only for a spectrum

        absorptance = tabulated(of.skin.specimen, model=of.model)
        parts += [
            of_spectrum(*_spectrum(text), absorptance, over, of.model.spectra, tanning)
            for text in arguments.spectrum
        ]
    light = {"absorptance": absorptance, "spectra": of.model.spectra, "tanning": tanning}
    of_sun, notes = sun.doses(over, **light)
    doses = joined([*parts, *of_sun])
    doses.exposures()  # whatever cannot be used is refused before anything is said
    notes += dose_notes.of_options(arguments)
    if has_spectrum:
        notes += dose_notes.of_absorptance(of.model.spectra, TANNING_ACTIONS[tanning])
    notes += dose_notes.of_blisters(doses, of.skin.med)
    for note in dict.fromkeys(notes):
        print(f"note: {note}", file=sys.stderr)
    return doses


def _tanning(arguments: argparse.Namespace, spectra: Spectra) -> str:
    """Name of the action spectrum of tanning; a user's own one wants to be used."""
    if arguments.tanning_action is not None:
        return arguments.tanning_action
    is_own = spectra[MELANOGENESIS] is not published_spectra()[MELANOGENESIS]
    return "parrish" if is_own else USUAL_TANNING


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


def _scheduled(path: Path, over: Protection) -> Doses:
    """Doses of a schedule file; a meter's are those for the thickness."""
    exposures, passed = read_schedule(path), over.of_sunlight()
    thickening = passed * exposures.thickening_doses
    return Doses(exposures.hours.astype(float), thickening, passed * exposures.doses, thickening)


def _parts(text: str, count: int, what: str, expected: str) -> list[str]:
    parts = text.split(":")
    if len(parts) < count or not all(parts):
        raise InputError(f"{what} is {text!r}; expected {expected}.")
    return [parts[0], ":".join(parts[1 : len(parts) - count + 2]), *parts[len(parts) - count + 2 :]]


def _dose(text: str, skin: Skin) -> tuple[float, float]:
    """Hour and SED of HOUR:AMOUNT."""
    hour, amount = _parts(text, 2, "a dose", "HOUR:SED, such as 0:30, or HOUR:2.5MMD or HOUR:2MED")
    units = {"SED": 1.0, "MMD": skin.mmd, "MED": skin.med}
    unit = units.get(amount[-3:].upper())
    if unit is not None:
        amount = amount[:-3]
    return number(hour, "hour of a dose"), (unit or 1.0) * number(amount, "dose")


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
