"""Settings that stay with a library override."""

from typing import TypeVar

import bpy

Group = TypeVar("Group", bound=type)


def overridable(cls: Group) -> Group:
    """Let all properties of a group be changed on an override of a linked object."""
    for deferred in cls.__annotations__.values():
        is_list = deferred.function is bpy.props.CollectionProperty
        insertion = {"USE_INSERTION"} if is_list else set()
        deferred.keywords.setdefault("override", {"LIBRARY_OVERRIDABLE", *insertion})
    return cls
