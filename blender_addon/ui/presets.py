"""Lists of presets."""

import bpy
from bl_ui.utils import PresetPanel


class SKIN_TAN_PT_skin_presets(PresetPanel, bpy.types.Panel):  # noqa: N801
    bl_label = "Skin Presets"
    preset_subdir = "skin_tan/skin"
    preset_operator = "script.execute_preset"
    preset_add_operator = "skin_tan.skin_preset_add"


class SKIN_TAN_PT_schedule_presets(PresetPanel, bpy.types.Panel):  # noqa: N801
    bl_label = "Schedule Presets"
    preset_subdir = "skin_tan/schedule"
    preset_operator = "script.execute_preset"
    preset_add_operator = "skin_tan.schedule_preset_add"
