"""`hylios specimen`: the parameters of a specimen with units, physiological ranges and sources."""

import argparse
import sys
import textwrap
from dataclasses import MISSING, asdict

from hylios.commands.skin_arguments import (
    add_region_argument,
    add_specimen_arguments,
    chosen_specimen,
)
from hylios.errors import InputError
from hylios.skin.phototypes import PHOTOTYPES, specimens
from hylios.skin.physiology import PHYSIOLOGY
from hylios.skin.specimen import ARRANGEMENTS, Specimen, parameters, specimen_of
from hylios.skin.specimen_file import specimen_toml

COLUMNS = ("parameter", "value", "unit", "physiological", "range", "value from", "meaning")
WIDTH = 100


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser(
        "specimen", help="parameters of a specimen, with ranges and sources"
    )
    parser.set_defaults(command=run)
    add_specimen_arguments(parser, "specimen", nargs="?", metavar="NAME|FILE.toml")
    add_region_argument(parser)
    parser.add_argument("--toml", action="store_true", help="print a file for --specimen FILE.toml")


def run(arguments: argparse.Namespace) -> None:
    """Print a table, or TOML."""
    specimen = chosen_specimen(arguments)
    print(specimen_toml(specimen) if arguments.toml else described(specimen), end="")
    if arguments.toml and not is_physiological(specimen):
        print("note: only --allow-unphysical reads this specimen again.", file=sys.stderr)


def is_physiological(specimen: Specimen) -> bool:
    """Whether commands take the specimen without being told to."""
    try:
        specimen_of(asdict(specimen))
    except InputError:
        return False
    return True


def described(specimen: Specimen) -> str:
    """The specimen as a table in aligned columns, and below it the sources of the ranges."""
    sources = list(dict.fromkeys(limits.source for limits in PHYSIOLOGY.values()))
    rows = [
        COLUMNS,
        ("name", specimen.name, *[""] * 5),
        ("melanosome_arrangement", specimen.melanosome_arrangement, *[""] * 4, _one_of()),
    ]
    for parameter in parameters():
        limits, value = PHYSIOLOGY[parameter.name], getattr(specimen, parameter.name)
        inside = "" if limits.holds(value) else ", outside"
        rows.append(
            (
                parameter.name,
                f"{value:.9g}",
                parameter.metadata["unit"],
                f"{limits.low:g} to {limits.high:g}{inside}",
                f"({sources.index(limits.source) + 1})",
                _origin(specimen, parameter),
                parameter.metadata["what"],
            )
        )
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    notes = [
        textwrap.fill(source, WIDTH, initial_indent=f"({number:2}) ", subsequent_indent=" " * 5)
        for number, source in enumerate(sources, start=1)
    ]
    return "\n".join([*lines, "", "Where the physiological ranges are from", *notes]) + "\n"


def _one_of() -> str:
    return "one of " + ", ".join(ARRANGEMENTS)


def _origin(specimen: Specimen, parameter) -> str:
    """Where a value is from: a table and what it cites, a type's fit, or whoever gave it."""
    value, cited = getattr(specimen, parameter.name), PHYSIOLOGY[parameter.name].cited
    if parameter.default is not MISSING and value == parameter.default:
        return f"table 6.2 {cited}"
    base = specimen.name.partition(" ")[0]  # a region is called after the skin around it
    if value != getattr(specimens().get(base), parameter.name, None):
        return "given"
    return "hylios/skin/phototypes" if base in PHOTOTYPES else f"table 6.1 {cited}"
