"""Pictures with captions, laid out in rows in one PNG file."""

import textwrap
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from examples.figures.shots import Window
from hylios.lab.pictures import write_figure

Panels = list[list["Panel"]]


@dataclass(frozen=True)
class Panel:
    """A picture (rows, columns, 3), sRGB, with lines under it.

    Drawn into it: a frame, and a line where `outlined` (rows, columns) is 0.
    """

    picture: np.ndarray
    caption: str
    marked: Window | None = None
    outlined: np.ndarray | None = None


DOTS_PER_INCH = 100
GAP, LINE, LETTER = 8, 19, 8
"""Pixels between pictures, of a line of a caption, and of a heading's letter."""


def sheet(heading: str, panels: Panels, path: Path) -> None:
    """Write rows of panels under a heading into a PNG file, each picture pixel by pixel."""
    heights = [
        max(panel.picture.shape[0] + GAP + LINE * (panel.caption.count("\n") + 1) for panel in row)
        for row in panels
    ]
    widths = [sum(panel.picture.shape[1] + GAP for panel in row) + GAP for row in panels]
    width, height = max(widths), sum(heights) + GAP * (len(panels) + 1) + 2 * LINE
    figure = Figure(figsize=(width / DOTS_PER_INCH, height / DOTS_PER_INCH), dpi=DOTS_PER_INCH)
    lines = textwrap.fill(heading, width // LETTER)
    figure.text(0.5, 1.0 - GAP / height, lines, ha="center", va="top", fontsize=10)
    top = GAP + LINE * (lines.count("\n") + 2) - LINE // 2
    for row, tall, wide in zip(panels, heights, widths, strict=True):
        left = (width - wide) // 2 + GAP
        for panel in row:
            _put(figure, panel, left, top, width, height)
            left += panel.picture.shape[1] + GAP
        top += tall + GAP
    write_figure(figure, path)


def _put(figure: Figure, panel: Panel, left: int, top: int, width: int, height: int) -> None:
    """Put a picture into a figure of so many pixels, its caption below."""
    rows, columns = panel.picture.shape[:2]
    bottom = height - top - rows
    axes = figure.add_axes((left / width, bottom / height, columns / width, rows / height))
    axes.imshow(panel.picture, interpolation="nearest", aspect="auto", extent=(0, 1, 0, 1))
    axes.axis("off")
    if panel.marked:
        x0, x1, y0, y1 = panel.marked
        axes.add_patch(
            Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, edgecolor="white", linewidth=1.0)
        )
    if panel.outlined is not None:
        axes.contour(
            panel.outlined,
            levels=[0.0],
            colors="white",
            linewidths=0.8,
            extent=(0, 1, 0, 1),
            origin="upper",
        )
    figure.text(
        (left + columns / 2) / width,
        (bottom - GAP / 2) / height,
        panel.caption,
        ha="center",
        va="top",
        fontsize=9,
    )
