"""Units of work: their results as bytes, and what they are known by."""

import os
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest
from interruptions import environment
from same_results import UNITS
from toy_work import fail, walk

import hylios
from hylios.skin.specimen import SPECIMENS
from lut_builder.jobs.local import in_threads
from lut_builder.jobs.run import run_units
from lut_builder.jobs.software import software_digest
from lut_builder.jobs.units import Unit, perform, unit_digest, unpacked


def test_results_are_those_of_the_functions_in_the_order_of_the_units(undisturbed):
    expected = {unit.name: walk(*unit.arguments) for unit in UNITS}
    assert list(undisturbed) == [unit.name for unit in UNITS]
    for name, arrays in expected.items():
        assert list(arrays) == list(undisturbed[name])
        for array_name, array in arrays.items():
            assert np.allclose(undisturbed[name][array_name], array, rtol=1e-12)


def test_arrays_of_every_kind_and_shape_come_back():
    arrays = {
        "empty": np.zeros((0, 3)),
        "scalar": np.float32(1.5),
        "truth": np.array([[True], [False]]),
        "columns first": np.asfortranarray(np.arange(6, dtype=">i2").reshape(2, 3)),
        "complex": np.array([1j, np.nan]),
    }
    again = unpacked(perform(Unit("a", given, (arrays,)), "1"))
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
        perform(Unit("b", given, ({"a": array},)), "1")


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
        run_units([Unit("a", walk, (1, 2)), Unit("A", walk, (2, 2))], None, "1", in_threads(1))


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
    digests = {unit_digest(Unit("a", walk, (argument,)), "1") for argument in DIFFERENT}
    assert len(digests) == len(DIFFERENT)
    unit = Unit("a", walk, (1,))
    others = [replace(unit, name="b"), replace(unit, function=fail)]
    assert len({unit_digest(argument, "1") for argument in [unit, *others]}) == 3
    assert unit_digest(unit, "1") != unit_digest(unit, "2")
    assert unit_digest(replace(unit, size=7.0), "1") == unit_digest(unit, "1")


def test_a_digest_is_the_same_in_every_process():
    """Sets of texts have another order in each, and equal texts may be one object or two."""
    code = (
        "from lut_builder.jobs.units import *\n"
        "from lut_builder.jobs.software import software_digest\n"
        "from toy_work import walk; import numpy as np\n"
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
    """A copy of the sources, in which one line is added to a file of sources."""
    root = Path(hylios.__file__).parent.parent
    for package in ("hylios", "lut_builder"):
        for path in (root / package).rglob("*"):
            if path.suffix in {".py", ".csv", ".toml"}:
                copy = tmp_path / path.relative_to(root)
                copy.parent.mkdir(parents=True, exist_ok=True)
                copy.write_bytes(path.read_bytes())

    def digest():
        code = "from lut_builder.jobs.software import software_digest; print(software_digest())"
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
