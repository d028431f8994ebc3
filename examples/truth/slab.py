"""Light through a thin piece of skin lit from behind, as an ear is."""

from collections.abc import Mapping, Sequence

import numpy as np

from examples.truth import model
from examples.truth.outcome import Outcome, Reading, Row
from examples.truth.shots import Shot

SKINS, THICKNESSES = ("II", "V"), (1.5, 2.0, 2.5, 3.0, 4.0)
ALLOWED = (None, 0.03)


def shots() -> list[Shot]:
    """Two types, in mm from thin to thick."""
    return [
        Shot(f"slab {skin} {thickness:g} mm", "slab", skin, thickness=thickness)
        for skin in SKINS
        for thickness in THICKNESSES
    ]


def read(taken: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> Outcome:
    """Compare renders of shots, by their names, with the model."""
    readings = []
    for shot in taken:
        said = model.slab(model.specimen(shot.skin, shot.tan), shot.thickness)
        shown = lights[shot.name]["combined"].mean(axis=(0, 1))
        apart = np.abs(shown - said).max(keepdims=True)
        place = np.array([shot.thickness])
        readings.append(Reading("slab", shot.name, shown[None], said[None], apart, place))
    what = "slab lit from behind, 1.5 to 4 mm, the channel that is farthest"
    return Outcome([Row.of(readings, what, ALLOWED, "share of light")], readings)
