"""Copies of what an artist has set."""

from collections.abc import Collection
from typing import Any

import bpy

UNSET = object()
"""Value of what is at its default."""


def values_in(group: bpy.types.PropertyGroup, leave: Collection[str] = ()) -> dict[str, Any]:
    """What is set in a group of properties, by name, but for some names.

    A group in it has a dictionary, a collection a list of them.
    """
    values: dict[str, Any] = {}
    for prop in group.bl_rna.properties:
        name = prop.identifier
        if name == "rna_type" or name in leave:
            continue
        value = getattr(group, name)
        if prop.type == "COLLECTION":
            values[name] = [values_in(item) for item in value]
        elif prop.type == "POINTER" and isinstance(value, bpy.types.PropertyGroup):
            values[name] = values_in(value)
        elif not group.is_property_set(name):
            values[name] = UNSET
        elif not prop.is_readonly:
            values[name] = tuple(value) if isinstance(value, bpy.types.bpy_prop_array) else value
    return values


def put_values(group: bpy.types.PropertyGroup, values: dict[str, Any]) -> None:
    """Set in a group of properties what `values_in` told of one of its kind.

    What is to be at its default is put back to it, so that it follows a later default.
    """
    for name, value in values.items():
        member = getattr(group, name)
        if isinstance(value, list):
            member.clear()
            for item in value:
                put_values(member.add(), item)
        elif isinstance(value, dict):
            put_values(member, value)
        else:
            _put(group, name, value)
    # A property may set another one, as frames set the way of timing.
    for name, value in values.items():
        if not isinstance(value, list | dict) and not _has(group, name, value):
            _put(group, name, value)


def copy_values(
    source: bpy.types.PropertyGroup,
    target: bpy.types.PropertyGroup,
    leave: Collection[str] = (),
) -> None:
    """Give a group of properties the values of another of its kind, but for some names."""
    put_values(target, values_in(source, leave))


def _put(group: bpy.types.PropertyGroup, name: str, value: Any) -> None:
    if value is UNSET:
        group.property_unset(name)
    else:
        setattr(group, name, value)


def _has(group: bpy.types.PropertyGroup, name: str, value: Any) -> bool:
    if value is UNSET or not group.is_property_set(name):
        return value is UNSET and not group.is_property_set(name)
    shown = getattr(group, name)
    return (tuple(shown) if isinstance(value, tuple) else shown) == value
