"""The command `lut-builder`: builds, describes and checks tables of skin that tans."""

import argparse
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hylios.commands.shell import (
    add_skin_arguments,
    add_tanning_arguments,
    add_work_arguments,
    chosen_skin,
    chosen_tanning_skin,
    named_values,
    number,
    require_work,
    run,
)
from hylios.errors import InputError, require_whole
from hylios.files import require_target
from hylios.quadrature import FEWEST, MOST
from hylios.skin import UNTANNED
from hylios.skin.phototypes import PHOTOTYPES, phototype
from hylios.spectra import published_spectra, with_own_spectrum
from hylios.table import INTERPOLATIONS, read_table
from hylios.table.kinds import printable
from hylios.tissue import Model
from lut_builder.settings import MOST_KNOTS, PRESETS, VISIBLE, Settings
from lut_builder.trade.pareto import best, cheapest, worst
from lut_builder.trade.points import (
    Point,
    described,
    read_points,
    shipped_points,
    usable_cores,
    write_points,
    write_rows,
)

if TYPE_CHECKING:
    from lut_builder.jobs.run import Runner

# numba, colour-science and OpenImageIO take a second or more: only the commands import them.

ERRORS = ("colour_error", "profile_error", "profile_effective_samples")
"""Planes that say how good the others are."""

SCENE_DAYS = 60.0
"""Of a schedule's scene by default."""

LEAST_RAYS, MOST_RAYS = 100, 10**9
SHORT = 5.0
"""Seconds of work below which the start of other processes does not pay."""

SECONDS_LEFT = "{desc}: {percentage:3.0f}%|{bar}| {elapsed}, {remaining} left"
"""Of a bar whose steps are seconds by an estimate, which is not worth printing."""


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
    building.add_argument("--preset", choices=list(PRESETS), default="standard")
    _add_choice_arguments(building)
    building.add_argument("--knots", help="numbers of knots per axis, such as 9,3,2")
    building.add_argument("--wavelengths", type=int, help="from which colours are made, 4 to 16")
    building.add_argument(
        "--bands", help="what to hold: visible and wavelengths in nm, such as visible,365,1100"
    )
    building.add_argument(
        "--profile-error",
        type=float,
        help="standard error of light skin's cumulative diffusion profile; dark skin's is larger, "
        "as it shows less",
    )
    building.add_argument(
        "--no-profile", action="store_true", help="no diffusion profile: for renders without"
    )
    building.add_argument("--nodes", type=int, help="directions of the solver, 6 to 200")
    building.add_argument("--interpolation", choices=INTERPOLATIONS, help="between the knots")
    building.add_argument("--half", action="store_true", help="store numbers of 16 bits")
    building.add_argument(
        "--schedule",
        type=Path,
        metavar="FILE.csv",
        help="compute only the states that these doses lead to; CSV with the columns hour, "
        "melanogenesis_sed, thickening_sed, as `hylios dose` prints and the add-on exports",
    )
    building.add_argument(
        "--days", type=float, help=f"that the schedule's scene lasts ({SCENE_DAYS:g})"
    )
    building.add_argument(
        "--resume", action="store_true", help="go on with a build that was interrupted"
    )
    building.add_argument(
        "--force", action="store_true", help="replace an existing file and unfinished work"
    )
    building.add_argument(
        "--dask",
        metavar="tcp://HOST:PORT",
        help="spread the work over the Dask cluster with this scheduler",
    )
    building.add_argument("-o", "--output", type=Path, required=True, metavar="FILE.exr")

    info = commands.add_parser("info", help="say what a table is")
    info.set_defaults(command=_info)
    info.add_argument("table", type=Path)

    checking = commands.add_parser("check", help="compare a table with the model between knots")
    checking.set_defaults(command=_check)
    checking.add_argument("table", type=Path)
    checking.add_argument("--states", type=int, default=200, help="between the knots (200)")
    checking.add_argument(
        "--rays",
        type=int,
        default=0,
        help="per wavelength of a random walk (default: the solver, without noise)",
    )
    checking.add_argument(
        "--own-spectrum",
        action="append",
        default=[],
        metavar="NAME=FILE",
        help="a spectrum of your own that the table was made with; repeatable",
    )
    add_work_arguments(checking)

    trading = commands.add_parser("trade", help="measure time against error, here and for a skin")
    trading.set_defaults(command=_trade)
    add_skin_arguments(trading)
    add_work_arguments(trading)
    add_tanning_arguments(trading)
    _add_choice_arguments(trading)
    trading.add_argument(
        "--also",
        choices=PHOTOTYPES,
        action="append",
        default=[],
        help="a skin type for which tables are to do as well; repeatable",
    )
    trading.add_argument("--quick", action="store_true", help="seconds, to see that it works")
    trading.add_argument("--force", action="store_true", help="replace existing files")
    trading.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE.png",
        help="measure anew (minutes): the picture, with the front and its parts as CSV beside it; "
        "without it the front measured before is shown",
    )
    return parser


