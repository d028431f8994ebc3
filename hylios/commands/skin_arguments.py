"""Whose skin it is, and how it tans, as commands take it."""

import argparse
import sys
from dataclasses import replace
from pathlib import Path

from hylios.commands.texts import named_values, number
from hylios.errors import InputError
from hylios.skin import Skin
from hylios.skin.phototypes import PHOTOTYPES, named_specimen, phototype
from hylios.skin.regions import REGIONS, Region, region
from hylios.skin.specimen import Specimen, parameters, with_values
from hylios.skin.specimen_file import read_specimen
from hylios.spectra import published_spectra, with_own_spectrum
from hylios.tanning import KINETICS, PIGMENTATIONS
from hylios.tissue import Model

USUAL_SPECIMEN = "S3"


def add_specimen_arguments(parser: argparse.ArgumentParser, *where: str, **how) -> None:
    """Add the arguments that `chosen_specimen` reads.

    `where` and `how` name the specimen's own argument and say more of it.
    """
    parser.add_argument(
        *where,
        help="S1 to S4 of table 6.1, skin type I to VI, or a file NAME.toml "
        f"(default {USUAL_SPECIMEN})",
        **how,
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="set a parameter of the specimen (`hylios specimen` lists them); repeatable",
    )
    parser.add_argument(
        "--allow-unphysical",
        action="store_true",
        help="accept parameters outside their physiological range",
    )


def add_skin_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that `chosen_skin` reads."""
    add_specimen_arguments(parser, "--specimen")
    for option, metavar, help_text in (
        ("--reading", "NAME=CHOICE", "another reading of the thesis (hylios.tissue.READINGS)"),
        ("--own-spectrum", "NAME=FILE", "your own spectrum in place of NAME: CSV of nm and value"),
        ("--figure", "NAME=FILE", argparse.SUPPRESS),  # what --own-spectrum was called
    ):
        parser.add_argument(
            option,
            action="append",
            default=[],
            dest="own_spectrum" if option == "--figure" else None,
            metavar=metavar,
            help=help_text,
        )


def add_region_argument(parser: argparse.ArgumentParser) -> None:
    """Add `--region`, which `chosen_specimen` reads where it is there."""
    parser.add_argument(
        "--region",
        choices=REGIONS,
        help="a region of that skin: what is set is of the skin around it",
    )


def add_tanning_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that `chosen_tanning_skin` reads besides the specimen's."""
    parser.add_argument(
        "--skin",
        choices=PHOTOTYPES,
        help="a skin type in place of --specimen: its specimen, and how it tans",
    )
    parser.add_argument(
        "--pigmentation",
        choices=list(PIGMENTATIONS),
        help="set of tanning rates from table 6.4 (default: the specimen's or the type's)",
    )
    for option, help_text in (
        ("--mmd", "minimal melanogenesis dose, which tans"),
        ("--med", "minimal erythema dose, which reddens"),
    ):
        usual = " (default: by the skin's melanin)"
        parser.add_argument(option, type=float, metavar="SED", help=f"{help_text}{usual}")
    parser.add_argument(
        "--tanning",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="set a rate of the tanning set, such as basale_extra_production=0.0858; repeatable",
    )


def add_kinetics_argument(parser: argparse.ArgumentParser) -> None:
    """Add `--kinetics`, which `chosen_tanning_skin` reads where it is there."""
    parser.add_argument(
        "--kinetics",
        choices=list(KINETICS),
        default="thesis",
        help="how melanin follows the sun: by the thesis, or as measured in people, where tans add "
        "up, are graded and last for months (default: thesis)",
    )


def add_erythema_argument(parser: argparse.ArgumentParser, help_text: str) -> None:
    """Add `--erythema`."""
    parser.add_argument("--erythema", action="store_true", help=help_text)


def chosen_specimen(arguments: argparse.Namespace) -> Specimen:
    """The specimen that the arguments ask for: one by name or a file's, with what is set.

    A region of it where one is named; standard error says what of that is an estimate.

    Raises
    ------
    InputError
        If there is none, or it would not be physiological and that is not allowed.
    """
    numeric = {parameter.name for parameter in parameters()}
    values = {
        name: number(text, name) if name in numeric else text
        for name, text in named_values(arguments.set, "a setting").items()
    }
    name, unphysical = _specimen_name(arguments), arguments.allow_unphysical
    if name.endswith(".toml"):
        start = read_specimen(Path(name), allow_unphysical=unphysical)
    else:
        start = named_specimen(name)
    specimen = with_values(start, values, allow_unphysical=unphysical)
    told = chosen_region(arguments, specimen)
    if told is None:
        return specimen
    return replace(told.of(specimen), name=f"{specimen.name} {arguments.region}")


def chosen_region(arguments: argparse.Namespace, specimen: Specimen) -> Region | None:
    """The region of a specimen that the arguments name, if any; says what of it is an estimate."""
    name = getattr(arguments, "region", None)
    if name is None:
        return None
    told = region(name, specimen.pigmentation)
    if told.is_estimate:
        marked = ", ".join(number for number, mark in told.marks.items() if mark == "E")
        print(f"note: of {name} it is an ESTIMATE: {marked}.", file=sys.stderr)
    return told


def _specimen_name(arguments: argparse.Namespace) -> str:
    """Name or file of the specimen asked for, which `--skin` can name as well."""
    type_of_skin = getattr(arguments, "skin", None)
    if type_of_skin is not None and arguments.specimen is not None:
        raise InputError(
            f"both the skin type {type_of_skin} and the specimen {arguments.specimen} are given; "
            "allowed is one of them."
        )
    return type_of_skin or arguments.specimen or USUAL_SPECIMEN


def chosen_tanning_skin(arguments: argparse.Namespace, untanned: str = "steady_state") -> Skin:
    """The skin that the arguments ask for: `chosen_specimen`, and how it tans.

    A skin type, be it named by `--skin`, as a specimen or in a specimen's file, tans as the type
    does; `--pigmentation` puts a whole set in the place of that, `--tanning` single rates.

    Raises
    ------
    InputError
        If there is none, or a part of it cannot be used.
    """
    kinetics = getattr(arguments, "kinetics", "thesis")
    if arguments.tanning and kinetics != "thesis":
        raise InputError(
            f"--tanning {arguments.tanning[0]} sets a rate of the thesis's kinetics; with "
            f"--kinetics {kinetics} no rate can be set."
        )
    specimen = chosen_specimen(arguments)
    rates = {
        rate: number(text, rate)
        for rate, text in named_values(arguments.tanning, "a rate of tanning").items()
    }
    pigmentation = arguments.pigmentation
    if specimen.name in PHOTOTYPES and pigmentation is None:
        usual = phototype(specimen.name)
        pigmentation, rates = usual.skin.pigmentation, {**usual.tanning, **rates}
    return Skin.of(
        specimen,
        pigmentation,
        arguments.mmd,
        arguments.med,
        tanning=rates,
        untanned=untanned,
        kinetics=kinetics,
    )


def chosen_skin(arguments: argparse.Namespace) -> tuple[Specimen, Model]:
    """The specimen that the arguments ask for, and the model with their spectra and readings.

    Raises
    ------
    InputError
        If one of them cannot be used.
    """
    spectra = published_spectra()
    for name, path in named_values(arguments.own_spectrum, "a spectrum of your own").items():
        spectra = with_own_spectrum(spectra, name, Path(path))
    readings = named_values(arguments.reading, "a reading")
    return chosen_specimen(arguments), Model(spectra, readings)
