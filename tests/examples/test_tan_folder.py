"""The example for a farm: a folder of files is tanned."""

import subprocess
import sys

import bpy
import pytest

import blender_addon
from examples import tan_folder
from hylios.commands import shell

COMMAND = [sys.executable, "-m", "examples.tan_folder"]


@pytest.fixture
def folder(tmp_path):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=8, ring_count=6)
    bpy.context.object.name = "Body of Nora"
    (tmp_path / "in").mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "in" / "nora.blend"))
    (tmp_path / "sun.csv").write_text("day,SED\n0,20\n1,10\n")
    return tmp_path


@pytest.fixture
def run(capfd):
    """Run the command in this process: its status and all that it says."""

    def told(*arguments):
        status = shell.run(tan_folder.tan_folder, tan_folder.parser().parse_args(arguments))
        return status, "".join(capfd.readouterr())

    yield lambda *arguments: told(*map(str, arguments))
    if hasattr(bpy.types.Object, "skin_tan"):
        blender_addon.unregister()


def test_a_folder_is_tanned(folder, run):
    out = folder / "out"
    schedule = "--schedule", folder / "sun.csv", "--skin", "II"
    command = [*COMMAND, *map(str, (folder / "in", "--out", out, *schedule))]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    bpy.ops.wm.open_mainfile(filepath=str(out / "nora.blend"))
    body = bpy.data.objects["Body of Nora"]
    group = next(group for group in bpy.data.node_groups if "skin_tan_layout" in group)
    assert group.users and body.animation_data.action is not None
    assert [path.name for path in out.iterdir()] == ["nora.blend"]
    stamp = (out / "nora.blend").stat().st_mtime_ns
    run(folder / "in", "--out", out)
    assert (out / "nora.blend").stat().st_mtime_ns == stamp


def test_one_that_cannot_be_read_stops_no_other(folder, run):
    (folder / "in" / "bad.blend").write_bytes(b"no blend")
    out = folder / "out"
    status, said = run(folder / "in", "--out", out)
    assert status == 2 and "bad.blend; all others are done" in said
    assert [path.name for path in out.iterdir()] == ["nora.blend"]


def test_originals_are_never_written_over(folder, run):
    original = folder / "in" / "nora.blend"
    before = original.read_bytes()
    status, said = run(folder / "in", "--out", folder / "in" / ".." / "in", "--force")
    assert status == 2 and "the folder of the originals" in said
    assert original.read_bytes() == before


def test_a_character_that_cannot_be_tanned_has_no_copy(folder, run):
    bpy.ops.wm.open_mainfile(filepath=str(folder / "in" / "nora.blend"))
    bpy.data.objects["Body of Nora"]["tan_day"] = "a note"
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "in" / "nora.blend"))
    status, said = run(folder / "in", "--out", folder / "out")
    assert status == 2 and "nora.blend; all others are done" in said
    assert not list((folder / "out").iterdir()) and "holds no number" in said


@pytest.mark.parametrize(
    ("option", "value", "said"), [("--skin", "VII", "'VII'"), ("--days", "-3", "last day is -3")]
)
def test_a_wrong_value_is_a_sentence(folder, run, option, value, said):
    status, told = run(folder / "in", "--out", folder / "out", option, value)
    assert status == 2 and said in told
    assert not (folder / "out").exists()


def test_no_copy_is_made_where_nothing_tans(folder, run):
    status, _ = run(folder / "in", "--out", folder / "out", "--objects", "Nobody*")
    assert status == 0 and not list((folder / "out").iterdir())


def test_an_empty_folder_is_said(tmp_path, run):
    status, said = run(tmp_path)
    assert status == 2 and "holds no .blend file" in said
