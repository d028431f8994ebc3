"""Colours of tanned and covered skin read from the pixels of a render."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from examples.demo import render, swimsuit
from examples.figures.stages import Stage

CLEAR_OF_EDGE = 0.006
"""Metres from the edge of a patch from which on its colour is read."""

FACING = 0.6
"""Cosine of the angle from the skin's normal to the camera, from which on its colour is read."""


@dataclass(frozen=True)
class Taken:
    """A rendered shot: linear Rec.709 (rows, columns, 3) and the light in it."""

    picture: np.ndarray
    light: render.Light


def sun_distance(white: render.Light, stage: Stage, camera: np.ndarray) -> np.ndarray:
    """Metres (rows, columns) to the edge of what the sun reaches, negative where it does not.

    Not a number beyond the stage's reach and where the skin turns away from a camera at (3,).
    """
    view = camera - white.position
    view /= np.linalg.norm(view, axis=-1, keepdims=True)
    seen = np.sum(view * white.normal, axis=-1) > FACING
    seen &= np.linalg.norm(white.position - np.array(stage.centre), axis=-1) < stage.reach
    points, normals = (each[seen].astype(float) for each in (white.position, white.normal))
    distance = np.full(seen.shape, np.nan)
    distance[seen] = swimsuit.distance_to_edge(stage.subject.cloth, points, normals)
    return distance


def regions(white: render.Light, distance: np.ndarray, stage: Stage) -> list[np.ndarray]:
    """Pixels (parts + 1, rows, columns) of each part in the sun, then of covered skin.

    Well lit, and well away from the edge between them.
    """
    seen = np.isfinite(distance)
    part = np.zeros(seen.shape, int)
    part[seen] = stage.part(white.position[seen].astype(float))
    bright = white.scattered.mean(axis=-1)
    lit = seen & (bright > 0.5 * np.median(bright[seen])) if seen.any() else seen
    sunned = [lit & (part == each) & (distance > CLEAR_OF_EDGE) for each in range(stage.parts)]
    return [*sunned, lit & (distance < -CLEAR_OF_EDGE)]


def readings(light: render.Light, white: render.Light, where: Sequence[np.ndarray]) -> np.ndarray:
    """Mean light out of the skin as a share of a white diffuser's, linear Rec.709 (regions, 3).

    Not a number where nothing of a region is in the picture.
    """
    return np.array(
        [
            light.scattered[each].mean(axis=0) / white.scattered[each].mean(axis=0)
            if each.any()
            else np.full(3, np.nan)
            for each in where
        ]
    )


def shine(taken: Taken, where: Sequence[np.ndarray]) -> np.ndarray:
    """What the surface reflects in the brightest hundredth of each region (regions,)."""
    reflected = (taken.picture - taken.light.scattered).mean(axis=-1)
    return np.array(
        [np.percentile(reflected[each], 99.0) if each.any() else np.nan for each in where]
    )
