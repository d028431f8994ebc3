"""`lut-builder check`: how far a table is from the model, between its knots."""

import argparse
from pathlib import Path

import numpy as np

from hylios.commands.shell import add_work_arguments, require_work
from hylios.commands.texts import named_values
from hylios.errors import InputError, require_whole
from hylios.readers.text import shown
from hylios.spectra import Spectra, published_spectra, with_own_spectrum
from hylios.table import LookAxes, SkinTable, read_table
from hylios.tissue import Model
from lut_builder.commands.progress import progress

LEAST_RAYS, MOST_RAYS = 100, 10**9


def add_check(commands) -> None:
    """Add the command to an argument parser's commands."""
    parser = commands.add_parser("check", help="compare a table with the model between its knots")
    parser.set_defaults(command=check_table)
    parser.add_argument("table", type=Path)
    parser.add_argument(
        "--states", type=int, default=200, help="number of states to compare (default: 200)"
    )
    parser.add_argument(
        "--rays",
        type=int,
        default=0,
        help="compare with a random walk of so many rays for a wavelength (default: with the "
        "solver, which has no noise)",
    )
    parser.add_argument(
        "--own-spectrum",
        action="append",
        default=[],
        metavar="NAME=FILE",
        help="a spectrum of your own that the table was made with, read from this file and not "
        "from where the table says it was; repeatable",
    )
    add_work_arguments(parser)


def check_table(arguments: argparse.Namespace) -> None:
    """Print the differences between a table and the model."""
    require_whole("number of states", arguments.states, 1, 10_000)
    require_work(arguments)
    if arguments.rays:
        require_whole("number of rays", arguments.rays, LEAST_RAYS, MOST_RAYS)

    from lut_builder.check import check

    table = read_table(arguments.table)
    spectra = _spectra_for(table, arguments.own_spectrum)
    with progress(arguments.states, "states directly") as show:
        result = check(
            table,
            count=arguments.states,
            rays=arguments.rays,
            seed=arguments.seed,
            threads=arguments.threads,
            progress=show,
            spectra=spectra,
        )
    scene = isinstance(table.axes, LookAxes) and table.axes.bounded
    held = ", held by the table" if scene or "state" in table.planes else ""
    most = result.states[:, 4].max()
    blood = f", of 1 to {most:.2g} times the blood" if most > 1.0 else ""
    print(f"states: {len(result.states)}, reachable{held}{blood}, none of them a knot")
    if result.differences.size:
        print(f"mean CIEDE2000 between table and model: {result.differences.mean():.3f}")
        print(f"largest: {result.differences.max():.3f}")
    if result.slanting is not None:
        slanting = f"{result.slanting.mean():.3f}, largest {result.slanting.max():.3f}"
        print(f"in light from 45 degrees: mean {slanting}")
    if result.bands is not None:
        print(
            f"rms error of the reflectance in single bands: {np.sqrt(np.mean(result.bands**2)):.4f}"
        )
    if result.noise is not None:
        print(f"mean CIEDE2000 that Monte Carlo noise alone gives: {result.noise.mean():.3f}")
        print(
            "share of the mean squared difference that noise explains: "
            f"{result.noise_share:.0%} (over 100 % by chance)"
        )


def _spectra_for(table: SkinTable, own: list[str]) -> Spectra:
    """The spectra that a table was made with, of which NAME=FILE give the user's own."""
    from lut_builder.own_spectra import OwnSpectraError, require_own_spectra

    spectra = published_spectra()
    for name, path in named_values(own, "a spectrum of your own").items():
        spectra = with_own_spectrum(spectra, name, Path(path))
    try:
        require_own_spectra(table.provenance, Model(spectra))
    except OwnSpectraError as error:
        if not error.missing:
            raise
        options = " ".join(f"--own-spectrum {shown(name)}=FILE" for name in error.missing)
        raise InputError(f"{str(error).removesuffix('.')}; give {options}.") from error
    return spectra
