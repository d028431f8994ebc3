"""Choosing a table's settings by a limit of time or error, from a front that was measured."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from lut_builder.trade.pareto import best, cheapest
from lut_builder.trade.points import Point, read_points, shipped_points, usable_cores


def add_limit_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that the other functions here read."""
    limit = parser.add_mutually_exclusive_group()
    limit.add_argument(
        "--max-delta-e",
        type=float,
        help="take the fastest table whose measured CIEDE2000 is no larger",
    )
    limit.add_argument(
        "--max-seconds",
        type=float,
        help="take the most accurate table measured to need no more seconds",
    )
    parser.add_argument(
        "--front",
        type=Path,
        metavar="FILE.csv",
        help="the front, tables measured by `lut-builder trade` than which none is both faster "
        "and more accurate, to choose from (default: the shipped one)",
    )


def has_limit(arguments: argparse.Namespace) -> bool:
    """Whether a limit is given."""
    return arguments.max_delta_e is not None or arguments.max_seconds is not None


def measured_points(arguments: argparse.Namespace) -> list[Point]:
    """The points of the front that the arguments name."""
    return shipped_points() if arguments.front is None else read_points(arguments.front)


def point_within(arguments: argparse.Namespace, points: Sequence[Point], profile: bool) -> Point:
    """The best point within the limit.

    Raises
    ------
    InputError
        If there is none.
    """
    cores = usable_cores(arguments.threads)
    if arguments.max_delta_e is not None:
        return cheapest(points, arguments.max_delta_e, cores=cores, profile=profile)
    return best(points, arguments.max_seconds, cores=cores, profile=profile)
