"""What an artist sets on an object."""

import zlib
from collections.abc import Sequence

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    StringProperty,
)

from .tables import SHIPPED, TYPES, ShippedTable
from .tan import LAST_DAY_LIMIT

SKIN_LABELS = {
    "I": "Type I, very light",
    "II": "Type II, light",
    "III": "Type III, intermediate",
    "IV": "Type IV, tan",
    "V": "Type V, brown",
    "VI": "Type VI, dark",
    "S1": "Light, pale (S1)",
    "S2": "Light, ruddy (S2)",
    "S3": "Light (S3)",
    "S4": "Dark (S4)",
}
USUAL_SKINS = ("III", "S3")
"""Of which the first that is shipped is chosen at first."""


def _skin_items() -> tuple:
    """Items of the enumeration: shipped skins, then the user's own file.

    Each is numbered by its name, so that files stay right when more skins are shipped.
    """
    shipped = tuple(
        (
            table.name,
            SKIN_LABELS.get(table.name, f"Skin ({table.name})"),
            _described(table),
            zlib.crc32(table.name.encode()) & 0x7FFFFFFF,
        )
        for table in SHIPPED
    )
    return (*shipped, ("FILE", "Table File", "Skin of a table in a file of your own", 0))


def _described(table: ShippedTable) -> str:
    kind = "Fitzpatrick skin type" if table.name in TYPES else "Skin of specimen"
    return f"{kind} {table.name}, {table.pigmentation} pigmentation"


def usual_skin(names: Sequence[str]) -> str:
    """The skin that an object has at first, of those that can be chosen."""
    return next((name for name in USUAL_SKINS if name in names), names[0])


SKIN_ITEMS = _skin_items()
NAMES = tuple(item[0] for item in SKIN_ITEMS)


class SkinTanExposure(bpy.types.PropertyGroup):
    day: FloatProperty(
        name="Day",
        description="When the skin was in the sun, in days from the start of the tan",
        min=0.0,
        max=LAST_DAY_LIMIT,
        step=100,
        precision=2,
    )
    dose: FloatProperty(
        name="Dose (SED)",
        description="How much sun, in standard erythema doses. Bare skin in strong summer sun "
        "(UV index 8) gets about 7 SED an hour",
        default=10.0,
        min=0.0,
        soft_max=60.0,
        max=1000.0,
        step=100,
        precision=1,
    )


class SkinTanSettings(bpy.types.PropertyGroup):
    skin: EnumProperty(
        name="Skin",
        description="Which skin it is that tans",
        items=SKIN_ITEMS,
        default=usual_skin(NAMES),
    )
    table_path: StringProperty(
        name="Table",
        description="Skin table to use, an EXR file",
        subtype="FILE_PATH",
        options={"PATH_SUPPORTS_BLEND_RELATIVE"},
    )
    own_minimal_doses: BoolProperty(
        name="Set Sensitivity by Hand",
        description="Set how much sun this person needs to tan and to burn, in place of the "
        "table's estimate",
    )
    mmd: FloatProperty(
        name="Tans from SED",
        description="Smallest dose in SED that tans this skin (MMD)",
        default=7.0,
        min=0.1,
        soft_max=60.0,
        step=10,
        precision=1,
    )
    med: FloatProperty(
        name="Burns from SED",
        description="Smallest dose in SED that reddens this skin (MED)",
        default=4.0,
        min=0.1,
        soft_max=60.0,
        step=10,
        precision=1,
    )
    exposures: CollectionProperty(type=SkinTanExposure)
    exposure_index: IntProperty(name="Active Exposure", options={"HIDDEN"})
    mask_attribute: StringProperty(
        name="Sun Mask",
        description="Attribute of the mesh with the share of the dose that reaches each point: "
        "0 is covered, 1 is bare. Without one the whole body is bare",
    )
    first_day: FloatProperty(
        name="First Day",
        description="Day of the tan at the first frame",
        min=0.0,
        max=LAST_DAY_LIMIT,
        step=100,
        precision=1,
    )
    last_day: FloatProperty(
        name="Last Day",
        description="Day of the tan at the last frame",
        default=30.0,
        min=0.0,
        max=LAST_DAY_LIMIT,
        step=100,
        precision=1,
    )
    first_frame: IntProperty(
        name="First Frame", description="Frame that shows the first day", default=1
    )
    last_frame: IntProperty(
        name="Last Frame", description="Frame that shows the last day", default=250
    )


CLASSES = (SkinTanExposure, SkinTanSettings)
