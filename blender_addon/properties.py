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

from .doses import LAST_DAY_LIMIT
from .tables import SHIPPED, TYPES, ShippedTable

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


UNITS = (
    ("SED", "Dose", "As a dose in standard erythema doses (SED)"),
    ("MMD", "Tanning Doses", "As a multiple of the smallest dose that tans this skin (MMD)"),
    ("UV_INDEX", "UV Index", "As hours at a UV index"),
    ("SUN", "Sun", "As hours of a day at a place, under a clear sky"),
)


class SkinTanExposure(bpy.types.PropertyGroup):
    day: FloatProperty(
        name="Day",
        description="When the skin was in the sun, in days from the start of the tan",
        min=0.0,
        max=LAST_DAY_LIMIT,
        step=100,
        precision=2,
    )
    unit: EnumProperty(
        name="Given as",
        description="How the amount of sun is given",
        items=UNITS,
        default="SED",
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
    multiple: FloatProperty(
        name="Times the Tanning Dose",
        description="How much sun, as a multiple of the smallest dose that tans this skin (MMD)",
        default=2.0,
        min=0.0,
        soft_max=10.0,
        max=100.0,
        step=10,
        precision=1,
    )
    uv_index: FloatProperty(
        name="UV Index",
        description="As weather reports give it: 3 is moderate, 8 very high, 11 extreme",
        default=8.0,
        min=0.0,
        soft_max=12.0,
        max=50.0,
        step=100,
        precision=1,
    )
    duration: FloatProperty(
        name="Hours",
        description="How long the skin was in the sun",
        default=2.0,
        min=0.0,
        soft_max=12.0,
        max=48.0,
        step=50,
        precision=1,
    )
    latitude: FloatProperty(
        name="Latitude",
        description="Of the place in degrees, north positive",
        default=40.0,
        min=-90.0,
        max=90.0,
        step=100,
        precision=1,
    )
    month: IntProperty(name="Month", description="Of the year", default=7, min=1, max=12)
    day_of_month: IntProperty(name="Day", description="Of the month", default=15, min=1, max=31)
    from_hour: FloatProperty(
        name="From",
        description="Hour of the day by the sun, which stands highest at 12",
        default=11.0,
        min=0.0,
        max=24.0,
        step=50,
        precision=1,
    )
    to_hour: FloatProperty(
        name="To",
        description="Hour of the day by the sun, which stands highest at 12",
        default=15.0,
        min=0.0,
        max=24.0,
        step=50,
        precision=1,
    )
    sunscreen: BoolProperty(
        name="Sunscreen",
        description="The skin was under sunscreen. Where only a part of it was, paint the mask",
    )
    spf: FloatProperty(
        name="SPF",
        description="Sun protection factor on the bottle, measured at 2 mg/cm²",
        default=30.0,
        min=1.0,
        soft_max=50.0,
        max=1000.0,
        step=100,
        precision=0,
    )
    sunscreen_amount: FloatProperty(
        name="mg/cm²",
        description="How much was put on. The factor on the bottle is for 2; people use 0.5 to 1, "
        "which protects far less",
        default=2.0,
        min=0.0,
        soft_max=2.0,
        max=20.0,
        step=10,
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
