"""The command `lut-builder`: builds, describes and checks tables of skin that tans."""

import sys

from hylios.commands.shell import Parser, run
from lut_builder.commands.build import add_build
from lut_builder.commands.check import add_check
from lut_builder.commands.info import add_info
from lut_builder.commands.trade import add_trade


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns its exit status."""
    parsed = parser().parse_args(arguments)
    return run(parsed.command, parsed)


def parser() -> Parser:
    """The parser of the command's arguments."""
    whole = Parser(prog="lut-builder", description=__doc__)
    commands = whole.add_subparsers(required=True, metavar="COMMAND")
    for add in (add_build, add_info, add_check, add_trade):
        add(commands)
    return whole


if __name__ == "__main__":
    sys.exit(main())
