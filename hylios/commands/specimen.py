"""`hylios specimen`: the parameters of a specimen with units, physiological ranges and sources."""

import argparse
import textwrap
from dataclasses import MISSING

from hylios.commands.shell import add_specimen_arguments, chosen_specimen
from hylios.skin.phototypes import PHOTOTYPES, specimens
from hylios.skin.physiology import PHYSIOLOGY
from hylios.skin.specimen import ARRANGEMENTS, Specimen, parameters
from hylios.skin.specimen_file import specimen_toml

COLUMNS = ("parameter", "value", "unit", "physiological", "range", "value from", "meaning")
WIDTH = 100


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser("specimen", help="parameters of a specimen, ranges and sources")
    parser.set_defaults(command=run)
    add_specimen_arguments(parser, "specimen", nargs="?", metavar="NAME|FILE.toml")
    parser.add_argument(
        "--toml", action="store_true", help="as a file that --specimen FILE.toml reads"
    )


def run(asked: argparse.Namespace) -> None:
    """Print a table, or TOML."""
    chosen = chosen_specimen(asked)
    print(specimen_toml(chosen) if asked.toml else described(chosen), end="")


def described(specimen: Specimen) -> str:
    """The specimen as a table in aligned columns, and below it the sources of the ranges."""
    sources = list(dict.fromkeys(known.source for known in PHYSIOLOGY.values()))
    rows = [
        COLUMNS,
        ("name", specimen.name, *[""] * 5),
        ("melanosome_arrangement", specimen.melanosome_arrangement, *[""] * 4, _one_of()),
    ]
    for each in parameters():
        known, value = PHYSIOLOGY[each.name], getattr(specimen, each.name)
        inside = "" if known.holds(value) else ", outside"
        rows.append(
            (
                each.name,
                f"{value:.9g}",
                each.metadata["unit"],
                f"{known.low:g} to {known.high:g}{inside}",
                f"({sources.index(known.source) + 1})",
                _origin(specimen, each),
                each.metadata["what"],
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
    if value != getattr(specimens().get(specimen.name), parameter.name, None):
        return "given"
    return "hylios/skin/phototypes" if specimen.name in PHOTOTYPES else f"table 6.1 {cited}"
