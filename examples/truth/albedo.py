"""Colour of flat skin under even white light, whole and without what the surface reflects."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from examples.truth import model
from examples.truth.outcome import CIEDE2000, Outcome, Reading, Row
from examples.truth.shots import BLOODS, TANS, TYPES, Shot
from hylios.lab.colour import difference

NAME = "albedo"
ANGLES = (0.0, 45.0, 70.0)
WHOLE = {0.0: (0.12, 0.25), 45.0: (0.25, 0.4), 70.0: (1.8, 2.4)}
INSIDE = {0.0: (0.06, 0.12), 45.0: (0.06, 0.12), 70.0: (0.2, 0.4)}
"""What is allowed at each angle: mean and largest CIEDE2000."""

SAMPLES = 1408

AGAIN = 13
"""Every so many pictures one is taken again, to tell what chance does."""


def shots(bloods: Sequence[float] = BLOODS) -> list[Shot]:
    """All types, tans and bloods at each angle; some again with other chance."""
    once = [
        Shot(
            f"{skin} {tan} blood {blood:g} at {angle:g}",
            "white",
            skin,
            tan,
            blood,
            angle,
            samples=SAMPLES,
        )
        for skin in TYPES
        for angle in ANGLES
        for tan in TANS
        for blood in bloods
    ]
    again = [replace(shot, name=_again(shot.name), seed=2) for shot in once[::AGAIN]]
    return sorted([*once, *again], key=_scene)


def _scene(shot: Shot) -> tuple:
    """What the scene of a shot depends on; the rest is changed in it."""
    return TYPES.index(shot.skin), shot.angle, TANS[shot.tan].multiple


def _again(name: str) -> str:
    return f"{name}, again"


def read(taken: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> Outcome:
    """Compare renders of shots, by their names, with the model."""
    once = [shot for shot in taken if shot.seed == 1]
    said = {
        case: model.albedo(model.specimen(*case), ANGLES)
        for case in {(shot.skin, shot.tan, shot.blood) for shot in once}
    }
    rows, readings = [], []
    for part, what, allowed in (("total", "whole", WHOLE), ("subsurface", "inside", INSIDE)):
        for number, angle in enumerate(ANGLES):
            some = [
                reading(
                    f"{NAME}, {what}",
                    shot,
                    lights[shot.name]["combined" if part == "total" else "diffuse"],
                    getattr(said[shot.skin, shot.tan, shot.blood], part)[number],
                )
                for shot in once
                if shot.angle == angle
            ]
            if some:
                label = "albedo, whole" if part == "total" else "albedo, subsurface part"
                rows.append(Row.of(some, f"{label}, at {angle:g}°", allowed[angle]))
                readings += some
    return Outcome([*rows, *_noise(once, lights)], readings)


def reading(row: str, shot: Shot, picture: np.ndarray, said: np.ndarray) -> Reading:
    """The mean colour of a picture beside the model's (3,)."""
    shown = picture.mean(axis=(0, 1))[None]
    return Reading(row, shot.name, shown, said[None], difference(shown, said[None]))


def _noise(once: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> list[Row]:
    """How far chance moves a mean, from pictures taken twice."""
    pairs = [
        [lights[name]["combined"].mean(axis=(0, 1)) for name in (shot.name, _again(shot.name))]
        for shot in once
        if _again(shot.name) in lights
    ]
    if not pairs:
        return []
    apart = np.array([difference(*pair) for pair in pairs]) / np.sqrt(2.0)
    what = "noise of these readings"
    return [Row(NAME, what, CIEDE2000, float(apart.mean()), float(apart.max()), 0.02)]
