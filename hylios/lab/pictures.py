"""Pictures of spectra and colours, drawn by matplotlib without a display and without pyplot."""

from collections.abc import Sequence
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.image import imsave

from hylios.files import written_beside
from hylios.readers.spectrum import NamedSpectrum

SIZE_INCHES, DOTS_PER_INCH = (8.0, 4.8), 150
BAND_OPACITY = 0.25
LABEL_HEIGHT, LETTER_WIDTH, LABEL_DPI = 24, 10, 100
"""Pixels of a label under a swatch, and dots per inch of its letters."""


def spectra_figure(spectra: Sequence[NamedSpectrum]) -> Figure:
    """Reflectance over wavelength: a line for a spectrum, and its standard error as a band."""
    figure = Figure(figsize=SIZE_INCHES, dpi=DOTS_PER_INCH, layout="constrained")
    axes = figure.add_subplot()
    for number, spectrum in enumerate(spectra):
        marker = "o" if spectrum.wavelengths.size == 1 else None
        (line,) = axes.plot(
            spectrum.wavelengths, spectrum.reflectance, label=f"spectrum {number}", marker=marker
        )
        if spectrum.standard_error is not None:
            axes.fill_between(
                spectrum.wavelengths,
                spectrum.reflectance - spectrum.standard_error,
                spectrum.reflectance + spectrum.standard_error,
                color=line.get_color(),
                alpha=BAND_OPACITY,
                linewidth=0.0,
            )
    axes.set_xlabel("wavelength (nm)")
    axes.set_ylabel("reflectance")
    axes.set_ylim(bottom=0.0)
    axes.margins(x=0.0)
    axes.grid(alpha=0.3)
    for text, spectrum in zip(axes.legend().get_texts(), spectra, strict=True):
        text.set_parse_math(False)  # a name may hold a $ or begin with _
        text.set_text(spectrum.name)
    return figure


def write_figure(figure: Figure, target: Path) -> None:
    """Write a figure as PNG or SVG, by the ending of the target's name.

    Equal figures give equal bytes with the same matplotlib: no date is written, and the names
    inside an SVG do not depend on chance.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    kind = target.suffix.lower()[1:]
    metadata = {"Date": None, "Creator": None} if kind == "svg" else {"Software": None}
    with written_beside(target) as path, matplotlib.rc_context({"svg.hashsalt": "hylios"}):
        figure.savefig(path, format=kind, metadata=metadata)


def swatches(colours: np.ndarray, size: int) -> np.ndarray:
    """Pixels (size, N size, 3), uint8, of squares side by side from sRGB (N, 3), 0 to 1."""
    row = np.round(255.0 * np.asarray(colours)).astype(np.uint8)
    return np.repeat(np.repeat(row, size, axis=0)[None], size, axis=0)


def labelled(pixels: np.ndarray, labels: Sequence[str]) -> np.ndarray:
    """Pixels (H + LABEL_HEIGHT, W, 3), uint8, of swatches side by side with labels under them.

    Where they have no room, every second, fifth or tenth is there, and so on.
    """
    width = pixels.shape[1]
    size = width // len(labels)
    figure = Figure(figsize=(width / LABEL_DPI, LABEL_HEIGHT / LABEL_DPI), dpi=LABEL_DPI)
    canvas = FigureCanvasAgg(figure)
    room = LETTER_WIDTH * (1 + max(map(len, labels)))
    steps = (first * 10**power for power in range(9) for first in (1, 2, 5))
    step = next(step for step in steps if step * size >= room or step >= len(labels))
    for number in range(0, len(labels), step):
        middle = (number + 0.5) * size
        inside = min(max(middle, 0.5 * room), max(width - 0.5 * room, 0.5 * width))
        figure.text(inside / width, 0.5, labels[number], ha="center", va="center")
    canvas.draw()
    band = np.asarray(canvas.buffer_rgba())[:LABEL_HEIGHT, :width, :3]
    return np.concatenate([pixels, band])


def write_pixels(pixels: np.ndarray, target: Path) -> None:
    """Write pixels (H, W, 3), uint8, as PNG.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    with written_beside(target) as path:
        imsave(path, pixels, format="png")
