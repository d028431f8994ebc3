"""Units in threads and processes: the same bytes; errors, Ctrl-C and SIGKILL."""

import os
import signal
import subprocess
import time
import traceback
from dataclasses import replace
from pathlib import Path

import pytest
from interruptions import environment, killed_and_resumed, units_in
from same_results import UNITS, same
from toy_work import command, die, fail, walk, walks

from hylios.errors import InputError
from lut_builder.jobs.local import in_processes, in_threads
from lut_builder.jobs.run import run_units
from lut_builder.jobs.unfinished import MARKER
from lut_builder.jobs.units import Unit


@pytest.mark.parametrize("runner", [in_threads(2), in_processes(1), in_processes(3)])
def test_threads_and_processes_give_the_same_bytes(undisturbed, runner):
    assert same(run_units(UNITS, None, "1", runner), undisturbed)


@pytest.mark.parametrize("runner", [in_threads(2), in_processes(2)])
def test_an_exception_of_a_unit_is_raised(runner):
    units = [Unit("a", fail, ("InputError",)), Unit("b", walk, (1, 2))]
    with pytest.raises(InputError, match="^it is 7.$"):
        run_units(units, None, "1", runner)
    units = [Unit("a", fail, ("ZeroDivisionError",)), Unit("b", walk, (1, 2))]
    with pytest.raises(ZeroDivisionError) as raised:
        run_units(units, None, "1", runner)
    assert "in fail" in "".join(traceback.format_exception(raised.value))


def test_a_process_that_dies_is_one_sentence_and_what_was_done_stays(tmp_path):
    units = [Unit("z", die, (), size=0.1), *UNITS]
    with pytest.raises(InputError, match="ended from outside; was there too little memory"):
        run_units(units, tmp_path, "1", in_processes(2))
    assert units_in(tmp_path) >= len(UNITS) - 1


def test_a_process_that_dies_while_others_wait_for_large_arguments_is_one_sentence():
    """More than a pipe holds, lest what feeds it waits for a reader that is gone."""
    units = [replace(unit, arguments=(*unit.arguments, bytes(10**6))) for unit in walks(12)]
    units.insert(3, Unit("z", die, (), size=1e9))
    with pytest.raises(InputError, match="ended from outside"):
        run_units(units, None, "1", in_processes(2))


def children(process):
    path = Path(f"/proc/{process}/task/{process}/children")
    return [int(number) for number in path.read_text().split()]


def require_gone(processes):
    """Wait for processes to end; the tracker that comes with them ends just after their parent."""
    until = time.monotonic() + 60.0
    while not all(gone(process) for process in processes):
        assert time.monotonic() < until
        time.sleep(0.01)


def gone(process):
    """Whether a process has ended; a zombie has."""
    try:
        return Path(f"/proc/{process}/stat").read_text().split()[2] == "Z"
    except (FileNotFoundError, ProcessLookupError):
        return True


def started(target, *arguments):
    """A running command of slow units, once it has done one."""
    running = subprocess.Popen(
        command(target, "--pause", "0.2", *arguments),
        stderr=subprocess.PIPE,
        text=True,
        env=environment(),
        start_new_session=True,
    )
    folder = target.with_name(target.name + ".unfinished")
    while not units_in(folder):
        assert running.poll() is None, running.communicate()
        time.sleep(0.01)
    return running, folder


@pytest.mark.parametrize("processes", [1, 2])
def test_ctrl_c_keeps_what_is_done_and_says_how_to_go_on(tmp_path, processes):
    """As a terminal sends it: to the command and its children."""
    target = tmp_path / "t.bin"
    running, folder = started(target, "--processes", processes)
    below = children(running.pid)
    os.killpg(running.pid, signal.SIGINT)
    _, said = running.communicate(timeout=60)
    assert running.returncode == 130
    assert 0 < units_in(folder) < 30
    assert said.splitlines()[-1] == (
        f"cancelled; what is done is kept in {folder}: give --resume to go on with it."
    )
    assert "Traceback" not in said
    assert len(below) == (0 if processes == 1 else 3)
    require_gone(below)
    others = [path.name for path in folder.iterdir() if path.suffix != ".unit"]
    assert others == [MARKER]
    assert not target.exists()


@pytest.mark.slow
def test_ctrl_c_while_processes_start_is_quiet(tmp_path):
    """At moments from the first sign of life on; nothing is kept, so nothing is said of it."""
    target = tmp_path / "t.bin"
    for moment in range(4):
        running = subprocess.Popen(
            command(target, "--pause", "9", "--processes", "2"),
            stderr=subprocess.PIPE,
            text=True,
            env=environment(),
            start_new_session=True,
        )
        read = running.stderr.read(20)
        time.sleep(0.04 * moment)
        os.killpg(running.pid, signal.SIGINT)
        said = read + running.communicate(timeout=60)[1]
        assert running.returncode == 130
        assert said.endswith("\ncancelled\n")
        assert "Traceback" not in said
        assert os.listdir(tmp_path) == []


def test_children_end_with_a_killed_parent(tmp_path):
    running, _ = started(tmp_path / "t.bin", "--processes", "2")
    below = children(running.pid)
    assert len(below) == 3
    running.kill()
    running.communicate(timeout=60)
    require_gone(below)


def killed_file(tmp_path, *, kills, processes, count, pause):
    """Bytes of an undisturbed file and of one whose command was killed again and again."""
    whole, killed = tmp_path / "whole.bin", tmp_path / "killed.bin"
    subprocess.run(
        command(whole, "--count", count), check=True, capture_output=True, env=environment()
    )
    killing = command(
        killed, "--resume", "--count", count, "--processes", processes, "--pause", pause
    )
    assert killed_and_resumed(killing, killed, kills, seed=processes, pause=pause) == kills
    assert sorted(os.listdir(tmp_path)) == ["killed.bin", "whole.bin"]
    return whole.read_bytes(), killed.read_bytes()


@pytest.mark.parametrize("kills", [2, pytest.param(20, marks=pytest.mark.slow)])
def test_killed_at_random_moments_and_resumed_the_file_is_the_same_bytes(tmp_path, kills):
    whole, killed = killed_file(tmp_path, kills=kills, processes=1, count=70, pause=0.02)
    assert killed == whole


@pytest.mark.slow
def test_killed_with_two_processes_the_file_is_the_same_bytes(tmp_path):
    whole, killed = killed_file(tmp_path, kills=20, processes=2, count=120, pause=0.1)
    assert killed == whole
