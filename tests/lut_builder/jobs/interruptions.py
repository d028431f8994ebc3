"""Killing a command that makes a file in units of work, for the tests of any such command."""

import os
import subprocess
import time
from pathlib import Path

import numpy as np


def environment():
    """Environment of a command that imports this project and the modules of these tests."""
    here = Path(__file__).parent
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(here.parents[2]), str(here)])}


def units_in(folder):
    """Number of units that are done."""
    return len(list(folder.glob("skin-tan-*.unit"))) if folder.is_dir() else 0


def killed_and_resumed(command, target, kills, seed, pause):
    """Start a command again and again, kill it each time, and let the last run end.

    Each is killed by SIGKILL at a random moment: up to `pause` seconds after it has done none to
    two more units, which hits the start, the units, the keeping of them and the pauses between.
    One that has ended by then, as on a busy machine it may have, is begun anew.

    Parameters
    ----------
    command : list of str
        It resumes unfinished work.
    target : Path
        Of the file that it makes; units are in the folder of `lut_builder.jobs.unfinished`.
    pause : float
        About the time of a unit in seconds.

    Returns
    -------
    int
        How many runs were killed, of twice as many as there are to be.
    """
    random, folder = np.random.default_rng(seed), target.with_name(target.name + ".unfinished")
    killed = 0
    for _ in range(2 * kills):
        enough = units_in(folder) + random.integers(0, 3)
        with subprocess.Popen(command, stderr=subprocess.PIPE, env=environment()) as running:
            while running.poll() is None and units_in(folder) < enough:
                time.sleep(0.002)
            time.sleep(random.uniform(0.0, pause))
            running.kill()
        assert running.returncode in (0, -9)
        killed += running.returncode == -9
        target.unlink(missing_ok=True)
        if killed == kills:
            break
    subprocess.run(command, check=True, capture_output=True, env=environment(), timeout=120)
    return killed
