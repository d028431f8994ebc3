"""The buttons that keep skins and schedules as Blender's own presets."""

from pathlib import Path
from typing import Any, cast

import bpy
from bl_operators.presets import AddPresetBase

from hylios.files import written_beside

from ..props.presets import SCHEDULE, SKIN, preset_text
from .active import active_settings, has_mesh


class _SkinTanPreset(AddPresetBase):
    """Its class writes every property; here a preset leaves out what belongs to one mesh."""

    preset_names: tuple[str, ...] = ()

    @classmethod
    def poll(cls, context):
        return has_mesh(cls, context)

    def add(self, context: Any, filepath: str) -> None:
        text = preset_text(cast(Any, active_settings(context)), self.preset_names)
        with written_beside(Path(filepath)) as beside:
            beside.write_text(text, encoding="utf-8")


class SKIN_TAN_OT_skin_preset_add(_SkinTanPreset, bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.skin_preset_add"
    bl_label = "Add Skin Preset"
    bl_description = "Keep this skin as a preset, or remove one"
    preset_menu = "SKIN_TAN_PT_skin_presets"
    preset_subdir = "skin_tan/skin"
    preset_names = SKIN


class SKIN_TAN_OT_schedule_preset_add(_SkinTanPreset, bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.schedule_preset_add"
    bl_label = "Add Schedule Preset"
    bl_description = "Keep these times in the sun as a preset, or remove one"
    preset_menu = "SKIN_TAN_PT_schedule_presets"
    preset_subdir = "skin_tan/schedule"
    preset_names = SCHEDULE
