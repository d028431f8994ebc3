"""What an artist sets of one exposure: one time in the sun."""

from itertools import count
from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ..model.settings import (
    AIR,
    DOSE_LIMIT,
    DURATION_LIMIT,
    FACTOR_LIMIT,
    LAST_DAY_LIMIT,
    MULTIPLE_LIMIT,
    USUAL_DATE,
    USUAL_GROUND,
    USUAL_HOURS,
    WATER,
)
from .mask import SkinTanMask, show_mask

UNITS = (
    ("SED", "Dose", "As a dose in standard erythema doses (SED)"),
    ("MMD", "Tanning Doses", "As a multiple of the smallest dose that tans this skin (MMD)"),
    ("UV_INDEX", "UV Index", "As hours at a UV index, as weather reports give it"),
    ("SUN", "Sun", "As hours of a date at a latitude, with clouds, ground and water"),
)

GROUNDS = (
    (USUAL_GROUND, "Usual", "Streets and gardens: 5 % of the ultraviolet comes back"),
    ("GRASS", "Grass", "3 % of the ultraviolet comes back"),
    ("WATER", "Water", "A lake or the sea, seen from a boat or the shore: 15 % comes back"),
    ("SAND", "Sand", "Dry sand: 18 % comes back"),
    ("FOAM", "Foam", "Surf: 25 % comes back"),
    ("SNOW", "Snow", "80 % comes back, so the sky is brighter too: 40 % more sun"),
)

THROUGH = (
    (AIR, "Air", "Nothing between the skin and the sun"),
    ("WINDOW", "Window", "Window glass: no UVB passes, so skin tans and burns far less"),
    ("CAR", "Car Window", "The side window of a car: no UVB passes"),
    ("LAMINATED", "Windscreen", "Laminated glass: hardly any ultraviolet passes"),
    (WATER, "Water", "Water over the skin: a metre leaves about half of what burns"),
)


HOUR_OF_DAY: dict[str, Any] = {"min": 0.0, "max": 24.0, "step": 50, "precision": 1}
"""Range and steps of a property that is an hour of the day."""


def tell_apart(exposure: Any, context: bpy.types.Context | None) -> None:
    """On an override, number a name that is there twice: Blender tells members by their names.

    Without it, what the second one says is lost when the file is read again.
    """
    obj = exposure.id_data
    if obj.override_library is None or not exposure.name:
        return
    names = {other.name for other in obj.skin_tan.exposures if other != exposure}
    if exposure.name in names:
        stem = exposure.name
        exposure.name = next(
            name for number in count(1) if (name := f"{stem}.{number:03d}") not in names
        )


class SkinTanExposure(bpy.types.PropertyGroup):
    name: StringProperty(
        name="Name", description="What you call this time in the sun", update=tell_apart
    )
    enabled: BoolProperty(
        name="On",
        description="This time in the sun counts. Turn it off to see the tan without it",
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
        description="How you say how much sun it was: as a dose, or as hours at a UV index or on a "
        "date",
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
        name="Latitude (°)",
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
        name="Day of Month", description="Day of the month", default=USUAL_DATE[1], min=1, max=31
    )
    from_hour: FloatProperty(
        name="From (h)",
        description="Start, in hours of solar time: the sun stands highest at 12",
        default=USUAL_HOURS[0],
        **HOUR_OF_DAY,
    )
    to_hour: FloatProperty(
        name="To (h)",
        description="End, in hours of solar time: the sun stands highest at 12",
        default=USUAL_HOURS[1],
        **HOUR_OF_DAY,
    )
    altitude: FloatProperty(
        name="Altitude (m)",
        description="Height of the place over the sea, in metres. A thousand bring 8 to 10 % more "
        "sun",
        min=-500.0,
        soft_min=0.0,
        soft_max=5000.0,
        max=9000.0,
        step=10000,
        precision=0,
    )
    cloud: FloatProperty(
        name="Clouds",
        description="How much of the sky clouds cover. A half leaves 84 % of the sun, a whole sky "
        "31 %, on average over all clouds",
        subtype="PERCENTAGE",
        min=0.0,
        max=100.0,
        precision=0,
    )
    ground: EnumProperty(
        name="Ground",
        description="What lies around: snow and sand throw much of the sun back",
        items=GROUNDS,
        default=USUAL_GROUND,
    )
    through: EnumProperty(
        name="Through",
        description="What the sun goes through before it meets the skin",
        items=THROUGH,
        default=AIR,
    )
    depth: FloatProperty(
        name="Depth (m)",
        description="How much water is over the skin, in metres. An estimate: in a clear sea "
        "the sun goes three times as deep",
        default=1.0,
        min=0.0,
        soft_max=10.0,
        max=100.0,
        step=10,
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
        description="Other clothes were worn this time: a mask for this time in the sun alone",
        update=show_mask,
    )
    mask: PointerProperty(name="Mask", type=SkinTanMask)

    def label(self, number: int) -> str:
        """What sentences call it: its name, or its number in the list, from 1."""
        return repr(self.name) if self.name else f"time in the sun {number}"