def _add_choice_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that `_chosen_point` reads."""
    limit = parser.add_mutually_exclusive_group()
    limit.add_argument(
        "--max-delta-e", type=float, help="the fastest table measured with no larger CIEDE2000"
    )
    limit.add_argument(
        "--max-seconds", type=float, help="the best table measured to take no more seconds"
    )
    parser.add_argument(
        "--front",
        type=Path,
        metavar="FILE.csv",
        help="to choose from, as `lut-builder trade` writes it (default: the one that is shipped)",
    )


@contextmanager
def _progress(total: float, what: str) -> Iterator[Callable[[float], object]]:
    from tqdm import tqdm

    with tqdm(total=total, desc=what, bar_format=SECONDS_LEFT, mininterval=0.5) as bar:
        yield lambda size: bar.update(min(size, total - bar.n))  # no rounding beyond the end


def _chosen_point(asked: argparse.Namespace, points: Sequence[Point], profile: bool) -> Point:
    """The point of a front that `--max-delta-e` or `--max-seconds` asks for."""
    cores = usable_cores(asked.threads)
    if asked.max_delta_e is not None:
        return cheapest(points, asked.max_delta_e, cores=cores, profile=profile)
    return best(points, asked.max_seconds, cores=cores, profile=profile)


def _known_points(asked: argparse.Namespace) -> list[Point]:
    return shipped_points() if asked.front is None else read_points(asked.front)


def _start(asked: argparse.Namespace) -> Settings:
    """The settings that other arguments change: a preset's, or those of a point of the front."""
    if asked.max_delta_e is None and asked.max_seconds is None:
        return PRESETS[asked.preset]
    with_colours = asked.bands is None or VISIBLE in asked.bands
    profile = with_colours and not asked.no_profile
    point = _chosen_point(asked, _known_points(asked), profile)
    cores = usable_cores(asked.threads)
    print(f"chosen: {described(point, cores)}, as measured for the front's machine and skin")
    return point.settings


def _settings(asked: argparse.Namespace) -> Settings:
    settings = _start(asked)
    if asked.knots is not None:
        counts = [number(part, "number of knots") for part in asked.knots.split(",")]
        knots = (require_whole("number of knots", count, 1, MOST_KNOTS) for count in counts)
        settings = replace(settings, knots=tuple(knots))
    if asked.wavelengths is not None:
        count = require_whole("number of wavelengths", asked.wavelengths, FEWEST, MOST)
        settings = replace(settings, colour_wavelengths=count)
    if asked.bands is not None:
        bands = [each.strip() for each in asked.bands.split(",") if each.strip()]
        shown = settings.colour_wavelengths if VISIBLE in bands else 0
        single = tuple(number(each, "band") for each in bands if each != VISIBLE)
        settings = replace(settings, colour_wavelengths=shown, bands=single)
    if asked.profile_error is not None:
        settings = replace(settings, profile_error=asked.profile_error)
    if asked.no_profile:
        settings = replace(settings, profile_error=0.0)
    if asked.nodes is not None:
        settings = replace(settings, nodes=asked.nodes)
    if asked.interpolation is not None:
        settings = replace(settings, interpolation=asked.interpolation)
    return replace(settings, half=asked.half or settings.half)


def _build(asked: argparse.Namespace) -> None:
    require_work(asked)
    if asked.days is not None and asked.schedule is None:
        raise InputError(f"--days is {asked.days:g} without a --schedule; allowed is both.")
    settings = _settings(asked)
    _, model = chosen_skin(asked)
    skin = chosen_tanning_skin(asked, asked.untanned)

    from hylios.history import read_schedule
    from lut_builder.assemble import assembled, requested, units
    from lut_builder.commands.resumable import resumable
    from lut_builder.exr_writer import write_table
    from lut_builder.jobs.run import run_units
    from lut_builder.jobs.software import software_digest
    from lut_builder.schedule import reached_states

    reached = None
    if asked.schedule is not None:
        days = SCENE_DAYS if asked.days is None else asked.days
        reached = reached_states(skin, read_schedule(asked.schedule), days)
    request = requested(skin, settings, seed=asked.seed, model=model, reached=reached)
    wanted, whole = len(request.states), request.whole
    work = units(request)
    with resumable(asked, ".exr") as unfinished:
        if reached is not None:
            saved = f"{1.0 - wanted / whole:.0%}" if wanted < whole else "none"
            print(f"states for the scene: {wanted}, for any sun: {whole}; {saved} saved")
        runner = _runner(asked, sum(each.size for each in work))
        label = f"table of {wanted} states"
        found = run_units(work, unfinished.folder, software_digest(), runner, label)
        table = assembled(request, found)
        write_table(unfinished.result, table, half=settings.half)
    cut = table.provenance["states_with_melanin_cut"]
    if cut:
        print(f"note: {cut} of {wanted} states would overfill a layer with melanin; cut")
    print(f"wrote {asked.output}: {os.path.getsize(asked.output) / 1000:.1f} KB")


