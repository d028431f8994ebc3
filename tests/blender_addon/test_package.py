"""The extension's zip: what is in it, the same bytes everywhere, installed by Blender."""

import base64
import hashlib
import io
import os
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

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
def archive(tmp_path_factory):
    return package.build(tmp_path_factory.mktemp("dist"))


def checkout(folder, when):
    """A git checkout of the packed files in a new folder, changed at a time given in seconds."""
    for name in [*package.tracked(package.ROOT, "."), *package.untracked()]:
        if name.split("/")[0] in {"blender_addon", "hylios", "LICENSE"}:
            target = folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(package.ROOT / name, target)
            os.utime(target, (when, when))
    git = {name: text for name, text in os.environ.items() if not name.startswith("GIT_")}
    for command in (["init", "-q"], ["add", "."]):
        subprocess.run(["git", "-C", folder, *command], check=True, env=git)
    return folder


def packed(root, destination, umask, settings):
    """The zip that a process of its own makes of a checkout, as bytes."""
    done = subprocess.run(
        [sys.executable, "-m", "blender_addon.package", "--output-dir", str(destination)],
        cwd=root,
        env={**os.environ, "PYTHONPATH": str(root), **settings},
        umask=umask,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    (path,) = destination.iterdir()
    assert Path(done.stdout.splitlines()[-1]) == path
    return path.read_bytes(), done.stderr


def test_the_zip_holds_what_blender_needs(archive):
    with zipfile.ZipFile(archive) as opened:
        names = set(opened.namelist())
        manifest = tomllib.loads(opened.read("blender_manifest.toml").decode())
        (wheel,) = (name for name in names if name.endswith(".whl"))
        assert {"__init__.py", "tables/S3.exr", "LICENSE"} <= names
        assert "package.py" not in names
        assert opened.read("LICENSE") == (package.ROOT / "LICENSE").read_bytes()
        assert manifest["wheels"] == [f"./{wheel}"]
        assert manifest["version"] == hylios.__version__
        assert "writes" in manifest["permissions"]["files"]
        with opened.open(wheel) as inner, zipfile.ZipFile(inner) as unpacked:
            contents = {name: unpacked.read(name) for name in unpacked.namelist()}
    assert archive.name == f"skin_tan-{hylios.__version__}.zip"
    modules = {name for name in contents if name.startswith("hylios/")}
    assert modules == {f"hylios/{name}" for name in package.hylios_files()}
    rooms = {name.split("/")[1] for name in modules}
    assert {"skin", "tanning", "table", "adding"} <= rooms
    assert not rooms & {"lab", "transport", "commands"}


def test_the_wheel_records_its_files_and_the_licence():
    name, content = package.wheel_of_hylios()
    with zipfile.ZipFile(io.BytesIO(content)) as wheel:
        files = {name: wheel.read(name) for name in wheel.namelist()}
    information = "-".join(name.split("-")[:2]) + ".dist-info"
    record = files.pop(f"{information}/RECORD").decode().splitlines()
    assert record.pop() == f"{information}/RECORD,,"
    lines = (line.rsplit(",", 2) for line in record)
    recorded = {path: (digest, int(size)) for path, digest, size in lines}
    assert recorded == {
        path: (
            "sha256="
            + base64.urlsafe_b64encode(hashlib.sha256(text).digest()).decode().rstrip("="),
            len(text),
        )
        for path, text in files.items()
    }
    licence = files[f"{information}/licenses/LICENSE"]
    assert licence == (package.ROOT / "LICENSE").read_bytes()
    assert "License-File: LICENSE" in files[f"{information}/METADATA"].decode()


def test_two_builds_are_the_same_bytes_and_hold_tracked_files_only(tmp_path):
    """In other folders, at other times, under other umasks and hours, from sources of other ages;
    an editor's lock and a private table lie in one of them."""
    one = checkout(tmp_path / "one", 1_000_000_000)
    two = checkout(tmp_path / "two" / "deeper", 1_500_000_001)
    (two / "blender_addon" / ".#apply.py").symlink_to("someone@machine.1234")
    tables = two / "blender_addon" / "tables"
    shutil.copyfile(tables / "S3.exr", tables / "private.exr")
    (two / "hylios" / "__pycache__").mkdir(exist_ok=True)
    (two / "hylios" / "skin" / "notes.txt").write_text("private")
    first, said = packed(one, tmp_path / "first", 0o022, {"TZ": "UTC"})
    assert "private" not in said
    second, said = packed(two, tmp_path / "second", 0o077, {"TZ": "Asia/Tokyo"})
    assert "git does not track it: blender_addon/tables/private.exr\n" in said
    assert first == second
    assert not any(name in second for name in (b"private.exr", b"notes.txt", b".#apply.py"))


@pytest.mark.parametrize("made", [False, True], ids=["no checkout", "nothing tracked"])
def test_outside_a_checkout_nothing_is_packed(tmp_path, made):
    if made:
        subprocess.run(["git", "init", "-q", tmp_path], check=True)
    with pytest.raises(InputError, match="The zip holds what git tracks, and "):
        package.build(tmp_path / "dist", tmp_path)
    assert not (tmp_path / "dist").exists()


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
        package.extension_tool("validate", str(tmp_path / "absent.zip"))
