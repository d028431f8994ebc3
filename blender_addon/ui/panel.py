"""The panel, from top to bottom."""

from typing import cast

import bpy

from hylios.errors import InputError

from ..applied import is_changed
from ..model import summary
from ..model.catalogue import FILE
from ..model.timing import FRAMES, SPEED
from ..ops.active import active_mesh, current_scene
from ..props import SkinTanSettings, settings_of
from ..scene.timeline import shown_day
from .exposures import draw_exposures
from .lines import draw_lines
from .masks import draw_mask, draw_object_mask
from .materials import draw_materials
from .size import draw_size


class VIEW3D_PT_skin_tan(bpy.types.Panel):  # noqa: N801
    bl_label = "Skin Tan"
    bl_idname = "VIEW3D_PT_skin_tan"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Tan"

    def draw(self, context):
        layout = cast(bpy.types.UILayout, self.layout)
        layout.use_property_decorate = False
        obj = active_mesh(context)
        if obj is None:
            layout.label(text="Select a mesh object", icon="INFO")
            return
        settings = settings_of(obj)
        _draw_skin(_section(layout, "Skin"), obj, context)
        draw_exposures(_section(layout, "Time in the Sun"), obj, context)
        draw_object_mask(_section(layout, "Mask: Where the Sun Reaches"), obj, context)
        draw_materials(_section(layout, "Materials"), obj)
        _draw_timeline(_section(layout, "Timeline"), settings)
        draw_size(layout, obj, context.scene)
        layout.separator()
        row = layout.row()
        row.scale_y = 1.5
        row.operator("skin_tan.apply", icon="MATERIAL")
        layout.prop(settings, "live")
        if is_changed(obj, current_scene(context)) and not settings.live:
            layout.label(text="Changed: Apply Tan shows it", icon="ERROR")
        layout.operator("skin_tan.export_schedule", icon="EXPORT")
        day = shown_day(obj)
        if day is not None:
            layout.label(text=f"This frame shows day {day:.1f}", icon="TIME")


def _section(layout: bpy.types.UILayout, title: str) -> bpy.types.UILayout:
    layout.separator()
    column = layout.column()
    column.label(text=title)
    return column


def _draw_skin(
    layout: bpy.types.UILayout, obj: bpy.types.Object, context: bpy.types.Context
) -> None:
    settings = settings_of(obj)
    layout.prop(settings, "skin", text="")
    if settings.skin == FILE:
        layout.prop(settings, "table_path", text="")
    draw_lines(layout, *skin_lines(settings))
    layout.prop(settings, "film")
    if settings.film != "NONE":
        draw_mask(layout, obj, settings.film_mask, context, "No mask: it lies everywhere")
    layout.prop(settings, "own_minimal_doses")
    if settings.own_minimal_doses:
        column = layout.column(align=True)
        column.prop(settings, "mmd")
        column.prop(settings, "med")


def skin_lines(settings: SkinTanSettings) -> tuple[tuple[str, ...], str]:
    """Short lines on what the skin's table says of it, and their icon."""
    if settings.skin == FILE and not settings.table_path:
        return ("Choose a skin table (EXR file)",), "INFO"
    try:
        return summary.of_table(settings.table_file()), "INFO"
    except InputError:
        # The whole sentence would be cut off here; Apply reports it.
        if settings.skin == FILE:
            return ("This is not a usable skin table",), "ERROR"
        return ("This skin's table is damaged:", "install the add-on anew"), "ERROR"


def _draw_timeline(layout: bpy.types.UILayout, settings: SkinTanSettings) -> None:
    way = settings.timing_values().way
    layout.prop(settings, "timing", text="")
    column = layout.column(align=True)
    for day, frame in (("first_day", "first_frame"), ("last_day", "last_frame")):
        row = column.row(align=True)
        row.prop(settings, day, text="Day")
        if way == FRAMES or (way == SPEED and frame == "first_frame"):
            row.prop(settings, frame, text="at Frame")
    if way == SPEED:
        column.prop(settings, "days_per_second")
    row = layout.row(align=True)
    row.operator("skin_tan.go_to_darkest_day", text="Darkest Day", icon="TIME")
    row.operator("skin_tan.reset_timing", text="Reset", icon="FILE_REFRESH")
