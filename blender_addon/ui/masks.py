"""What a mask reads, and how."""

from typing import Any, cast

import bpy

from ..props import SkinTanFilmMask, SkinTanMask, SkinTanRegionMask, settings_of
from ..scene import masks
from .lines import draw_lines

AnyMask = SkinTanMask | SkinTanFilmMask | SkinTanRegionMask
BARE = "No mask: the whole body is bare"


def draw_object_mask(
    layout: bpy.types.UILayout, obj: bpy.types.Object, context: bpy.types.Context
) -> None:
    """The mask of all exposures that have none of their own."""
    settings = settings_of(obj)
    if settings.mask.source == "" and settings.mask_attribute:
        # A file of version 0.1.0 has its name there.
        layout.prop(settings, "mask_attribute", text="", icon="MOD_MASK")
    else:
        _draw_source(layout, settings.mask)
    _draw_makers(layout, "OBJECT")
    _draw_reading(layout, obj, settings.mask, settings.object_mask(), context, BARE)


def draw_mask(
    layout: bpy.types.UILayout,
    obj: bpy.types.Object,
    settings: AnyMask,
    context: bpy.types.Context,
    without: str = BARE,
) -> None:
    """A mask of the selected exposure or region, or of the film, and what having none means."""
    _draw_source(layout, settings)
    if isinstance(settings, SkinTanMask):
        _draw_makers(layout, "EXPOSURE")
    if isinstance(settings, SkinTanRegionMask):
        paint: Any = layout.operator("skin_tan.paint_mask", icon="BRUSH_DATA")
        paint.target = "REGION"
    _draw_reading(layout, obj, settings, masks.Mask.of(settings), context, without)


def _draw_source(layout: bpy.types.UILayout, settings: AnyMask) -> None:
    layout.prop(settings, "source", text="", icon="MOD_MASK", placeholder="Choose a mask")


def _draw_makers(layout: bpy.types.UILayout, target: str) -> None:
    """The buttons that make a mask."""
    row: Any = layout.row(align=True)
    for name, icon in (("paint_mask", "BRUSH_DATA"), ("mask_from_clothes", "MATCLOTH")):
        button = row.operator(f"skin_tan.{name}", icon=icon)
        button.target = target


def _draw_reading(
    layout: bpy.types.UILayout,
    obj: bpy.types.Object,
    settings: AnyMask,
    mask: masks.Mask,
    context: bpy.types.Context,
    without: str,
) -> None:
    if not mask:
        layout.label(text=without, icon="INFO")
        return
    layer = cast(Any, context).view_layer
    source = masks.source_of(obj, mask, layer.depsgraph if layer else None)
    if source is None:
        draw_lines(layout, ("The mesh does not have this mask:", "choose another one"), "ERROR")
        return
    if source.kind == "IMAGE":
        if settings.image and settings.image.name != settings.source:
            layout.label(text=settings.image.name, icon="IMAGE_DATA")
        layout.prop(settings, "uv_map", text="", icon="GROUP_UVS")
    if source.has_channels:
        layout.prop(settings, "channel")
    row = layout.row(align=True)
    if not isinstance(settings, SkinTanRegionMask):  # a region has its own
        row.prop(settings, "strength")
    row.prop(settings, "invert")
