"""`hylios dose`: the doses that a skin gets from exposures, as CSV."""

import argparse

import numpy as np

from hylios.commands.dose_arguments import (
    add_exposure_arguments,
    add_skin_in_light_arguments,
    chosen_doses,
    skin_in_light,
)
from hylios.commands.shell import print_table

DESCRIPTION = """\
One line for each hour of the tanning model and each exposure: the dose as a meter shows it, as it
counts for melanin (5.1 to 5.4 of the thesis) and for thickness (5.17 to 5.20), all in SED, and the
multiples of the minimal doses that these are. With the sun or spectra also the UVA of 320 to 400 nm
in J/cm^2, 0 for doses that are given as numbers or by UV index.
"""


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "dose", help="doses of sun, lamps and UV index", description=DESCRIPTION
    )
    parser.set_defaults(command=run)
    add_skin_in_light_arguments(parser)
    add_exposure_arguments(parser)


def run(arguments: argparse.Namespace) -> None:
    """Compute and print."""
    of = skin_in_light(arguments)
    doses = chosen_doses(arguments, of)
    checked = doses.exposures()
    order = np.argsort(checked.hours, kind="stable")
    columns = {
        "hour": checked.hours,
        "erythemal_sed": doses.erythemal,
        "melanogenesis_sed": doses.melanogenesis,
        "thickening_sed": doses.thickening,
        "mmd_multiple": doses.melanogenesis / of.skin.mmd,
        "med_multiple": doses.thickening / of.skin.med,
    }
    if doses.uva is not None:
        columns["uva_j_cm2"] = doses.uva
    print_table({name: values[order] for name, values in columns.items()}, digits=10)
