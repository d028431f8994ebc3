"""The buttons beside the list of exposures."""

import bpy

from .active import active_mesh, active_settings


class SKIN_TAN_OT_add_exposure(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.add_exposure"
    bl_label = "Add Exposure"
    bl_description = "Add a time in the sun"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return active_mesh(context) is not None

    def execute(self, context):
        settings = active_settings(context)
        settings.exposures.add()
        settings.exposure_index = len(settings.exposures) - 1
        return {"FINISHED"}


class SKIN_TAN_OT_remove_exposure(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.remove_exposure"
    bl_label = "Remove Exposure"
    bl_description = "Remove the selected time in the sun"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return active_mesh(context) is not None and len(active_settings(context).exposures) > 0

    def execute(self, context):
        settings = active_settings(context)
        last = len(settings.exposures) - 1
        settings.exposures.remove(min(settings.exposure_index, last))
        settings.exposure_index = max(0, min(settings.exposure_index, last - 1))
        return {"FINISHED"}
