"""Which materials tan: ticks, once they are listed."""

import bpy

from ..props import settings_of
from ..scene.slots import is_all_tanned


def draw_materials(layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
    settings = settings_of(obj)
    shown = {slot.material for slot in obj.material_slots if slot.material}
    listed = [entry for entry in settings.materials if entry.material in shown]
    column = layout.column(align=True)
    for entry in listed:
        column.prop(entry, "tans", text=entry.material.name)
    if len(listed) < len(shown):
        layout.operator("skin_tan.list_materials", icon="VIEWZOOM")
    if shown:
        row = layout.row()
        row.enabled = not is_all_tanned(obj)  # which gets a new material is settled
        row.prop(settings, "new_material")
        if not row.enabled:
            layout.label(text="Remove Tan to change this", icon="INFO")
    else:
        layout.label(text="No material: a new skin is made", icon="INFO")
