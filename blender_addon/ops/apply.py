"""The buttons that give objects a tan."""

from collections.abc import Iterator
from contextlib import contextmanager, nullcontext

import bpy
from bpy.props import BoolProperty, EnumProperty

from hylios.errors import InputError

from .. import timing
from ..apply import apply_tan
from ..model.fitting import nearest_type
from ..own_colour import painted_skin
from ..props import SkinTanSettings, settings_of
from ..props.copying import copy_values, put_values, values_in
from ..tannable import tannable
from .active import (
    active_mesh,
    active_object,
    active_settings,
    current_scene,
    is_named,
    selected_meshes,
)

FIRST_EXPOSURE = "Day in the sun"
FIRST_AMOUNT = 2.0
"""Tanning doses of the exposure that an object without any is given: it burns light skin and tans
all but the lightest, and blisters none."""

OF_THE_OBJECT = ("group", "material", "materials", "keyed", "own_day", "applied", "undone")
"""What Apply notes of an object, which is no setting."""


class SKIN_TAN_OT_apply(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.apply"
    bl_label = "Apply Tan"
    bl_description = (
        "Give the active object skin that tans over the timeline, and every selected one that has "
        "times in the sun, each by its own settings. An active one without any gets a day of it"
    )
    bl_options = {"REGISTER", "UNDO"}

    objects: EnumProperty(
        name="Objects",
        description="Which objects tan",
        items=(
            ("SELECTED", "Selected", "The active one, and those selected with times in the sun"),
            ("ACTIVE", "Active", "The active object alone"),
        ),
        default="SELECTED",
    )
    show: BoolProperty(
        name="Show",
        description="Go to the frame of the darkest day",
        options={"SKIP_SAVE"},
    )

    def invoke(self, context, event):
        """As `execute`; the first tan of an object is shown on its darkest day."""
        obj = active_mesh(context)
        self.show = obj is not None and settings_of(obj).group is None
        return self.execute(context)

    def execute(self, context):
        scene = current_scene(context)
        try:
            obj = tannable(active_object(context))
            with _exposed(obj), _fitted(obj) as fitted:
                said = " ".join([apply_tan(obj, scene), *fitted])
            is_shown = self.show and timing.is_timed(obj)
            darkest = timing.show_darkest(obj, scene) if is_shown else ""
            if darkest != timing.NOT_SEEN:  # else Apply has said why
                said = f"{said} {darkest}".rstrip()
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        others = [] if self.objects == "ACTIVE" or is_named(context) else selected_meshes(context)
        others = [other for other in others if other != obj and settings_of(other).exposures]
        self.report({"INFO"}, said)
        _apply(self, others, scene)
        return {"FINISHED"}


class SKIN_TAN_OT_copy_to_selected(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.copy_to_selected"
    bl_label = "Copy Tan to Selected"
    bl_description = (
        "Give the selected objects the settings of the active one in place of their own, and apply "
        "them. Every object keeps its own masks, matched by name"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        obj = active_mesh(context)
        if obj is None or not set(selected_meshes(context)) - {obj}:
            cls.poll_message_set("Select other mesh objects, and last the one to copy from")
            return False
        return True

    def execute(self, context):
        source = active_mesh(context)
        settings = active_settings(context)
        others = [obj for obj in selected_meshes(context) if obj != source]
        done = _apply(self, others, current_scene(context), settings)
        return {"FINISHED"} if done else {"CANCELLED"}


@contextmanager
def _fitted(obj: bpy.types.Object) -> Iterator[list[str]]:
    """Give an object the skin type nearest to its painted colour, unless one was set before.

    An exception takes it back. Yields sentences on it.
    """
    settings = settings_of(obj)
    colour = None
    if settings.group is None and not settings.is_property_set("skin"):
        colour = painted_skin(obj)
    fitting = None if colour is None else nearest_type(colour)
    if fitting is None:
        yield []
        return
    settings.skin = fitting[0]
    try:
        yield [f"Of the skin types, {fitting[0]} is nearest to the painted colour."]
    except BaseException:
        settings.property_unset("skin")
        raise


@contextmanager
def _exposed(obj: bpy.types.Object) -> Iterator[None]:
    """Give an object without a time in the sun a day of it, unless an exception follows."""
    settings = settings_of(obj)
    if settings.exposures or settings.group is not None:
        yield
        return
    exposure = settings.exposures.add()
    exposure.name, exposure.unit, exposure.multiple = FIRST_EXPOSURE, "MMD", FIRST_AMOUNT
    try:
        yield
    except BaseException:
        settings.exposures.clear()
        raise


@contextmanager
def _set_as(obj: bpy.types.Object, settings: SkinTanSettings) -> Iterator[None]:
    """Give an object the settings of another, unless an exception follows."""
    own = settings_of(obj)
    former = values_in(own, leave=OF_THE_OBJECT)
    try:
        copy_values(settings, own, leave=OF_THE_OBJECT)
        for name, number in settings.response_numbers().items():
            setattr(own, name, number)
        yield
    except BaseException:
        put_values(own, former)
        raise


def _apply(
    operator: bpy.types.Operator,
    objects: list[bpy.types.Object],
    scene: bpy.types.Scene,
    settings: SkinTanSettings | None = None,
) -> list[bpy.types.Object]:
    """Apply the tans of objects, report what was done, and return those that have one.

    Parameters
    ----------
    settings : SkinTanSettings, optional
        In place of their own.
    """
    done = []
    for obj in objects:
        try:
            tannable(obj)
            with _set_as(obj, settings) if settings else nullcontext():
                said = apply_tan(obj, scene)
        except InputError as error:
            operator.report({"WARNING"}, f"{obj.name}: {error}")
        else:
            done.append(obj)
            if said:
                operator.report({"INFO"}, f"{obj.name}: {said}")
    if done:
        operator.report({"INFO"}, f"Applied to {', '.join(repr(obj.name) for obj in done)} too.")
    return done
