"""The panel in the 3D view's sidebar."""

import bpy

from hylios.errors import InputError

from . import tables
from .apply import minimal_doses
from .doses import of_exposure
from .nodes import DAY_PROPERTY

# Erythemal dose rate of the sun at UV index 8: 8 x 25 mW/m^2 for an hour is 720 J/m^2.
SED_PER_HOUR_OF_SUMMER_SUN = 7.2


FIELDS = {
    "SED": (("dose",),),
    "MMD": (("multiple",),),
    "UV_INDEX": (("uv_index", "duration"),),
    "SUN": (("latitude",), ("month", "day_of_month"), ("from_hour", "to_hour")),
}
"""What is shown of an exposure by its unit, row by row."""


class SKIN_TAN_UL_exposures(bpy.types.UIList):  # noqa: N801
    def draw_item(self, context, layout, data, item, icon, active_data, active_property):
        row = layout.row(align=True)
        row.use_property_split = False
        row.prop(item, "day", text="Day", emboss=False)
        if item.unit == "SED":
            row.prop(item, "dose", text="SED", emboss=False)
        else:
            row.label(text=summary(item))


class VIEW3D_PT_skin_tan(bpy.types.Panel):  # noqa: N801
    bl_label = "Skin Tan"
    bl_idname = "VIEW3D_PT_skin_tan"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Tan"

    def draw(self, context):
        layout = self.layout
        layout.use_property_decorate = False
        obj = context.object
        if obj is None or obj.type != "MESH":
            layout.label(text="Select a mesh object", icon="INFO")
            return
        settings = obj.skin_tan
        _draw_skin(_section(layout, "Skin"), settings)
        _draw_exposures(_section(layout, "Time in the Sun"), settings)
        _draw_mask(_section(layout, "Where the Sun Reaches"), obj)
        _draw_timeline(_section(layout, "Timeline"), settings)
        layout.separator()
        row = layout.row()
        row.scale_y = 1.5
        row.operator("skin_tan.apply", icon="MATERIAL")
        layout.operator("skin_tan.export_schedule", icon="EXPORT")
        if DAY_PROPERTY in obj:
            layout.label(text=f"This frame shows day {obj[DAY_PROPERTY]:.1f}", icon="TIME")


def _section(layout, title: str):
    layout.separator()
    column = layout.column()
    column.label(text=title)
    return column


def _draw_skin(layout, settings) -> None:
    layout.prop(settings, "skin", text="")
    if settings.skin == "FILE":
        layout.prop(settings, "table_path", text="")
    lines, icon = estimate(settings)
    column = layout.column(align=True)
    column.scale_y = 0.8
    for line in lines:
        column.label(text=line, icon=icon if line == lines[0] else "BLANK1")
    layout.prop(settings, "own_minimal_doses")
    if settings.own_minimal_doses:
        column = layout.column(align=True)
        column.prop(settings, "mmd")
        column.prop(settings, "med")


def estimate(settings) -> tuple[tuple[str, ...], str]:
    """Short lines on what the chosen table says of its skin, and their icon."""
    if settings.skin == "FILE" and not settings.table_path:
        return ("Choose a skin table (EXR file)",), "INFO"
    try:
        provenance = tables.provenance(tables.table_path(settings.skin, settings.table_path))
        doses = tables.minimal_doses(provenance)
    except InputError:
        # The whole sentence would be cut off here; Apply reports it.
        return ("This is not a usable skin table",), "ERROR"
    return (
        f"Tans from {doses.mmd:.1f} SED of sun,",
        f"burns from {doses.med:.1f} SED (estimates)",
    ), "INFO"


def _draw_exposures(layout, settings) -> None:
    row = layout.row()
    row.template_list(
        "SKIN_TAN_UL_exposures", "", settings, "exposures", settings, "exposure_index", rows=3
    )
    buttons = row.column(align=True)
    buttons.operator("skin_tan.add_exposure", text="", icon="ADD")
    buttons.operator("skin_tan.remove_exposure", text="", icon="REMOVE")
    if not settings.exposures:
        layout.label(text="Add a time in the sun with +", icon="INFO")
        return
    chosen = settings.exposures[min(settings.exposure_index, len(settings.exposures) - 1)]
    layout.prop(chosen, "unit")
    column = layout.column(align=True)
    for names in FIELDS[chosen.unit]:
        row = column.row(align=True)
        for name in names:
            row.prop(chosen, name)
    layout.prop(chosen, "sunscreen")
    if chosen.sunscreen:
        row = layout.row(align=True)
        row.prop(chosen, "spf")
        row.prop(chosen, "sunscreen_amount")
    column = layout.column(align=True)
    column.scale_y = 0.8
    lines, icon = reaching(settings, chosen)
    for line in lines:
        column.label(text=line, icon=icon if line == lines[0] else "BLANK1")


def summary(exposure) -> str:
    """An exposure in a few characters."""
    return {
        "SED": f"{exposure.dose:g} SED",
        "MMD": f"{exposure.multiple:g} MMD",
        "UV_INDEX": f"UV {exposure.uv_index:g}, {exposure.duration:g} h",
        "SUN": f"Sun {exposure.from_hour:g}-{exposure.to_hour:g} h",
    }[exposure.unit]


def reaching(settings, exposure) -> tuple[tuple[str, ...], str]:
    """Short lines on the dose that reaches the skin in an exposure, and their icon."""
    try:
        provenance = tables.provenance(tables.table_path(settings.skin, settings.table_path))
        mmd = minimal_doses(settings, provenance).mmd
        doses = of_exposure(exposure, mmd, provenance)
    except InputError as error:
        # Apply says it in full; here it would be cut off.
        return ("No dose: " + str(error).split(";")[0][:40],), "ERROR"
    meter, tanning = doses.erythemal.sum(), doses.melanogenesis.sum()
    hours = meter / SED_PER_HOUR_OF_SUMMER_SUN
    lines = [f"{meter:.3g} SED: {hours:.1f} h of strong summer sun"]
    if exposure.unit == "SUN":
        lines.append(f"tans like {tanning:.3g} SED (provisional)")
    return tuple(lines), "LIGHT_SUN"


def _draw_mask(layout, obj) -> None:
    layout.prop_search(
        obj.skin_tan, "mask_attribute", obj.data, "attributes", text="", icon="MOD_MASK"
    )
    if not obj.skin_tan.mask_attribute:
        layout.label(text="No mask: the whole body is bare", icon="INFO")


def _draw_timeline(layout, settings) -> None:
    for day, frame in (("first_day", "first_frame"), ("last_day", "last_frame")):
        row = layout.row(align=True)
        row.prop(settings, day, text="Day")
        row.prop(settings, frame, text="at Frame")


CLASSES = (SKIN_TAN_UL_exposures, VIEW3D_PT_skin_tan)
