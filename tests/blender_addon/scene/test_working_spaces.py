"""Session and reloaded file show the same colours, whatever space Blender works in."""

import json
import os
import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest

ROOT = Path(__file__).parents[3]
HERE = Path(__file__).parents[1]
SPACES = ("Linear Rec.709", "Linear Rec.2020", "ACEScg")
TO_SPACE = {
    "Linear Rec.709": np.eye(3),
    # Rec. ITU-R BT.2087-0, 4.2; and the same by primaries and white (D65 to D60 by Bradford).
    "Linear Rec.2020": np.array(
        [[0.6274, 0.3293, 0.0433], [0.0691, 0.9195, 0.0114], [0.0164, 0.0880, 0.8956]]
    ),
    "ACEScg": np.array(
        [[0.6131, 0.3395, 0.0474], [0.0702, 0.9164, 0.0134], [0.0206, 0.1096, 0.8698]]
    ),
}
SCRIPT = """
import json, os, sys
from pathlib import Path

sys.path.insert(0, sys.argv[1])
import bpy
import blender_addon
from scenes import add_camera, apply, render, tan_object

space, table, folder = sys.argv[2], sys.argv[3], Path(sys.argv[4])
bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
blender_addon.register()
if space:
    bpy.ops.wm.set_working_color_space(working_space=space, convert_colors=True)

def seen():
    material = bpy.data.objects["Body"].material_slots[0].material
    tree = material.node_tree
    group = next(node for node in tree.nodes if node.bl_idname == "ShaderNodeGroup")
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(group.outputs["Colour"], emission.inputs["Color"])
    tree.links.new(emission.outputs["Emission"], tree.nodes["Material Output"].inputs["Surface"])
    bpy.context.scene.frame_set(60)
    # Pixels as Blender works with them, not as it saves them.
    return render(folder / "one.exr", width=3, height=3)[1, 1].tolist()

obj = tan_object(Path(table))
apply(obj)
add_camera((0.5, 0.5, 5.0), 1.0)
first = seen()
obj.skin_tan.exposures[0].dose = 8.0
apply(obj)
again = seen()
bpy.ops.wm.save_as_mainfile(filepath=str(folder / "saved.blend"))
bpy.ops.wm.open_mainfile(filepath=str(folder / "saved.blend"))
reloaded = seen()
spaces = [image.colorspace_settings.name for image in bpy.data.images if image.packed_file]
print("RESULT" + json.dumps([first, again, reloaded, spaces]))
sys.stdout.flush()
os._exit(0)
"""
CONFIG = ROOT / "examples" / "truth" / "studio.ocio"


def shown(space: str, table_path: Path, folder: Path, **environment: str) -> list:
    """Colours after a first and a second Apply and after loading the file, and images' spaces."""
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, str(HERE), space, str(table_path), str(folder)],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, **environment},
        timeout=120,
    )
    (line,) = (line for line in done.stdout.splitlines() if line.startswith("RESULT"))
    return json.loads(line.removeprefix("RESULT"))


@pytest.fixture(scope="module")
def expected(table_path, tmp_path_factory):
    """The colours in Linear Rec.709, Blender's own working space."""
    return shown("", table_path, tmp_path_factory.mktemp("usual"))


def test_in_blender_s_usual_space(expected):
    first, again, reloaded, spaces = expected
    assert first != again == reloaded
    assert set(spaces) == {"Linear Rec.709", "Non-Color"}


@pytest.mark.skipif(bpy.app.version < (5, 0), reason="Blender 4.5 has one working space")
@pytest.mark.parametrize("space", SPACES[1:])
def test_in_another_working_space(space, expected, table_path, tmp_path):
    first, again, reloaded, _ = shown(space, table_path, tmp_path)
    assert first == pytest.approx(TO_SPACE[space] @ expected[0], abs=1e-4)
    assert again == pytest.approx(TO_SPACE[space] @ expected[1], abs=1e-4)
    assert reloaded == pytest.approx(again, abs=1e-6)


def test_under_a_studio_s_configuration(expected, table_path, tmp_path):
    first, again, reloaded, spaces = shown("", table_path, tmp_path, OCIO=str(CONFIG))
    assert set(spaces) == {"Linear Rec.709 (sRGB)", "Raw"}
    assert first == pytest.approx(TO_SPACE["ACEScg"] @ expected[0], abs=1e-4)
    assert again == pytest.approx(TO_SPACE["ACEScg"] @ expected[1], abs=1e-4)
    assert reloaded == pytest.approx(again, abs=1e-6)
