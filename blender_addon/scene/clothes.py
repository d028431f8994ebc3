"""Where clothes cover skin: rays out of it along its normals, and a soft edge at garments' hems.

The hem is found between points of the mesh, to a 64th of an edge, and the share of the dose follows
from the distance to it. So the edge is a clean line, though it lies on few points.
"""

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree
from mathutils.kdtree import KDTree
from numpy.typing import NDArray

from .images import stem
from .posed import Surface

HALVINGS = 6
"""Of an edge of the mesh, to find where the hem crosses it."""

RAYS_PER_STEP = 4000
"""After so many an artist may cancel."""

NEAREST = 8
"""Pieces of the hem of which one is the nearest."""

LEAST_WIDTH = 1.25
"""Of the edge of a tan, over the length of the edges of the mesh there. A line of half the dose is
then .013 of that length from the hem (rms), with 1 it is .032, and with 1.5 .005 but blurred."""

DELETE = "Delete"
MPFB_KEY = "MPFB_MC_delete_group"
"""Property of a garment of MPFB: the name of the group with what of the body it covers."""

Progress = Generator[float, None, NDArray]
"""Yields how much is done, from 0 to 1; returns an array."""


@dataclass(frozen=True)
class Reach:
    """How far a garment may be, and how soft its edge is, in units of the scene.

    Attributes
    ----------
    outward : float
        From the skin to a garment over it.
    inward : float
        From the skin to a garment that dips into it.
    softness : float
        Width of the edge, from covered to bare; no less than `LEAST_WIDTH`.
    """

    outward: float
    inward: float
    softness: float


def covered_shares(
    skin: Surface, clothes: Surface, reach: Reach, also: NDArray[np.bool_]
) -> Progress:
    """The share of the dose (points,) at points of skin; 0 under clothes.

    Parameters
    ----------
    also : (points,) bool array
        Points that are covered whatever the rays say.
    """
    tree: Any = BVHTree.FromPolygons(clothes.points.tolist(), clothes.triangles.tolist())

    def is_covered(points: NDArray, normals: NDArray) -> NDArray[np.bool_]:
        length = reach.inward + reach.outward
        hits = map(
            tree.ray_cast,
            (points - reach.inward * normals).tolist(),
            normals.tolist(),
            [length] * len(points),
        )
        return np.fromiter((hit[0] is not None for hit in hits), bool, len(points))

    covered = np.zeros(len(also), bool)
    for first in range(0, len(covered), RAYS_PER_STEP):
        part = slice(first, first + RAYS_PER_STEP)
        covered[part] = is_covered(skin.points[part], skin.normals[part])
        yield 0.6 * min(first + RAYS_PER_STEP, len(covered)) / len(covered)
    missed = also & ~covered
    covered |= also
    edges = _edges(skin.triangles)
    hem = _hem(skin, edges, covered, missed, is_covered)
    yield 0.7
    width = np.maximum(reach.softness, LEAST_WIDTH * _spacing(skin.points, edges))
    distance = yield from _distances(skin.points, hem, width)
    ramp = 0.5 + np.where(covered, -distance, distance) / width
    return np.clip(ramp, 0.0, 1.0).astype(np.float32)


def delete_groups(body: bpy.types.Object, garment: bpy.types.Object) -> list[str]:
    """Vertex groups of a body that hold what a garment of MPFB covers.

    MPFB calls them after the garment's file, and the garment after the same with the person's name
    before it; the garment has the name in a property too.
    """
    stored = getattr(garment, MPFB_KEY, None) or garment.get(MPFB_KEY)
    called = stem(garment.name).replace(" ", "_").casefold()
    listed = []
    for group in body.vertex_groups:
        name = group.name.removeprefix(DELETE).casefold()
        if group.name == stored or (name[:1] == "." and name[1:] and f".{called}".endswith(name)):
            listed.append(group.name)
    return listed


def _edges(triangles: NDArray[np.int32]) -> NDArray[np.int32]:
    """Edges (N, 2) of triangles, each once, the lower point first."""
    pairs = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    return np.unique(pairs, axis=0)


