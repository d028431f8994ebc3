"""`lut-builder build`: a table of a skin's tanning states."""

import argparse
import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hylios.commands.shell import add_work_arguments, require_work
from hylios.commands.skin_arguments import (
    add_skin_arguments,
    add_tanning_arguments,
    chosen_skin,
    chosen_tanning_skin,
)
from hylios.commands.texts import number
from hylios.errors import InputError, require_whole
from hylios.quadrature import FEWEST, MOST
from hylios.readers.text import name_of
from hylios.skin import UNTANNED, Skin
from hylios.table import INTERPOLATIONS
from hylios.tanning import Exposures
from lut_builder.commands.limits import (
    add_limit_arguments,
    has_limit,
    measured_points,
    point_within,
)
from lut_builder.lighting import DAYLIGHT, STANDARD_OBSERVER, lighting
from lut_builder.settings import MOST_KNOTS, PRESETS, VISIBLE, Settings
from lut_builder.trade.points import described, usable_cores

if TYPE_CHECKING:
    from lut_builder.jobs.run import Runner

SCENE_DAYS = 60.0
"""Days of a schedule's scene by default."""

BLOOD = 3
"""Which number of knots is that of the blood."""

SHORT = 5.0
"""Seconds of work below which the start of other processes does not pay."""


def add_build(commands) -> None:
    """Add the command to an argument parser's commands."""
    parser = commands.add_parser("build", help="simulate a skin's tanning states into a table")
    parser.set_defaults(command=build_table)
    add_skin_arguments(parser)
    add_work_arguments(parser)
    add_tanning_arguments(parser)
    parser.add_argument(
        "--untanned",
        choices=list(UNTANNED),
        default="steady_state",
        help="melanin of skin without sun: the tanning set's steady state (equation 5.16), or "
        "the specimen's own",
    )
    _add_settings_arguments(parser)
    _add_scene_arguments(parser)
    _add_output_arguments(parser)


def _add_settings_arguments(parser: argparse.ArgumentParser) -> None:
    """What `_settings` reads."""
    parser.add_argument(
        "--preset",
        choices=list(PRESETS),
        help="accuracy of the table (default: standard)",
    )
    add_limit_arguments(parser)
    parser.add_argument(
        "--knots", help="numbers of knots of melanin, thickness, spread and blood, such as 15,3,4,4"
    )
    parser.add_argument(
        "--wavelengths",
        type=int,
        help="number of wavelengths that make a colour, 4 to 20 "
        "(default: the preset's, and more for a lamp whose spectrum has lines)",
    )
    parser.add_argument(
        "--bands", help="what the table holds: visible and wavelengths in nm, as visible,365,1100"
    )
    parser.add_argument(
        "--profile-error",
        type=float,
        help="standard error of light skin's cumulative diffusion profile; dark skin's, which "
        "shows less, is larger",
    )
    parser.add_argument(
        "--no-profile",
        action="store_true",
        help="hold no diffusion profile: for renders without subsurface light",
    )
    parser.add_argument("--nodes", type=int, help="number of directions in the solver, 6 to 200")
    parser.add_argument(
        "--interpolation", choices=INTERPOLATIONS, help="interpolation between the knots"
    )
    parser.add_argument(
        "--illuminant",
        default=DAYLIGHT,
        metavar="NAME|FILE.csv",
        help="light of the colours, which is white in them: A, D50, FL2, LED-B3, ... or a spectrum "
        f"of power by wavelength (default: {DAYLIGHT})",
    )
    parser.add_argument(
        "--observer",
        default=STANDARD_OBSERVER,
        help="who sees them: CIE 1931 or 2015 2 degree, CIE 1964 or 2015 10 degree (default: "
        f"{STANDARD_OBSERVER})",
    )
    parser.add_argument("--half", action="store_true", help="store numbers in 16 bits")


