"""The panels, from top to bottom: in the sidebar of the 3D view, and beside a material."""

import textwrap
from typing import Any, cast

import bpy

from hylios.errors import InputError

from ..applied import is_changed, is_left_behind, text_of
from ..model.lines import Line
from ..model.summary import LINE
from ..ops.active import active_mesh, current_scene
from ..props import settings_of
from ..scene.masks import require_usable
from ..scene.ownership import is_local
from ..scene.slots import has_tan
from ..scene.timeline import shown_day
from .biology import draw_biology
from .curve import draw_curve
from .exposures import draw_exposures
from .lines import draw_lines
from .masks import draw_object_mask
from .materials import draw_materials
from .presets import SKIN_TAN_PT_schedule_presets, SKIN_TAN_PT_skin_presets
from .regions import draw_regions
from .size import draw_size
from .skin import draw_film, draw_skin
from .timeline import draw_timeline

FRAMES_CHANGED = (Line("Scene's frames have changed:"), Line("Apply Tan follows them"))


class _Sidebar:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Tan"


class _MaterialTab:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"


class _Main:
    bl_label = "Skin Tan"

    def draw(self, context: bpy.types.Context) -> None:
        layout = _layout(self)
        obj = active_mesh(context)
        if obj is None:
            layout.label(text="Select a mesh object", icon="INFO")
            return
        settings = settings_of(obj)
        elsewhere = _of_another_file(obj)
        row = layout.row()
        row.scale_y = 1.5
        row.enabled = not elsewhere
        row.operator("skin_tan.apply", icon="MATERIAL")
        if elsewhere:
            draw_lines(layout, elsewhere, "LINKED")
        day = shown_day(obj)
        if day is not None:
            draw_lines(layout, (Line("This frame shows day {day:.1f}", day=day),), "TIME")
        if settings.group is None:
            if has_tan(obj):
                layout.operator("skin_tan.remove", icon="X")
            return
        draw_curve(layout, settings)
        layout.prop(settings, "live")
        if is_changed(obj, current_scene(context)):
            _draw_change(layout, obj, current_scene(context))
        if is_left_behind(obj, current_scene(context)):
            draw_lines(layout, FRAMES_CHANGED, "INFO")
        draw_size(layout, obj, current_scene(context))
        row = layout.row()
        row.enabled = not elsewhere
        row.operator("skin_tan.remove", icon="X")


def _of_another_file(obj: bpy.types.Object) -> tuple[str, ...]:
    """Short lines on why the tan of an object is not changed here; none where it is."""
    if obj.library is not None:
        return "Linked from another file: make it", "local or a library override"
    if obj.override_library is not None:
        return "Library override: its tan changes in", "its own file; Reset keys its days here"
    action = obj.animation_data.action if obj.animation_data else None
    if all(block is None or is_local(block) for block in (obj.data, action)):
        return ()
    return "Its mesh or animation is linked:", "make it local to change its tan"


def _draw_change(layout: bpy.types.UILayout, obj: bpy.types.Object, scene: bpy.types.Scene) -> None:
    """What waits for Apply, or why it would refuse."""
    settings = settings_of(obj)
    try:
        for mask in settings.all_masks():
            require_usable(obj, mask)
    except InputError as error:
        said = textwrap.wrap(str(error).split(";")[0], LINE)
        draw_lines(layout, (Line("Apply Tan cannot show it:"), *said), "ERROR")
        return
    if not settings.live or settings.undone == text_of(obj, scene):
        layout.label(text="Changed: Apply Tan shows it", icon="ERROR")


class _Section:
    """A sub-panel on one subject of the active mesh."""

    bl_options: Any = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return active_mesh(context) is not None


class _Skin(_Section):
    bl_label = "Skin"
    bl_options: Any = set()

    def draw_header_preset(self, context: bpy.types.Context) -> None:
        SKIN_TAN_PT_skin_presets.draw_panel_header(_layout(self))

    def draw(self, context: bpy.types.Context) -> None:
        draw_skin(_layout(self), _mesh(context), context)


class _Biology(_Section):
    bl_label = "Biology"

    def draw(self, context: bpy.types.Context) -> None:
        draw_biology(_layout(self), settings_of(_mesh(context)))


class _Exposures(_Section):
    bl_label = "Time in the Sun"
    bl_options: Any = set()

    def draw_header_preset(self, context: bpy.types.Context) -> None:
        SKIN_TAN_PT_schedule_presets.draw_panel_header(_layout(self))

    def draw(self, context: bpy.types.Context) -> None:
        draw_exposures(_layout(self), _mesh(context), context)