def _hem(
    skin: Surface,
    edges: NDArray[np.int32],
    covered: NDArray[np.bool_],
    missed: NDArray[np.bool_],
    is_covered: Callable[[NDArray, NDArray], NDArray[np.bool_]],
) -> NDArray[np.float64]:
    """Straight pieces (N, 2, 3) of the line between covered and bare skin."""
    crossed = edges[covered[edges[:, 0]] != covered[edges[:, 1]]]
    if not len(crossed):
        return np.zeros((0, 2, 3))
    inside = np.where(covered[crossed[:, 0]], crossed[:, 0], crossed[:, 1])
    outside = np.where(covered[crossed[:, 0]], crossed[:, 1], crossed[:, 0])
    low, high = np.zeros(len(crossed)), np.ones(len(crossed))
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        part = middle[:, None]
        points = skin.points[inside] * (1 - part) + skin.points[outside] * part
        normals = skin.normals[inside] * (1 - part) + skin.normals[outside] * part
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        still = is_covered(points, normals)
        low, high = np.where(still, middle, low), np.where(still, high, middle)
    # At points that are covered though rays miss, it is in the middle of an edge.
    part = np.where(missed[inside], 0.5, (low + high) / 2)[:, None]
    places = skin.points[inside] * (1 - part) + skin.points[outside] * part
    return _pieces(skin.triangles, covered, crossed, places)


def _pieces(
    triangles: NDArray[np.int32],
    covered: NDArray[np.bool_],
    crossed: NDArray[np.int32],
    places: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Of every triangle that the hem crosses, the piece between two of its edges."""
    mixed = triangles[np.ptp(covered[triangles].astype(np.int8), axis=1) > 0]
    sides = np.sort(mixed[:, [[0, 1], [1, 2], [2, 0]]], axis=2)
    is_crossed = covered[sides[..., 0]] != covered[sides[..., 1]]
    count = int(triangles.max()) + 1
    keys = crossed[:, 0].astype(np.int64) * count + crossed[:, 1]  # in order, as edges are
    of_sides = sides[..., 0].astype(np.int64) * count + sides[..., 1]
    indices = np.searchsorted(keys, of_sides[is_crossed]).reshape(-1, 2)
    return places[indices]


def _distances(points: NDArray, hem: NDArray[np.float64], width: NDArray) -> Progress:
    """Distance (points,) of points from the hem; infinite beyond half the width of the edge."""
    distances = np.full(len(points), np.inf)
    if not len(hem):
        return distances
    middles, lengths = hem.mean(axis=1), np.linalg.norm(hem[:, 1] - hem[:, 0], axis=1)
    tree: Any = KDTree(len(hem))
    for index, middle in enumerate(middles.tolist()):
        tree.insert(middle, index)
    tree.balance()
    within = 0.5 * (width + lengths.max())
    for first in range(0, len(distances), RAYS_PER_STEP):
        part = slice(first, first + RAYS_PER_STEP)
        nearest = np.array([tree.find(point)[2] for point in points[part].tolist()])
        for index in first + np.flatnonzero(nearest <= within[part]):
            pieces = hem[[item[1] for item in tree.find_n(points[index], NEAREST)]]
            distances[index] = _to_pieces(points[index], pieces)
        yield 0.7 + 0.3 * min(first + RAYS_PER_STEP, len(distances)) / len(distances)
    return distances


def _to_pieces(point: NDArray[np.float64], pieces: NDArray[np.float64]) -> float:
    """Distance of a point from the nearest of some straight pieces (N, 2, 3)."""
    along = pieces[:, 1] - pieces[:, 0]
    squares = np.maximum((along * along).sum(axis=1), 1e-30)
    part = np.clip(((point - pieces[:, 0]) * along).sum(axis=1) / squares, 0.0, 1.0)
    return float(np.linalg.norm(pieces[:, 0] + part[:, None] * along - point, axis=1).min())


def _spacing(points: NDArray[np.float64], edges: NDArray[np.int32]) -> NDArray[np.float64]:
    """Mean length (points,) of the edges at points."""
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    count = len(points)
    total = np.bincount(edges.ravel(), np.repeat(lengths, 2), minlength=count)
    return total / np.maximum(np.bincount(edges.ravel(), minlength=count), 1)
