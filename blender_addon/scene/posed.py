"""Points of meshes where modifiers and pose put them, in the world."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, cast

import bpy
import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError

DEFORMING = frozenset(
    """
    ARMATURE CAST CURVE DISPLACE HOOK LAPLACIANDEFORM LATTICE MESH_CACHE MESH_DEFORM
    MESH_SEQUENCE_CACHE SHRINKWRAP SIMPLE_DEFORM SMOOTH CORRECTIVE_SMOOTH LAPLACIANSMOOTH
    SURFACE_DEFORM WARP WAVE
    """.split()
)
"""Types of modifiers that move points and neither make nor remove any."""


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles in the world.

    Attributes
    ----------
    points, normals : (points, 3) arrays
    triangles : (triangles, 3) int array
        Indices of points.
    """

    points: NDArray[np.float64]
    normals: NDArray[np.float64]
    triangles: NDArray[np.int32]


def posed_skin(obj: bpy.types.Object, context: bpy.types.Context) -> Surface:
    """A mesh's own points where modifiers put them, whatever others add to them or mask out.

    Raises
    ------
    InputError
        If the object is hidden or in Edit Mode, or its points cannot be told any more.
    """
    require_shown(obj, context)
    depsgraph = context.evaluated_depsgraph_get()
    if _is_whole(obj, depsgraph):
        return _surface(obj, depsgraph)
    with _deformed_copy(obj, context) as copy:
        depsgraph = context.evaluated_depsgraph_get()
        if not _is_whole(copy, depsgraph):
            raise InputError(
                f"The modifiers of {obj.name!r} leave none of its own points; apply those that "
                "make a new mesh."
            )
        return _surface(copy, depsgraph)


def posed_clothes(objects: list[bpy.types.Object], context: bpy.types.Context) -> Surface:
    """Garments as they show, all in one.

    Raises
    ------
    InputError
        If one is hidden or in Edit Mode.
    """
    for obj in objects:
        require_shown(obj, context)
    depsgraph = context.evaluated_depsgraph_get()
    surfaces = [_surface(obj, depsgraph) for obj in objects]
    starts = np.cumsum([0, *(len(surface.points) for surface in surfaces[:-1])])
    return Surface(
        np.concatenate([surface.points for surface in surfaces]),
        np.concatenate([surface.normals for surface in surfaces]),
        np.concatenate(
            [surface.triangles + start for surface, start in zip(surfaces, starts, strict=True)]
        ),
    )


def require_shown(obj: bpy.types.Object, context: bpy.types.Context) -> None:
    """Raise InputError unless Blender evaluates an object: hidden ones it leaves as they were."""
    if not obj.visible_get(view_layer=cast(Any, context).view_layer):
        raise InputError(f"{obj.name!r} is hidden in this view layer; show it for a moment.")
    if obj.mode == "EDIT":
        raise InputError(f"{obj.name!r} is in Edit Mode; leave Edit Mode (Tab).")


def _is_whole(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bool:
    """Whether modifiers leave the mesh its points and corners."""
    mesh, data = cast(bpy.types.Mesh, obj.data), obj.evaluated_get(depsgraph).data
    return isinstance(data, bpy.types.Mesh) and (len(data.vertices), len(data.loops)) == (
        len(mesh.vertices),
        len(mesh.loops),
    )


@contextmanager
def _deformed_copy(obj: bpy.types.Object, context: bpy.types.Context) -> Iterator[bpy.types.Object]:
    """A copy of an object that only deforms, in the scene for as long as it takes."""
    copy: Any = obj.copy()
    try:
        for modifier in list(copy.modifiers):
            if modifier.type not in DEFORMING:
                copy.modifiers.remove(modifier)
        cast(Any, context).scene.collection.objects.link(copy)
        yield copy
    finally:
        bpy.data.objects.remove(copy)


def _surface(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Surface:
    evaluated = obj.evaluated_get(depsgraph)
    mesh: Any = evaluated.data
    points = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.vertices.foreach_get("co", points.ravel())
    normals = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.vertex_normals.foreach_get("vector", normals.ravel())
    mesh.calc_loop_triangles()
    triangles = np.empty((len(mesh.loop_triangles), 3), np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles.ravel())
    triangles = triangles[np.isfinite(points).all(axis=1)[triangles].all(axis=1)]
    matrix = np.array(evaluated.matrix_world, float)
    turned = normals @ np.linalg.pinv(matrix[:3, :3])
    lengths = np.linalg.norm(turned, axis=1, keepdims=True)
    return Surface(
        np.nan_to_num(np.asarray(points @ matrix[:3, :3].T + matrix[:3, 3], float)),
        np.nan_to_num(turned / np.maximum(lengths, 1e-30)),
        triangles,
    )
