"""Examples as commands: help is printed, and nothing is measured or rendered for it."""

import subprocess
import sys

import pytest

COMMANDS = [
    "demo",
    pytest.param("gallery", marks=pytest.mark.slow),
    *(
        pytest.param(command, marks=pytest.mark.slow)
        for command in (
            *("bench", "bench_blender", "simplifications", "simplifications.quadrature"),
            *("truth.film_fit", "truth.layer"),
        )
    ),
]
"""Those without a parser of options that their other tests use."""


@pytest.mark.parametrize("command", COMMANDS)
def test_help_is_printed_at_once(command):
    ended = subprocess.run(
        [sys.executable, "-m", f"examples.{command}", "--help"], capture_output=True, text=True
    )
    assert (ended.returncode, ended.stderr) == (0, "")
    assert ended.stdout.startswith("usage: ") and "examples" in ended.stdout
