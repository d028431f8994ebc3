"""Which objects can carry a tan, and of which its day can be keyed."""

from typing import Any

import bpy

from hylios.errors import InputError

from .scene.ownership import is_local


def mesh_object(obj: bpy.types.Object | None) -> bpy.types.Object:
    """The object, if it is a mesh.

    Raises
    ------
    InputError
        If it is not.
    """
    if obj is None:
        raise InputError("No object is active; select a mesh object.")
    if obj.type != "MESH":
        raise InputError(f"{obj.name!r} is of type {kind_of(obj)}; select a mesh object.")
    return obj


def kind_of(obj: bpy.types.Object) -> str:
    """What an object is, as Blender's menus call it."""
    kinds: Any = obj.bl_rna.properties["type"]
    return kinds.enum_items[obj.type].name


def timeable(obj: bpy.types.Object | None) -> bpy.types.Object:
    """The object, if the day of its tan can be keyed: a local mesh object or a library override.

    Raises
    ------
    InputError
        If it cannot.
    """
    obj = mesh_object(obj)
    if obj.library is not None:
        raise InputError(
            f"The object {obj.name!r} is linked from another file; allowed is a local one or a "
            "library override (Object > Library Override > Make)."
        )
    return obj


def tannable(obj: bpy.types.Object | None) -> bpy.types.Object:
    """The object, if it can carry a tan.

    Raises
    ------
    InputError
        If it cannot.
    """
    obj = mesh_object(obj)
    action = obj.animation_data.action if obj.animation_data else None
    for block, what in ((obj, "object"), (obj.data, "mesh of"), (action, "animation of")):
        if block is not None and block.override_library is not None:
            raise InputError(
                f"The {what} {obj.name!r} is a library override; allowed is a local one "
                "(Object > Library Override > Clear)."
            )
        if block is not None and not is_local(block):
            raise InputError(
                f"The {what} {obj.name!r} is linked from another file; allowed is a local one "
                "(Object > Relations > Make Local)."
            )
    return obj
