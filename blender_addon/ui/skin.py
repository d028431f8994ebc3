"""Whose skin it is, and what lies on it."""

from typing import Any, cast

import bpy

from hylios.errors import InputError

from ..model import summary
from ..model.catalogue import FILE
from ..model.lines import Line
from ..props import SkinTanSettings, settings_of
from ..scene import recolour
from .lines import draw_lines
from .masks import draw_mask
from .swatches import draw_types


def draw_skin(
    layout: bpy.types.UILayout, obj: bpy.types.Object, context: bpy.types.Context
) -> None:
    settings = settings_of(obj)
    draw_types(layout, settings.skin)
    layout.prop(settings, "skin", text="")
    if settings.skin == FILE:
        layout.prop(settings, "table_path", text="")
    draw_lines(layout, *skin_lines(settings))
    layout.prop(settings, "kinetics")
    row = layout.row()
    row.prop(settings, "redness")
    row.prop(settings, "peeling")
    layout.prop(settings, "darkening")
    if settings.darkening and all(item.unit != "SUN" for item in settings.exposures):
        draw_lines(layout, (Line("No time is given as Sun:"), Line("its UVA is not known")), "INFO")
    row = layout.row(align=True)
    row.prop(cast(Any, context).scene.skin_tan, "sample", text="")
    row.operator("skin_tan.match_colour")
    layout.operator("skin_tan.match_texture", icon="TEXTURE")
    column = layout.column()
    column.active = not settings.new_material
    column.prop(settings, "own_colour")
    if settings.own_colour:
        column.prop(settings, "usual_colour")
    layout.prop(settings, "own_minimal_doses")
    if settings.own_minimal_doses:
        column = layout.column(align=True)
        column.prop(settings, "mmd")
        column.prop(settings, "med")


def draw_film(
    layout: bpy.types.UILayout, obj: bpy.types.Object, context: bpy.types.Context
) -> None:
    settings = settings_of(obj)
    layout.prop(settings, "film")
    if settings.film != "NONE":
        if _is_recoloured(obj):
            lines = Line("A recoloured material"), Line("shows no film, a new one does")
            draw_lines(layout, lines, "INFO")
        draw_mask(layout, obj, settings.film_mask, context, "No mask: it lies everywhere")


def _is_recoloured(obj: bpy.types.Object) -> bool:
    """Whether a material of an artist's own shows an object's tan, or is to by Apply."""
    settings = settings_of(obj)
    shown = [slot.material for slot in obj.material_slots if slot.material]
    if settings.group is None:
        return bool(shown) and not settings.new_material
    return any(recolour.is_in(material) for material in shown)


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
