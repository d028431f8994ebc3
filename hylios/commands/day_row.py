"""The colours of a skin over the days of a tan, as a row of swatches."""

import argparse
import sys
from dataclasses import replace

import numpy as np

from hylios.adding import colours, spectra
from hylios.adding.redness import erythema
from hylios.commands.dose_arguments import (
    add_exposure_arguments,
    chosen_doses,
    skin_in_light,
)
from hylios.commands.notes import note_estimates, note_kinetics, note_redness
from hylios.commands.skin_arguments import (
    add_erythema_argument,
    add_kinetics_argument,
    add_tanning_arguments,
    chosen_region,
)
from hylios.commands.texts import number_range
from hylios.errors import InputError, require_range, require_whole, shown
from hylios.quadrature import skin_quadrature
from hylios.tanning import LONGEST_HOURS

MOST_DAYS = 1000
WAVELENGTHS = 8
"""Wavelengths that make a colour."""

USUAL_SIZE = 48
MOST_ACROSS = 2**15
"""Most pixels of a row, which its labels are drawn for at once."""

OF_A_TAN = (
    *("dose", "uv_index", "spectrum", "schedule", "sun", "weather", "erythema"),
    *("pigmentation", "mmd", "med", "tanning", "spf", "sunscreen", "upf", "glass", "water"),
)
"""Arguments that say nothing of a skin without sun."""


def add_row_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that `write_row` reads, all but the specimen's."""
    parser.add_argument(
        "--days",
        metavar="FIRST:LAST:STEP",
        help="a row over the days of a tan, such as 0:60:1 or 0,1,7,30; computed without noise, "
        "so rays, seed and step do not matter",
    )
    add_tanning_arguments(parser)
    add_kinetics_argument(parser)
    add_erythema_argument(
        parser, "show redness, just seen a day after 1 MED; then only the epidermis thickens"
    )
    add_exposure_arguments(parser)


def require_no_tan(arguments: argparse.Namespace) -> None:
    """Raise InputError where a tan is given without `--days`."""
    needless = [name for name in OF_A_TAN if getattr(arguments, name)]
    if arguments.kinetics != "thesis":
        needless.append("kinetics")
    if needless:
        option = needless[0].replace("_", "-")
        raise InputError(f"--{option} is given without --days, such as --days 0:60:1.")


def write_row(arguments: argparse.Namespace) -> None:
    """Tan, write the row as PNG and print its days and colours as CSV."""
    days = _days(arguments.days)
    usual = USUAL_SIZE if arguments.size is None else arguments.size
    size = require_whole("size", usual, 1, 4096)
    if days.size * size > MOST_ACROSS:
        raise InputError(
            f"{days.size} days of {size} pixels are {days.size * size} across; allowed are "
            f"{MOST_ACROSS}, which is a size of {MOST_ACROSS // days.size}."
        )
    angle = require_range("angle", arguments.angle, 0.0, 89.99, "degrees")
    of = skin_in_light(argparse.Namespace(**{**vars(arguments), "region": None}))
    skin, reddening = of.skin, None
    if arguments.erythema:
        skin = replace(skin, thickening="epidermis")
        reddening = erythema(skin, of.model)
    exposures = chosen_doses(arguments, of).exposures()
    states = skin.states(exposures, 24.0 * days, erythema=reddening)
    told = chosen_region(arguments, skin.specimen)
    if told is None:
        seen = colours(skin, states, count=WAVELENGTHS, angle=angle, model=of.model).total
    else:
        tanned = [told.of(skin.at(state)) for state in told.own_states(states)]
        few = skin_quadrature(WAVELENGTHS)
        light = spectra(tanned, few.wavelengths, angle=angle, model=of.model)
        seen = light.total @ few.weights.T
    note_estimates(of.model, skin_quadrature(WAVELENGTHS).wavelengths)
    note_kinetics(skin.kinetics)
    if reddening is not None:
        note_redness()
    _write(arguments, days, seen, size)


def _write(arguments: argparse.Namespace, days: np.ndarray, seen: np.ndarray, size: int) -> None:
    from hylios.lab.colour import srgb
    from hylios.lab.pictures import labelled, swatches, write_pixels

    pixels = swatches(srgb(seen), size)
    labels = [f"{day:g}" for day in days]
    write_pixels(labelled(pixels, labels), arguments.output)
    print("day,srgb")
    for label, pixel in zip(labels, pixels[0, ::size], strict=True):
        print("{},#{:02x}{:02x}{:02x}".format(label, *pixel))
    print(f"wrote {shown(arguments.output)}", file=sys.stderr)


def _days(text: str) -> np.ndarray:
    days = number_range(text, "days", "days", MOST_DAYS)
    last = LONGEST_HOURS // 24
    outside = days[~((days >= 0.0) & (days <= last))]
    if outside.size:
        require_range("day", float(outside[0]), 0.0, last)
    return days
