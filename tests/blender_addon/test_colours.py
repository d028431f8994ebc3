"""A skin's colours made anew in Blender's Python, by what the add-on carries alone."""

import io
import os
import subprocess
import sys
import zipfile

import numpy as np

from blender_addon import package
from hylios.lab import colour
from hylios.table import read_table

STATES, FILES = 32, ("states.npy", "colours.npy")

SCRIPT = """
import sys
from pathlib import Path

carried, checkout = sys.argv[1], Path(sys.argv[2])
sys.path[:] = [entry for entry in sys.path if entry and Path(entry) != checkout]
sys.meta_path[:] = [finder for finder in sys.meta_path if "editable" not in repr(finder).lower()]
sys.path.insert(0, carried)

import time
from dataclasses import replace

import bpy
import numpy as np

import hylios
from hylios.adding import colours
from hylios.skin import Skin
from hylios.skin.specimen import SPECIMENS

assert Path(hylios.__file__).is_relative_to(carried), hylios.__file__
states = np.load(sys.argv[3])
appearance = colours(Skin.of(SPECIMENS["S3"]), states, count=8)
assert not {"numba", "scipy", "colour"} & set(sys.modules)
np.save(sys.argv[4], appearance.total)

for index in (1.5, 1.51, 1.52):  # all that depends on refraction is worked out anew
    changed = replace(SPECIMENS["S3"], corneum_refractive_index=index, papillary_blood=4.0)
    started = time.process_time()
    colours(Skin.of(changed), states, count=8)
    print(time.process_time() - started)
"""


def test_a_changed_skin_has_its_colours_in_a_second_in_blender(tmp_path):
    """Processor time of 32 states, at the best of three times; threads of BLAS are not limited
    from outside, and with them it would take several seconds. Colours are those of the shipped
    table, whose own noise is .2."""
    _, content = package.wheel_of_hylios()
    with zipfile.ZipFile(io.BytesIO(content)) as wheel:
        wheel.extractall(tmp_path / "carried")
    table = read_table(package.ADDON / "tables" / "S3.exr")
    states = table.axes.knot_states()[..., 0, :4].reshape(-1, 4)  # of the untanned blood
    sample = np.linspace(0, len(states) - 1, STATES).astype(int)
    np.save(tmp_path / "states.npy", states[sample])
    arguments = [tmp_path / "carried", package.ADDON.parent, *map(tmp_path.joinpath, FILES)]
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, *map(str, arguments)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    seconds = done.stdout.splitlines()[-3:]  # Blender may say something before
    assert min(map(float, seconds)) < 1.0
    stored = table.planes["total_colour"][..., 0, :].reshape(-1, 3)[sample]
    assert colour.difference(stored, np.load(tmp_path / "colours.npy")).mean() < 0.5
