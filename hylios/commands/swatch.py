"""`hylios swatch`: colours of spectra, or of a skin over the days of a tan, as PNG."""

import argparse
from pathlib import Path

import numpy as np

from hylios.commands.day_row import add_row_arguments, require_no_tan, write_row
from hylios.commands.notes import note_estimates, note_omissions
from hylios.commands.shell import add_work_arguments, require_work
from hylios.commands.skin_arguments import add_region_argument, add_skin_arguments, chosen_skin
from hylios.errors import InputError, require_range, require_whole, shown
from hylios.files import require_target
from hylios.readers.spectrum import NamedSpectrum, read_spectra

DESCRIPTION = """\
Draws a square for every CSV file that `hylios reflectance` printed, or one for a specimen that it
simulates; with --days a row over the days of a tan, and prints its colours as CSV. A visible swatch
is the colour under D65. A swatch of the ultraviolet (250 to 400 nm) or the infrared (700 to 2500
nm) is the mean reflectance as a grey, tinted violet or red; the tint is this project's choice.
"""

USUAL_SIZE = 256

MOST_PIXELS = 2**26
"""Most pixels of a picture: a quarter of a gigabyte while it is written."""


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser(
        "swatch", help="colour of a spectrum or a specimen, as PNG", description=DESCRIPTION
    )
    parser.set_defaults(command=run)
    parser.add_argument(
        "files", nargs="*", type=Path, metavar="FILE.csv", help="spectra; - is standard input"
    )
    add_skin_arguments(parser)
    add_region_argument(parser)
    add_row_arguments(parser)
    add_work_arguments(parser)
    parser.add_argument(
        "--band",
        choices=("visible", "uv", "ir"),
        default="visible",
        help="band of wavelengths to show (default: visible)",
    )
    parser.add_argument(
        "--angle", type=float, default=8.0, help="angle of incidence in degrees (default: 8)"
    )
    parser.add_argument(
        "--step", type=float, default=5.0, help="nm from wavelength to wavelength (default: 5)"
    )
    parser.add_argument(
        "--rays", type=int, default=10_000, help="rays for a wavelength (default: 10000)"
    )
    parser.add_argument(
        "--size", type=int, help="side of a square in pixels (default: 256; 48 in a row of days)"
    )
    parser.add_argument("--force", action="store_true", help="replace an existing file")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE.png")


def run(arguments: argparse.Namespace) -> None:
    """Read or simulate, and write."""
    require_target(arguments.output, (".png",), arguments.force)
    usual = USUAL_SIZE if arguments.size is None else arguments.size
    size = require_whole("size", usual, 1, 4096)
    of_specimen = (arguments.specimen, arguments.skin, arguments.set, arguments.days)
    others = arguments.reading, arguments.own_spectrum, arguments.region
    if arguments.files and any([*of_specimen, *others]):
        raise InputError("a swatch is of spectra in files or of a specimen; give only one.")
    if arguments.days is not None:
        if arguments.band != "visible":
            raise InputError(f"band is {arguments.band}; allowed with --days is visible.")
        write_row(arguments)
        return
    require_no_tan(arguments)
    _require_room(max(len(arguments.files), 1), size)
    spectra = read_spectra(arguments.files) if arguments.files else [_simulated(arguments)]
    note_omissions(spectra)

    from hylios.lab.colour import srgb, swatch
    from hylios.lab.pictures import swatches, write_pixels

    colours = srgb(
        np.array(
            [
                swatch(spectrum.wavelengths, spectrum.reflectance, arguments.band)
                for spectrum in spectra
            ]
        )
    )
    pixels = swatches(colours, size)
    write_pixels(pixels, arguments.output)
    codes = ("#{:02x}{:02x}{:02x}".format(*pixel) for pixel in pixels[0, ::size])
    named = ", ".join(
        f"{spectrum.name} {code}" for spectrum, code in zip(spectra, codes, strict=True)
    )
    print(f"wrote {shown(arguments.output)}: {named}")


def _require_room(count: int, size: int) -> None:
    """Raise InputError where squares side by side would be too large a picture."""
    pixels = count * size**2
    if pixels > MOST_PIXELS:
        raise InputError(
            f"{count} squares of {size} pixels have {pixels} in all; allowed are {MOST_PIXELS}, "
            f"which is a size of {int((MOST_PIXELS / count) ** 0.5)}."
        )


def _simulated(arguments: argparse.Namespace) -> NamedSpectrum:
    """The spectrum of the specimen asked for over the band."""
    from hylios.lab.colour import BANDS
    from hylios.transport.simulate import spectrum  # numba: only when light is asked for

    require_work(arguments)
    specimen, model = chosen_skin(arguments)
    first, last = BANDS[arguments.band]
    step = require_range("step", arguments.step, 1.0, last - first, "nm")
    result = spectrum(
        specimen,
        np.linspace(first, last, round((last - first) / step) + 1),
        angle=arguments.angle,
        rays=arguments.rays,
        seed=arguments.seed,
        threads=arguments.threads,
        model=model,
    )
    note_estimates(model, result.wavelengths)
    return NamedSpectrum(specimen.name, result.wavelengths, result.total, result.standard_error)
