"""The buttons beside the list of exposures."""

from typing import Any

import bpy
from bpy.props import EnumProperty, FloatProperty, StringProperty

from ..model.settings import DOSE_LIMIT, LAST_DAY_LIMIT
from ..props.copying import copy_values
from ..props.presets import OF_ONE_MESH
from .active import active_settings, can_edit
from .lists import OnMember, RemovesMember, move


class SKIN_TAN_OT_add_exposure(bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.add_exposure"
    bl_label = "Add Time in the Sun"
    bl_description = "Add a time in the sun, a day after the last one"
    bl_options = {"REGISTER", "UNDO"}

    name: StringProperty(name="Name", description="What you call this time in the sun")
    day: FloatProperty(
        name="Day",
        description="Day from the start of the tan; a day after the last if not given",
        min=0.0,
        max=LAST_DAY_LIMIT,
        options={"SKIP_SAVE"},
    )
    dose: FloatProperty(
        name="Dose (SED)",
        description="How much sun in standard erythema doses; as the last time if not given",
        min=0.0,
        max=DOSE_LIMIT,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context):
        return can_edit(cls, context)

    def execute(self, context):
        settings = active_settings(context)
        last = max(settings.exposures, key=lambda item: item.day, default=None)
        day = 0.0 if last is None else min(last.day + 1.0, LAST_DAY_LIMIT)
        latest = None if last is None else list(settings.exposures).index(last)
        added = settings.exposures.add()
        if latest is not None:
            copy_values(settings.exposures[latest], added, leave=OF_ONE_MESH)
        added.name, added.enabled = self.name, True
        added.day = self.day if self.properties.is_property_set("day") else day
        if self.properties.is_property_set("dose"):
            added.unit, added.dose = "SED", self.dose
        settings.exposure_index = len(settings.exposures) - 1
        like = "" if latest is None else ", with what is set of the last one"
        if latest is not None and settings.exposures[latest].own_mask:
            like += " but its own mask"
        self.report({"INFO"}, f"Added a time in the sun on day {added.day:g}{like}.")
        return {"FINISHED"}


class _OnExposure(OnMember):
    members, selected = "exposures", "exposure_index"
    nothing = "The object has no time in the sun: add one with +"


class SKIN_TAN_OT_duplicate_exposure(_OnExposure, bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.duplicate_exposure"
    bl_label = "Duplicate Time in the Sun"
    bl_description = "Copy the selected time in the sun, on the same day"
    bl_options = {"REGISTER", "UNDO"}

    def act(self, members: Any, index: int, selected: int) -> int | None:
        added = members.add()
        copy_values(members[index], added)
        members.move(len(members) - 1, index + 1)
        return index + 1


class SKIN_TAN_OT_move_exposure(_OnExposure, bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.move_exposure"
    bl_label = "Move Time in the Sun"
    bl_description = "Move the selected time in the sun up or down the list; its day stays"
    bl_options = {"REGISTER", "UNDO"}

    direction: EnumProperty(
        name="Direction",
        description="Which way in the list",
        items=(("UP", "Up", ""), ("DOWN", "Down", "")),
        default="UP",
    )

    def act(self, members: Any, index: int, selected: int) -> int | None:
        target = index + (-1 if self.direction == "UP" else 1)
        if not 0 <= target < len(members):
            return None
        move(members, index, target)
        return target


class SKIN_TAN_OT_remove_exposure(_OnExposure, RemovesMember, bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.remove_exposure"
    bl_label = "Remove Time in the Sun"
    bl_description = "Remove the selected time in the sun"
    bl_options = {"REGISTER", "UNDO"}