def _runner(asked: argparse.Namespace, seconds: float) -> "Runner":
    """Where the units are done: on a cluster, in this process if they are short, or in several."""
    from lut_builder.jobs.local import in_processes, in_threads

    if asked.dask is not None:
        from lut_builder.jobs.cluster import on_cluster

        return on_cluster(asked.dask)
    cores = asked.threads or os.cpu_count() or 1
    return in_threads(cores) if seconds < SHORT else in_processes(cores)


def _trade(asked: argparse.Namespace) -> None:
    require_work(asked)
    if asked.output is None:
        if asked.also:
            raise InputError(f"--also {asked.also[0]} is given without -o; it is for measuring.")
        _show(asked, _known_points(asked))
        return
    if asked.front is not None:
        raise InputError(f"both {asked.front} and {asked.output} are given; allowed is one.")
    written = [
        asked.output,
        asked.output.with_suffix(".csv"),
        asked.output.with_name(f"{asked.output.stem}_parts.csv"),
    ]
    for path, kind in zip(written, (".png", ".csv", ".csv"), strict=True):
        require_target(path, (kind,), asked.force)
    skins = [chosen_tanning_skin(asked), *(phototype(each).skin for each in asked.also)]

    from lut_builder.trade.extent import FULL, QUICK
    from lut_builder.trade.figure import draw
    from lut_builder.trade.measurement import Trade, measure, notes

    extent = QUICK if asked.quick else FULL
    measured = []
    for each in skins:
        with ExitStack() as stack:

            def begin(
                total: float, stack: ExitStack = stack, name: str = each.specimen.name
            ) -> Callable[[float], object]:
                return stack.enter_context(_progress(total, f"time against error, {name}"))

            measured.append(measure(each, extent, seed=asked.seed, begin=begin))
    found = Trade(worst([each.points for each in measured]), measured[0].parts)
    told = notes(skins, extent)
    picture, front_file, parts_file = written
    write_points(front_file, found.front, told)
    write_rows(parts_file, found.parts, told)
    draw(found, picture, "; ".join(told[:3]))
    print(f"wrote {', '.join(map(str, written))}")
    _show(asked, found.front)


def _show(asked: argparse.Namespace, points: Sequence[Point]) -> None:
    """Print the front, or the point of it that is asked for."""
    if asked.max_delta_e is None and asked.max_seconds is None:
        print("\n".join(described(each) for each in points))
    else:
        point = _chosen_point(asked, points, profile=True)
        print(f"chosen: {described(point, usable_cores(asked.threads))}")


def _info(asked: argparse.Namespace) -> None:
    table = read_table(asked.table)
    for name, value in table.provenance.items():
        if isinstance(value, dict) and value:
            print(f"{printable(name)}:")
            print("\n".join(f"  {printable(f'{key}: {one}')}" for key, one in value.items()))
        elif name == "estimated_figures":
            print(f"{name}:")
            print("\n".join(f"  {printable(line)}" for line in value))
        else:
            print(printable(f"{name}: {value}"))
    print(f"planes: {', '.join(table.planes)}")
    for name in ERRORS:
        if name in table.planes:
            values = table.planes[name]
            print(f"{name}: {values.min():.3g} to {values.max():.3g}, mean {values.mean():.3g}")
    directions = zip(table.axes.basis.T, table.axes.knots, strict=True)
    for axis, (direction, knots) in enumerate(directions, start=1):
        print(
            f"axis {axis}: {np.round(direction, 3)} in ln of (basale, spinosum, granulosum, "
            f"thickness) to the untanned, knots {np.round(knots, 3)}"
        )


def _check(asked: argparse.Namespace) -> None:
    require_whole("number of states", asked.states, 1, 10_000)
    require_work(asked)
    if asked.rays:
        require_whole("number of rays", asked.rays, LEAST_RAYS, MOST_RAYS)

    from lut_builder.check import check
    from lut_builder.own_spectra import OwnSpectraError, require_own_spectra

    table = read_table(asked.table)
    spectra = published_spectra()
    for name, path in named_values(asked.own_spectrum, "a spectrum of your own").items():
        spectra = with_own_spectrum(spectra, name, Path(path))
    try:
        require_own_spectra(table.provenance, Model(spectra))
    except OwnSpectraError as error:
        if not error.missing:
            raise
        hint = " ".join(f"--own-spectrum {printable(name)}=FILE" for name in error.missing)
        raise InputError(f"{str(error).removesuffix('.')}; give {hint}.") from error
    with _progress(asked.states, "states directly") as progress:
        result = check(
            table,
            count=asked.states,
            rays=asked.rays,
            seed=asked.seed,
            threads=asked.threads,
            progress=progress,
            spectra=spectra,
        )
    held = ", held by the table" if "state" in table.planes else ""
    print(f"states: {len(result.differences)}, reachable{held}, none of them a knot")
    print(f"mean CIEDE2000 between table and model: {result.differences.mean():.3f}")
    print(f"largest: {result.differences.max():.3f}")
    if result.noise is not None:
        print(f"mean CIEDE2000 that Monte Carlo noise alone gives: {result.noise.mean():.3f}")
        print(
            "share of the mean squared difference that noise explains: "
            f"{result.noise_share:.0%} (over 100 % by chance)"
        )


if __name__ == "__main__":
    sys.exit(main())