def _add_scene_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--schedule",
        type=Path,
        metavar="FILE.csv",
        help="compute only the states that these doses lead to; CSV with the columns hour, "
        "melanogenesis_sed, thickening_sed, as `hylios dose` prints and the add-on exports",
    )
    parser.add_argument(
        "--days",
        type=float,
        help=f"days that the scene of --schedule lasts (default: {SCENE_DAYS:g})",
    )
    parser.add_argument(
        "--no-redness",
        action="store_true",
        help="leave out how the doses of --schedule redden skin: for scenes without sunburn",
    )


def _add_output_arguments(parser: argparse.ArgumentParser) -> None:
    """Where the work is done, and where to."""
    parser.add_argument(
        "--resume", action="store_true", help="go on with a build that was interrupted"
    )
    parser.add_argument(
        "--force", action="store_true", help="replace an existing file and unfinished work"
    )
    parser.add_argument(
        "--dask",
        metavar="tcp://HOST:PORT",
        help="spread the work over the Dask cluster with this scheduler; this process and the "
        "workers run whatever the scheduler sends them, so use only one that you trust",
    )
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE.exr")


def build_table(arguments: argparse.Namespace) -> None:
    """Build a table and write it."""
    require_work(arguments)
    _require_effects(arguments)
    settings = _settings(arguments)
    _, model = chosen_skin(arguments)
    skin = chosen_tanning_skin(arguments, arguments.untanned)

    # numba, colour-science and OpenImageIO take a second or more.
    from lut_builder.assemble import assembled, requested, units
    from lut_builder.commands.resumable import resumable
    from lut_builder.exr_writer import write_table
    from lut_builder.jobs.run import run_units
    from lut_builder.jobs.software import software_digest

    reached = None if arguments.schedule is None else _reached(skin, settings, arguments)
    seen_in = lighting(arguments.illuminant, arguments.observer)
    if settings.colour_wavelengths and arguments.wavelengths is None:
        enough = seen_in.enough(settings.colour_wavelengths)
        settings = replace(settings, colour_wavelengths=enough)
    request = requested(
        skin,
        settings,
        seed=arguments.seed,
        model=model,
        reached=reached,
        lighting=seen_in,
    )
    count, work = len(request.states), units(request)
    with resumable(arguments, ".exr") as unfinished:
        if reached is not None:
            whole = request.whole
            saved = f"{1.0 - count / whole:.0%}" if count < whole else "none"
            print(f"states for the scene: {count}, for any sun: {whole}; {saved} saved")
        runner = _runner(arguments, sum(unit.size for unit in work))
        label = f"table of {count} states"
        results = run_units(work, unfinished.folder, software_digest(), runner, label)
        table = assembled(request, results)
        write_table(unfinished.result, table, half=settings.half)
    cut = table.provenance["states_with_melanin_cut"]
    if cut:
        print(f"note: {cut} of {count} states would overfill a layer with melanin; cut")
    print(f"wrote {arguments.output}: {os.path.getsize(arguments.output) / 1000:.1f} KB")


def _require_effects(arguments: argparse.Namespace) -> None:
    """Refuse options that have no effect beside the others, or without them."""
    if arguments.schedule is None:
        if arguments.days is not None:
            raise InputError(f"--days is {arguments.days:g} without a --schedule; allowed is both.")
        if arguments.no_redness:
            raise InputError("--no-redness is given without a --schedule; allowed is both.")
    if has_limit(arguments):
        if arguments.preset is not None:
            raise InputError(
                f"--preset is {arguments.preset} beside a limit of error or time, which chooses "
                "the settings itself; allowed is one."
            )
    elif arguments.front is not None:
        raise InputError(
            f"--front is {arguments.front} without --max-delta-e or --max-seconds; allowed is both."
        )
    if arguments.no_profile and arguments.profile_error is not None:
        raise InputError("both --no-profile and --profile-error are given; allowed is one.")
    if not _shows_colours(arguments):
        for name, value, usual in (
            ("--illuminant", arguments.illuminant, DAYLIGHT),
            ("--observer", arguments.observer, STANDARD_OBSERVER),
        ):
            if value != usual:
                raise InputError(
                    f"{name} is {value} for a table without the visible, which has no colours; "
                    "allowed is with it."
                )


