"""The buttons about days and frames."""

import bpy

from hylios.errors import InputError

from .. import timing
from ..apply import timeable
from .active import active_mesh, active_object, current_scene


class SKIN_TAN_OT_reset_timing(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.reset_timing"
    bl_label = "Reset Timing"
    bl_description = "Key the days anew as set here, in place of your own keys of tan_day"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return active_mesh(context) is not None

    def execute(self, context):
        try:
            obj = timeable(active_object(context))
            message = timing.reset(obj, current_scene(context))
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, message)
        return {"FINISHED"}


class SKIN_TAN_OT_go_to_darkest_day(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.go_to_darkest_day"
    bl_label = "Go to Darkest Day"
    bl_description = "Show the frame on which bare skin is darkest"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return active_mesh(context) is not None

    def execute(self, context):
        try:
            message = timing.show_darkest(timeable(active_object(context)), current_scene(context))
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, message)
        return {"FINISHED"}
