"""The add-on and the part of hylios that it carries need numpy alone."""

import subprocess
import sys

SCRIPT = """
import sys

class Refuse:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("numba", "colour", "OpenImageIO", "scipy", "lut_builder"):
            raise ImportError(f"{name} is refused here")

sys.meta_path.insert(0, Refuse())
import hylios
import hylios.tanning
import blender_addon

history = hylios.tanning.simulate(
    hylios.tanning.Exposures([0], [30.0]),
    hylios.tanning.PIGMENTATIONS["low"],
    mmd=5.0,
    med=3.0,
    hours=24,
)
assert history.total[-1] > 1.0
blender_addon.register()
blender_addon.unregister()
print("imported")
"""


def test_without_numba_colour_science_and_openimageio():
    done = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "imported" in done.stdout
