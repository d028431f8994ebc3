"""What an artist sets of one exposure: one time in the sun."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty

from ..model.settings import (
    DOSE_LIMIT,
    DURATION_LIMIT,
    FACTOR_LIMIT,
    LAST_DAY_LIMIT,
    MULTIPLE_LIMIT,
    USUAL_DATE,
    USUAL_HOURS,
)
from .mask import SkinTanMask, show_mask

UNITS = (
    ("SED", "Dose", "As a dose in standard erythema doses (SED)"),
    ("MMD", "Tanning Doses", "As a multiple of the smallest dose that tans this skin (MMD)"),
    ("UV_INDEX", "UV Index", "As hours at a UV index"),
    ("SUN", "Sun", "As hours of a day at a place, under a clear sky"),
)


class SkinTanExposure(bpy.types.PropertyGroup):
    enabled: BoolProperty(
        name="On",
        description="Whether this time in the sun counts",
        default=True,
    )
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
        description="How much sun: as a dose, or as hours under a UV index or the sun of a date",
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
        max=DOSE_LIMIT,
        step=100,
        precision=1,
    )
    multiple: FloatProperty(
        name="Tanning Doses",
        description="How much sun, as a multiple of the smallest dose that tans this skin (MMD)",
        default=2.0,
        min=0.0,
        soft_max=10.0,
        max=MULTIPLE_LIMIT,
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
        max=DURATION_LIMIT,
        step=50,
        precision=1,
    )
    latitude: FloatProperty(
        name="Latitude",
        description="Latitude of the place in degrees, negative south of the equator",
        default=40.0,
        min=-90.0,
        max=90.0,
        step=100,
        precision=1,
    )
    month: IntProperty(
        name="Month", description="Month of the year", default=USUAL_DATE[0], min=1, max=12
    )
    day_of_month: IntProperty(
        name="Day", description="Day of the month", default=USUAL_DATE[1], min=1, max=31
    )
    from_hour: FloatProperty(
        name="From",
        description="Start, in hours of solar time: the sun stands highest at 12",
        default=USUAL_HOURS[0],
        min=0.0,
        max=24.0,
        step=50,
        precision=1,
    )
    to_hour: FloatProperty(
        name="To",
        description="End, in hours of solar time: the sun stands highest at 12",
        default=USUAL_HOURS[1],
        min=0.0,
        max=24.0,
        step=50,
        precision=1,
    )
    sunscreen: BoolProperty(
        name="Sunscreen",
        description="All of the skin had sunscreen on. If only a part had, paint the mask instead",
    )
    spf: FloatProperty(
        name="SPF",
        description="Sun protection factor on the bottle, measured at 2 mg/cm²",
        default=30.0,
        min=1.0,
        soft_max=50.0,
        max=FACTOR_LIMIT,
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
    own_mask: BoolProperty(
        name="Own Mask",
        description="Other cloth was worn this time: a mask for this time in the sun alone",
        update=show_mask,
    )
    mask: PointerProperty(name="Mask", type=SkinTanMask)
