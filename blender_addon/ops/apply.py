"""The button that gives an object its tan."""

import bpy

from hylios.errors import InputError

from ..apply import apply_tan
from .active import active_object, current_scene


class SKIN_TAN_OT_apply(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.apply"
    bl_label = "Apply Tan"
    bl_description = (
        "Give the active object skin that tans over the timeline, with the settings of this panel"
    )
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            message = apply_tan(active_object(context), current_scene(context))
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, message)
        return {"FINISHED"}
