"""The buttons about whose skin it is."""

from typing import Any, cast

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatVectorProperty
from mathutils import Color

from hylios.errors import InputError

from ..matching import match_colour, own_colour
from ..model.biology import build_command
from ..model.catalogue import TYPES
from .active import active_object, active_settings, can_edit, current_scene
from .reports import finished

ADJUST = BoolProperty(
    name="Melanin and Blood",
    description="Set melanin and blood too, for what is left of the distance",
    default=True,
)


class SKIN_TAN_OT_choose_type(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.choose_type"
    bl_label = "Choose Skin Type"
    bl_description = "Give the object this skin type, with that type's usual melanin and blood"
    bl_options = {"REGISTER", "UNDO"}

    type: EnumProperty(
        name="Type",
        description="I is very light skin, VI dark",
        items=[(name, f"Type {name}", "") for name in TYPES],
        default="III",
    )

    @classmethod
    def poll(cls, context):
        return can_edit(cls, context)

    def execute(self, context):
        settings = active_settings(context)
        try:
            settings.skin = self.type
        except TypeError:
            self.report({"ERROR"}, f"This add-on comes without type {self.type}; install it anew.")
            return {"CANCELLED"}
        settings.biology.reset()
        said = f"The skin is of type {self.type}, with that type's usual melanin and blood."
        self.report({"INFO"}, said)
        return {"FINISHED"}


class SKIN_TAN_OT_match_colour(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.match_colour"
    bl_label = "Match Colour"
    bl_description = (
        "Choose the skin type that is nearest to the colour beside, and say how far away it is"
    )
    bl_options = {"REGISTER", "UNDO"}

    colour: FloatVectorProperty(
        name="Colour",
        description="Skin without sun, in linear values; the scene's sample if not given",
        subtype="COLOR",
        min=0.0,
        max=1.0,
        options={"SKIP_SAVE"},
    )
    adjust: ADJUST

    @classmethod
    def poll(cls, context):
        return can_edit(cls, context)

    def execute(self, context):
        scene: Any = current_scene(context)
        is_given = self.properties.is_property_set("colour")
        return _match(self, context, self.colour if is_given else scene.skin_tan.sample)


class SKIN_TAN_OT_match_texture(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.match_texture"
    bl_label = "Match Painted Skin"
    bl_description = (
        "Choose the skin type that is nearest to the colour in which the object's skin is painted"
    )
    bl_options = {"REGISTER", "UNDO"}

    adjust: ADJUST

    @classmethod
    def poll(cls, context):
        return can_edit(cls, context)

    def execute(self, context):
        try:
            colour = own_colour(active_object(context))
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        scene: Any = current_scene(context)
        scene.skin_tan.sample = colour.tolist()
        return _match(self, context, scene.skin_tan.sample)


def _match(operator: Any, context: bpy.types.Context, colour: Any) -> set[str]:
    """Give the active object the skin nearest to a colour of the scene's working space."""
    rec709: Any = Color(colour).from_scene_linear_to_rec709_linear()
    linear = np.clip(tuple(rec709), 0.0, 1.0)
    return finished(
        operator, lambda: match_colour(active_settings(context), linear, adjust=operator.adjust)
    )


class SKIN_TAN_OT_reset_biology(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.reset_biology"
    bl_label = "Reset Biology"
    bl_description = "Put the sliders back to the skin type's own biology"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return can_edit(cls, context)

    def execute(self, context):
        active_settings(context).biology.reset()
        self.report({"INFO"}, "Melanin, blood, oxygen and thickness are those of the skin type.")
        return {"FINISHED"}


class SKIN_TAN_OT_copy_build_command(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.copy_build_command"
    bl_label = "Copy Build Command"
    bl_description = (
        "Copy the shell command that builds this skin's table anew with lut-builder, outside "
        "Blender: then light also spreads in it as in such skin"
    )
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        return can_edit(cls, context)

    def execute(self, context):
        try:
            command = build_command(active_settings(context).values())
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        cast(Any, context).window_manager.clipboard = command
        self.report({"INFO"}, command)
        return {"FINISHED"}
