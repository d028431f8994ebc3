"""What only whole tables tell: the time of a start, and what 16 bits do to a file."""

import os
import resource
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from hylios.lab.colour import difference
from hylios.skin import Skin
from lut_builder.assemble import assembled, requested
from lut_builder.exr_writer import write_table
from lut_builder.request import computed, pieces
from lut_builder.settings import Settings


def start_seconds(has_profile: bool, repeats: int) -> float:
    """Seconds of a table of one state in a process of its own; of some the fastest."""
    with tempfile.TemporaryDirectory() as folder:
        arguments = ["build", "--preset", "preview", "--knots", "1", "--wavelengths", "4"]
        arguments += ["--bands", "visible", "--force", "-o", str(Path(folder) / "start.exr")]
        arguments += [] if has_profile else ["--no-profile"]
        seconds = []
        for _ in range(repeats):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run(
                [sys.executable, "-m", "lut_builder.cli", *arguments],
                check=True,
                capture_output=True,
            )
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(seconds)


def half_against_full(
    skin: Skin, settings: Settings, states: np.ndarray, seed: int
) -> tuple[np.ndarray, dict[str, int]]:
    """CIEDE2000 (N,) that numbers of 16 bits make, and bytes of the file by kind of number."""
    request = requested(skin, settings, seed=seed)
    table = assembled(request, {piece.name: computed(request, piece) for piece in pieces(request)})
    rounded = {
        name: values.astype(np.float16).astype(float)
        for name, values in table.planes.items()
        if name == "total_colour"
    }
    apart = difference(
        replace(table, planes=rounded).plane("total_colour", states),
        table.plane("total_colour", states),
    )
    sizes = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in ("float", "half"):
            path = Path(folder) / f"{name}.exr"
            write_table(path, table, half=name == "half")
            sizes[name] = os.path.getsize(path)
    return apart, sizes
