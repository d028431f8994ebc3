"""Numbers that an artist sets say their unit: Blender has none for days, doses or factors."""

import re

import bpy

from blender_addon.registration import CLASSES

UNITS = re.compile(
    r"[%°²]|\b(days?|hours?|months?|frames?|second|SED|MMD|degrees|metres|times|multiple|factor"
    r"|index|[01] is)\b",
    re.IGNORECASE,
)
SHOWN_BY_BLENDER = ("COLOR", "FACTOR", "PERCENTAGE")


def test_numbers_say_their_unit_in_name_or_tooltip():
    classes = [kind for kind in CLASSES if issubclass(kind, bpy.types.PropertyGroup)]
    numbers = [
        setting
        for kind in classes
        for setting in kind.bl_rna.properties
        if setting.type in ("FLOAT", "INT") and not setting.is_hidden
    ]
    assert len(numbers) > 30
    for setting in numbers:
        told = UNITS.search(f"{setting.name} {setting.description}")
        assert told or setting.subtype in SHOWN_BY_BLENDER, setting.identifier
