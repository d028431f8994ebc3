"""The buttons that switch the view."""

from typing import Any, cast

import bpy
from bpy.props import EnumProperty

from ..props.scene import VIEW_ITEMS
from ..views import switch_view
from .reports import finished


class SKIN_TAN_OT_switch_view(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.switch_view"
    bl_label = "Switch View"
    bl_description = "Show all tanned skin of this file as a camera for other light sees it"
    bl_options = {"REGISTER", "UNDO"}

    view: EnumProperty(name="View", description="The light in which skin is seen", items=VIEW_ITEMS)

    @classmethod
    def description(cls, context, properties):
        return next(says for name, _, says, _ in VIEW_ITEMS if name == properties.view)

    def execute(self, context):
        return finished(self, lambda: switch_view(cast(Any, self).view))
