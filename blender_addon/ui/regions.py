"""The list of regions, and the selected one."""

import bpy

from ..model.regions import spots
from ..props import settings_of
from .masks import draw_mask


class SKIN_TAN_UL_regions(bpy.types.UIList):  # noqa: N801
    def draw_item(self, context, layout, data, item, icon, active_data, active_property):
        row = layout.row(align=True)
        row.prop(item, "enabled", text="")
        split = row.split(factor=0.66)
        split.active = item.enabled
        split.label(text=item.label())
        split.prop(item, "strength", text="", emboss=False)


def draw_regions(
    layout: bpy.types.UILayout, obj: bpy.types.Object, context: bpy.types.Context
) -> None:
    settings = settings_of(obj)
    row = layout.row()
    row.template_list(
        "SKIN_TAN_UL_regions", "", settings, "regions", settings, "region_index", rows=2
    )
    buttons = row.column(align=True)
    buttons.operator("skin_tan.add_region", text="", icon="ADD")
    buttons.operator("skin_tan.remove_region", text="", icon="REMOVE")
    if not settings.regions:
        return
    region = settings.regions[min(settings.region_index, len(settings.regions) - 1)]
    layout.prop(region, "kind", text="")
    layout.prop(region, "strength")
    if region.kind.lower() in spots():
        layout.prop(region, "painted")
    without = "No mask: they are everywhere" if region.has_spots() else "No mask: it is nowhere"
    draw_mask(layout, obj, region.mask, context, without)
