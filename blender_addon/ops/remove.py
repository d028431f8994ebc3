"""The button that takes a tan off."""

from typing import cast

import bpy
from bpy.props import BoolProperty

from ..removal import has_tan, remove_tan
from .active import active_mesh, active_object, has_mesh
from .reports import finished


class SKIN_TAN_OT_remove(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.remove"
    bl_label = "Remove Tan"
    bl_description = (
        "Take the tan off the active object: materials, slots and animation as they were before "
        "Apply, with your own edits since. Settings and masks stay"
    )
    bl_options = {"REGISTER", "UNDO"}

    keep_timing: BoolProperty(
        name="Keep Timing",
        description="Leave the keys of the day on the object",
    )

    @classmethod
    def poll(cls, context):
        if not has_mesh(cls, context):
            return False
        if not has_tan(cast(bpy.types.Object, active_mesh(context))):
            cls.poll_message_set("The active object has no tan")
            return False
        return True

    def execute(self, context):
        return finished(
            self, lambda: remove_tan(active_object(context), keep_timing=self.keep_timing)
        )
