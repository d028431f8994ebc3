"""`lut-builder trade`: time against error of tables, measured now or before."""

import argparse
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path

from hylios.commands.shell import add_work_arguments, require_work
from hylios.commands.skin_arguments import (
    add_skin_arguments,
    add_tanning_arguments,
    chosen_tanning_skin,
)
from hylios.errors import InputError
from hylios.files import require_target
from hylios.skin.phototypes import PHOTOTYPES, phototype
from lut_builder.commands.limits import (
    add_limit_arguments,
    has_limit,
    measured_points,
    point_within,
)
from lut_builder.commands.progress import progress
from lut_builder.trade.pareto import worst
from lut_builder.trade.points import Point, described, usable_cores, write_points, write_rows


def add_trade(commands) -> None:
    """Add the command to an argument parser's commands."""
    parser = commands.add_parser(
        "trade", help="measure time against error of tables, on this machine and for a skin"
    )
    parser.set_defaults(command=trade)
    add_skin_arguments(parser)
    add_work_arguments(parser)
    add_tanning_arguments(parser)
    add_limit_arguments(parser)
    parser.add_argument(
        "--also",
        choices=PHOTOTYPES,
        action="append",
        default=[],
        help="another skin type that tables must suit; repeatable",
    )
    parser.add_argument(
        "--quick", action="store_true", help="measure for some seconds only, to see that it works"
    )
    parser.add_argument("--force", action="store_true", help="replace existing files")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE.png",
        help="measure anew (minutes) and draw the front into this picture, with CSV files of the "
        "front and its parts beside it (default: print the front measured before)",
    )


def trade(arguments: argparse.Namespace) -> None:
    """Measure and write a front, or show the one measured before."""
    require_work(arguments)
    if arguments.output is None:
        if arguments.also:
            raise InputError(
                f"--also {arguments.also[0]} is given without -o; it is for measuring."
            )
        if arguments.quick:
            raise InputError("--quick is given without -o; it is for measuring.")
        _show(arguments, measured_points(arguments))
        return
    if arguments.front is not None:
        raise InputError(
            f"both {arguments.front} and {arguments.output} are given; allowed is one."
        )
    picture, front_file, parts_file = targets = [
        arguments.output,
        arguments.output.with_suffix(".csv"),
        arguments.output.with_name(f"{arguments.output.stem}_parts.csv"),
    ]
    for path, suffix in zip(targets, (".png", ".csv", ".csv"), strict=True):
        require_target(path, (suffix,), arguments.force)
    skins = [chosen_tanning_skin(arguments), *(phototype(name).skin for name in arguments.also)]

    from lut_builder.trade.extent import FULL, QUICK
    from lut_builder.trade.figure import draw
    from lut_builder.trade.measurement import Trade, measure, notes

    extent = QUICK if arguments.quick else FULL
    measured = []
    for skin in skins:
        with ExitStack() as stack:
            begin = _beginning(stack, f"time against error, {skin.specimen.name}")
            measured.append(measure(skin, extent, seed=arguments.seed, begin=begin))
    together = Trade(worst([one.points for one in measured]), measured[0].parts)
    comments = notes(skins, extent)
    write_points(front_file, together.front, comments)
    write_rows(parts_file, together.parts, comments)
    draw(together, picture, "; ".join(comments[:3]))
    print(f"wrote {', '.join(map(str, targets))}")
    _show(arguments, together.front)


def _beginning(stack: ExitStack, label: str) -> Callable[[float], Callable[[float], object]]:
    """Starts the bar once it is known how long all takes."""

    def begin(total: float) -> Callable[[float], object]:
        return stack.enter_context(progress(total, label))

    return begin


def _show(arguments: argparse.Namespace, points: Sequence[Point]) -> None:
    """Print the front, or its point within the limit."""
    if has_limit(arguments):
        point = point_within(arguments, points, profile=True)
        print(f"chosen: {described(point, usable_cores(arguments.threads))}")
    else:
        print("\n".join(described(point) for point in points))
