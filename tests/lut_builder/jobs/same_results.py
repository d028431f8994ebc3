"""Results of the same units compared, and a runner that says what it did."""

from toy_work import walks

from lut_builder.jobs.run import run_units
from lut_builder.jobs.units import perform

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


def counting(names):
    """A runner that notes what it did."""

    def run(units, software):
        for unit in units:
            names.append(unit.name)
            yield unit, perform(unit, software)

    return run


def in_folder(tmp_path, units=UNITS, software="1"):
    """Names of the units that had to be done in a folder, and what came of all."""
    did = []
    results = run_units(units, tmp_path, software, counting(did))
    return sorted(did), results
