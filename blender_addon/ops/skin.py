"""The buttons about whose skin it is."""

from typing import Any, cast

import bpy

from hylios.errors import InputError

from ..model.biology import build_command
from .active import active_mesh, active_settings


class SKIN_TAN_OT_reset_biology(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.reset_biology"
    bl_label = "Reset Biology"
    bl_description = "Put the sliders back to the skin type's own biology"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return active_mesh(context) is not None

    def execute(self, context):
        active_settings(context).biology.reset()
        return {"FINISHED"}


class SKIN_TAN_OT_copy_build_command(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.copy_build_command"
    bl_label = "Copy Build Command"
    bl_description = (
        "Copy the shell command that builds this skin's table anew with lut-builder, outside "
        "Blender: then light also spreads in it as in such skin"
    )
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        return active_mesh(context) is not None

    def execute(self, context):
        try:
            command = build_command(active_settings(context).values())
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        cast(Any, context).window_manager.clipboard = command
        self.report({"INFO"}, command)
        return {"FINISHED"}
