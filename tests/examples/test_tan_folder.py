"""The example for a farm: a folder of files is tanned."""

import subprocess
import sys

import bpy
import pytest

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


def run(*arguments):
    return subprocess.run([*COMMAND, *map(str, arguments)], capture_output=True, text=True)


def test_a_folder_is_tanned(folder):
    out = folder / "out"
    done = run(folder / "in", "--out", out, "--schedule", folder / "sun.csv", "--skin", "II")
    assert done.returncode == 0, done.stderr
    bpy.ops.wm.open_mainfile(filepath=str(out / "nora.blend"))
    body = bpy.data.objects["Body of Nora"]
    group = next(group for group in bpy.data.node_groups if "skin_tan_layout" in group)
    assert group.users and body.animation_data.action is not None
    assert [path.name for path in out.iterdir()] == ["nora.blend"]
    stamp = (out / "nora.blend").stat().st_mtime_ns
    run(folder / "in", "--out", out)
    assert (out / "nora.blend").stat().st_mtime_ns == stamp


def test_one_that_cannot_be_read_stops_no_other(folder):
    (folder / "in" / "bad.blend").write_bytes(b"no blend")
    out = folder / "out"
    done = run(folder / "in", "--out", out)
    assert done.returncode == 2 and "bad.blend; all others are done" in done.stderr
    assert "Traceback" not in done.stderr
    assert [path.name for path in out.iterdir()] == ["nora.blend"]


def test_originals_are_never_written_over(folder):
    original = folder / "in" / "nora.blend"
    before = original.read_bytes()
    done = run(folder / "in", "--out", folder / "in" / ".." / "in", "--force")
    assert done.returncode == 2 and "the folder of the originals" in done.stderr
    assert original.read_bytes() == before and "Traceback" not in done.stderr


def test_a_character_that_cannot_be_tanned_has_no_copy(folder):
    bpy.ops.wm.open_mainfile(filepath=str(folder / "in" / "nora.blend"))
    bpy.data.objects["Body of Nora"]["tan_day"] = "a note"
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "in" / "nora.blend"))
    done = run(folder / "in", "--out", folder / "out")
    assert done.returncode == 2 and "nora.blend; all others are done" in done.stderr
    assert not list((folder / "out").iterdir()) and "holds no number" in done.stdout + done.stderr


@pytest.mark.parametrize(
    ("option", "value", "said"), [("--skin", "VII", "'VII'"), ("--days", "-3", "last day is -3")]
)
def test_a_wrong_value_is_a_sentence(folder, option, value, said):
    done = run(folder / "in", "--out", folder / "out", option, value)
    assert done.returncode == 2 and said in done.stderr and "Traceback" not in done.stderr
    assert not (folder / "out").exists()


def test_no_copy_is_made_where_nothing_tans(folder):
    done = run(folder / "in", "--out", folder / "out", "--objects", "Nobody*")
    assert done.returncode == 0 and not list((folder / "out").iterdir())


def test_an_empty_folder_is_said(tmp_path):
    done = run(tmp_path)
    assert done.returncode == 2 and "holds no .blend file" in done.stderr
    assert "Traceback" not in done.stderr
