"""`hylios profile`: how far from a pencil beam light leaves a specimen, as CSV."""

import argparse
import sys

import numpy as np

from hylios.commands.beam import add_beam_arguments, simulated
from hylios.commands.notes import note_estimates
from hylios.commands.shell import print_table

DESCRIPTION = """\
Prints one row for a ring around the point where a pencil beam comes in: its inner and outer radius
in mm, its radial exitance R(r) in 1/mm^2 with the standard error, and the mean of the fitted Burley
profile over the ring. R times the rings' areas, summed, is the subsurface reflectance, without the
light beyond the last ring. Notes on standard error give that light and the fitted width d; Cycles'
radius is 4 pi 1.04 d = 13.07 d. With --fit there is one row only: the reflectance and the width.
"""


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser(
        "profile",
        help="radial exitance of a specimen, and the width of Burley's profile",
        description=DESCRIPTION,
    )
    parser.set_defaults(command=run)
    add_beam_arguments(parser, wavelength=633.0, angle=0.0)
    parser.add_argument(
        "--smallest", type=float, default=0.01, help="radius of the first ring in mm"
    )
    parser.add_argument(
        "--largest", type=float, default=100.0, help="radius of the last ring in mm"
    )
    parser.add_argument("--rings", type=int, default=60, help="number of rings (default: 60)")
    parser.add_argument("--fit", action="store_true", help="print only the fitted width, as CSV")


def run(arguments: argparse.Namespace) -> None:
    """Simulate and print."""
    from hylios.transport.radial import Rings, profile  # numba: only when light is asked for

    rings = Rings(arguments.smallest, arguments.largest, arguments.rings)
    result, model = simulated(profile, arguments, rings=rings)
    width, error = result.burley_width, result.burley_width_error
    note_estimates(model, np.array([arguments.wavelength]))
    if arguments.fit:
        row = {
            "wavelength_nm": arguments.wavelength,
            "subsurface": result.subsurface,
            "burley_width_mm": width,
            "standard_error_mm": error,
        }
        print_table({name: np.array([value]) for name, value in row.items()})
        return
    print(f"note: Burley's width d is {width:.4g} mm, standard error {error:.2g}", file=sys.stderr)
    if result.beyond:
        print(
            f"note: {result.beyond:.3g} of the light leaves beyond {arguments.largest:g} mm",
            file=sys.stderr,
        )
    print_table(
        {
            "inner_mm": result.edges[:-1],
            "outer_mm": result.edges[1:],
            "exitance_per_mm2": result.exitance,
            "standard_error": result.standard_error,
            "burley_per_mm2": result.burley,
        }
    )
