"""Spectra of the user's own: what a table's header says, and whether a file still agrees."""

import hashlib
from collections.abc import Mapping
from typing import Any

import numpy as np

from hylios.errors import InputError
from hylios.readers.text import shown
from hylios.spectra import Spectrum
from hylios.table import own_spectra
from hylios.tissue import SPECTRA, Model


class OwnSpectraError(InputError):
    """Spectra other than those that a table was made with; `missing` are the names of some."""

    def __init__(self, sentence: str, missing: tuple[str, ...] = ()):
        super().__init__(sentence)
        self.missing = missing


def described_spectra(model: Model) -> dict[str, dict[str, str]]:
    """What a table's provenance says of the spectra that are not the published ones.

    The source of each, for people to read, and its digest.
    """
    own = {name: one for name, one in model.own_spectra.items() if name in SPECTRA}
    described = {"own_figures": {name: shown(one.source) for name, one in own.items()}}
    if own:
        described["own_spectra_sha256"] = {name: digest(one) for name, one in own.items()}
    return described


def digest(spectrum: Spectrum) -> str:
    """SHA-256 of a spectrum's wavelengths and values, in hexadecimal."""
    numbers = np.stack([spectrum.wavelengths, spectrum.values]).astype("<f8")
    return hashlib.sha256(numbers.tobytes()).hexdigest()


def require_own_spectra(provenance: Mapping[str, Any], model: Model) -> None:
    """Raise OwnSpectraError unless a model has the spectra that a table was made with.

    They are given again: a path in a table is never followed.
    """
    digests, given = own_spectra(provenance), model.own_spectra
    missing = tuple(name for name in digests if name not in given)
    if missing:
        names = shown(", ".join(missing))
        raise OwnSpectraError(
            f"the table was made with a spectrum of its maker's own for {names}, which is needed "
            "to check it.",
            missing,
        )
    for name, spectrum in given.items():
        if name in SPECTRA and name not in digests:
            raise OwnSpectraError(f"the table was made with the published spectrum of {name}.")
        if digests.get(name) not in (None, digest(spectrum)):
            raise OwnSpectraError(
                f"the spectrum of {name} is not the one that the table was made with: "
                "its numbers differ."
            )
