"""What the pages for artists and studios say holds in Blender, with the zip installed."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from blender_addon import package

ROOT = Path(__file__).parents[2]

PAINTED = """
import bpy

bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
bpy.ops.mesh.primitive_cube_add()
body = bpy.context.view_layer.objects.active
body.name = "Body"

bpy.ops.object.mode_set(mode="VERTEX_PAINT")
paint = body.data.color_attributes.active_color
assert (paint.name, paint.data_type) == ("Attribute", "BYTE_COLOR")
bpy.ops.object.mode_set(mode="OBJECT")
for corner, loop in zip(paint.data, body.data.loops):
    white = body.data.vertices[loop.vertex_index].co.z > 0
    corner.color = (white, white, white, 1)
body.data.attributes.active = body.data.attributes["Attribute"]
bpy.ops.geometry.attribute_convert(mode="GENERIC", domain="POINT", data_type="FLOAT")
bare = body.data.attributes["Attribute"]
assert (bare.domain, bare.data_type) == ("POINT", "FLOAT")
for vertex, value in zip(body.data.vertices, bare.data):
    assert value.value == float(vertex.co.z > 0)
bare.name = "bare"
bpy.ops.wm.save_as_mainfile(filepath="scene.blend")
"""
"""The artist's way to a mask, with the strokes of a brush replaced."""

CHECKED = """
assert body["tan_day"] == 0.0 and body.active_material.name == "Skin Tan Body"
assert len(body.skin_tan.exposures) > 1, "the schedule of a preset"
print("tanned", bpy.data.filepath)
"""


def script_of_the_studio(zip_path):
    """All blocks of the page, from top to bottom."""
    text = (ROOT / "docs" / "studio.md").read_text(encoding="utf-8")
    code = "".join(re.findall(r"```python\n(.*?)```", text, re.DOTALL))
    assert '"skin_tan-0.1.0.zip"' in code
    return code.replace('"skin_tan-0.1.0.zip"', repr(str(zip_path)))


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    return package.build(tmp_path_factory.mktemp("built"))


def test_a_painted_mask_and_the_scripts_of_the_studio(archive, tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", PAINTED + script_of_the_studio(archive) + CHECKED],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        # Blender 4.5 takes relative paths from PWD
        env={**os.environ, "BLENDER_USER_RESOURCES": str(tmp_path), "PWD": str(tmp_path)},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "tanned" in done.stdout
