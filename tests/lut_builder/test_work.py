"""Long work in units: kept, trusted, resumed, interrupted; the same bytes whoever did it."""

import os
import resource
import signal
import subprocess
import sys
import time
import traceback
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest
from interruptions import environment, killed_and_resumed, units_in
from toy_work import command, die, fail, main, walk, walks

import hylios
from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS
from lut_builder.jobs.work import (
    Unit,
    done,
    in_processes,
    in_threads,
    performed,
    software_digest,
    unfinished,
    unit_digest,
    unpacked,
)

UNITS = walks(8)


def same(one, other):
    """Whether results are equal to the last bit, in the same order."""
    return [
        (unit, name, array.dtype.str, array.shape, array.tobytes())
        for unit, arrays in one.items()
        for name, array in arrays.items()
    ] == [
        (unit, name, array.dtype.str, array.shape, array.tobytes())
        for unit, arrays in other.items()
        for name, array in arrays.items()
    ]


def counting(performed_units):
    """A runner that notes what it did."""

    def run(units, software):
        for unit in units:
            performed_units.append(unit.name)
            yield unit, performed(unit, software)

    return run


def in_folder(tmp_path, units=UNITS, software="1"):
    """Names of the units that had to be done in a folder, and what came of all."""
    did = []
    found = done(units, tmp_path, software, counting(did))
    return sorted(did), found


@pytest.fixture
def undisturbed():
    return done(UNITS, None, "1", in_threads(1))


def test_results_are_those_of_the_functions_in_the_order_of_the_units(undisturbed):
    expected = {unit.name: walk(*unit.arguments) for unit in UNITS}
    assert list(undisturbed) == [unit.name for unit in UNITS]
    for name, arrays in expected.items():
        assert list(arrays) == list(undisturbed[name])
        for each, array in arrays.items():
            assert np.allclose(undisturbed[name][each], array, rtol=1e-12)


@pytest.mark.parametrize("runner", [in_threads(2), in_processes(1), in_processes(3)])
def test_threads_and_processes_give_the_same_bytes(undisturbed, runner):
    assert same(done(UNITS, None, "1", runner), undisturbed)


def test_arrays_of_every_kind_and_shape_come_back():
    arrays = {
        "empty": np.zeros((0, 3)),
        "scalar": np.float32(1.5),
        "truth": np.array([[True], [False]]),
        "columns first": np.asfortranarray(np.arange(6, dtype=">i2").reshape(2, 3)),
        "complex": np.array([1j, np.nan]),
    }
    again = unpacked(performed(Unit("a", given, (arrays,)), "1"))
    assert list(again) == list(arrays)
    for name, array in arrays.items():
        assert again[name].dtype == array.dtype
        assert again[name].shape == array.shape
        assert np.array_equal(again[name], array, equal_nan=name == "complex")
        assert again[name].flags.aligned and again[name].flags.writeable


def given(arrays):
    return arrays


@pytest.mark.parametrize("array", [np.array([None]), np.array(["a"]), np.zeros(1, "f4,f4")])
def test_anything_but_numbers_is_refused(array):
    with pytest.raises(TypeError, match="a of unit b is an array of"):
        performed(Unit("b", given, ({"a": array},)), "1")


@pytest.mark.parametrize("name", ["", ".a", "a/b", "a\n", "x" * 101, "ä"])
def test_a_name_that_is_no_file_name_is_refused(name):
    with pytest.raises(ValueError, match="cannot be a unit's name"):
        Unit(name, walk, ())


@pytest.mark.parametrize("size", [0.0, -1.0, np.nan, np.inf])
def test_a_size_that_is_none_is_refused(size):
    with pytest.raises(ValueError, match="size"):
        Unit("a", walk, (), size)


def test_two_units_of_one_name_are_refused():
    with pytest.raises(ValueError, match="same name"):
        done([Unit("a", walk, (1, 2)), Unit("A", walk, (2, 2))], None, "1", in_threads(1))


# What a unit is known by


@dataclass(frozen=True)
class Pair:
    one: object
    other: object


