"""A build that is killed again and again makes the same file as one that is left alone."""

import sys

import pytest
from interruptions import killed_and_resumed

from lut_builder.cli import main
from lut_builder.jobs.unfinished import MARKER, unit_file

WORK = "--skin III --preset preview --knots 2 --bands visible,365 --profile-error 0.1".split()
SHORT_WORK = "--knots 1 --wavelengths 4 --bands visible --no-profile".split()


def command(target, *more):
    build = [sys.executable, "-m", "lut_builder.cli", "build", *WORK]
    return [*build, *more, "-o", str(target)]


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """Content of the file, made in this process alone."""
    path = tmp_path_factory.mktemp("undisturbed") / "t.exr"
    assert main(["build", *WORK, "--threads", "1", "-o", str(path)]) == 0
    return path.read_bytes()


def killed(tmp_path, kills, undisturbed):
    target = tmp_path / "killed.exr"
    done = killed_and_resumed(command(target, "--resume"), target, kills, seed=4, pause=0.2)
    assert target.read_bytes() == undisturbed
    assert [path.name for path in tmp_path.iterdir()] == ["killed.exr"]
    return done


@pytest.mark.slow
def test_killed_and_resumed(tmp_path, undisturbed):
    assert killed(tmp_path, 1, undisturbed) == 1


@pytest.mark.slow
def test_killed_at_20_random_moments_and_resumed(tmp_path, undisturbed):
    assert killed(tmp_path, 20, undisturbed) == 20


@pytest.mark.slow
def test_threads_do_not_change_the_file(tmp_path, monkeypatch, undisturbed):
    """In two other processes."""
    monkeypatch.setattr("lut_builder.commands.build.SHORT", 0.0)
    path = tmp_path / "t.exr"
    assert main(["build", *WORK, "--threads", "2", "-o", str(path)]) == 0
    assert path.read_bytes() == undisturbed


def test_unfinished_work_is_told(tmp_path, capsys):
    target = tmp_path / "t.exr"
    folder = tmp_path / "t.exr.unfinished"
    folder.mkdir()
    (folder / MARKER).touch()
    unit_file(folder, "colours-0").write_bytes(b"half")
    assert main(["build", *SHORT_WORK, "-o", str(target)]) == 2
    assert "give --resume to go on with it, or --force to begin anew" in capsys.readouterr().err
    assert main(["build", *SHORT_WORK, "-o", str(target), "--force"]) == 0
    assert target.exists() and not folder.exists()
