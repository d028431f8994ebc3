"""What must not change a picture: working space, OpenColorIO, units, scale of object or model."""

from collections.abc import Mapping, Sequence

import colour
import numpy as np

from examples.truth.edge import COLUMNS, LINES
from examples.truth.outcome import Outcome, Reading, Row
from examples.truth.shots import Shot
from hylios.lab.colour import difference

SPACES = {"Linear Rec.2020": "ITU-R BT.2020", "ACEScg": "ACEScg"}
"""Working spaces, and their names in colour-science."""

ALIKE = 0.05
"""Largest mean CIEDE2000 between pictures of the same."""

STUDIO = "a studio's OpenColorIO configuration"
"""In ACEScg, with other names for all colour spaces."""

WHITE, EDGE = "usual, even light", "usual, edge"


def shots() -> list[Shot]:
    """A dark tan of type III as usual, and otherwise."""
    size = (COLUMNS, LINES)
    return [
        Shot(WHITE, "white", "III", "dark"),
        *(Shot(space, "white", "III", "dark", space=space) for space in SPACES),
        Shot(EDGE, "edge", "III", "dark", size=size),
        Shot("scene unit of .01 m", "edge", "III", "dark", size=size, unit=0.01),
        Shot("object scale 10", "edge", "III", "dark", size=size, scale=10.0),
        Shot("ten times life-size and mended", "edge", "III", "dark", size=size, model_scale=10.0),
        Shot(
            "unit .01 m after Apply and mended",
            "edge",
            "III",
            "dark",
            size=size,
            unit=0.01,
            applied_unit=1.0,
        ),
        Shot(STUDIO, "white", "III", "dark", configuration="studio.ocio"),
    ]


def read(taken: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> Outcome:
    """Compare pictures with the usual ones."""
    readings = []
    for shot in taken:
        if shot.name in (WHITE, EDGE):
            continue
        even = shot.stage == "white"
        usual, other = (
            lights[name]["combined"].mean(axis=(0, 1) if even else 0).reshape(-1, 3)
            for name in (WHITE if even else EDGE, shot.name)
        )
        space = "ACEScg" if shot.configuration else shot.space
        seen = in_rec709(other, SPACES[space]) if space else other
        apart = difference(seen, usual)
        places = np.arange(len(seen), dtype=float)
        readings.append(Reading("alike", shot.name, seen, usual, apart, places))
    rows = [
        Row.of([reading], f"{reading.case}, from the usual picture", (None, ALIKE))
        for reading in readings
    ]
    return Outcome(rows, readings)


def in_rec709(pixels: np.ndarray, space: str) -> np.ndarray:
    """Linear Rec.709 of pixels in another linear space; what is white stays white."""
    return np.asarray(colour.RGB_to_RGB(pixels, space, "ITU-R BT.709", "Bradford"))
