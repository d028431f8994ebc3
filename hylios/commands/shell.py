"""What the project's shell commands share: how they end, and how arguments are read."""

import argparse
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import numpy as np

from hylios.commands.streams import discard_output, prepare_streams
from hylios.commands.texts import named_values, number, plain_number, plain_whole
from hylios.errors import InputError, require_whole, shown
from hylios.readers.spectrum import NamedSpectrum
from hylios.skin import Skin
from hylios.skin.phototypes import PHOTOTYPES, named_specimen, phototype
from hylios.skin.regions import REGIONS, Region, region
from hylios.skin.specimen import Specimen, parameters, with_values
from hylios.skin.specimen_file import read_specimen
from hylios.spectra import estimates_within, published_spectra, with_own_spectrum
from hylios.tanning import KINETICS, PIGMENTATIONS
from hylios.tissue import SPECTRA, Model

USUAL_SPECIMEN = "S3"


class Parser(argparse.ArgumentParser):
    """A parser of a command's arguments whose errors are one sentence.

    An empty text is none of a path, a name or a number: in a shell it is mostly a variable that
    was never set.
    """

    def __init__(self, *arguments, **named):
        super().__init__(*arguments, **named)
        # As Python 3.14 has it: -1:2 and -1e9 are values, not options.
        self._negative_number_matcher = re.compile(r"-\.?\d")
        self.register("type", float, plain_number)
        self.register("type", int, plain_whole)

    def parse_args(self, args=None, namespace=None):  # pyright: ignore[reportIncompatibleMethodOverride]
        """The arguments; ends the process with status 2 and a sentence where one is missing."""
        given = sys.argv[1:] if args is None else args
        for before, text in zip(["", *given], given, strict=False):
            if not text or (text.startswith("--") and text.endswith("=") and text.count("=") == 1):
                name = text.removesuffix("=") or (before if before.startswith("-") else "")
                self.error(f"{name or 'an argument'} is empty; leave it out or give a value.")
        return super().parse_args(args, namespace)

    def error(self, message: str) -> NoReturn:
        """End the process with status 2."""
        sentence = message.strip().removesuffix(".")
        for type_of, meaning in (("float", "a number"), ("int", "a whole number")):
            sentence = sentence.replace(f"invalid {type_of} value:", f"expected {meaning}, not")
        print(f"error: {shown(sentence)}. `{self.prog} --help` says more.", file=sys.stderr)
        sys.exit(2)


def run(command: Callable[[argparse.Namespace], None], arguments: argparse.Namespace) -> int:
    """Run a command; bad input is one sentence and status 2, Ctrl-C status 130.

    Of Ctrl-C one word is said, or what the command gave the KeyboardInterrupt to say.
    """
    try:
        prepare_streams()
        command(arguments)
        sys.stdout.flush()
    except InputError as error:
        print(f"error: {shown(_in_options(str(error)))}", file=sys.stderr)
        return 2
    except MemoryError:
        print("error: there is not enough memory for this.", file=sys.stderr)
        return 2
    except KeyboardInterrupt as interrupt:
        print(str(interrupt) or "cancelled", file=sys.stderr)
        return 130
    except BrokenPipeError:
        discard_output()
        return 1
    except OSError as error:
        print(f"error: {shown(str(error))}.", file=sys.stderr)
        discard_output()
        return 2
    return 0


OPTIONS = {"with allow_unphysical": "with --allow-unphysical", "replacing=True": "--force"}
"""What the library's sentences call its arguments, and what the shell calls them."""


def _in_options(sentence: str) -> str:
    for argument, option in OPTIONS.items():
        sentence = sentence.replace(argument, option)
    return sentence


def print_table(columns: Mapping[str, np.ndarray], digits: int = 9) -> None:
    """Print columns of equal length as CSV with a header."""
    print(",".join(columns))
    print_rows(columns.values(), digits)


def print_rows(columns: Iterable[np.ndarray], digits: int = 9) -> None:
    """Print the rows of columns of equal length as CSV."""
    values = [column.tolist() for column in columns]
    row = ",".join([f"%.{digits}g"] * len(values)) + "\n"
    sys.stdout.writelines(row % cells for cells in zip(*values, strict=True))


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


def note_estimates(model: Model, wavelengths: np.ndarray, names: Sequence[str] = SPECTRA) -> None:
    """Say on standard error which spectra are estimates at some wavelength in nm."""
    for line in estimates_within(model.spectra, names, wavelengths):
        print(f"note: {line}", file=sys.stderr)


def note_omissions(spectra: Sequence[NamedSpectrum]) -> None:
    """Say on standard error what was left out of files of spectra."""
    for spectrum in spectra:
        for line in spectrum.notes:
            print(f"note: {spectrum.name}: {line}", file=sys.stderr)


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


def note_kinetics(name: str) -> None:
    """Say on standard error what of a kinetics other than the thesis's is an estimate."""
    if name != "thesis":
        print(f"note: the {name} kinetics is {KINETICS[name]}", file=sys.stderr)


def note_redness() -> None:
    """Say on standard error that redness is an estimate."""
    print(
        "note: redness is an estimate but for the hours and doses to which it was fitted",
        file=sys.stderr,
    )


def add_work_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of every simulation, which `require_work` checks."""
    parser.add_argument("--seed", type=int, default=1, help="seed of random numbers (default: 1)")
    parser.add_argument("--threads", type=int, help="number of threads (default: one per core)")


def require_work(arguments: argparse.Namespace) -> None:
    """Raise InputError where the seed or the number of threads is out of range."""
    require_whole("seed", arguments.seed, 0, 2**32 - 1)
    if arguments.threads is not None:
        require_whole("number of threads", arguments.threads, 1, 1024)


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