class _Mask(_Section):
    bl_label = "Where the Sun Reaches"
    bl_options: Any = set()

    def draw(self, context: bpy.types.Context) -> None:
        draw_object_mask(_layout(self), _mesh(context), context)


class _Timeline(_Section):
    bl_label = "Timeline"

    def draw(self, context: bpy.types.Context) -> None:
        draw_timeline(_layout(self), settings_of(_mesh(context)))


class _Materials(_Section):
    bl_label = "Materials That Tan"

    def draw(self, context: bpy.types.Context) -> None:
        draw_materials(_layout(self), _mesh(context))


class _Regions(_Section):
    bl_label = "Regions"

    def draw(self, context: bpy.types.Context) -> None:
        draw_regions(_layout(self), _mesh(context), context)


class _Film(_Section):
    bl_label = "On the Skin"

    def draw(self, context: bpy.types.Context) -> None:
        draw_film(_layout(self), _mesh(context), context)


def _layout(panel: Any) -> bpy.types.UILayout:
    layout = cast(bpy.types.UILayout, panel.layout)
    layout.use_property_decorate = False
    return layout


def _mesh(context: bpy.types.Context) -> bpy.types.Object:
    """The active mesh, where `poll` found one."""
    return cast(bpy.types.Object, active_mesh(context))


class VIEW3D_PT_skin_tan(_Sidebar, _Main, bpy.types.Panel):  # noqa: N801
    pass


class VIEW3D_PT_skin_tan_skin(_Sidebar, _Skin, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "VIEW3D_PT_skin_tan"


class VIEW3D_PT_skin_tan_biology(_Sidebar, _Biology, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "VIEW3D_PT_skin_tan_skin"


class VIEW3D_PT_skin_tan_regions(_Sidebar, _Regions, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "VIEW3D_PT_skin_tan_skin"


class VIEW3D_PT_skin_tan_exposures(_Sidebar, _Exposures, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "VIEW3D_PT_skin_tan"


class VIEW3D_PT_skin_tan_mask(_Sidebar, _Mask, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "VIEW3D_PT_skin_tan"


class VIEW3D_PT_skin_tan_timeline(_Sidebar, _Timeline, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "VIEW3D_PT_skin_tan"


class VIEW3D_PT_skin_tan_materials(_Sidebar, _Materials, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "VIEW3D_PT_skin_tan"


class VIEW3D_PT_skin_tan_film(_Sidebar, _Film, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "VIEW3D_PT_skin_tan"


class MATERIAL_PT_skin_tan(_MaterialTab, _Main, bpy.types.Panel):  # noqa: N801
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return active_mesh(context) is not None


class MATERIAL_PT_skin_tan_skin(_MaterialTab, _Skin, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "MATERIAL_PT_skin_tan"


class MATERIAL_PT_skin_tan_biology(_MaterialTab, _Biology, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "MATERIAL_PT_skin_tan_skin"


class MATERIAL_PT_skin_tan_regions(_MaterialTab, _Regions, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "MATERIAL_PT_skin_tan_skin"


class MATERIAL_PT_skin_tan_exposures(_MaterialTab, _Exposures, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "MATERIAL_PT_skin_tan"


class MATERIAL_PT_skin_tan_mask(_MaterialTab, _Mask, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "MATERIAL_PT_skin_tan"


class MATERIAL_PT_skin_tan_timeline(_MaterialTab, _Timeline, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "MATERIAL_PT_skin_tan"


class MATERIAL_PT_skin_tan_materials(_MaterialTab, _Materials, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "MATERIAL_PT_skin_tan"


class MATERIAL_PT_skin_tan_film(_MaterialTab, _Film, bpy.types.Panel):  # noqa: N801
    bl_parent_id = "MATERIAL_PT_skin_tan"


SIDEBAR = (
    VIEW3D_PT_skin_tan,
    VIEW3D_PT_skin_tan_skin,
    VIEW3D_PT_skin_tan_biology,
    VIEW3D_PT_skin_tan_regions,
    VIEW3D_PT_skin_tan_exposures,
    VIEW3D_PT_skin_tan_mask,
    VIEW3D_PT_skin_tan_timeline,
    VIEW3D_PT_skin_tan_materials,
    VIEW3D_PT_skin_tan_film,
)
MATERIAL_TAB = (
    MATERIAL_PT_skin_tan,
    MATERIAL_PT_skin_tan_skin,
    MATERIAL_PT_skin_tan_biology,
    MATERIAL_PT_skin_tan_regions,
    MATERIAL_PT_skin_tan_exposures,
    MATERIAL_PT_skin_tan_mask,
    MATERIAL_PT_skin_tan_timeline,
    MATERIAL_PT_skin_tan_materials,
    MATERIAL_PT_skin_tan_film,
)
