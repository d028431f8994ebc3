"""The command `hylios`: light and tanning in skin from a shell; see `hylios.commands`."""

import argparse
import sys

from hylios.commands import brdf, dose, fit, plot, profile, reflectance, specimen, swatch, tan
from hylios.commands.shell import Parser, run

COMMANDS = (reflectance, brdf, profile, swatch, plot, specimen, fit, dose, tan)
"""Modules with a function `add_to`, which adds their command to a parser's subcommands."""


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns its exit status."""
    parsed = _parser().parse_args(arguments)
    return run(parsed.command, parsed)


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog="hylios",
        description="Light and tanning in human skin: CSV on standard output, pictures in files.",
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for module in COMMANDS:
        module.add_to(commands)
    return parser


if __name__ == "__main__":
    sys.exit(main())
