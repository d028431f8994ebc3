"""Where the sun gets on the subjects of figures 6.24 to 6.28, as distances. Needs no Blender."""

from dataclasses import dataclass

import numpy as np

from examples.demo import swimsuit

PATCH_HEIGHTS = (0.072, 0.0, -0.072)
"""Heights of the three patches' centres over the middle one's, in metres."""
PATCH_HALF, PATCH_CORNER = 0.024, 0.008
SUN_RADIUS, RAY_FROM, RAY_TO, RAY_WIDTH, RAYS = 0.034, 0.048, 0.074, 0.011, 12


def square_patches(across: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Positive (N,) in three patches with rounded corners, one over the other; metres."""
    return np.maximum.reduce([_patch(across, up - height) for height in PATCH_HEIGHTS])


def nearest_patch(up: np.ndarray) -> np.ndarray:
    """Number (N,) of the patch at each height over the middle one's centre."""
    return np.argmin(np.abs(up[:, None] - np.array(PATCH_HEIGHTS)), axis=1)


def _patch(across: np.ndarray, up: np.ndarray) -> np.ndarray:
    beyond = np.abs(np.stack([across, up])) - (PATCH_HALF - PATCH_CORNER)
    outside = np.hypot(*np.maximum(beyond, 0.0))
    return PATCH_CORNER - outside - np.minimum(beyond.max(axis=0), 0.0)


def sun_sign(across: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Negative (N,) on a disk with rays around it, painted with sunscreen; metres."""
    radius, angle = np.hypot(across, up), np.arctan2(up, across)
    step = 2.0 * np.pi / RAYS
    off = (angle + 0.5 * step) % step - 0.5 * step
    along = np.clip(radius * np.cos(off), RAY_FROM, RAY_TO)
    ray = np.hypot(radius * np.cos(off) - along, radius * np.sin(off)) - 0.5 * RAY_WIDTH
    return np.minimum(radius - SUN_RADIUS, ray)


@dataclass(frozen=True)
class Placement:
    """Where on a subject a pattern lies, and how large; `facing` is the sign of y there."""

    origin: tuple[float, float, float]
    scale: float = 1.0
    facing: float = 1.0

    def local(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Points (N, 3) in metres to the right and up from the origin, in the pattern's size."""
        across, _, up = (points - np.array(self.origin)).T / self.scale
        return across, up

    def on_this_side(self, points: np.ndarray) -> np.ndarray:
        """Positive (N,) on the side of the subject that the pattern is on."""
        return self.facing * (points[:, 1] - self.origin[1])


def patches_at(placement: Placement) -> swimsuit.Field:
    """The sun reaches three patches only."""

    def field(points: np.ndarray) -> np.ndarray:
        return np.minimum(
            placement.scale * square_patches(*placement.local(points)),
            placement.on_this_side(points),
        )

    return field


def sunscreen_at(placement: Placement) -> swimsuit.Field:
    """The sun reaches all but a sun painted with sunscreen."""

    def field(points: np.ndarray) -> np.ndarray:
        return np.maximum(
            placement.scale * sun_sign(*placement.local(points)), -placement.on_this_side(points)
        )

    return field


def half(points: np.ndarray) -> np.ndarray:
    """The sun reaches the side of positive x only."""
    return points[:, 0]


def whole(points: np.ndarray) -> np.ndarray:
    """All points belong to one part."""
    return np.zeros(len(points), int)
