"""`hylios fit`: the specimen that reflects like a measured spectrum, or has a measured colour."""

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np

from hylios.commands.notes import note_estimates, note_omissions
from hylios.commands.skin_arguments import add_skin_arguments, chosen_skin
from hylios.commands.streams import progress
from hylios.commands.texts import number, wavelength_range
from hylios.errors import InputError, shown
from hylios.quadrature import skin_quadrature
from hylios.readers.spectrum import read_spectrum
from hylios.skin.specimen_file import specimen_toml


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser(
        "fit",
        help="a specimen that reflects like measured skin",
        description="Prints the fitted specimen as TOML, which all commands read with --specimen. "
        "Comments in it say what the data do not determine. The fit starts from --specimen "
        "and --set.",
    )
    parser.set_defaults(command=run)
    add_skin_arguments(parser)
    data = parser.add_mutually_exclusive_group(required=True)
    data.add_argument(
        "--spectrum",
        type=Path,
        metavar="FILE",
        help="a measured spectrum: CSV of wavelength_nm and reflectance, 0 to 1, or an "
        "instrument's file",
    )
    data.add_argument(
        "--srgb", metavar="R,G,B", help="a measured colour under D65: three numbers from 0 to 255"
    )
    parser.add_argument(
        "--column",
        help="column of --spectrum that holds reflectance, or sample of a CGATS or CxF file",
    )
    parser.add_argument(
        "--wavelengths",
        help="wavelengths in nm: FIRST:LAST:STEP or a,b,c (default: at most 61 of the file's)",
    )
    parser.add_argument(
        "--angle", type=float, default=8.0, help="angle of incidence in degrees (default: 8)"
    )
    parser.add_argument("--free", help="names of what may change, with commas between")


def run(arguments: argparse.Namespace) -> None:
    """Fit and print."""
    from hylios.lab.fit import COLOUR_COUNT, USUAL, fit_colour, fit_spectrum  # scipy

    start, model = chosen_skin(arguments)
    light = {
        "free": USUAL if arguments.free is None else tuple(arguments.free.split(",")),
        "angle": arguments.angle,
        "model": model,
    }
    with progress("fit", None, " solutions") as advance:
        if arguments.srgb is not None:
            wavelengths = skin_quadrature(COLOUR_COUNT).wavelengths
            result = fit_colour(start, _colour(arguments.srgb), **light, advance=advance)
            target = f"the colour {shown(arguments.srgb)}"
            error = f"{np.linalg.norm(result.residual):.2f} off in L*a*b* (CIE76)"
        else:
            measured = read_spectrum(arguments.spectrum, arguments.column)
            note_omissions([measured])
            wavelengths = _wavelengths(arguments.wavelengths, measured.wavelengths)
            reflectance = np.interp(wavelengths, measured.wavelengths, measured.reflectance)
            result = fit_spectrum(start, wavelengths, reflectance, **light, advance=advance)
            column = shown(arguments.column or "total")
            target = f"{measured.name}, {column}, at {wavelengths.size} wavelengths"
            error = f"root mean square error {result.rmse:.4f}"
    note_estimates(model, wavelengths)
    fitted = replace(result.specimen, name=f"{start.name} fitted")
    remarks = (f"Fitted to {target}: {error}.", *result.remarks())
    print(specimen_toml(fitted, remarks), end="")


MOST_WAVELENGTHS = 61


def _wavelengths(text: str | None, measured: np.ndarray) -> np.ndarray:
    """Wavelengths of the option, or up to `MOST_WAVELENGTHS` of the measured ones, evenly apart."""
    if text is None:
        count = min(measured.size, MOST_WAVELENGTHS)
        return measured[np.round(np.linspace(0, measured.size - 1, count)).astype(int)]
    wavelengths = wavelength_range(text)
    if wavelengths.min() < measured[0] or wavelengths.max() > measured[-1]:
        raise InputError(
            f"wavelengths are {text!r}; the spectrum has {measured[0]:g} to {measured[-1]:g} nm."
        )
    return wavelengths


def _colour(text: str) -> np.ndarray:
    """sRGB (3,), 0 to 1, of a text R,G,B."""
    values = np.array([number(part, "a part of --srgb") for part in text.split(",")])
    if values.shape != (3,) or not np.all((values >= 0.0) & (values <= 255.0)):
        raise InputError(f"--srgb is {text!r}; allowed are three numbers from 0 to 255.")
    if np.all(values <= 1.0):
        given = ",".join(f"{255.0 * value:.4g}" for value in values)
        raise InputError(
            f"--srgb is {text!r}, darker than any skin; allowed are numbers from 0 to 255, and "
            f"a colour of 0 to 1 is given as {given}."
        )
    return values / 255.0
