"""`hylios tan`: melanin and thickness over time after doses of ultraviolet, as CSV."""

import argparse

from hylios.commands.dose_arguments import (
    add_chosen_arguments,
    add_exposure_arguments,
    chosen,
    chosen_doses,
)
from hylios.commands.shell import print_table


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser("tan", help="melanin and thickness over time")
    parser.set_defaults(command=run)
    add_chosen_arguments(parser)
    add_exposure_arguments(parser)
    parser.add_argument("--hours", type=int, default=720, help="last hour (720)")
    parser.add_argument(
        "--step",
        type=float,
        default=1.0,
        help="hours from line to line: 1 to 24, or 1 divided by a whole number (1)",
    )


def run(asked: argparse.Namespace) -> None:
    """Simulate and print."""
    of = chosen(asked)
    history = of.skin.history(
        chosen_doses(asked, of).exposures(),
        asked.hours,
        step=int(asked.step) if asked.step >= 1.0 and asked.step.is_integer() else asked.step,
    )
    names = ("hour", "basale", "spinosum", "granulosum", "total", "thickness")
    columns = (history.hours, *history.melanin.T, history.total, history.thickness)
    print_table(dict(zip(names, columns, strict=True)), digits=10)
