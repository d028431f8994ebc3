"""The buttons that make masks: for a brush, and from clothes."""

import time
from collections.abc import Generator
from typing import Any, cast

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, StringProperty

from hylios.errors import InputError

from ..masking import ClothesRequest, from_clothes, mask_for_brush
from ..props import SkinTanMask, SkinTanRegion, settings_of
from ..tannable import kind_of, tannable
from .active import active_object, current_scene, has_mesh, selected_objects

STEP_SECONDS = 0.05
"""So long From Clothes computes before it looks for Esc."""

SURFACES = ("CURVE", "SURFACE", "FONT", "META")
"""Types of objects that may be modelled as clothes, and are no meshes."""

MODES = {"COLOUR": "VERTEX_PAINT", "GROUP": "WEIGHT_PAINT", "IMAGE": "TEXTURE_PAINT"}


TARGETS = (
    ("AUTO", "Selected", "The own mask of the selected time in the sun, else the object's"),
    ("OBJECT", "Object", "The mask of all times in the sun without their own"),
    (
        "EXPOSURE",
        "Time in the Sun",
        "The own mask of the selected time in the sun, which gets one if it has none",
    ),
)
"""Which mask a button makes or paints."""

REGION = "REGION"
PAINTED = (*TARGETS, (REGION, "Region", "The mask of the selected region of the skin"))


def target_property(items: tuple[tuple[str, str, str], ...] = TARGETS) -> Any:
    return EnumProperty(
        name="Mask of",
        description="Which mask is made or painted",
        items=items,
        default="AUTO",
        options={"SKIP_SAVE"},
    )


def edited_mask(obj: bpy.types.Object, target: str) -> SkinTanMask:
    """The mask that a button makes or paints.

    Raises
    ------
    InputError
        If it is an exposure's and there is none.
    """
    settings = settings_of(obj)
    exposures = settings.exposures
    if target == "OBJECT" or (target == "AUTO" and not exposures):
        return settings.mask
    if not exposures:
        raise InputError(
            f"{obj.name!r} has no time in the sun that could have a mask; add one first."
        )
    exposure = exposures[min(settings.exposure_index, len(exposures) - 1)]
    return exposure.mask if target == "EXPOSURE" or exposure.own_mask else settings.mask


def wear(obj: bpy.types.Object, mask: SkinTanMask) -> None:
    """Turn on a time in the sun's own mask, now that it is made."""
    for exposure in settings_of(obj).exposures:
        if exposure.mask == mask and not exposure.own_mask:
            exposure.own_mask = True


def _worn_when_made(
    work: Generator[float, None, str], obj: bpy.types.Object, mask: SkinTanMask
) -> Generator[float, None, str]:
    said = yield from work
    wear(obj, mask)
    return said


def edited_region(obj: bpy.types.Object) -> SkinTanRegion:
    """The region that is selected in the list.

    Raises
    ------
    InputError
        If there is none.
    """
    settings = settings_of(obj)
    if not settings.regions:
        raise InputError(f"{obj.name!r} has no region that could have a mask; add one first.")
    return settings.regions[min(settings.region_index, len(settings.regions) - 1)]


def has_window(context: bpy.types.Context) -> bool:
    return context.window is not None and not bpy.app.background