def _shows_colours(arguments: argparse.Namespace) -> bool:
    return arguments.bands is None or VISIBLE in (
        band.strip() for band in arguments.bands.split(",")
    )


def _reached(skin: Skin, settings: Settings, arguments: argparse.Namespace) -> np.ndarray:
    """States that the scene of `--schedule` leads through, as far as the settings tell them."""
    from hylios.adding.redness import erythema
    from hylios.history import read_schedule
    from lut_builder.reachable import reached_states

    days = SCENE_DAYS if arguments.days is None else arguments.days
    schedule = _doses_of(read_schedule(arguments.schedule), arguments.schedule, days)
    reddens = len(settings.knots) > BLOOD and settings.knots[BLOOD] > 1 and not arguments.no_redness
    return reached_states(skin, schedule, days, erythema(skin) if reddens else None)


def _doses_of(schedule: Exposures, path: Path, days: float) -> Exposures:
    """The schedule, if it has a dose; says which doses come too late to count."""
    if not schedule.hours.size:
        raise InputError(f"{name_of(path)} has no dose; a schedule needs at least one row.")
    late = np.unique(schedule.hours[schedule.hours > 24.0 * days])
    if late.size:
        hours = ", ".join(map(str, late[:5])) + (", ..." if late.size > 5 else "")
        print(
            f"note: doses after day {days:g}, the last of the scene, do not count: hour {hours}",
            file=sys.stderr,
        )
    return schedule


def _runner(arguments: argparse.Namespace, seconds: float) -> "Runner":
    """Where the units are done: on a cluster, in this process if they are short, or in several."""
    from lut_builder.jobs.local import in_processes, in_threads

    if arguments.dask is not None:
        from lut_builder.jobs.cluster import on_cluster

        return on_cluster(arguments.dask)
    cores = arguments.threads or os.cpu_count() or 1
    return in_threads(cores) if seconds < SHORT else in_processes(cores)


def _start(arguments: argparse.Namespace) -> Settings:
    """The settings that other arguments change: a preset's, or those of a point of the front."""
    if not has_limit(arguments):
        return PRESETS[arguments.preset or "standard"]
    profile = _shows_colours(arguments) and not arguments.no_profile
    point = point_within(arguments, measured_points(arguments), profile)
    cores = usable_cores(arguments.threads)
    print(f"chosen: {described(point, cores)}, as measured for the front's machine and skin")
    return point.settings


def _settings(arguments: argparse.Namespace) -> Settings:
    settings = _start(arguments)
    if arguments.knots is not None:
        counts = [number(part, "number of knots") for part in arguments.knots.split(",")]
        knots = (require_whole("number of knots", count, 1, MOST_KNOTS) for count in counts)
        settings = replace(settings, knots=tuple(knots))
    if arguments.wavelengths is not None:
        count = require_whole("number of wavelengths", arguments.wavelengths, FEWEST, MOST)
        settings = replace(settings, colour_wavelengths=count)
    if arguments.bands is not None:
        bands = [band.strip() for band in arguments.bands.split(",") if band.strip()]
        shown = settings.colour_wavelengths if VISIBLE in bands else 0
        single = tuple(number(band, "band") for band in bands if band != VISIBLE)
        settings = replace(settings, colour_wavelengths=shown, bands=single)
    if arguments.profile_error is not None:
        settings = replace(settings, profile_error=arguments.profile_error)
    if arguments.no_profile:
        settings = replace(settings, profile_error=0.0)
    if arguments.nodes is not None:
        settings = replace(settings, nodes=arguments.nodes)
    if arguments.interpolation is not None:
        settings = replace(settings, interpolation=arguments.interpolation)
    return replace(settings, half=arguments.half or settings.half)
