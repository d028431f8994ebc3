"""The button that lists an object's materials, skin ticked."""

from typing import Any, cast

import bpy

from ..apply import list_materials
from .active import active_mesh, active_object, has_mesh
from .reports import finished


class SKIN_TAN_OT_list_materials(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.list_materials"
    bl_label = "Find Skin Materials"
    bl_description = (
        "List this object's materials and tick those that look like skin, by name or by colour"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not has_mesh(cls, context):
            return False
        if not any(slot.material for slot in cast(Any, active_mesh(context)).material_slots):
            cls.poll_message_set("The object has no material: Apply Tan makes a skin")
            return False
        return True

    def execute(self, context):
        return finished(self, lambda: list_materials(active_object(context)))
