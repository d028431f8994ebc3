"""What a tan adds to a saved file."""

import bpy
import numpy as np
import pytest
from scenes import apply, tan_object

MEGABYTE = 1e6

RELIEF = 0.12
"""Megabytes of the group of skin's relief, which a file holds once."""


def saved(folder, *, compress: bool = False) -> int:
    path = folder / "saved.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=compress, copy=True)
    return path.stat().st_size


def sunny(table_path, days: float, exposures: int):
    obj = tan_object(table_path)
    obj.skin_tan.last_day = days
    random = np.random.default_rng(exposures)
    for day in np.sort(random.uniform(0.0, 0.8 * days, exposures - 1)):
        exposure = obj.skin_tan.exposures.add()
        exposure.day, exposure.dose = float(day), float(random.uniform(2.0, 14.0))
    return obj


@pytest.mark.parametrize(("days", "exposures", "most"), [(30.0, 1, 0.4), (365.0, 20, 1.0)])
def test_as_blender_5_saves_it_adds_less(table_path, tmp_path, days, exposures, most):
    """Compressed, as its factory settings have it."""
    obj = sunny(table_path, days, exposures)
    before = saved(tmp_path, compress=True)
    apply(obj)
    assert (saved(tmp_path, compress=True) - before) / MEGABYTE < most / 2


@pytest.mark.parametrize(
    ("days", "exposures", "first", "further"),
    [(30.0, 1, 0.485, 0.42), (30.0, 10, 0.535, 0.46), (365.0, 20, 0.735, 0.66)],
)
def test_a_tan_adds_little_to_a_file(table_path, tmp_path, days, exposures, first, further):
    """In megabytes, as measured: half of it are nodes, 3 kB and more for each.

    Another object of the same skin brings neither look nor relief of its own.
    """
    objects = [sunny(table_path, days, exposures) for _ in range(2)]
    sizes = [saved(tmp_path)]
    for obj in objects:
        apply(obj)
        sizes.append(saved(tmp_path))
    added = np.diff(sizes) / MEGABYTE
    assert added[0] < first + RELIEF
    assert added[1] < further
