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
    facing = np.sum(view * white.normal, axis=-1) > FACING
    facing &= np.linalg.norm(white.position - np.array(stage.centre), axis=-1) < stage.reach
    points, normals = (values[facing].astype(float) for values in (white.position, white.normal))
    distance = np.full(facing.shape, np.nan)
    distance[facing] = swimsuit.distance_to_edge(stage.subject.cloth, points, normals)
    return distance


def regions(white: render.Light, distance: np.ndarray, stage: Stage) -> list[np.ndarray]:
    """Pixels (parts + 1, rows, columns) of each part in the sun, then of covered skin.

    Well lit, and well away from the edge between them.
    """
    readable = np.isfinite(distance)
    part = np.zeros(readable.shape, int)
    part[readable] = stage.part(white.position[readable].astype(float))
    bright = white.scattered.mean(axis=-1)
    lit = readable & (bright > 0.5 * np.median(bright[readable])) if readable.any() else readable
    sunned = [lit & (part == number) & (distance > CLEAR_OF_EDGE) for number in range(stage.parts)]
    return [*sunned, lit & (distance < -CLEAR_OF_EDGE)]


def readings(light: render.Light, white: render.Light, pixels: Sequence[np.ndarray]) -> np.ndarray:
    """Mean light out of the skin as a share of a white diffuser's, linear Rec.709 (regions, 3).

    Not a number where nothing of a region is in the picture.
    """
    return np.array(
        [
            light.scattered[region].mean(axis=0) / white.scattered[region].mean(axis=0)
            if region.any()
            else np.full(3, np.nan)
            for region in pixels
        ]
    )


def shine(taken: Taken, pixels: Sequence[np.ndarray]) -> np.ndarray:
    """What the surface reflects in the brightest hundredth of each region (regions,)."""
    reflected = (taken.picture - taken.light.scattered).mean(axis=-1)
    return np.array(
        [np.percentile(reflected[region], 99.0) if region.any() else np.nan for region in pixels]
    )