DIFFERENT = [
    1,
    1.0,
    True,
    "1",
    b"1",
    None,
    np.float32(1.0),
    np.array(1.0),
    np.array([1.0]),
    np.array([1.0, 0.0]),
    np.array([[1.0, 0.0]]),
    np.nextafter(1.0, 2.0),
    (1,),
    [1],
    ((1,), ()),
    ((), (1,)),
    ("a", "b"),
    ("a str 'b'",),
    {"a": 1},
    {"a": 2},
    {1},
    Pair(1, 2),
    Pair(2, 1),
    walk,
    fail,
    SPECIMENS["S3"],
    replace(SPECIMENS["S3"], corneum_thickness=np.nextafter(0.001, 1.0)),
    replace(SPECIMENS["S3"], corneum_thickness=0.001),
]


def test_different_units_have_different_digests():
    digests = {unit_digest(Unit("a", walk, (each,)), "1") for each in DIFFERENT}
    assert len(digests) == len(DIFFERENT)
    unit = Unit("a", walk, (1,))
    others = [replace(unit, name="b"), replace(unit, function=fail)]
    assert len({unit_digest(each, "1") for each in [unit, *others]}) == 3
    assert unit_digest(unit, "1") != unit_digest(unit, "2")
    assert unit_digest(replace(unit, size=7.0), "1") == unit_digest(unit, "1")


