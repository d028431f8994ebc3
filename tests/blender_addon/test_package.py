"""The extension's zip, built and validated by Blender's own tool and installed from there."""

import os
import subprocess
import sys
import tomllib
import zipfile

import pytest

import hylios
from blender_addon import package
from hylios.errors import InputError

SCRIPT = """
import sys
from pathlib import Path

# The checkout must not be found: what is imported has to come from the zip.
checkout = Path(sys.argv[2])
sys.path[:] = [entry for entry in sys.path if entry and Path(entry) != checkout]
sys.meta_path[:] = [finder for finder in sys.meta_path if "editable" not in repr(finder).lower()]

import bpy

bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
bpy.ops.extensions.package_install_files(
    filepath=sys.argv[1], repo="user_default", enable_on_install=True
)
import hylios.tanning

resources = Path(bpy.utils.resource_path("USER"))
assert resources in Path(hylios.tanning.__file__).parents, hylios.tanning.__file__
addon = sys.modules["bl_ext.user_default.skin_tan"]
assert resources in Path(addon.__file__).parents, addon.__file__
assert not {"blender_addon", "lut_builder", "numba", "colour", "OpenImageIO"} & set(sys.modules)

bpy.ops.mesh.primitive_monkey_add()
body = bpy.context.object
body.skin_tan.skin = "S3"
bpy.ops.skin_tan.add_exposure()
assert bpy.ops.skin_tan.apply() == {"FINISHED"}
assert body.material_slots[0].material.name == "Skin Tan Suzanne"
print("applied")
"""


@pytest.fixture(scope="module")
def archive(tmp_path_factory, table_path):
    return package.build(tmp_path_factory.mktemp("dist"), table_path.parent)


def test_the_zip_holds_what_blender_needs(archive):
    with zipfile.ZipFile(archive) as opened:
        names = set(opened.namelist())
        manifest = tomllib.loads(opened.read("blender_manifest.toml").decode())
        (wheel,) = (name for name in names if name.endswith(".whl"))
        assert {"__init__.py", "panels.py", "tables/S3.exr"} <= names
        assert "package.py" not in names
        assert manifest["wheels"] == [f"./{wheel}"]
        assert manifest["version"] == hylios.__version__
        with opened.open(wheel) as inner, zipfile.ZipFile(inner) as unpacked:
            modules = {name for name in unpacked.namelist() if name.startswith("hylios/")}
    assert modules == {f"hylios/{name}" for name in package.hylios_files()}


def test_the_zip_can_be_installed_and_applied(archive, tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, str(archive), str(package.ADDON.parent)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={**os.environ, "BLENDER_USER_RESOURCES": str(tmp_path)},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "applied" in done.stdout


def test_what_the_tool_refuses_is_said_in_a_sentence(tmp_path):
    with pytest.raises(InputError, match="Blender's extension tool refuses to validate: .*absent"):
        package._extension_tool("validate", str(tmp_path / "absent.zip"))
