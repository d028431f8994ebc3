"""`lut-builder info`: what a table holds, and how good its numbers are."""

import argparse
from pathlib import Path

import numpy as np

from hylios.readers.text import shown
from hylios.table import LOOK_AXES, LookAxes, SkinTable, StateAxes, read_table

ERRORS = (
    "colour_error",
    "near_share_error",
    "far_width_error",
    "profile_error",
    "profile_effective_samples",
)
"""Planes that say how good the others are."""


def add_info(commands) -> None:
    """Add the command to an argument parser's commands."""
    parser = commands.add_parser("info", help="describe a table")
    parser.set_defaults(command=info)
    parser.add_argument("table", type=Path)


def info(arguments: argparse.Namespace) -> None:
    """Print what a table's header says, and how good its numbers are."""
    table = read_table(arguments.table)
    # Whoever made the file wrote these texts: none reaches the terminal as it is.
    for line in described(table):
        print(shown(line))


def described(table: SkinTable) -> list[str]:
    """What there is to say of a table, line by line."""
    lines = []
    for name, value in table.provenance.items():
        if isinstance(value, dict) and value:
            lines += [f"{name}:", *(f"  {key}: {one}" for key, one in value.items())]
        elif name == "estimated_figures":
            lines += [f"{name}:", *(f"  {one}" for one in value)]
        else:
            lines.append(f"{name}: {value}")
    lines.append(f"planes: {', '.join(table.planes)}")
    for name in ERRORS:
        if name in table.planes:
            values = table.planes[name]
            lines.append(
                f"{name}: {values.min():.3g} to {values.max():.3g}, mean {values.mean():.3g}"
            )
    return [*lines, *_described_axes(table.axes)]


UNITS = {"spread": "from kinetics to kinetics"}


def _described_axes(axes: LookAxes | StateAxes) -> list[str]:
    """What a table's axes are, line by line."""
    listed = [np.array2string(np.round(knots, 3), max_line_width=10**6) for knots in axes.knots]
    if isinstance(axes, LookAxes):
        aside = np.round(axes.aside, 3)
        return [
            "spread: 0 as by the thesis's kinetics, 1 as by the measured one, below 0 off it "
            f"along {aside} in ln of (basale, spinosum, granulosum) to the untanned",
            *(
                f"axis {number}: {name}, {UNITS.get(name, 'in ln to the untanned')}, knots {knots}"
                for number, (name, knots) in enumerate(zip(LOOK_AXES, listed, strict=True), start=1)
            ),
            *(["the table says nothing beyond these knots"] if axes.bounded else []),
        ]
    return [
        f"axis {number}: {np.round(direction, 3)} in ln of (basale, spinosum, granulosum, "
        f"thickness) to the untanned, knots {knots}"
        for number, (direction, knots) in enumerate(zip(axes.basis.T, listed, strict=True), start=1)
    ]
