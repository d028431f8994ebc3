"""What commands say on standard error of estimates, and of what files leave out."""

import sys
from collections.abc import Sequence

import numpy as np

from hylios.readers.spectrum import NamedSpectrum
from hylios.spectra import estimates_within
from hylios.tanning import KINETICS
from hylios.tissue import SPECTRA, Model


def note_estimates(model: Model, wavelengths: np.ndarray, names: Sequence[str] = SPECTRA) -> None:
    """Say on standard error which spectra are estimates at some wavelength in nm."""
    for line in estimates_within(model.spectra, names, wavelengths):
        print(f"note: {line}", file=sys.stderr)


def note_omissions(spectra: Sequence[NamedSpectrum]) -> None:
    """Say on standard error what was left out of files of spectra."""
    for spectrum in spectra:
        for line in spectrum.notes:
            print(f"note: {spectrum.name}: {line}", file=sys.stderr)


def note_kinetics(name: str) -> None:
    """Say on standard error what of a kinetics other than the thesis's is an estimate."""
    if name != "thesis":
        print(f"note: the {name} kinetics is {KINETICS[name]}", file=sys.stderr)


def note_redness() -> None:
    """Say on standard error that redness is an estimate."""
    print(
        "note: redness is an estimate but for the hours and doses to which it was fitted",
        file=sys.stderr,
    )
