"""What an artist sets for the whole file."""

from contextlib import suppress
from typing import Any

import bpy
from bpy.props import EnumProperty, FloatVectorProperty

from ..model.views import VISIBLE
from ..scene.views import view_of_file

VIEW_ITEMS = (
    (VISIBLE, "Visible", "Skin as the eye sees it", 0),
    (
        "NM365",
        "365 nm",
        "Skin as an ultraviolet camera sees it, in violet: freckles and sunscreen are dark",
        1,
    ),
    ("NM1100", "1100 nm", "Skin as an infrared camera sees it, in red: tans hardly show", 2),
    (
        "NM1650",
        "1650 nm",
        "Skin as a camera for longer infrared sees it, in red: water makes it dark",
        3,
    ),
)
"""The visible and the views; their numbers stay, for they stand in keymaps and scripts."""


class SkinTanScene(bpy.types.PropertyGroup):
    sample: FloatVectorProperty(
        name="Colour of Skin",
        description="A colour of skin without sun and without gloss, to find the type that is "
        "nearest. Pick it from a painted texture or a photo in even light",
        subtype="COLOR",
        default=(0.37, 0.23, 0.14),
        min=0.0,
        max=1.0,
    )
    view: EnumProperty(
        name="View",
        description="Show all tanned skin of this file as a camera for ultraviolet or infrared "
        "sees it. Other materials and lamps stay as they are",
        items=VIEW_ITEMS,
        options=set(),
        get=lambda self: _number_of(view_of_file()),
        set=lambda self, number: _switch(number),
    )


def _number_of(view: str | None) -> int:
    return next((number for name, *_, number in VIEW_ITEMS if name == view), 0)


def _switch(number: int) -> None:
    """Press the button, which says what is wrong; where it fails, the view stays."""
    (view,) = (name for name, *_, other in VIEW_ITEMS if other == number)
    operators: Any = bpy.ops
    with suppress(RuntimeError):
        operators.skin_tan.switch_view(view=view)
