"""A saved .blend renders the same without the add-on and with scripts off."""

import subprocess
import sys

import bpy
import numpy as np
import pytest
from artist_skins import layered
from scenes import add_camera, read_pixels, render, tan_object, white_world

FRAMES = (1, 90)
SCRIPT = """
import sys
import bpy

blend, *outputs = sys.argv[1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.preferences.filepaths.use_scripts_auto_execute = False
bpy.ops.wm.open_mainfile(filepath=blend, load_ui=False, use_scripts=False)
assert not hasattr(bpy.types.Object, "skin_tan")
for output in outputs:
    frame, path = output.split("=")
    bpy.context.scene.frame_set(int(frame))
    bpy.context.scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
assert not {"blender_addon", "hylios", "lut_builder"} & set(sys.modules)
"""


@pytest.mark.parametrize(
    ("view", "materials"), [("VISIBLE", ()), ("NM365", ()), ("VISIBLE", (layered,))]
)
def test_the_render_needs_no_add_on(tmp_path, table_path, view, materials):
    """With a material of ours, and with one of the artist's, recoloured in its groups."""
    settings = tan_object(table_path).skin_tan
    bpy.ops.mesh.primitive_monkey_add()
    body = bpy.context.object
    body.skin_tan.skin, body.skin_tan.table_path = "FILE", settings.table_path
    body.skin_tan.exposures.add().dose = 30.0
    body.skin_tan.film, body.skin_tan.own_colour = "OIL", True
    body.skin_tan.peeling = not materials
    for make in materials:
        body.data.materials.append(make("skin"))
    bare = body.vertex_groups.new(name="Bare")
    bare.add([vertex.index for vertex in body.data.vertices if vertex.co.x > 0], 1.0, "REPLACE")
    body.skin_tan.mask.source = "Bare"
    body.skin_tan.regions.add().kind = "FRECKLES"
    bpy.ops.skin_tan.add_region(kind="FLUSH", strength=0.1, mask="Bare")
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    bpy.context.scene.skin_tan.view = view
    white_world()
    add_camera((0.0, 0.0, 5.0), 3.0)
    inside = [render(tmp_path / f"inside{frame}.exr", **size(frame)) for frame in FRAMES]
    blend = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(blend))

    outputs = [f"{frame}={tmp_path / f'outside{frame}.exr'}" for frame in FRAMES]
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, str(blend), *outputs], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    outside = [read_pixels(tmp_path / f"outside{frame}.exr") for frame in FRAMES]
    assert np.array_equal(inside, outside)
    # The half in the sun is darker after ten days, the other is not.
    before, after = outside
    assert after[20:40, 36:44].mean() < 0.9 * before[20:40, 36:44].mean()
    assert abs(after[20:40, 20:28].mean() - before[20:40, 20:28].mean()) < 0.01


def size(frame: int) -> dict:
    bpy.context.scene.frame_set(frame)
    return {"width": 64, "height": 64, "samples": 8}
