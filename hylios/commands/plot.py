"""`hylios plot`: spectra as PNG or SVG."""

import argparse
from pathlib import Path

from hylios.commands.notes import note_omissions
from hylios.errors import shown
from hylios.files import require_target
from hylios.readers.spectrum import read_spectra


def add_to(commands) -> None:
    """Add the command to an argument parser's subcommands."""
    parser = commands.add_parser(
        "plot",
        help="spectra as PNG or SVG",
        description="Draws CSV files as `hylios reflectance` prints them: the column total over "
        "wavelength_nm, and a band of one standard_error to both sides if there is that column.",
    )
    parser.set_defaults(command=run)
    parser.add_argument(
        "files", nargs="+", type=Path, metavar="FILE.csv", help="spectra; - is standard input"
    )
    parser.add_argument("--force", action="store_true", help="replace an existing file")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE.png|FILE.svg")


def run(arguments: argparse.Namespace) -> None:
    """Read, draw and write."""
    require_target(arguments.output, (".png", ".svg"), arguments.force)
    spectra = read_spectra(arguments.files)
    note_omissions(spectra)

    from hylios.lab.pictures import spectra_figure, write_figure  # matplotlib takes a second

    write_figure(spectra_figure(spectra), arguments.output)
    names = ", ".join(spectrum.name for spectrum in spectra)
    print(f"wrote {shown(arguments.output)}: {names}")
