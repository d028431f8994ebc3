"""The page of docs that shows what was compared, with its pictures."""

import platform
import shutil
import time
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from os import cpu_count
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from examples.truth import text
from examples.truth.outcome import Outcome, Reading, Row, markdown, read_rows
from examples.truth.shots import TYPES
from hylios.errors import InputError
from hylios.files import written_beside
from hylios.lab.colour import srgb
from hylios.lab.pictures import write_figure

ROWS = "rows.csv"
CHANNELS = ("tab:red", "tab:green", "tab:blue")


def machine(seconds: float) -> dict[str, str]:
    """What a run was made with, by `examples.truth.outcome.DESCRIBED`."""
    return {
        "blender": version("bpy"),
        "machine": f"{platform.machine()}, {cpu_count()} cores, Python {platform.python_version()}",
        "date": time.strftime("%Y-%m-%d"),
        "seconds": f"{seconds:.0f}",
    }


def draw(outcomes: Mapping[str, Outcome], folder: Path) -> None:
    """Draw the pictures of the comparisons that have one."""
    drawings = {"albedo": _albedo, "edge": _edges, "gloss": _lobes, "slab": _slabs}
    for name, outcome in outcomes.items():
        if name in drawings:
            whole = [reading for reading in outcome.readings if "inside" not in reading.row]
            figure = drawings[name]({reading.case: reading for reading in whole})
            write_figure(figure, folder / f"truth_{name}.png")


def write(path: Path, folders: Sequence[Path]) -> None:
    """Write the page from the folders of runs, each with another Blender; pictures of the first.

    Raises
    ------
    InputError
        If a folder has no rows.
    """
    columns: dict[str, list[Row]] = {}
    runs = []
    for folder in folders:
        if not (folder / ROWS).exists():
            raise InputError(f"{folder} has no {ROWS}; expected the folder of a run.")
        described, rows = read_rows(folder / ROWS)
        columns[described["blender"]] = rows
        runs.append(described)
    made = "; ".join(
        f"Blender {run['blender']} on {run['machine']}, {run['date']}, {run['seconds']} s"
        for run in runs
    )
    names = {row.name.split(",")[0] for row in columns[runs[0]["blender"]]}
    parts = [text.INTRODUCTION, markdown(columns), text.MADE.format(made=made)]
    parts += [section for name, section in text.SECTIONS.items() if name in names]
    for picture in sorted(folders[0].glob("truth_*.png")):
        with written_beside(path.parent / picture.name) as file:
            shutil.copyfile(picture, file)
    with written_beside(path) as file:
        file.write_text("\n".join(parts), encoding="utf-8")


def _albedo(readings: Mapping[str, Reading]) -> Figure:
    """Each type in its tans and bloods, seen from above: the render around the model's colour."""
    cases = [case for case in readings if case.endswith("at 0")]
    columns = list(dict.fromkeys(case.split(" ", 1)[1] for case in cases))
    size, inner = 40, slice(12, 28)
    picture = np.ones((len(TYPES) * size, len(columns) * size, 3))
    for case in cases:
        kind, column = case.split(" ", 1)
        row, place = TYPES.index(kind) * size, columns.index(column) * size
        tile = picture[row : row + size, place : place + size]
        tile[:] = srgb(readings[case].shown[0])
        tile[inner, inner] = srgb(readings[case].said[0])
    figure = Figure(figsize=(9.0, 4.6), dpi=100, layout="constrained")
    axes = figure.add_subplot()
    axes.imshow(picture, interpolation="nearest")
    axes.set_yticks((np.arange(len(TYPES)) + 0.5) * size, TYPES)
    labels = [column.removesuffix(" at 0").replace(" blood ", "\n") for column in columns]
    axes.set_xticks((np.arange(len(columns)) + 0.5) * size, labels, fontsize=7)
    axes.tick_params(length=0)
    axes.set_xlabel("tan, and blood as a multiple; the square within each patch is the model's")
    return figure


def _edges(readings: Mapping[str, Reading]) -> Figure:
    figure = Figure(figsize=(9.0, 5.0), dpi=100, layout="constrained")
    for axes, case in zip(figure.subplots(2, 3, sharex=True).flat, _chosen_edges(), strict=True):
        if case in readings:
            _curves(axes, readings[case])
            axes.set_title(f"{case}: {readings[case].mean:.2f}", fontsize=9)
    figure.supxlabel("mm from the edge of the light")
    figure.supylabel("light out of the skin; white is 1")
    return figure


def _chosen_edges() -> list[str]:
    return [f"edge {kind} {tan}" for tan in ("untanned", "dark") for kind in ("II", "IV", "VI")]


def _curves(axes, reading: Reading) -> None:
    """Three channels over the places, the model's dashed."""
    for channel, colour in enumerate(CHANNELS):
        axes.plot(reading.places, reading.shown[:, channel], color=colour, linewidth=1.0)
        axes.plot(reading.places, reading.said[:, channel], "--", color=colour, linewidth=1.0)


def _lobes(readings: Mapping[str, Reading]) -> Figure:
    figure = Figure(figsize=(9.0, 3.0 * (len(readings) // 3)), dpi=100, layout="constrained")
    grid = figure.subplots(max(1, len(readings) // 3), 3, squeeze=False).flat
    for axes, (case, reading) in zip(grid, readings.items(), strict=False):
        axes.plot(reading.places, reading.shown[:, 0], "k", linewidth=1.0)
        axes.plot(reading.places, reading.said[:, 0], "k--", linewidth=1.0)
        axes.set_title(f"{case}°: L1 {reading.mean:.0%}", fontsize=9)
    figure.supxlabel("degrees from the normal, positive on the mirror's side")
    figure.supylabel("BRDF of the surface (1/sr)")
    return figure


def _slabs(readings: Mapping[str, Reading]) -> Figure:
    figure = Figure(figsize=(9.0, 3.6), dpi=100, layout="constrained")
    kinds = list(dict.fromkeys(case.split()[1] for case in readings))
    for axes, kind in zip(figure.subplots(1, len(kinds), squeeze=False).flat, kinds, strict=True):
        some = [reading for case, reading in readings.items() if case.split()[1] == kind]
        places = np.concatenate([reading.places for reading in some])
        shown, said = (
            np.concatenate([getattr(reading, name) for reading in some])
            for name in ("shown", "said")
        )
        _curves(axes, Reading("slab", kind, shown, said, np.zeros(places.size), places))
        axes.set_title(f"type {kind}", fontsize=9)
    figure.supxlabel("thickness (mm)")
    figure.supylabel("light that comes through")
    return figure
