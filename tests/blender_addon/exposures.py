"""A time in the sun as an artist has it, for tests to change."""

from blender_addon.model.settings import Exposure

USUAL = Exposure(
    day=0.0,
    unit="SED",
    dose=10.0,
    multiple=2.0,
    uv_index=8.0,
    duration=2.0,
    latitude=40.0,
    month=7,
    day_of_month=15,
    from_hour=11.0,
    to_hour=15.0,
    sunscreen=False,
    spf=30.0,
    sunscreen_amount=2.0,
)
