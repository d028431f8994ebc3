"""Where cloth kept the sun off the skin: the share of the dose that reached each point.

Cloth is described by a field over points (N, 3) in metres: negative under the cloth, positive on
bare skin, zero at its edge. It need not be a distance: `distance_to_edge` makes it one.
"""

from collections.abc import Callable

import numpy as np

Field = Callable[[np.ndarray], np.ndarray]

EDGE_WIDTH = 0.005  # metres, from full shade to full sun
STRAP_WIDTH = 0.013
SEAM_RADIUS = 0.010  # of the corners where a strap meets the suit
# Where the straps pass over the ridge of the shoulders.
SHOULDER_X, SHOULDER_Y = 0.080, 0.008


def share_of_dose(distance: np.ndarray) -> np.ndarray:
    """Share of the dose, 0 to 1, at a signed distance in metres from the cloth's edge."""
    return smooth_step(distance / EDGE_WIDTH + 0.5)


def smooth_step(values: np.ndarray) -> np.ndarray:
    """From 0 where values are at most 0 to 1 where they are at least 1, smooth at both ends."""
    cut = np.clip(values, 0.0, 1.0)
    return cut * cut * (3.0 - 2.0 * cut)


def distance_to_edge(cloth: Field, points: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Distance (N,) in metres to the cloth's edge along the surface, negative under the cloth.

    Right near the edge, where it matters: there a field is its slope along the surface times
    the distance.
    """
    step = 1e-4
    slope = np.stack(
        [
            (cloth(points + step * axis) - cloth(points - step * axis)) / (2.0 * step)
            for axis in np.eye(3)
        ],
        axis=1,
    )
    slope -= normals * np.sum(normals * slope, axis=1, keepdims=True)
    return cloth(points) / np.maximum(np.linalg.norm(slope, axis=1), 0.1)


def one_piece(points: np.ndarray) -> np.ndarray:
    """A swimsuit with a low round back and crossed straps, for the body of `read_body`."""
    x, y, z = points.T
    aside = np.abs(x)
    suit = np.maximum(z - _upper_edge(np.arctan2(aside, y + 0.06)), _leg_opening(aside) - z)
    straps = np.minimum(_back_strap(x, y, z), _back_strap(-x, y, z))
    straps = np.minimum(straps, _front_strap(aside, y, z))
    arm = aside - (0.143 + 0.3 * (1.15 - z))
    return np.maximum(_joined(suit, straps, SEAM_RADIUS), arm)


def band(points: np.ndarray, low: float, high: float) -> np.ndarray:
    """Cloth between two heights in metres."""
    z = points[:, 2]
    return np.maximum(low - z, z - high)


def _upper_edge(angle: np.ndarray) -> np.ndarray:
    """Height of the suit's upper edge around the trunk, 0 at the back and pi in front."""
    back, side, front = 0.975, 1.125, 1.21
    around = np.where(angle < np.pi / 2, np.sin(angle) ** 3, 1.0)
    forward = np.where(angle < np.pi / 2, 0.0, np.cos(angle) ** 2)
    return back + (side - back) * around + (front - side) * forward


def _leg_opening(aside: np.ndarray) -> np.ndarray:
    return 0.76 + 0.9 * np.maximum(aside - 0.03, 0.0)


def _back_strap(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """From the top of one shoulder across the back to the suit's edge on the other side."""
    (x0, z0), (x1, z1) = (SHOULDER_X, 1.353), (-0.105, 1.08)
    length = np.hypot(x1 - x0, z1 - z0)
    off_line = np.abs((x - x0) * (z1 - z0) - (z - z0) * (x1 - x0)) / length
    front = SHOULDER_Y - 0.25 * (z0 - z) - y
    return _all_of(off_line - STRAP_WIDTH / 2, front, z1 - 0.05 - z, z - 1.38)


def _front_strap(aside: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    return _all_of(np.abs(aside - SHOULDER_X) - STRAP_WIDTH / 2, y - SHOULDER_Y, 1.1 - z, z - 1.38)


def _all_of(*fields: np.ndarray) -> np.ndarray:
    return np.maximum.reduce(fields)


def _joined(first: np.ndarray, second: np.ndarray, radius: float) -> np.ndarray:
    """Union of two cloths, rounded where their edges meet."""
    near = np.maximum(radius - np.abs(first - second), 0.0)
    return np.minimum(first, second) - near * near / (4.0 * radius)
