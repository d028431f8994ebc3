"""`hylios brdf`: where a specimen reflects light of one wavelength and incidence, as CSV."""

import argparse

import numpy as np

from hylios.commands.beam import add_beam_arguments, simulated
from hylios.commands.notes import note_estimates
from hylios.commands.shell import print_table

DESCRIPTION = """\
Prints one row for a bin of directions: the polar angle and azimuth of its middle, its projected
solid angle, and its mean BRDF in 1/sr: of light that the surface reflects, of light that was
inside, and of both, with the standard error. The polar angle is 0 along the skin's normal. The
azimuth is 0 on the side to which a mirror sends the light and 180 where the light comes from; both
sides of the plane of incidence are alike and counted together. Total times projected solid angle,
summed over all rows, is the reflectance.
"""


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser(
        "brdf", help="angular distribution of a specimen's reflectance", description=DESCRIPTION
    )
    parser.set_defaults(command=run)
    add_beam_arguments(parser, wavelength=550.0, angle=45.0)
    parser.add_argument(
        "--polar-bins", type=int, default=18, help="bins of polar angle, 0 to 90 degrees"
    )
    parser.add_argument(
        "--azimuth-bins", type=int, default=12, help="bins of azimuth, 0 to 180 degrees"
    )


def run(arguments: argparse.Namespace) -> None:
    """Simulate and print."""
    from hylios.transport.angular import brdf  # numba: only when light is asked for

    result, model = simulated(
        brdf,
        arguments,
        polar_bins=arguments.polar_bins,
        azimuth_bins=arguments.azimuth_bins,
    )
    note_estimates(model, np.array([arguments.wavelength]))
    polar, azimuth = np.meshgrid(
        _middles(result.polar_edges), _middles(result.azimuth_edges), indexing="ij"
    )
    columns = {
        "polar_degrees": polar,
        "azimuth_degrees": azimuth,
        "projected_solid_angle_sr": result.projected_solid_angle,
        "surface_per_sr": result.surface,
        "subsurface_per_sr": result.subsurface,
        "total_per_sr": result.total,
        "standard_error": result.standard_error,
    }
    print_table({name: values.ravel() for name, values in columns.items()})


def _middles(edges: np.ndarray) -> np.ndarray:
    return 0.5 * (edges[1:] + edges[:-1])
