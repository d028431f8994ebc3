"""Skin that tans over the timeline, in Blender.

Imports go one way: panels -> operators -> schedule -> apply -> tables, tan, images, nodes, timeline
-> doses -> hylios. `tan` and `doses` are numpy only; what Apply leaves in the scene needs neither
this add-on nor scripts.
"""

import bpy

from . import operators, panels, properties

CLASSES = (*properties.CLASSES, *operators.CLASSES, *panels.CLASSES)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Object.skin_tan = bpy.props.PointerProperty(type=properties.SkinTanSettings)


def unregister():
    del bpy.types.Object.skin_tan
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
