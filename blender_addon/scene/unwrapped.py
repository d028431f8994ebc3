"""Which point of a mesh lies at each texel of an image, by a UV map."""

from dataclasses import dataclass
from typing import Any, cast

import bpy
import numpy as np
from numpy.typing import NDArray

CHUNK = 1_000_000
"""Texels that are looked at together."""

MARGIN = 2
"""Texels beside the faces that take what lies next to them, since texels are interpolated."""


EDGE = 1e-5
"""Weight at which a texel lies on the edge of a triangle, for numbers of 32 bits."""

UNCLEAR = 0.02
"""Share of faces over each other or outside the image that is no matter."""


@dataclass(frozen=True, eq=False)
class Covered:
    """Points of a mesh at texels.

    Attributes
    ----------
    texels : (N,) int array
        Texels that faces cover or nearly so, row by row from the bottom.
    corners : (N, 3) int array
        Corners of the mesh between which the points lie.
    weights : (N, 3) float32 array
        Of the corners.
    is_clear : bool
        Whether hardly any faces lie over each other or outside the image.
    """

    texels: NDArray[np.int64]
    corners: NDArray[np.int32]
    weights: NDArray[np.float32]
    is_clear: bool

    def values(self, of_corners: NDArray[np.float32]) -> NDArray[np.float32]:
        """Values (N,) or (N, K) at the points, of those (C,) or (C, K) at the mesh's corners."""
        given = of_corners[self.corners]
        return np.einsum("nc,nc...->n...", self.weights, given)


def covered(mesh: bpy.types.Mesh, places: NDArray[np.float32], rows: int, columns: int) -> Covered:
    """The points at the middle of texels; where faces lie over each other, of one of them.

    Parameters
    ----------
    places : (corners, 2) array
        UV coordinates.
    """
    mesh.calc_loop_triangles()
    corners = np.empty((len(mesh.loop_triangles), 3), np.int32)
    cast(Any, mesh.loop_triangles).foreach_get("loops", corners.ravel())
    ends = (np.nan_to_num(places) * (columns, rows) - 0.5)[corners]
    low = np.clip(np.ceil(ends.min(axis=1)), 0, (columns, rows)).astype(np.int32)
    high = np.clip(np.floor(ends.max(axis=1)) + 1, 0, (columns, rows)).astype(np.int32)
    wide, tall = np.maximum(high - low, 0).T
    planes = _planes(ends - low[:, None])
    last = np.cumsum(wide.astype(np.int64) * tall)
    before = last - wide.astype(np.int64) * tall
    triangle = np.full(rows * columns, -1, np.int32)
    within = 0
    for start in range(0, int(last[-1]) if len(last) else 0, CHUNK):
        end = min(start + CHUNK, int(last[-1]))
        first, final = np.searchsorted(last, (start, end - 1), side="right")
        inner = np.diff(np.clip(last[first : final + 1], start, end), prepend=start)
        own = np.repeat(np.arange(first, final + 1, dtype=np.int32), inner)
        number = (np.arange(start, end) - before[own]).astype(np.int32)
        y = number // wide[own]
        x = number - y * wide[own]
        least = _weights(planes, own, x, y).min(axis=0)
        inside = least >= -EDGE
        own, x, y = own[inside], x[inside], y[inside]
        within += np.count_nonzero(least > EDGE)
        triangle[(low[own, 1] + y) * columns + low[own, 0] + x] = own
    nearest = _grown(np.where(triangle >= 0, np.arange(triangle.size), -1).reshape(rows, columns))
    texels = np.flatnonzero(nearest >= 0)
    source = nearest.ravel()[texels]
    own = triangle[source]
    x, y = source % columns - low[own, 0], source // columns - low[own, 1]
    weights = _weights(planes, own, x, y).T
    outside = np.any((ends.max(axis=1) < -0.5) | (ends.min(axis=1) > (columns, rows)), axis=1)
    over = within - np.count_nonzero(triangle >= 0)
    is_clear = over <= UNCLEAR * within and np.count_nonzero(outside) <= UNCLEAR * len(outside)
    return Covered(texels, corners[own], weights, bool(is_clear))


def _planes(ends: NDArray[np.floating]) -> NDArray[np.float32]:
    """Barycentric coordinates of triangles (N, 3, 2) over x and y: slopes and start, (3, 3, N).

    Those of triangles without area are -1.
    """
    (ax, ay), (bx, by), (cx, cy) = (ends[:, corner].T for corner in range(3))
    area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    whole = np.where(area == 0.0, 1.0, area)
    second = np.stack([cy - ay, ax - cx, (cx - ax) * ay - (cy - ay) * ax]) / whole
    third = np.stack([ay - by, bx - ax, (by - ay) * ax - (bx - ax) * ay]) / whole
    first = np.array([0.0, 0.0, 1.0])[:, None] - second - third
    planes = np.stack([first, second, third])
    flat = np.array([0.0, 0.0, -1.0])[:, None]
    return np.where(area == 0.0, flat, planes).astype(np.float32)


def _weights(
    planes: NDArray[np.float32], own: NDArray, x: NDArray, y: NDArray
) -> NDArray[np.float32]:
    """Barycentric coordinates (3, N) of places in triangles."""
    across, up = x.astype(np.float32), y.astype(np.float32)
    return np.stack([a[own] * across + b[own] * up + c[own] for a, b, c in planes])


def _grown(nearest: NDArray[np.int64]) -> NDArray[np.int64]:
    """Numbers of texels, also beside where they are not negative."""
    for _ in range(MARGIN):
        former = np.pad(nearest, 1, constant_values=-1)
        for down, right in ((1, 2), (1, 0), (2, 1), (0, 1), (2, 2), (0, 0), (2, 0), (0, 2)):
            rows, columns = nearest.shape
            beside = former[down : down + rows, right : right + columns]
            nearest = np.where(nearest < 0, beside, nearest)
    return nearest
