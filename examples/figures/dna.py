"""What would have to be true for table 6.3's indices of DNA, .135, and of keratin, .068."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from examples.figures.light import Task, Tick, exact
from examples.figures.report import Row
from hylios.skin.specimen import SPECIMENS, with_values
from hylios.spectra import published_spectra
from hylios.tissue import Layer, Stack

ANGLE = 8.0
WAVELENGTHS = np.arange(250.0, 401.0, 5.0)
SKIN = SPECIMENS["S3"]
PRINTED_DNA, PRINTED_KERATIN = 0.135, 0.068

SPECTRUM_ENDS = 310.0
"""nm above which the figure for DNA is next to nothing."""

KERATIN_AS_PRINTED = 4e4 / 2.5e3
"""A.3's factor over that for 4 um, which this project takes."""

DNA_AS_PRINTED = 0.05 * 1e3
"""A.4 with its density in mg/L, and not divided by the sample's 0.05 mg/mL, over what we take."""


@dataclass(frozen=True)
class Absorbers:
    """What absorbs in the UV, relative to this project's spectra at table 6.2's values.

    `beyond` is an absorption coefficient of the epidermis's DNA in 1/cm above `SPECTRUM_ENDS`.
    """

    epidermis: float = 1.0
    dermis: float = 0.0
    keratin: float = 1.0
    urocanic_acid: float = 1.0
    beyond: float = 0.0


AS_PRINTED = Absorbers(epidermis=DNA_AS_PRINTED, keratin=KERATIN_AS_PRINTED, urocanic_acid=15e-6)
"""A.3 to A.5 to the letter; A.5 leaves urocanic acid as little as its sample has of it."""


def task() -> Task:
    """The task of all rows; its size is a guess."""
    return Task(rows, 60.0 * WAVELENGTHS.size)


def rows(tick: Tick) -> list[Row]:
    """Both indices as they are, under other readings, and what gives the printed ones."""
    ours = Absorbers()

    def amount(times: float) -> Absorbers:
        return replace(ours, epidermis=times)

    def everywhere(times: float) -> Absorbers:
        return replace(ours, epidermis=times, dermis=times)

    def tail(coefficient: float) -> Absorbers:
        return replace(ours, beyond=coefficient)

    def printed_tail(coefficient: float) -> Absorbers:
        return replace(AS_PRINTED, beyond=coefficient)

    def keratin(times: float) -> Absorbers:
        return replace(ours, keratin=times)

    rows = [
        row("DNA as in table 6.2, in the epidermis", ours),
        row("DNA as in table 6.2, in the dermis too", everywhere(1.0)),
        row("no urocanic acid", replace(ours, urocanic_acid=0.0)),
        row("A.4 with 185 for its density (x 50), epidermis", amount(DNA_AS_PRINTED)),
        row("A.4 with 185 for its density (x 50), dermis too", everywhere(DNA_AS_PRINTED)),
        row("A.3, A.4 (with 185) and A.5 to the letter", AS_PRINTED),
    ]
    for what, unit, change in (
        ("DNA in the epidermis times", "", amount),
        ("DNA in epidermis and dermis times", "", everywhere),
        ("DNA that beyond 310 nm absorbs with", "/cm", tail),
        ("A.3 to A.5 to the letter, and DNA that beyond 310 nm absorbs with", "/cm", printed_tail),
    ):
        tick(6.0 * WAVELENGTHS.size)
        needed = solved(lambda x, change=change: dna_index(change(x)), PRINTED_DNA)
        rows.append(row(f"for DNA .135: {what} {needed:.3g}{unit}", change(needed)))
    needed = solved(lambda times: keratin_index(keratin(times)), PRINTED_KERATIN)
    rows.append(row(f"for keratin .068: keratin times {needed:.3g}", keratin(needed)))
    tick(36.0 * WAVELENGTHS.size)
    return rows


def row(what: str, absorbers: Absorbers) -> Row:
    """A row with the indices of DNA and keratin."""
    return Row(
        "table 6.3",
        f"DNA, keratin, MSI, UV: {what}",
        f"{PRINTED_DNA:g}, {PRINTED_KERATIN:g}",
        f"{dna_index(absorbers):.3f}, {keratin_index(absorbers):.3f}",
    )


def solved(function: Callable[[float], float], target: float) -> float:
    """Where a function that rises from 0.01 to 1e4 has a value."""
    exponent = brentq(lambda power: function(10.0**power) - target, -2.0, 4.0, xtol=1e-3)
    return float(10.0**exponent)


def dna_index(absorbers: Absorbers) -> float:
    """Mean sensitivity index (6.1) of DNA over the UV."""
    return index(absorbers, replace(absorbers, epidermis=0.0, dermis=0.0, beyond=0.0))


def keratin_index(absorbers: Absorbers) -> float:
    """Mean sensitivity index (6.1) of keratin over the UV."""
    return index(absorbers, replace(absorbers, keratin=0.0))


def index(base: Absorbers, changed: Absorbers) -> float:
    """Mean sensitivity index (6.1) over the UV."""
    first, second = reflectance(base), reflectance(changed)
    return float(np.mean(np.abs(first - second) / np.maximum(first, second)))


def reflectance(absorbers: Absorbers) -> np.ndarray:
    """Reflectance of S3 over the UV with other absorbers, (W,)."""
    skin = with_values(
        SKIN,
        {
            "skin_dna": 0.0,
            "corneum_keratin": 0.0,
            "corneum_urocanic_acid": SKIN.corneum_urocanic_acid * absorbers.urocanic_acid,
        },
        allow_unphysical=True,
    )
    return exact([absorbing(Stack.of(skin, nm), nm, absorbers) for nm in WAVELENGTHS], ANGLE)


def absorbing(stack: Stack, wavelength: float, absorbers: Absorbers) -> Stack:
    """S3 without DNA and keratin, with those of `absorbers` added."""
    dna = published_spectra()["dna"].at(wavelength) * SKIN.skin_dna
    keratin = published_spectra()["keratin"].at(wavelength) * 0.01 * SKIN.corneum_keratin
    beyond = absorbers.beyond if wavelength > SPECTRUM_ENDS else 0.0
    epidermis, dermis = absorbers.epidermis * dna + beyond, absorbers.dermis * dna
    added = (absorbers.keratin * keratin, *[epidermis] * 3, *[dermis] * 2)
    layers = zip(stack.layers, added, strict=True)
    return replace(stack, layers=tuple(more_absorbing(layer, more) for layer, more in layers))


def more_absorbing(layer: Layer, more: float) -> Layer:
    """The layer with a coefficient in 1/cm added to its absorption."""
    return replace(layer, absorption=layer.absorption + more)