def test_a_digest_is_the_same_in_every_process():
    """Sets of texts have another order in each, and equal texts may be one object or two."""
    code = (
        "from lut_builder.jobs.work import *; from toy_work import walk; import numpy as np\n"
        "names = frozenset('abcdefgh'), {'x': np.arange(3), 'y': 'a' * 3}, ('aaa', 1e-300)\n"
        "print(unit_digest(Unit('a', walk, names), '1'), software_digest())"
    )
    said = {
        subprocess.run(
            [sys.executable, "-c", code],
            env={**environment(), "PYTHONHASHSEED": seed},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for seed in "12"
    }
    assert len(said) == 1
    assert said.pop().split()[1] == software_digest()


@pytest.mark.parametrize("value", [object(), lambda: 0, np.array([None]), int, Path("a")])
def test_what_has_no_digest_is_refused(value):
    with pytest.raises(TypeError, match="no digest"):
        unit_digest(Unit("a", walk, ([value],)), "1")


def test_mappings_that_cannot_be_changed_have_a_digest():
    assert unit_digest(Unit("a", walk, (MappingProxyType({"a": 1}),)), "1")


def test_a_changed_source_changes_the_digest_of_the_software(tmp_path):
    """A copy of the sources, in which one line of a figure's file is added."""
    root = Path(hylios.__file__).parent.parent
    for package in ("hylios", "lut_builder"):
        for path in (root / package).rglob("*"):
            if path.suffix in {".py", ".csv", ".toml"}:
                copy = tmp_path / path.relative_to(root)
                copy.parent.mkdir(parents=True, exist_ok=True)
                copy.write_bytes(path.read_bytes())

    def digest():
        code = "from lut_builder.jobs.work import software_digest; print(software_digest())"
        told = subprocess.run(
            [sys.executable, "-c", code],
            cwd=tmp_path,
            env={**os.environ, "PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"},
            capture_output=True,
            check=True,
        )
        return told.stdout.decode().strip()

    assert digest() == software_digest()
    with (tmp_path / "hylios" / "spectra" / "sources.toml").open("a") as file:
        file.write("\n")
    assert digest() != software_digest()


# What is kept


def test_kept_units_are_not_done_again(tmp_path, undisturbed):
    did, found = in_folder(tmp_path)
    assert did == sorted(unit.name for unit in UNITS)
    again, found_again = in_folder(tmp_path)
    assert again == []
    assert same(found, undisturbed) and same(found_again, undisturbed)


def test_a_kept_unit_is_the_same_bytes_each_time(tmp_path):
    for each in ("one", "other"):
        (tmp_path / each).mkdir()
        in_folder(tmp_path / each)
    for path in (tmp_path / "one").iterdir():
        assert path.read_bytes() == (tmp_path / "other" / path.name).read_bytes()


def test_every_unit_is_kept_before_the_next_is_done(tmp_path):
    def stopping(units, software):
        for count, unit in enumerate(units):
            assert units_in(tmp_path) == count
            if count == 5:
                raise KeyboardInterrupt
            yield unit, performed(unit, software)

    with pytest.raises(KeyboardInterrupt):
        done(UNITS, tmp_path, "1", stopping)
    did, _ = in_folder(tmp_path)
    assert len(did) == 3


def test_the_largest_are_done_first(tmp_path):
    did = []
    done(UNITS, None, "1", counting(did))
    assert did == [unit.name for unit in reversed(UNITS)]


def test_another_unit_or_software_is_not_trusted(tmp_path, undisturbed):
    in_folder(tmp_path)
    changed = [replace(UNITS[3], arguments=(99, 70)), *UNITS[:3], *UNITS[4:]]
    did, found = in_folder(tmp_path, changed)
    assert did == ["walk-3"]
    assert not np.array_equal(found["walk-3"]["ends"], undisturbed["walk-3"]["ends"])
    did, _ = in_folder(tmp_path, software="2")
    assert len(did) == len(UNITS)


def test_a_file_under_another_units_name_is_not_trusted(tmp_path, undisturbed):
    in_folder(tmp_path)
    (tmp_path / "walk-3.unit").write_bytes((tmp_path / "walk-4.unit").read_bytes())
    did, found = in_folder(tmp_path)
    assert did == ["walk-3"]
    assert same(found, undisturbed)


def test_a_damaged_unit_is_done_again(tmp_path, undisturbed):
    """Cut at any place, changed in any bit (300 of them), lengthened, emptied, no file at all."""
    unit = UNITS[2]
    path = tmp_path / f"{unit.name}.unit"
    whole = performed(unit, "1")
    random = np.random.default_rng(5)
    cut = [whole[: random.integers(len(whole))] for _ in range(100)]
    flipped = []
    for _ in range(300):
        content = bytearray(whole)
        content[random.integers(len(whole))] ^= 1 << random.integers(8)
        flipped.append(bytes(content))
    path.write_bytes(whole)
    assert in_folder(tmp_path, [unit])[0] == []
    for content in [b"", b"\n", whole[:-1], whole + b"\0", *cut, *flipped]:
        path.write_bytes(content)
        did, found = in_folder(tmp_path, [unit])
        assert did == [unit.name]
        assert same(found, {unit.name: undisturbed[unit.name]})
        assert path.read_bytes() == whole


def test_progress_tells_count_and_time_left_on_standard_error(tmp_path, capsys):
    in_folder(tmp_path, UNITS[:3])
    done(UNITS, tmp_path, "1", in_threads(1), "walks")
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "walks, 3 of 8" in captured.err
    assert "walks, 8 of 8 100%" in captured.err
    done(UNITS, None, "1", in_threads(1))
    assert capsys.readouterr().err == ""


@pytest.mark.filterwarnings("error")
def test_rounding_does_not_take_the_bar_beyond_its_end():
    """.7 + .1 + .3 is less than .7 + .3 + .1, the order in which they are done."""
    units = [Unit(f"u{size}", walk, (1, 2), size=size) for size in (0.7, 0.1, 0.3)]
    assert sum(each.size for each in units) < 0.7 + 0.3 + 0.1
    done(units, None, "1", in_threads(1), "walks")


# Threads and processes


@pytest.mark.parametrize("runner", [in_threads(2), in_processes(2)])
def test_an_exception_of_a_unit_is_raised(runner):
    units = [Unit("a", fail, ("InputError",)), Unit("b", walk, (1, 2))]
    with pytest.raises(InputError, match="^it is 7.$"):
        done(units, None, "1", runner)
    units = [Unit("a", fail, ("ZeroDivisionError",)), Unit("b", walk, (1, 2))]
    with pytest.raises(ZeroDivisionError) as raised:
        done(units, None, "1", runner)
    told = [*getattr(raised.value, "__notes__", []), *traceback.format_tb(raised.tb)]
    assert "in fail" in "".join(told)


def test_a_process_that_dies_is_one_sentence_and_what_was_done_stays(tmp_path):
    units = [Unit("z", die, (), size=0.1), *UNITS]
    with pytest.raises(InputError, match="ended from outside; was there too little memory"):
        done(units, tmp_path, "1", in_processes(2))
    assert units_in(tmp_path) >= len(UNITS) - 1


def children(process):
    path = Path(f"/proc/{process}/task/{process}/children")
    return [int(each) for each in path.read_text().split()]


def require_gone(processes):
    """Wait for processes to end; the tracker that comes with them ends just after their parent."""
    until = time.monotonic() + 10.0
    while not all(gone(each) for each in processes):
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
    sent = time.monotonic()
    _, said = running.communicate(timeout=30)
    assert time.monotonic() - sent < 10.0
    assert running.returncode == 130
    assert said.splitlines()[-1] == (
        f"cancelled; what is done is kept in {folder}: give --resume to go on with it."
    )
    assert "Traceback" not in said
    assert len(below) == (0 if processes == 1 else 3)
    require_gone(below)
    assert {path.suffix for path in folder.iterdir()} == {".unit"}
    assert not target.exists()


def test_ctrl_c_while_processes_start_is_quiet(tmp_path):
    """At moments from the first sign of life on; nothing is kept, so nothing is said of it."""
    target = tmp_path / "t.bin"
    for moment in range(6):
        running = subprocess.Popen(
            command(target, "--pause", "9", "--processes", "2"),
            stderr=subprocess.PIPE,
            text=True,
            env=environment(),
            start_new_session=True,
        )
        read = running.stderr.read(20)
        time.sleep(0.03 * moment)
        os.killpg(running.pid, signal.SIGINT)
        said = read + running.communicate(timeout=30)[1]
        assert running.returncode == 130
        assert said.endswith("\ncancelled\n")
        assert "Traceback" not in said
        assert os.listdir(tmp_path) == []


def test_children_end_with_a_killed_parent(tmp_path):
    running, _ = started(tmp_path / "t.bin", "--processes", "2")
    below = children(running.pid)
    assert len(below) == 3
    running.kill()
    running.communicate(timeout=30)
    require_gone(below)


# Killed


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


def test_killed_at_20_random_moments_and_resumed_the_file_is_the_same_bytes(tmp_path):
    whole, killed = killed_file(tmp_path, kills=20, processes=1, count=70, pause=0.02)
    assert killed == whole


@pytest.mark.slow
def test_killed_with_two_processes_the_file_is_the_same_bytes(tmp_path):
    whole, killed = killed_file(tmp_path, kills=20, processes=2, count=120, pause=0.1)
    assert killed == whole


# The folder of unfinished work


def left_behind(tmp_path, *, units=3):
    """A target whose work is unfinished, and its folder."""
    target = tmp_path / "t.bin"
    folder = tmp_path / "t.bin.unfinished"
    folder.mkdir()
    done(walks(30)[:units], folder, software_digest(), in_threads(1))
    (folder / ".half.unit").write_bytes(b"half")
    return target, folder


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
    with unfinished(target, (".bin",), resume=True, force=False) as folder:
        with (
            pytest.raises(InputError, match="another process is at work in"),
            unfinished(target, (".bin",), resume=True, force=True),
        ):
            pass
        (folder / "t.bin").write_bytes(b"whole")
    assert os.listdir(tmp_path) == ["t.bin"]


@pytest.mark.parametrize("below", ["file/t.bin", "none/t.bin"])
def test_a_target_that_cannot_be_written_is_one_sentence(tmp_path, capsys, below):
    (tmp_path / "file").write_bytes(b"")
    assert run_toy(tmp_path / below) == 2
    said = capsys.readouterr().err
    assert said.startswith("error: ") and said.count("\n") == 1
    assert os.listdir(tmp_path) == ["file"]


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
        done(UNITS, tmp_path, "1", in_threads(1))
    monkeypatch.undo()
    assert len(os.listdir(tmp_path)) == 4
    assert len(in_folder(tmp_path)[0]) == len(UNITS) - 4
