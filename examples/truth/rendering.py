"""Shots rendered by Blender in a process of its own."""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from examples.truth.shots import DONE, Shot
from hylios.errors import InputError

HERE = Path(__file__).parent

LONGEST = 1800.0
"""Seconds after which Blender is taken to hang."""

Lights = dict[str, dict[str, np.ndarray]]
"""Light in the pictures of shots, by their names, as `examples.truth.cycles.rendered` gives it."""


def rendered(shots: Sequence[Shot], progress: Callable[[str], object] | None = None) -> Lights:
    """Render shots; `progress` is told each one's name.

    Raises
    ------
    InputError
        If that fails; Blender's process has said why.
    """
    lights: Lights = {}
    for configuration in dict.fromkeys(shot.configuration for shot in shots):
        some = [shot for shot in shots if shot.configuration == configuration]
        lights |= _rendered(some, configuration, progress)
    return lights


def _rendered(
    shots: Sequence[Shot], configuration: str, progress: Callable[[str], object] | None
) -> Lights:
    """The same, where OpenColorIO, which Blender reads as it starts, is configured alike."""
    ocio = {"OCIO": str(HERE / configuration)} if configuration else {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        described = folder / "shots.json"
        described.write_text(json.dumps([shot.described for shot in shots]))
        command = [sys.executable, "-m", "examples.truth.cycles", str(described), str(folder)]
        with subprocess.Popen(
            command, stdout=subprocess.PIPE, text=True, env={**os.environ, **ocio}
        ) as blender:
            for line in blender.stdout or ():
                if progress and line.startswith(DONE):
                    progress(line.removeprefix(DONE).strip())
            status = blender.wait(LONGEST)
        if status:
            raise InputError(f"Blender could not render the pictures (status {status}).")
        return {shot.name: _read(folder / f"{shot.name}.npz") for shot in shots}


def _read(path: Path) -> dict[str, np.ndarray]:
    with np.load(path) as file:
        return dict(file)
