"""The command `lut-builder`: builds, describes and checks tables of skin that tans."""

import argparse
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hylios.errors import require_range, require_whole
from hylios.files import require_target
from hylios.shell import (
    add_skin_arguments,
    add_tanning_arguments,
    add_work_arguments,
    chosen_skin,
    chosen_tanning_skin,
    number,
    require_work,
    run,
)
from hylios.skin import UNTANNED
from hylios.table import read_table

if TYPE_CHECKING:
    from lut_builder.build import Settings

# numba, colour-science and OpenImageIO take a second or more: only the commands import them.

MOST_KNOTS = 100
LEAST_RAYS, MOST_RAYS = 100, 10**9


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns its exit status."""
    parsed = _parser().parse_args(arguments)
    return run(parsed.command, parsed)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="lut-builder", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    building = commands.add_parser("build", help="simulate a skin's tanning states into a table")
    building.set_defaults(command=_build)
    add_skin_arguments(building)
    add_work_arguments(building)
    add_tanning_arguments(building)
    building.add_argument(
        "--untanned",
        choices=list(UNTANNED),
        default="steady_state",
        help="skin without sun: 5.16 as printed, melanin by the tanning set's steady state, or "
        "the specimen's own distribution",
    )
    building.add_argument("--preset", choices=["small", "standard"], default="standard")
    building.add_argument("--knots", help="numbers of knots per axis, such as 9,3,2")
    building.add_argument("--step", type=float, help="spacing of visible wavelengths, nm")
    building.add_argument("--rays", type=int, help="rays per wavelength and state")
    building.add_argument("--force", action="store_true", help="replace an existing file")
    building.add_argument("-o", "--output", type=Path, required=True, metavar="FILE.exr")

    info = commands.add_parser("info", help="say what a table is")
    info.set_defaults(command=_info)
    info.add_argument("table", type=Path)

    checking = commands.add_parser("check", help="compare a table with direct simulation")
    checking.set_defaults(command=_check)
    checking.add_argument("table", type=Path)
    checking.add_argument("--states", type=int, default=20, help="states between the knots")
    checking.add_argument("--rays", type=int, help="rays per wavelength (default: the table's)")
    add_work_arguments(checking)
    return parser


@contextmanager
def _progress(total: int, what: str) -> Iterator[Callable[[int], object]]:
    from tqdm import tqdm

    with tqdm(total=total, desc=what, unit="ray", unit_scale=True, mininterval=0.5) as bar:
        yield bar.update


def _settings(asked: argparse.Namespace) -> "Settings":
    from lut_builder.build import PRESETS, visible_wavelengths

    settings = PRESETS[asked.preset]
    if asked.knots is not None:
        counts = [number(part, "number of knots") for part in asked.knots.split(",")]
        require_whole("number of axes", len(counts), 1, 4)
        knots = (require_whole("number of knots", count, 1, MOST_KNOTS) for count in counts)
        settings = replace(settings, knots=tuple(knots))
    if asked.step is not None:
        step = require_range("step", asked.step, 1.0, 100.0, "nm")
        settings = replace(settings, visible=visible_wavelengths(step))
    if asked.rays is not None:
        rays = require_whole("number of rays", asked.rays, LEAST_RAYS, MOST_RAYS)
        settings = replace(settings, rays=rays)
    return settings


def _build(asked: argparse.Namespace) -> None:
    require_target(asked.output, (".exr",), asked.force)
    require_work(asked)
    _, known, chosen = chosen_skin(asked)
    made_for = chosen_tanning_skin(asked, asked.untanned)

    from lut_builder.build import build
    from lut_builder.exr import write_table
    from lut_builder.states import choose_axes

    settings = _settings(asked)
    settings = replace(settings, knots=choose_axes(made_for, settings.knots).shape)
    with _progress(settings.total_rays, f"table of {settings.states} states") as progress:
        table = build(
            made_for,
            settings,
            seed=asked.seed,
            threads=asked.threads,
            known=known,
            chosen=chosen,
            progress=progress,
        )
    write_table(asked.output, table)
    cut = table.provenance["states_with_melanin_cut"]
    if cut:
        print(f"note: {cut} of {settings.states} states would overfill a layer with melanin; cut")
    print(f"wrote {asked.output}: {os.path.getsize(asked.output) / 1000:.1f} KB")


def _info(asked: argparse.Namespace) -> None:
    table = read_table(asked.table)
    for name, value in table.provenance.items():
        if isinstance(value, dict) and value:
            print(f"{name}:")
            print("\n".join(f"  {each}: {setting}" for each, setting in value.items()))
        elif name == "estimated_figures":
            print(f"{name}:")
            print("\n".join(f"  {line}" for line in value))
        else:
            print(f"{name}: {value}")
    print(f"planes: {', '.join(table.planes)}")
    directions = zip(table.axes.basis.T, table.axes.knots, strict=True)
    for axis, (direction, knots) in enumerate(directions, start=1):
        print(
            f"axis {axis}: {np.round(direction, 3)} in ln of (basale, spinosum, granulosum, "
            f"thickness) to the untanned, knots {np.round(knots, 3)}"
        )


def _check(asked: argparse.Namespace) -> None:
    require_whole("number of states", asked.states, 1, 10_000)
    require_work(asked)

    from lut_builder.check import check, settings_of

    table = read_table(asked.table)
    settings = settings_of(table)
    rays = settings.rays if asked.rays is None else asked.rays
    require_whole("number of rays", rays, LEAST_RAYS, MOST_RAYS)
    total = asked.states * settings.wavelengths.size * rays
    with _progress(total, f"{asked.states} states directly") as progress:
        result = check(
            table,
            count=asked.states,
            rays=rays,
            seed=asked.seed,
            threads=asked.threads,
            progress=progress,
        )
    print(f"states: {len(result.differences)}, reachable, none of them a knot")
    print(f"mean CIEDE2000 between table and simulation: {result.differences.mean():.3f}")
    print(f"largest: {result.differences.max():.3f}")
    print(f"mean CIEDE2000 that Monte Carlo noise alone gives: {result.noise.mean():.3f}")
    print(
        "share of the mean squared difference that noise explains: "
        f"{result.noise_share:.0%} (over 100 % by chance)"
    )


if __name__ == "__main__":
    sys.exit(main())
