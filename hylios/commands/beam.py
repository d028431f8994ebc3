"""What the commands `brdf` and `profile` share: one wavelength, one incidence, many rays."""

import argparse
from collections.abc import Callable
from typing import Any

from hylios.commands.shell import add_work_arguments, require_work
from hylios.commands.skin_arguments import add_region_argument, add_skin_arguments, chosen_skin
from hylios.tissue import Model


def add_beam_arguments(parser: argparse.ArgumentParser, *, wavelength: float, angle: float) -> None:
    """Add the arguments that `simulated` reads, with the defaults of some."""
    add_skin_arguments(parser)
    add_region_argument(parser)
    add_work_arguments(parser)
    parser.add_argument(
        "--wavelength",
        type=float,
        default=wavelength,
        help=f"wavelength in nm (default: {wavelength:g})",
    )
    parser.add_argument(
        "--angle",
        type=float,
        default=angle,
        help=f"angle of incidence in degrees (default: {angle:g})",
    )
    parser.add_argument(
        "--rays", type=int, default=1_000_000, help="number of rays (default: a million)"
    )


def simulated(
    simulate: Callable[..., Any], arguments: argparse.Namespace, **more: Any
) -> tuple[Any, Model]:
    """What a simulation of `hylios.transport` gives for the arguments, and the model of light.

    Raises
    ------
    InputError
        If an argument cannot be used.
    """
    require_work(arguments)
    specimen, model = chosen_skin(arguments)
    result = simulate(
        specimen,
        arguments.wavelength,
        angle=arguments.angle,
        rays=arguments.rays,
        seed=arguments.seed,
        threads=arguments.threads,
        model=model,
        **more,
    )
    return result, model
