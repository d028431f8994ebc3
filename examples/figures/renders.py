"""Renders after figures 6.24 to 6.29: skin that tans, in Blender, by tables and the add-on.

Blender runs in a process of its own (`scenes`); `shots` says what it renders.
"""

import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from blender_addon.model.views import VIEWS
from examples.figures import report, shots
from examples.figures.light import Effort, Task, Tick
from examples.figures.render_claims import (
    HEADINGS,
    face,
    matched,
    mild_beside_strong,
    month,
    plain,
    readings_rows,
    schedules,
    strong,
)
from examples.figures.render_results import Result, result
from examples.figures.render_sheet import sheet
from examples.figures.shots import UV, Shot
from examples.figures.spectral_shots import SpectralShot
from hylios.errors import InputError
from hylios.skin import Skin
from hylios.table import SkinTable
from lut_builder.assemble import build
from lut_builder.exr_writer import write_table
from lut_builder.settings import Settings

FIGURES = ("6.24", "6.25", "6.26", "6.27", "6.28", "6.29")

SETTINGS = Settings(knots=(9, 2, 2), profile_error=0.03, bands=(VIEWS[UV].nm,))
"""Settings of the tables: coarser than the standard preset, and of the bands only the view's."""

TABLE_AS_LONG = 4000
"""Wavelengths without noise that take as long as a table; only the time left follows from it."""

PICTURE_AS_LONG = 2000
"""Wavelengths without noise that take as long as a picture; only the time left follows from it."""


def tasks(effort: Effort) -> dict[str, Task]:
    """One task: tables, then renders in a process of their own.

    Raises
    ------
    InputError
        If there is no Blender.
    """
    wanted = of_figures(effort.wanted(FIGURES))
    skins = len(_tables(wanted))
    return rendering(
        "figures 6.24 to 6.29",
        lambda folder, tick: rendered(wanted, folder, effort, tick),
        skins * TABLE_AS_LONG + PICTURE_AS_LONG * len(wanted),
    )


def rendering(figures: str, work: Callable[[Path, Tick], list[Any]], size: int) -> dict[str, Task]:
    """One task that renders in a folder of its own.

    Raises
    ------
    InputError
        If there is no Blender.
    """
    if find_spec("bpy") is None:
        raise InputError(f"{figures} need Blender's Python module bpy.")

    def in_folder(tick: Tick) -> list[Any]:
        with tempfile.TemporaryDirectory() as folder:
            return work(Path(folder), tick)

    return {"renders": Task(in_folder, size)}


def rendered(
    wanted: Sequence[Shot],
    folder: Path,
    effort: Effort,
    tick: Tick,
    options: Sequence[str] = (),
) -> list[Result]:
    """Build the tables that shots need in a folder, render there, and read what came of it."""
    skins = shots.skins()
    tables = {name: table_of(skins[name], effort, tick) for name in _tables(wanted)}
    for name, table in tables.items():
        write_table(folder / f"{name}.exr", table)
    run_blender(wanted, folder, options, tick)
    return [result(shot, skins[shot.table], tables[shot.table], folder) for shot in wanted]


def of_figures(figures: Sequence[str]) -> list[Shot]:
    """The shots of some figures."""
    return [shot for shot in shots.shots() if shot.name.split()[0] in figures]


def _tables(wanted: Sequence[Shot]) -> list[str]:
    return sorted({shot.table for shot in wanted})


def table_of(skin: Skin, effort: Effort, tick: Tick) -> SkinTable:
    """The table of a skin."""
    table = build(skin, SETTINGS, seed=effort.seed, threads=effort.threads)
    tick(TABLE_AS_LONG)
    return table


def run_blender(
    wanted: Sequence[Shot] | Sequence[SpectralShot],
    folder: Path,
    options: Sequence[str],
    tick: Tick,
    module: str = "examples.figures.scenes",
) -> None:
    """Render shots into a folder that has what they need, by a module that is a command.

    Raises
    ------
    InputError
        If that fails; Blender's process has said why.
    """
    command = [sys.executable, "-m", module, str(folder), *options]
    with subprocess.Popen(
        [*command, *(shot.name for shot in wanted)], stdout=subprocess.PIPE, text=True
    ) as blender:
        for line in blender.stdout or ():
            if line.startswith(shots.DONE):
                tick(PICTURE_AS_LONG)
    if blender.returncode:
        raise InputError(f"Blender could not render the figures (status {blender.returncode}).")


def draw(results: Mapping[str, Sequence[Result]], folder: Path) -> list[report.Row]:
    """Draw the figures; returns what they say."""
    by_figure: dict[str, list[Result]] = {}
    for drawn in results["renders"]:
        by_figure.setdefault(drawn.shot.name.split()[0], []).append(drawn)
    rows = [*readings_rows(by_figure)]
    drawings = dict(zip(FIGURES, (schedules, plain, matched, strong, face, month), strict=True))
    for figure, drawn in by_figure.items():
        panels, more = drawings[figure](drawn)
        sheet(HEADINGS[figure], panels, folder / f"{figure}.png")
        rows += more
    if {"6.27", "6.28"} <= set(by_figure):
        rows.append(mild_beside_strong(by_figure["6.27"], by_figure["6.28"]))
    return sorted(rows, key=lambda row: FIGURES.index(row.where))
