"""Copies of what an artist has set."""

from collections.abc import Collection

import bpy


def copy_values(
    source: bpy.types.PropertyGroup,
    target: bpy.types.PropertyGroup,
    leave: Collection[str] = (),
) -> None:
    """Give a group of properties the values of another of its kind, but for some names.

    What the source has at its default is put back to it, so that it follows a later default.
    """
    for prop in source.bl_rna.properties:
        name = prop.identifier
        if name == "rna_type" or name in leave:
            continue
        if prop.type == "COLLECTION":
            members = getattr(target, name)
            members.clear()
            for item in getattr(source, name):
                copy_values(item, members.add())
        elif prop.type == "POINTER" and isinstance(getattr(source, name), bpy.types.PropertyGroup):
            copy_values(getattr(source, name), getattr(target, name))
        elif not source.is_property_set(name):
            target.property_unset(name)
        elif not prop.is_readonly:
            setattr(target, name, getattr(source, name))
