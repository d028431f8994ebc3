"""`hylios reflectance`: a specimen's spectrum by random walk, as CSV."""

import argparse

from hylios.commands.notes import note_estimates
from hylios.commands.shell import add_work_arguments, print_table, require_work
from hylios.commands.skin_arguments import add_region_argument, add_skin_arguments, chosen_skin
from hylios.commands.texts import wavelength_range


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser("reflectance", help="spectrum of a specimen by random walk")
    parser.set_defaults(command=run)
    add_skin_arguments(parser)
    add_region_argument(parser)
    add_work_arguments(parser)
    parser.add_argument(
        "--wavelengths",
        default="400:700:10",
        help="wavelengths in nm: FIRST:LAST:STEP or a,b,c (default: 400:700:10)",
    )
    parser.add_argument(
        "--angle", type=float, default=8.0, help="angle of incidence in degrees (default: 8)"
    )
    parser.add_argument(
        "--rays", type=int, default=100_000, help="rays for a wavelength (default: 100000)"
    )
    parser.add_argument(
        "--as-printed",
        action="store_true",
        help="walk rays loop by loop, as the thesis prints it (the same model, slower)",
    )


def run(arguments: argparse.Namespace) -> None:
    """Simulate and print."""
    from hylios.transport.simulate import spectrum  # numba: only when light is asked for

    require_work(arguments)
    specimen, model = chosen_skin(arguments)
    result = spectrum(
        specimen,
        wavelength_range(arguments.wavelengths),
        angle=arguments.angle,
        rays=arguments.rays,
        seed=arguments.seed,
        threads=arguments.threads,
        model=model,
        as_printed=arguments.as_printed,
    )
    note_estimates(model, result.wavelengths)
    print_table(
        {
            "wavelength_nm": result.wavelengths,
            "total": result.total,
            "surface": result.surface,
            "subsurface": result.subsurface,
            "absorptance": result.absorptance,
            "standard_error": result.standard_error,
        }
    )
