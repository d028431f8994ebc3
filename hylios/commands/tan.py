"""`hylios tan`: melanin and thickness over time after doses of ultraviolet, as CSV."""

import argparse

import numpy as np

from hylios.errors import InputError
from hylios.shell import number, print_table
from hylios.tanning import (
    PIGMENTATIONS,
    TYPICAL_PIGMENTATION,
    Exposures,
    minimal_erythema_dose,
    minimal_melanogenesis_dose,
    simulate,
)


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser("tan", help="melanin and thickness over time")
    parser.set_defaults(command=run)
    parser.add_argument("--pigmentation", choices=list(PIGMENTATIONS), default="low")
    parser.add_argument(
        "--dose", action="append", default=[], metavar="HOUR:SED", help="an exposure; repeatable"
    )
    parser.add_argument("--mmd", type=float, help="minimal melanogenesis dose, SED (default: 3.2)")
    parser.add_argument("--med", type=float, help="minimal erythema dose, SED (default: 3.1)")
    parser.add_argument("--hours", type=int, default=720)


def run(asked: argparse.Namespace) -> None:
    """Simulate and print."""
    typical = TYPICAL_PIGMENTATION[asked.pigmentation]
    history = simulate(
        _exposures(asked.dose),
        PIGMENTATIONS[asked.pigmentation],
        mmd=minimal_melanogenesis_dose(typical) if asked.mmd is None else asked.mmd,
        med=minimal_erythema_dose(typical) if asked.med is None else asked.med,
        hours=asked.hours,
    )
    names = ("hour", "basale", "spinosum", "granulosum", "total", "thickness")
    columns = (history.hours, *history.melanin.T, history.total, history.thickness)
    print_table(dict(zip(names, columns, strict=True)), digits=10)


def _exposures(texts: list[str]) -> Exposures:
    """Doses from texts HOUR:SED."""
    pairs = []
    for text in texts:
        hour, separator, dose = text.partition(":")
        if not separator:
            raise InputError(f"a dose is {text!r}; expected HOUR:SED, such as 0:30.")
        pairs.append((number(hour, "hour of a dose"), number(dose, "dose")))
    hours, doses = np.array(pairs, dtype=float).reshape(-1, 2).T
    return Exposures(hours, doses)
