"""`hylios tan`: melanin, thickness and blood over time after doses of ultraviolet, as CSV."""

import argparse
from itertools import chain

from hylios.adding.redness import erythema
from hylios.commands.dose_arguments import (
    add_exposure_arguments,
    add_skin_in_light_arguments,
    chosen_doses,
    skin_in_light,
)
from hylios.commands.notes import note_kinetics, note_redness
from hylios.commands.shell import print_rows
from hylios.commands.skin_arguments import add_erythema_argument, add_kinetics_argument
from hylios.commands.streams import progress
from hylios.commands.texts import number
from hylios.tanning import simulate_in_parts

DESCRIPTION = """\
Melanin and thickness of the epidermis after doses of ultraviolet, hour by hour, as CSV: melanin of
the basale, spinosum and granulosum relative to their total at hour 0, that total, and the
thickness relative to hour 0. Hours count from the beginning.
"""
COLUMNS = ("hour", "basale", "spinosum", "granulosum", "total", "thickness")


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser(
        "tan", help="melanin and thickness of the epidermis over time", description=DESCRIPTION
    )
    parser.set_defaults(command=run)
    add_skin_in_light_arguments(parser)
    add_kinetics_argument(parser)
    add_erythema_argument(
        parser,
        "print the blood of the dermis too, relative to hour 0, as sunburn widens its vessels; "
        "skin of all types just seems redder a day after 1 MED",
    )
    add_exposure_arguments(parser)
    parser.add_argument("--hours", type=int, default=720, help="last hour (default: 720)")
    parser.add_argument(
        "--step",
        default="1",
        help="hours from row to row: 1 to 24, or a part of an hour such as 1/60 (default: 1)",
    )


def run(arguments: argparse.Namespace) -> None:
    """Simulate and print, a part after the other: a century by minutes has 53 million rows."""
    of = skin_in_light(arguments)
    step = _step(arguments.step)
    reddening = erythema(of.skin, of.model) if arguments.erythema else None
    parts = simulate_in_parts(
        chosen_doses(arguments, of).exposures(),
        of.skin.melanin_kinetics,
        mmd=of.skin.mmd,
        med=of.skin.med,
        hours=arguments.hours,
        erythema=reddening,
        step=step,
    )
    first = next(parts)
    note_kinetics(of.skin.kinetics)
    if reddening is not None:
        note_redness()
    print(",".join(COLUMNS if reddening is None else (*COLUMNS, "blood")))
    with progress("tan", int(arguments.hours / step) + 1, " rows") as advance:
        for part in chain([first], parts):
            columns = [part.hours, *part.melanin.T, part.total, part.thickness]
            print_rows(columns if part.blood is None else [*columns, part.blood], digits=10)
            advance(part.hours.size)


def _step(text: str) -> float:
    """Hours of a text such as 6, 0.5 or 1/60."""
    over, separator, under = text.partition("/")
    step = number(over, "step")
    if separator:
        divisor = number(under, "step")
        step = step / divisor if divisor else float("nan")
    return int(step) if step >= 1.0 and step.is_integer() else step
