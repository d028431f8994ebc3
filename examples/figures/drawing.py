"""Axes, curves, bars and swatches that several figures share."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from examples.figures.light import Curve
from hylios.lab.colour import BANDS, srgb
from hylios.lab.colour import swatch as colour_of_band
from hylios.tanning import TanningHistory

COLOURS = ("black", "#c1272d", "#0072b2", "#009e73", "#e69f00", "#7b3294")
DOMAINS = {"UV": BANDS["uv"], "visible": BANDS["visible"], "IR": BANDS["ir"]}
"""Domains of section 6.1.3 in nm; where two meet belongs to both."""

LAYERS = {"stratum basale": "-", "stratum spinosum": "--", "stratum granulosum": "-."}
"""Line of each layer, as in the thesis."""


def sheet(width: float = 7.0, height: float = 4.2, columns: int = 1, rows: int = 1, **options):
    """A figure of so many inches, and its axes as an array (rows, columns)."""
    figure = Figure(figsize=(width, height), dpi=120, layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False, **options)


def reflectance_axes(axes: Axes, first: float, last: float, title: str = "") -> None:
    """Label axes for reflectance over wavelength."""
    axes.set(xlabel="wavelength (nm)", ylabel="reflectance", title=title, xlim=(first, last))
    axes.grid(alpha=0.25)


def plot(axes: Axes, curves: Mapping[str, Curve], domain: tuple[float, float]) -> None:
    """Draw curves; where they have noise, a band of one standard error on either side."""
    for colour, (name, curve) in zip(COLOURS, curves.items(), strict=False):
        inside = (curve.wavelengths >= domain[0]) & (curve.wavelengths <= domain[1])
        across, up = curve.wavelengths[inside], curve.reflectance[inside]
        axes.plot(across, up, color=colour, label=name, linewidth=1.3)
        if curve.rays:
            error = curve.standard_error[inside]
            axes.fill_between(across, up - error, up + error, color=colour, alpha=0.25, lw=0)


def points(axes: Axes, curves: Sequence[Curve], domain: tuple[float, float]) -> None:
    """Draw curves of the random walk as points with bars of one standard error."""
    for colour, curve in zip(COLOURS, curves, strict=False):
        inside = (curve.wavelengths >= domain[0]) & (curve.wavelengths <= domain[1])
        axes.errorbar(
            curve.wavelengths[inside],
            curve.reflectance[inside],
            curve.standard_error[inside],
            fmt=".",
            color=colour,
            markersize=4,
            elinewidth=0.8,
        )


def plot_layers(axes: Axes, states: TanningHistory) -> None:
    """Draw the melanin of each layer over days, relative to all melanin at the start."""
    for number, (layer, line) in enumerate(LAYERS.items()):
        content = states.melanin[:, number]
        axes.plot(states.hours / 24, content, color=COLOURS[number + 1], ls=line, label=layer)


def swatch(axes: Axes, curve: Curve, domain: str, title: str) -> None:
    """Fill axes with the colour of a curve over the whole range."""
    colour = srgb(colour_of_band(curve.wavelengths, curve.reflectance, domain.lower()))
    axes.imshow(colour[None, None])
    axes.set(xticks=[], yticks=[])
    axes.set_title(title, fontsize=9)


def bars(
    axes: Axes, labels: Sequence[str], series: Mapping[str, Sequence[float]], ylabel: str
) -> None:
    """Draw groups of bars, one for each label, with a value of each series in it."""
    width = 0.8 / len(series)
    places = np.arange(len(labels))
    for row, (colour, (name, values)) in enumerate(zip(COLOURS[1:], series.items(), strict=False)):
        offset = (row - (len(series) - 1) / 2) * width
        drawn = axes.bar(places + offset, values, width, color=colour, label=name)
        axes.bar_label(drawn, fmt="%.3f", fontsize=6)
    axes.set_xticks(places, labels)
    axes.set(ylabel=ylabel)
    axes.grid(axis="y", alpha=0.25)
    axes.legend(fontsize=8)
