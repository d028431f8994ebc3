"""Units of work done once, kept, trusted and shown."""

from dataclasses import replace

import numpy as np
import pytest
from interruptions import units_in
from same_results import UNITS, counting, in_folder, same
from toy_work import walk

from lut_builder.jobs.local import in_threads
from lut_builder.jobs.run import run_units
from lut_builder.jobs.unfinished import unit_file
from lut_builder.jobs.units import Unit, perform


def test_kept_units_are_not_done_again(tmp_path, undisturbed):
    did, results = in_folder(tmp_path)
    assert did == sorted(unit.name for unit in UNITS)
    again, results_again = in_folder(tmp_path)
    assert again == []
    assert same(results, undisturbed) and same(results_again, undisturbed)


def test_a_kept_unit_is_the_same_bytes_each_time(tmp_path):
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
        in_folder(tmp_path / name)
    for path in (tmp_path / "one").iterdir():
        assert path.read_bytes() == (tmp_path / "other" / path.name).read_bytes()


def test_every_unit_is_kept_before_the_next_is_done(tmp_path):
    def stopping(units, software):
        for count, unit in enumerate(units):
            assert units_in(tmp_path) == count
            if count == 5:
                raise KeyboardInterrupt
            yield unit, perform(unit, software)

    with pytest.raises(KeyboardInterrupt):
        run_units(UNITS, tmp_path, "1", stopping)
    did, _ = in_folder(tmp_path)
    assert len(did) == 3


def test_the_largest_are_done_first(tmp_path):
    did = []
    run_units(UNITS, None, "1", counting(did))
    assert did == [unit.name for unit in reversed(UNITS)]


def test_another_unit_or_software_is_not_trusted(tmp_path, undisturbed):
    in_folder(tmp_path)
    changed = [replace(UNITS[3], arguments=(99, 70)), *UNITS[:3], *UNITS[4:]]
    did, results = in_folder(tmp_path, changed)
    assert did == ["walk-3"]
    assert not np.array_equal(results["walk-3"]["ends"], undisturbed["walk-3"]["ends"])
    did, _ = in_folder(tmp_path, software="2")
    assert len(did) == len(UNITS)


def test_a_file_under_another_units_name_is_not_trusted(tmp_path, undisturbed):
    in_folder(tmp_path)
    unit_file(tmp_path, "walk-3").write_bytes(unit_file(tmp_path, "walk-4").read_bytes())
    did, results = in_folder(tmp_path)
    assert did == ["walk-3"]
    assert same(results, undisturbed)


def test_a_damaged_unit_is_done_again(tmp_path, undisturbed):
    """Cut at any place, changed in any bit (300 of them), lengthened, emptied, no file at all."""
    unit = UNITS[2]
    path = unit_file(tmp_path, unit.name)
    whole = perform(unit, "1")
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
        did, results = in_folder(tmp_path, [unit])
        assert did == [unit.name]
        assert same(results, {unit.name: undisturbed[unit.name]})
        assert path.read_bytes() == whole


def test_progress_tells_count_and_time_left_on_standard_error(tmp_path, capsys):
    in_folder(tmp_path, UNITS[:3])
    run_units(UNITS, tmp_path, "1", in_threads(1), "walks")
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "walks, 3 of 8" in captured.err
    assert "walks, 8 of 8 100%" in captured.err
    run_units(UNITS, None, "1", in_threads(1))
    assert capsys.readouterr().err == ""


@pytest.mark.filterwarnings("error")
def test_rounding_does_not_take_the_bar_beyond_its_end():
    """.7 + .1 + .3 is less than .7 + .3 + .1, the order in which they are done."""
    units = [Unit(f"u{size}", walk, (1, 2), size=size) for size in (0.7, 0.1, 0.3)]
    assert sum(unit.size for unit in units) < 0.7 + 0.3 + 0.1
    run_units(units, None, "1", in_threads(1), "walks")
