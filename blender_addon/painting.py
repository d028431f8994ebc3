"""While weights are painted that are a mask, the tan shows them.

The shader reads a copy of the vertex group (`scene.vertex_groups`). A handler notices strokes, and
a timer brings the copy up to date when the brush rests.
"""

from typing import Any, cast

import bpy
from bpy.app.handlers import persistent

from . import timers
from .scene.masks import COPIES_KEY
from .scene.vertex_groups import mask_names, refresh

REST_SECONDS = 0.15


@persistent
def notice(scene: bpy.types.Scene, depsgraph: Any) -> None:
    """Handler: have a stroke on weights shown soon."""
    del scene
    updates = (item.id.original for item in depsgraph.updates if item.is_updated_geometry)
    painted = any(isinstance(block, bpy.types.Object) and _is_painted(block) for block in updates)
    if painted:
        timers.wait(show_strokes, REST_SECONDS)


def show_strokes() -> float | None:
    """Timer: bring the copies of painted groups up to date; the seconds until the next call."""
    if bpy.app.is_job_running("RENDER"):
        return REST_SECONDS
    for obj in filter(_is_painted, cast(Any, bpy.context).scene.objects):
        refresh(obj, mask_names(obj))
    return None


def _is_painted(obj: bpy.types.Object) -> bool:
    return (
        obj.mode == "WEIGHT_PAINT"
        and isinstance(obj.data, bpy.types.Mesh)
        and COPIES_KEY in obj.data
    )


def register() -> None:
    bpy.app.handlers.depsgraph_update_post.append(notice)


def unregister() -> None:
    bpy.app.handlers.depsgraph_update_post.remove(notice)
    timers.forget(show_strokes)
