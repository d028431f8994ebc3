"""How the days lie on the timeline."""

import bpy

from ..model.timing import FRAMES, SPEED
from ..props import SkinTanSettings


def draw_timeline(layout: bpy.types.UILayout, settings: SkinTanSettings) -> None:
    way = settings.timing_values().way
    layout.prop(settings, "timing", text="")
    column = layout.column(align=True)
    for day, frame in (("first_day", "first_frame"), ("last_day", "last_frame")):
        row = column.row(align=True)
        if way == FRAMES or (way == SPEED and frame == "first_frame"):
            row.prop(settings, day, text="Day")
            row.prop(settings, frame, text="at Frame")
        else:
            row.prop(settings, day)
    if way == SPEED:
        column.prop(settings, "days_per_second")
    row = layout.row(align=True)
    row.operator("skin_tan.go_to_darkest_day", text="Darkest Day", icon="TIME")
    row.operator("skin_tan.reset_timing", text="Reset", icon="FILE_REFRESH")
