"""Colour of skin that a burn reddened, and of its tan, under even white light."""

from collections.abc import Mapping, Sequence

import numpy as np

from examples.truth import model
from examples.truth.albedo import SAMPLES, reading
from examples.truth.outcome import Outcome, Reading, Row
from examples.truth.shots import BURNS, Shot

SKINS, ANGLES = ("III", "VI"), (0.0, 45.0)
ALLOWED = (0.3, 0.6)
"""Mean and largest CIEDE2000 that are allowed at either angle."""


def shots() -> list[Shot]:
    """Two types a day and ten days after a burn, at each angle."""
    return [
        Shot(f"{skin} {tan} at {angle:g}", "white", skin, tan, angle=angle, samples=SAMPLES)
        for skin in SKINS
        for angle in ANGLES
        for tan in BURNS
    ]


def read(taken: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> Outcome:
    """Compare renders of shots, by their names, with the model."""
    rows: list[Row] = []
    readings: list[Reading] = []
    for angle in ANGLES:
        some = [
            reading(
                "burn",
                shot,
                lights[shot.name]["combined"],
                model.albedo(model.specimen(shot.skin, shot.tan), [angle]).total[0],
            )
            for shot in taken
            if shot.angle == angle
        ]
        if some:
            rows.append(Row.of(some, f"burnt skin and its tan, whole, at {angle:g}°", ALLOWED))
            readings += some
    return Outcome(rows, readings)
