"""The button that mends skin of the wrong size."""

from typing import Any, cast

import bpy
from bpy.props import FloatProperty

from ..model.settings import LARGEST_SCALE
from ..size import fit_size
from .active import active_object, current_scene, has_mesh
from .reports import finished


class SKIN_TAN_OT_fit_size(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.fit_size"
    bl_label = "Fit Skin to Size"
    bl_description = (
        "Fit how deep light goes in skin to the size of this object, and of all others in the "
        "scene that were made for other units. Keys, settings and colours stay"
    )
    bl_options = {"REGISTER", "UNDO"}

    model_scale: FloatProperty(
        name="Model Scale",
        description="How many times life-size the object is; 0 judges by its size",
        default=0.0,
        min=0.0,
        max=LARGEST_SCALE,
    )

    @classmethod
    def poll(cls, context):
        return has_mesh(cls, context)

    def execute(self, context):
        scale = cast(Any, self).model_scale
        return finished(
            self, lambda: fit_size(active_object(context), current_scene(context), scale)
        )
