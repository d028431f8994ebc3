"""All classes of the add-on, and where Blender keeps their properties."""

from pathlib import Path
from typing import Any

import bpy

from . import live, ops, painting, props, renaming, translations, ui

FOLDER = str(Path(__file__).parent)
"""With the presets that the add-on brings."""

CLASSES = (*props.CLASSES, *ops.CLASSES, *ui.CLASSES)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    objects: Any = bpy.types.Object
    objects.skin_tan = bpy.props.PointerProperty(
        type=props.SkinTanSettings, override={"LIBRARY_OVERRIDABLE"}
    )
    scenes: Any = bpy.types.Scene
    scenes.skin_tan = bpy.props.PointerProperty(type=props.SkinTanScene)
    bpy.utils.register_preset_path(FOLDER)
    translations.register()
    live.register()
    painting.register()
    renaming.register()


def unregister():
    ui.forget_swatches()
    ui.forget_curve()
    renaming.unregister()
    painting.unregister()
    live.unregister()
    translations.unregister()
    bpy.utils.unregister_preset_path(FOLDER)
    objects: Any = bpy.types.Object
    del objects.skin_tan
    scenes: Any = bpy.types.Scene
    del scenes.skin_tan
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
