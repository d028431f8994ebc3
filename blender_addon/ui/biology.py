"""Sliders of what differs in a skin from its type."""

import bpy

from ..props import SkinTanSettings
from .lines import draw_lines

MELANIN, BLOOD = ("melanin", "eumelanin", "pheomelanin"), ("blood", "oxygenation")


def draw_biology(layout: bpy.types.UILayout, settings: SkinTanSettings) -> None:
    biology = settings.biology
    for names in (MELANIN, BLOOD, ("thickness",)):
        column = layout.column(align=True)
        for name in names:
            column.prop(biology, name)
    if not biology.is_changed():
        return
    layout.operator("skin_tan.reset_biology", icon="LOOP_BACK")
    lines = "Light spreads as in the type.", "For a table of this very skin:"
    draw_lines(layout, lines, "INFO")
    layout.operator("skin_tan.copy_build_command", icon="COPYDOWN")
