"""The buttons beside the list of regions."""

import bpy
from bpy.props import EnumProperty, FloatProperty, StringProperty

from ..model.regions import MOST_STRENGTH
from ..props.region import KIND_ITEMS
from .active import active_settings, can_edit
from .lists import RemovesMember


class SKIN_TAN_OT_add_region(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.add_region"
    bl_label = "Add Region"
    bl_description = (
        "Add freckles, age spots, moles, cheeks, palms and soles, lips, vitiligo or others. Spots "
        "come by themselves; the others lie where their mask is"
    )
    bl_options = {"REGISTER", "UNDO"}

    kind: EnumProperty(
        name="Kind",
        description="What is different there from the skin around it",
        items=KIND_ITEMS,
        default="FRECKLES",
    )
    strength: FloatProperty(
        name="Strength",
        description="How much it differs from the skin around it: 1 is usual, 0 is not at all",
        default=1.0,
        min=0.0,
        max=MOST_STRENGTH,
    )
    mask: StringProperty(
        name="Mask",
        description="Vertex group, attribute or image that says where the region lies",
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context):
        return can_edit(cls, context)

    def execute(self, context):
        settings = active_settings(context)
        added = settings.regions.add()
        added.kind, added.strength = self.kind, self.strength
        added.mask.source = self.mask
        settings.region_index = len(settings.regions) - 1
        return {"FINISHED"}


class SKIN_TAN_OT_remove_region(RemovesMember, bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.remove_region"
    bl_label = "Remove Region"
    bl_description = "Remove the selected region; its mask stays on the mesh"
    bl_options = {"REGISTER", "UNDO"}

    members, selected = "regions", "region_index"
    nothing = "The object has no region of the skin: add one with +"
