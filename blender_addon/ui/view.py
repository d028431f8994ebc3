"""The panel that switches the view of all skin."""

from typing import Any, cast

import bpy

from ..ops.active import active_mesh
from ..props import settings_of
from ..props.scene import VIEW_ITEMS
from ..scene.views import shown_view, view_of_file
from .lines import draw_lines


class VIEW3D_PT_skin_tan_view(bpy.types.Panel):  # noqa: N801
    bl_label = "View of All Skin"
    bl_idname = "VIEW3D_PT_skin_tan_view"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Tan"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = cast(bpy.types.UILayout, self.layout)
        shown = cast(Any, context).scene.skin_tan.view
        column = layout.column(align=True)
        for pair in (VIEW_ITEMS[:2], VIEW_ITEMS[2:]):
            row = column.row(align=True)
            for view, label, *_ in pair:
                button: Any = row.operator(
                    "skin_tan.switch_view", text=label, depress=view == shown
                )
                button.view = view
        obj = active_mesh(context)
        group = settings_of(obj).group if obj else None
        if group is not None and shown_view(group) != view_of_file():
            draw_lines(
                layout, ("This skin shows another view:", "press the button to see why"), "INFO"
            )
