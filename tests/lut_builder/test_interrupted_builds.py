"""A build that is killed again and again makes the same file as one that is left alone."""

import subprocess
import sys

import pytest
from interruptions import environment, killed_and_resumed

from lut_builder.cli import main

WORK = "--skin III --knots 3 --bands visible,365 --profile-error 0.1".split()


def command(target, *more):
    build = [sys.executable, "-m", "lut_builder.cli", "build", *WORK]
    return [*build, *more, "-o", str(target)]


def killed(tmp_path, kills):
    undisturbed, target = tmp_path / "undisturbed.exr", tmp_path / "killed.exr"
    subprocess.run(command(undisturbed), check=True, capture_output=True, env=environment())
    done = killed_and_resumed(command(target, "--resume"), target, kills, seed=4, pause=0.2)
    assert target.read_bytes() == undisturbed.read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["killed.exr", "undisturbed.exr"]
    return done


def test_killed_twice_and_resumed(tmp_path):
    assert killed(tmp_path, 2) == 2


@pytest.mark.slow
def test_killed_at_20_random_moments_and_resumed(tmp_path):
    assert killed(tmp_path, 20) > 3


def test_threads_do_not_change_the_file(tmp_path, monkeypatch):
    """In this process, and in two others."""
    monkeypatch.setattr("lut_builder.cli.SHORT", 0.0)
    for threads in ("1", "2"):
        path = tmp_path / f"{threads}.exr"
        assert main(["build", *WORK, "--threads", threads, "-o", str(path)]) == 0
    assert (tmp_path / "1.exr").read_bytes() == (tmp_path / "2.exr").read_bytes()


def test_unfinished_work_is_told(tmp_path, capsys):
    target = tmp_path / "t.exr"
    folder = tmp_path / "t.exr.unfinished"
    folder.mkdir()
    (folder / "colours-0.unit").write_bytes(b"half")
    assert main(["build", *WORK, "-o", str(target)]) == 2
    assert "give --resume to go on with it, or --force to begin anew" in capsys.readouterr().err
    assert main(["build", *WORK, "-o", str(target), "--force"]) == 0
    assert target.exists() and not folder.exists()
