"""The folder of unfinished work: whose it is, and what in it is removed."""

import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest
from interruptions import environment, units_in
from same_results import UNITS, in_folder
from toy_work import command, main, walks

from hylios.errors import InputError
from lut_builder.jobs.local import in_threads
from lut_builder.jobs.run import run_units
from lut_builder.jobs.software import software_digest
from lut_builder.jobs.unfinished import MARKER, Interrupted, unfinished


def left_behind(tmp_path, *, units=3):
    """A target whose work is unfinished, and its folder."""
    target = tmp_path / "t.bin"
    with (
        pytest.raises(Interrupted) as interrupt,
        unfinished(target, (".bin",), resume=False, replace=False) as work,
    ):
        run_units(walks(30)[:units], work.folder, software_digest(), in_threads(1))
        raise KeyboardInterrupt
    (work.folder / ".skin-tan-half.unit").write_bytes(b"half")
    assert interrupt.value.folder == work.folder
    return target, work.folder


def test_unfinished_work_is_neither_used_nor_thrown_away_unasked(tmp_path, capsys):
    target, folder = left_behind(tmp_path)
    assert run_toy(target) == 2
    assert capsys.readouterr().err == (
        f"error: there is unfinished work in {folder}; "
        "give --resume to go on with it, or --force to begin anew.\n"
    )
    assert units_in(folder) == 3


@pytest.mark.parametrize(
    ("arguments", "taken"), [(["--resume"], 3), (["--force"], 0), (["--resume", "--force"], 3)]
)
def test_unfinished_work_goes_on_or_begins_anew(tmp_path, capsys, arguments, taken):
    target, _ = left_behind(tmp_path)
    assert run_toy(target, *arguments) == 0
    assert f"walks, {taken} of 30 " in capsys.readouterr().err
    assert os.listdir(tmp_path) == ["t.bin"]


def run_toy(target, *arguments):
    sys.argv = ["toy", str(target), *arguments]
    return main()


def test_a_run_killed_between_its_target_and_its_folder_can_be_resumed(tmp_path):
    target, _ = left_behind(tmp_path)
    target.write_bytes(b"written")
    assert run_toy(target) == 2
    assert run_toy(target, "--resume") == 0
    assert os.listdir(tmp_path) == ["t.bin"]
    assert target.read_bytes() != b"written"


def test_resume_with_nothing_to_resume_begins(tmp_path):
    assert run_toy(tmp_path / "t.bin", "--resume") == 0


@pytest.mark.parametrize("arguments", [[], ["--resume"]])
def test_an_existing_target_stays(tmp_path, capsys, arguments):
    target = tmp_path / "t.bin"
    target.write_bytes(b"former")
    assert run_toy(target, *arguments) == 2
    assert "exists already; --force replaces it" in capsys.readouterr().err
    assert target.read_bytes() == b"former"
    assert run_toy(target, *arguments, "--force") == 0
    assert target.read_bytes() != b"former"


def test_only_one_process_is_at_work_in_a_folder(tmp_path):
    target = tmp_path / "t.bin"
    with unfinished(target, (".bin",), resume=True, replace=False) as work:
        with (
            pytest.raises(InputError, match="another process is at work in"),
            unfinished(target, (".bin",), resume=True, replace=True),
        ):
            pass
        work.result.write_bytes(b"whole")
    assert os.listdir(tmp_path) == ["t.bin"]


@pytest.mark.parametrize("below", ["file/t.bin", "none/t.bin"])
def test_a_target_that_cannot_be_written_is_one_sentence(tmp_path, capsys, below):
    (tmp_path / "file").write_bytes(b"")
    assert run_toy(tmp_path / below) == 2
    said = capsys.readouterr().err
    assert said.startswith("error: ") and said.count("\n") == 1
    assert os.listdir(tmp_path) == ["file"]


HOME = (".bashrc", ".profile", ".half.unit", "t.bin", "letter.txt", "colours-0.unit")


def home(folder):
    """A folder with what people keep, and what it holds."""
    folder.mkdir()
    (folder / ".ssh").mkdir()
    for name in (*HOME, ".ssh/id"):
        (folder / name).write_bytes(name.encode())
    return contents(folder)


def contents(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("arguments", [[], ["--resume"], ["--force"], ["--resume", "--force"]])
@pytest.mark.parametrize("linked", [False, True])
def test_a_folder_of_someone_else_s_is_refused_and_stays(tmp_path, capsys, arguments, linked):
    folder = tmp_path / "t.bin.unfinished"
    before = home(tmp_path / "home" if linked else folder)
    if linked:
        folder.symlink_to(tmp_path / "home")
    assert run_toy(tmp_path / "t.bin", *arguments) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and str(folder) in said
    assert ("is a link" if linked else "did not make it") in said
    assert contents(tmp_path) == before


def test_a_link_to_a_folder_of_ours_is_refused_too(tmp_path, capsys):
    target, folder = left_behind(tmp_path)
    folder.rename(tmp_path / "elsewhere")
    folder.symlink_to(tmp_path / "elsewhere")
    assert run_toy(target, "--resume") == 2
    assert "is a link; expected is a folder that skin-tan made" in capsys.readouterr().err
    assert units_in(tmp_path / "elsewhere") == 3


def test_files_that_someone_puts_into_our_folder_stay(tmp_path):
    target, folder = left_behind(tmp_path)
    for name in HOME:
        (folder / name).write_bytes(name.encode())
    assert run_toy(target, "--resume") == 0
    assert target.exists()
    assert sorted(path.name for path in folder.iterdir()) == sorted([*HOME, MARKER])
    assert run_toy(target, "--force") == 0


def test_a_folder_that_cannot_be_made_is_one_sentence(tmp_path, capsys):
    (tmp_path / "t.bin.unfinished").write_bytes(b"a file")
    assert run_toy(tmp_path / "t.bin") == 2
    assert "t.bin.unfinished cannot be made: File exists." in capsys.readouterr().err
    assert (tmp_path / "t.bin.unfinished").read_bytes() == b"a file"


def test_a_full_disk_is_one_sentence_and_leaves_nothing_half_written(tmp_path):
    """A limit on the size of files stands in for the disk."""
    target = tmp_path / "t.bin"
    running = subprocess.run(
        command(target, "--processes", "2"),
        capture_output=True,
        text=True,
        # Else the interpreter might keep half of a compiled module.
        env={**environment(), "PYTHONDONTWRITEBYTECODE": "1"},
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300)),
    )
    assert running.returncode == 2
    last = running.stderr.splitlines()[-1]
    assert last.startswith("error: ") and last.endswith("cannot be written: File too large.")
    assert "Traceback" not in running.stderr
    assert os.listdir(tmp_path) == []


def test_no_space_for_a_unit_keeps_those_before(tmp_path, monkeypatch):
    real = Path.write_bytes

    def write(path, content):
        if units_in(tmp_path) == 4:
            real(path, content[: len(content) // 2])
            raise OSError(28, "No space left on device")
        return real(path, content)

    monkeypatch.setattr(Path, "write_bytes", write)
    with pytest.raises(InputError, match="cannot be written: No space left on device.$"):
        run_units(UNITS, tmp_path, "1", in_threads(1))
    monkeypatch.undo()
    assert len(os.listdir(tmp_path)) == 4
    assert len(in_folder(tmp_path)[0]) == len(UNITS) - 4
