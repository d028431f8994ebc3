"""What a tan adds to a saved file."""

import bpy
import numpy as np
import pytest
from scenes import apply, tan_object

MEGABYTE = 1e6


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


@pytest.mark.parametrize(
    ("days", "exposures", "most", "further"), [(30.0, 1, 0.4, 0.3), (365.0, 20, 0.6, 0.5)]
)
def test_a_tan_adds_little_to_a_file(table_path, tmp_path, days, exposures, most, further):
    """In megabytes, as Blender 4.5 saves it: three quarters are nodes, 3 kB and more for each.

    Another object of the same skin brings neither look nor relief of its own. Compressed, as
    Blender 5 saves it by itself, a tan adds a quarter.
    """
    objects = [sunny(table_path, days, exposures) for _ in range(2)]
    sizes, packed = [saved(tmp_path)], [saved(tmp_path, compress=True)]
    for obj in objects:
        apply(obj)
        sizes.append(saved(tmp_path))
        packed.append(saved(tmp_path, compress=True))
    added = np.diff(sizes) / MEGABYTE
    assert added[0] < most and added[1] < further
    assert np.diff(packed)[0] / MEGABYTE < most / 2
