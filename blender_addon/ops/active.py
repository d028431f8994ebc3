"""The object that an operator works on."""

import bpy


def active_object(context: bpy.types.Context) -> bpy.types.Object | None:
    """The active object, or the one that `temp_override` names; works without a window too."""
    active = context.view_layer.objects.active if context.view_layer else None
    for name in ("object", "active_object"):
        obj = getattr(context, name, None)
        if obj is not None and obj != active:
            return obj
    return active


def active_mesh(context: bpy.types.Context) -> bpy.types.Object | None:
    """The active object where that is a mesh."""
    obj = active_object(context)
    return obj if obj is not None and obj.type == "MESH" else None
