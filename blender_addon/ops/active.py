"""The object that an operator works on."""

from typing import Any, cast

import bpy

from ..props import SkinTanSettings, settings_of


def active_object(context: bpy.types.Context) -> bpy.types.Object | None:
    """The active object, or the one that `temp_override` names; works without a window too."""
    layer = cast(Any, context).view_layer
    active = layer.objects.active if layer else None
    for name in ("object", "active_object"):
        obj = getattr(context, name, None)
        if obj is not None and obj != active:
            return obj
    return active


def selected_objects(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Selected objects, or those that `temp_override` names; works without a window too."""
    layer = cast(Any, context).view_layer
    selected = getattr(context, "selected_objects", None)
    if selected is None:
        selected = layer.objects.selected if layer else ()
    return list(selected)


def selected_meshes(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Those of `selected_objects` that are meshes."""
    return [obj for obj in selected_objects(context) if obj.type == "MESH"]


def is_named(context: bpy.types.Context) -> bool:
    """Whether `temp_override` names an object other than the active one."""
    layer = cast(Any, context).view_layer
    return layer is not None and active_object(context) != layer.objects.active


def current_scene(context: bpy.types.Context) -> bpy.types.Scene:
    return cast(Any, context).scene


def active_mesh(context: bpy.types.Context) -> bpy.types.Object | None:
    """The active object where that is a mesh."""
    obj = active_object(context)
    return obj if obj is not None and obj.type == "MESH" else None


def has_mesh(cls: Any, context: bpy.types.Context) -> bool:
    """Whether the active object is a mesh; a poll of `cls` says so where it is not."""
    if active_mesh(context) is None:
        cls.poll_message_set("Select a mesh object")
        return False
    return True


def can_edit(cls: Any, context: bpy.types.Context) -> bool:
    """Whether the settings of the active mesh can be changed; a poll of `cls` says why not."""
    if not has_mesh(cls, context):
        return False
    if cast(bpy.types.Object, active_mesh(context)).library is not None:
        cls.poll_message_set("The object is linked from another file: make it local or override it")
        return False
    return True


def active_settings(context: bpy.types.Context) -> SkinTanSettings:
    """What is set on the active mesh, where `poll` found one."""
    obj = active_mesh(context)
    assert obj is not None
    return settings_of(obj)
