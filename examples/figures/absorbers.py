"""Figure A.1: absorption spectra of the main absorbers of the skin."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from examples.figures.drawing import COLOURS, sheet
from examples.figures.light import Effort, Task
from examples.figures.report import Row
from hylios.lab.pictures import write_figure
from hylios.spectra import Spectrum, published_spectra
from hylios.tissue.absorbers import HEMOGLOBIN_WEIGHT

FIGURES = ("A.1",)

KERATIN_DEPTH = 4e-4
"""cm of solid keratin that the thesis's absorptance is measured over."""

DNA_SAMPLE, UROCANIC_SAMPLE = 0.05, 15e-6
"""mg/mL and mol/L that the thesis's absorptance is measured in, over 1 cm."""


@dataclass(frozen=True)
class Panel:
    """One of the six plots: what it shows, how spectra become it, and where."""

    title: str
    ylabel: str
    domain: tuple[float, float]
    shown: Mapping[str, Callable[[np.ndarray], np.ndarray]]
    logarithmic: bool = False


def same(values: np.ndarray) -> np.ndarray:
    """The spectrum as it is."""
    return values


PANELS = (
    Panel(
        "keratin 4 µm; DNA 50 µg/mL, urocanic acid 15 µmol/L, 1 cm",
        "absorptance",
        (250.0, 400.0),
        {
            "keratin": lambda mu: 1.0 - np.exp(-mu * KERATIN_DEPTH),
            "dna": lambda mu: 1.0 - np.exp(-mu * DNA_SAMPLE),
            "urocanic_acid": lambda extinction: 1.0 - 10.0 ** (-extinction * UROCANIC_SAMPLE),
        },
    ),
    Panel(
        "melanins",
        "extinction (1/(cm mg/mL))",
        (250.0, 1100.0),
        {"eumelanin": same, "pheomelanin": same},
        logarithmic=True,
    ),
    Panel(
        f"functional hemoglobins ({HEMOGLOBIN_WEIGHT:g} g/mol)",
        "molar extinction (1/(cm mol/L))",
        (250.0, 1100.0),
        {"oxyhemoglobin": same, "deoxyhemoglobin": same},
        logarithmic=True,
    ),
    Panel(
        "dysfunctional hemoglobins",
        "molar extinction (1/(cm mol/L))",
        (250.0, 1100.0),
        {"carboxyhemoglobin": same, "methemoglobin": same, "sulfhemoglobin": same},
        logarithmic=True,
    ),
    Panel(
        "carotene and bilirubin",
        "molar extinction (1/(cm mol/L))",
        (250.0, 700.0),
        {"beta_carotene": same, "bilirubin": same},
    ),
    Panel(
        "water and lipids",
        "absorption coefficient (1/cm)",
        (250.0, 2500.0),
        {"water": same, "lipids": same},
        logarithmic=True,
    ),
)


def tasks(effort: Effort) -> dict[str, Task]:
    """Nothing to compute."""
    return {}


def draw(results: Mapping[str, object], folder: Path) -> list[Row]:
    """Draw all panels; what is no measurement is dashed."""
    figure, axes = sheet(14.0, 7.5, columns=3, rows=2)
    for panel, place in zip(PANELS, axes.flat, strict=True):
        _panel(panel, place)
    figure.suptitle(
        "A.1  Absorbers of the skin: solid as measured, dashed estimated (hylios.spectra)"
    )
    write_figure(figure, folder / "A.1.png")
    return [
        Row("A.1", f"{name}, {part.first:g} to {part.last:g} nm", "plotted", part.what, "none")
        for panel in PANELS
        for name in panel.shown
        for part in published_spectra()[name].estimates
        if part.first < panel.domain[1]
    ]


def _panel(panel: Panel, axes: Axes) -> None:
    for colour, (name, change) in zip(COLOURS, panel.shown.items(), strict=False):
        spectrum = published_spectra()[name]
        inside = (spectrum.wavelengths >= panel.domain[0]) & (
            spectrum.wavelengths <= panel.domain[1]
        )
        values = np.where(inside, change(spectrum.values), np.nan)
        if panel.logarithmic:
            values = np.where(values > 0.0, values, np.nan)
        guessed = estimated(spectrum)
        axes.plot(spectrum.wavelengths, np.where(guessed, np.nan, values), color=colour)
        axes.plot(spectrum.wavelengths, np.where(guessed, values, np.nan), color=colour, ls="--")
    names = [
        Line2D([], [], color=colour, label=name.replace("_", " "))
        for colour, name in zip(COLOURS, panel.shown, strict=False)
    ]
    axes.legend(handles=names, fontsize=8)
    axes.set(xlabel="wavelength (nm)", ylabel=panel.ylabel, xlim=panel.domain)
    axes.set_title(panel.title, fontsize=9)
    axes.grid(alpha=0.25)
    if panel.logarithmic:
        axes.set_yscale("log")


def estimated(spectrum: Spectrum) -> np.ndarray:
    """Where a spectrum is an estimate, (N,) bool; the ends of measured parts are measured."""
    inside = np.zeros(spectrum.wavelengths.size, bool)
    for part in spectrum.estimates:
        first = part.first if part.first == spectrum.wavelengths[0] else part.first + 1e-9
        last = part.last if part.last == spectrum.wavelengths[-1] else part.last - 1e-9
        inside |= (spectrum.wavelengths >= first) & (spectrum.wavelengths <= last)
    return inside
