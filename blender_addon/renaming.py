"""The panel calls an image that is a mask by its name, also after the image was renamed.

A mask has its image by pointer; the text field that an artist picks from holds a name.
"""

from typing import Any

import bpy
from bpy.app.handlers import persistent

from .props import settings_of

OWNER = object()
"""Whose subscription it is, for Blender's message bus."""


def name_masks() -> None:
    """Have masks of all objects of this file called after their images."""
    for obj in bpy.data.objects:
        if obj.type == "MESH" and obj.library is None:
            settings_of(obj).name_masks()


@persistent
def subscribe(*_: object) -> None:
    """Handler: Blender forgets subscriptions when it loads a file."""
    unsubscribe()
    names: Any = (bpy.types.Image, "name")
    bpy.msgbus.subscribe_rna(key=names, owner=OWNER, args=(), notify=name_masks)


def unsubscribe() -> None:
    bpy.msgbus.clear_by_owner(OWNER)


def register() -> None:
    bpy.app.handlers.load_post.append(subscribe)
    subscribe()


def unregister() -> None:
    bpy.app.handlers.load_post.remove(subscribe)
    unsubscribe()