class SKIN_TAN_OT_paint_mask(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.paint_mask"
    bl_label = "Paint Mask"
    bl_description = (
        "Paint where the sun did not reach: black is covered, white is bare. Goes on with the mask "
        "that there is, or makes one that is all bare"
    )
    bl_options = {"REGISTER", "UNDO"}

    target: target_property(PAINTED)
    name: StringProperty(
        name="Name",
        description="Name of a new mask; that of a region is called after its kind if not given",
        default="Sun Mask",
        options={"SKIP_SAVE"},
    )
    domain: EnumProperty(
        name="Domain",
        description="What holds the colours of a new mask",
        items=(
            ("POINT", "Points", "Smooth from point to point"),
            ("CORNER", "Corners", "Faces can be filled alone, with hard edges, by Paint Mask"),
        ),
        default="POINT",
    )
    enter: BoolProperty(
        name="Enter Paint Mode",
        description="Take up the brush, where there is a window",
        default=True,
    )

    @classmethod
    def poll(cls, context):
        return has_mesh(cls, context)

    def execute(self, context):
        try:
            obj = tannable(active_object(context))
            kind, said = self._prepared(obj)
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if (
            self.enter
            and has_window(context)
            and obj == cast(Any, context).view_layer.objects.active
        ):
            if obj.mode != MODES[kind]:
                cast(Any, bpy.ops).object.mode_set(mode=MODES[kind])
            if kind == "COLOUR":
                _take_brush(context, white=self.target == REGION)
        self.report({"INFO"}, said)
        return {"FINISHED"}

    def _prepared(self, obj: bpy.types.Object) -> tuple[str, str]:
        if self.target != REGION:
            mask = edited_mask(obj, self.target)
            done = mask_for_brush(obj, mask, self.name, self.domain)
            wear(obj, mask)
            return done
        region = edited_region(obj)
        is_named = self.properties.is_property_set("name")
        name = self.name if is_named else f"{region.label()} Mask"
        return mask_for_brush(obj, region.mask, name, self.domain)


def _take_brush(context: bpy.types.Context, *, white: bool) -> None:
    """Have the brush paint black or white, and the other with its second colour (X swaps them)."""
    tools: Any = context.tool_settings
    paint = tools.vertex_paint
    unified = getattr(paint, "unified_paint_settings", None) or tools.unified_paint_settings
    brush = unified if unified.use_unified_color else paint.brush
    if brush is not None:
        brush.color, brush.secondary_color = (float(white),) * 3, (float(not white),) * 3


class SKIN_TAN_OT_mask_from_clothes(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.mask_from_clothes"
    bl_label = "From Clothes"
    bl_description = (
        "Cover what lies under the selected garments. Select them first and the body last; pose "
        "arms and legs apart. The mask can be painted on. Esc cancels"
    )
    bl_options = {"REGISTER", "UNDO"}

    garments: CollectionProperty(
        name="Garments",
        description="Names of garments; the other selected meshes if none are given",
        type=bpy.types.OperatorFileListElement,
        options={"HIDDEN", "SKIP_SAVE"},
    )
    target: target_property()
    name: StringProperty(name="Name", description="Name of a new mask", default="Clothes Mask")
    reach: FloatProperty(
        name="Reach (mm)",
        description="How far from the skin cloth may be, in millimetres, to cover it",
        default=30.0,
        min=0.0,
        soft_max=200.0,
        max=10000.0,
        step=100,
        precision=1,
    )
    inside: FloatProperty(
        name="Inside (mm)",
        description="How far cloth may dip into the skin, in millimetres, and still cover it",
        default=5.0,
        min=0.0,
        soft_max=50.0,
        max=10000.0,
        step=100,
        precision=1,
    )
    softness: FloatProperty(
        name="Softness (mm)",
        description="Width of the edge of the tan in millimetres, from covered to bare. Where the "
        "mesh is coarse the edge is a little wider than the mesh's own edges are long",
        default=4.0,
        min=0.0,
        soft_max=100.0,
        max=10000.0,
        step=100,
        precision=1,
    )

    _work: Generator[float, None, str] | None = None
    _timer: Any = None

    @classmethod
    def poll(cls, context):
        return has_mesh(cls, context)

    def invoke(self, context, event):
        del event
        if not has_window(context):
            return self.execute(context)
        try:
            self._work = self._started(context)
            next(self._work)
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        manager: Any = context.window_manager
        manager.progress_begin(0.0, 1.0)
        self._timer = manager.event_timer_add(0.01, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self._end(context)
            self.report({"INFO"}, "Cancelled; nothing has changed.")
            return {"CANCELLED"}
        if event.type != "TIMER" or self._work is None:
            return {"RUNNING_MODAL"}
        manager: Any = context.window_manager
        until = time.monotonic() + STEP_SECONDS
        try:
            while time.monotonic() < until:
                manager.progress_update(next(self._work))
        except StopIteration as done:
            self._end(context)
            self.report({"INFO"}, done.value)
            return {"FINISHED"}
        except InputError as error:
            self._end(context)
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"RUNNING_MODAL"}

    def _end(self, context: Any) -> None:
        context.window_manager.progress_end()
        context.window_manager.event_timer_remove(self._timer)
        self._work = self._timer = None

    def execute(self, context):
        try:
            work = self._started(context)
            while True:
                next(work)
        except StopIteration as done:
            self.report({"INFO"}, done.value)
            return {"FINISHED"}
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}

    def _started(self, context: bpy.types.Context) -> Generator[float, None, str]:
        obj = tannable(active_object(context))
        named = [item.name for item in cast(Any, self).garments]
        worn = [_object(name) for name in named] if named else selected_objects(context)
        request = ClothesRequest(
            garments=tuple(item for item in worn if item.type == "MESH" and item != obj),
            left_out=tuple(item for item in worn if _may_be_clothes(item)),
            name=self.name,
            reach=self.reach,
            inside=self.inside,
            softness=self.softness,
        )
        mask = edited_mask(obj, self.target)
        work = from_clothes(obj, mask, request, context, current_scene(context))
        return _worn_when_made(work, obj, mask)


def _may_be_clothes(obj: bpy.types.Object) -> bool:
    """Whether an object shows surfaces like a garment's, though it is no mesh."""
    return obj.type in SURFACES or obj.instance_type == "COLLECTION"


def _object(name: str) -> bpy.types.Object:
    obj = bpy.data.objects.get(name)
    if obj is None:
        raise InputError(f"There is no object {name!r}; garments are names of objects.")
    if obj.type != "MESH":
        raise InputError(f"{name!r} is of type {kind_of(obj)}; a garment is a mesh object.")
    return obj
