"""What the buttons do."""

import bpy
from bpy_extras.io_utils import ExportHelper

from hylios.errors import InputError

from .apply import apply_tan
from .schedule import export_schedule


def _has_settings(context) -> bool:
    return context.object is not None and context.object.type == "MESH"


class SKIN_TAN_OT_add_exposure(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.add_exposure"
    bl_label = "Add Exposure"
    bl_description = "Add a time in the sun"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return _has_settings(context)

    def execute(self, context):
        settings = context.object.skin_tan
        settings.exposures.add()
        settings.exposure_index = len(settings.exposures) - 1
        return {"FINISHED"}


class SKIN_TAN_OT_remove_exposure(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.remove_exposure"
    bl_label = "Remove Exposure"
    bl_description = "Remove the chosen time in the sun"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return _has_settings(context) and len(context.object.skin_tan.exposures) > 0

    def execute(self, context):
        settings = context.object.skin_tan
        last = len(settings.exposures) - 1
        settings.exposures.remove(min(settings.exposure_index, last))
        settings.exposure_index = max(0, min(settings.exposure_index, last - 1))
        return {"FINISHED"}


class SKIN_TAN_OT_apply(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.apply"
    bl_label = "Apply Tan"
    bl_description = "Give the active object a skin material that tans over the timeline"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            message = apply_tan(context.object, context.scene)
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, message)
        return {"FINISHED"}


class SKIN_TAN_OT_export_schedule(bpy.types.Operator, ExportHelper):  # noqa: N801
    bl_idname = "skin_tan.export_schedule"
    bl_label = "Export Schedule"
    bl_description = "Write the times in the sun to a file, for a table of what they lead to alone"
    filename_ext = ".csv"
    filter_glob: bpy.props.StringProperty(default="*.csv", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return _has_settings(context)

    def execute(self, context):
        try:
            message = export_schedule(context.object, self.filepath)
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, message)
        return {"FINISHED"}


CLASSES = (
    SKIN_TAN_OT_add_exposure,
    SKIN_TAN_OT_remove_exposure,
    SKIN_TAN_OT_apply,
    SKIN_TAN_OT_export_schedule,
)
