"""The list of exposures, and the selected one."""

from typing import Any, cast

import bpy

from hylios.errors import InputError

from ..model import summary
from ..model.lines import Line
from ..model.settings import WATER, Exposure
from ..props import SkinTanSettings, settings_of
from ..translations import told
from .lines import draw_lines
from .masks import draw_mask

FIELDS = {
    "SED": (("dose",),),
    "MMD": (("multiple",),),
    "UV_INDEX": (("uv_index", "duration"),),
    "SUN": (
        ("latitude",),
        ("altitude",),
        ("month",),
        ("day_of_month",),
        ("from_hour", "to_hour"),
        ("cloud",),
    ),
}
"""What is shown of an exposure by its unit, row by row."""


class SKIN_TAN_UL_exposures(bpy.types.UIList):  # noqa: N801
    def draw_item(self, context, layout, data, item, icon, active_data, active_property):
        row = layout.row(align=True)
        row.prop(item, "enabled", text="")
        split = row.split(factor=0.66)
        split.active = item.enabled
        if item.name:
            split.prop(item, "name", text="", emboss=False)
        else:
            split.label(text=told(summary.of_exposure(Exposure.of(item))))
        split.label(text=told(Line("Day {day:g}", day=item.day)))


class SKIN_TAN_MT_exposures(bpy.types.Menu):  # noqa: N801
    bl_label = "Times in the Sun"

    def draw(self, context):
        layout = cast(bpy.types.UILayout, self.layout)
        layout.operator("skin_tan.duplicate_exposure", icon="DUPLICATE")
        layout.operator("skin_tan.copy_to_selected", icon="COPYDOWN")
        layout.separator()
        layout.operator("skin_tan.import_exposures", icon="IMPORT")
        layout.operator("skin_tan.import_weather", icon="LIGHT_SUN")
        layout.operator("skin_tan.export_exposures", icon="EXPORT")
        layout.operator("skin_tan.export_schedule", icon="EXPORT")


def draw_exposures(
    layout: bpy.types.UILayout, obj: bpy.types.Object, context: bpy.types.Context
) -> None:
    settings = settings_of(obj)
    row = layout.row()
    row.template_list(
        "SKIN_TAN_UL_exposures", "", settings, "exposures", settings, "exposure_index", rows=3
    )
    buttons = row.column(align=True)
    buttons.operator("skin_tan.add_exposure", text="", icon="ADD")
    buttons.operator("skin_tan.remove_exposure", text="", icon="REMOVE")
    buttons.menu("SKIN_TAN_MT_exposures", text="", icon="DOWNARROW_HLT")
    if len(settings.exposures) > 1:
        up: Any = buttons.operator("skin_tan.move_exposure", text="", icon="TRIA_UP")
        down: Any = buttons.operator("skin_tan.move_exposure", text="", icon="TRIA_DOWN")
        up.direction, down.direction = "UP", "DOWN"
    if not settings.exposures:
        layout.label(text="Add a time in the sun with +", icon="INFO")
        return
    exposure = settings.exposures[min(settings.exposure_index, len(settings.exposures) - 1)]
    layout.prop(exposure, "name")
    layout.prop(exposure, "unit")
    column = layout.column(align=True)
    column.prop(exposure, "day")
    for names in FIELDS.get(exposure.unit, ()):  # a later version may know more units
        row = column.row(align=True)
        for name in names:
            row.prop(exposure, name)
    if exposure.unit == "SUN":
        layout.prop(exposure, "ground")
        layout.prop(exposure, "through")
        if exposure.through == WATER:
            layout.prop(exposure, "depth")
    layout.prop(exposure, "sunscreen")
    if exposure.sunscreen:
        row = layout.row(align=True)
        row.prop(exposure, "spf")
        row.prop(exposure, "sunscreen_amount")
    layout.prop(exposure, "own_mask")
    if exposure.own_mask:
        draw_mask(layout, obj, exposure.mask, context)
    draw_lines(layout, *dose_lines(settings, Exposure.of(exposure)))
    if exposure.day > settings.last_day:
        draw_lines(layout, ("After the last day: no effect",), "INFO")
    blisters = blister_lines(settings)
    if blisters:
        draw_lines(layout, blisters, "ERROR")


def dose_lines(settings: SkinTanSettings, exposure: Exposure) -> tuple[tuple[str, ...], str]:
    """Short lines on the dose that reaches the skin in an exposure, and their icon."""
    try:
        lines = summary.of_dose(exposure, settings.table_file(), settings.own_doses())
    except InputError as error:
        # Apply says it in full; here it would be cut off.
        return ("No dose: " + str(error).split(";")[0][: summary.LINE],), "ERROR"
    return lines, "LIGHT_SUN"


def blister_lines(settings: SkinTanSettings) -> tuple[str, ...]:
    """Short lines on doses that the model does not show; none where another line says why."""
    try:
        return summary.of_blisters(settings.values())
    except InputError:
        return ()
