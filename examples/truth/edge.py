"""Light around the sharp edge of a lamp's light on flat skin."""

from collections.abc import Mapping, Sequence

import numpy as np

from examples.truth import model
from examples.truth.outcome import Outcome, Reading, Row
from examples.truth.shots import TYPES, Shot
from examples.truth.stages import EDGE_WIDTH
from hylios.lab.colour import difference

SEEN = ("untanned", "dark")
COLUMNS, LINES = 80, 16
WITHIN = 5
"""Places in a pixel at which the model is asked."""

RAYS = 100_000
ALLOWED = (1.0, 1.3)


def shots() -> list[Shot]:
    """All types, untanned and tanned."""
    return [
        Shot(f"edge {skin} {tan}", "edge", skin, tan, size=(COLUMNS, LINES), samples=1024)
        for skin in TYPES
        for tan in SEEN
    ]


def read(taken: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> Outcome:
    """Compare renders of shots, by their names, with the model."""
    width = 1000.0 * EDGE_WIDTH
    fine = width * ((np.arange(COLUMNS * WITHIN) + 0.5) / (COLUMNS * WITHIN) - 0.5)
    places = fine.reshape(COLUMNS, WITHIN).mean(axis=1)
    readings = []
    for shot in taken:
        light = model.lit_edge(model.specimen(shot.skin, shot.tan), fine, RAYS)
        said = light.reshape(COLUMNS, WITHIN, 3).mean(axis=1)
        shown = lights[shot.name]["diffuse"].mean(axis=0)
        readings.append(Reading("edge", shot.name, shown, said, difference(shown, said), places))
    return Outcome([Row.of(readings, "lit edge, within 10 mm", ALLOWED)], readings)
