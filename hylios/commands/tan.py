"""`hylios tan`: melanin and thickness over time after doses of ultraviolet, as CSV."""

import argparse

from hylios.commands.exposures import (
    add_exposure_arguments,
    add_tanning_skin_arguments,
    chosen_doses,
    chosen_tanning_skin,
)
from hylios.shell import print_table
from hylios.tanning import simulate


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser("tan", help="melanin and thickness over time")
    parser.set_defaults(command=run)
    add_tanning_skin_arguments(parser)
    add_exposure_arguments(parser)
    parser.add_argument("--hours", type=int, default=720, help="last hour (720)")


def run(asked: argparse.Namespace) -> None:
    """Simulate and print."""
    skin = chosen_tanning_skin(asked)
    history = simulate(
        chosen_doses(asked, skin).exposures(),
        skin.melanin,
        mmd=skin.mmd,
        med=skin.med,
        hours=asked.hours,
    )
    names = ("hour", "basale", "spinosum", "granulosum", "total", "thickness")
    columns = (history.hours, *history.melanin.T, history.total, history.thickness)
    print_table(dict(zip(names, columns, strict=True)), digits=10)
