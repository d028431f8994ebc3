"""The buttons about days and frames."""

import bpy

from .. import timing
from ..tannable import timeable
from .active import active_object, current_scene, has_mesh
from .reports import finished


class SKIN_TAN_OT_reset_timing(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.reset_timing"
    bl_label = "Reset Timing"
    bl_description = "Key the days anew as set here, in place of your own keys of tan_day"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return has_mesh(cls, context)

    def execute(self, context):
        return finished(
            self, lambda: timing.reset(timeable(active_object(context)), current_scene(context))
        )


class SKIN_TAN_OT_go_to_darkest_day(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.go_to_darkest_day"
    bl_label = "Go to Darkest Day"
    bl_description = "Show the frame on which bare skin is darkest"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return has_mesh(cls, context)

    def execute(self, context):
        return finished(
            self,
            lambda: timing.show_darkest(timeable(active_object(context)), current_scene(context)),
        )
