"""The button that lists an object's materials, skin ticked."""

import bpy

from hylios.errors import InputError

from ..apply import list_materials
from .active import active_mesh, active_object


class SKIN_TAN_OT_list_materials(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.list_materials"
    bl_label = "Find Skin Materials"
    bl_description = (
        "List this object's materials and tick those that look like skin, by name or by colour"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        obj = active_mesh(context)
        return obj is not None and any(slot.material for slot in obj.material_slots)

    def execute(self, context):
        try:
            list_materials(active_object(context))
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}
