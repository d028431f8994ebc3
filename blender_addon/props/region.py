"""What an artist sets of one region of the skin."""

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, PointerProperty

from ..model.regions import MOST_STRENGTH, is_estimate, spots
from .mask import CHANNEL, UV_MAP, image_field, invert_field, source_field, strength_field

KINDS = (
    ("FRECKLES", 0, "Freckles", "Spots of 1 to 3 mm that tan more than the skin around them"),
    ("LENTIGINES", 6, "Age Spots", "Spots of 3 to 8 mm (lentigines) that do not fade with a tan"),
    ("MOLES", 1, "Moles", "Dark spots of 2 to 5 mm that do not tan"),
    ("CHEEKS", 7, "Cheeks", "Redder than an inner arm and brighter below, as people's cheeks"),
    ("FOREHEAD", 8, "Forehead", "Redder than an inner arm and browner, as people's foreheads"),
    ("EARS", 9, "Ears", "Much redder than an inner arm, as people's ear lobes"),
    ("FLUSH", 4, "Flush", "More blood, as in cheeks, nose and ears"),
    ("LIPS", 3, "Lips", "Much more blood; the melanin is that of the skin around them"),
    ("FINGERS", 10, "Fingers", "Redder and brighter below, as people's ring fingers"),
    ("PALMS", 2, "Palms and Soles", "Redder skin, in darker people paler, that does not tan"),
    ("VITILIGO", 5, "Vitiligo", "No melanin, so no tan"),
)
"""Kinds of region: their names in `hylios.skin.regions` in capitals, and the numbers by which files
hold them."""


def _told(name: str, text: str) -> str:
    """With a word on what nobody has measured."""
    return f"{text}. How much is an estimate" if is_estimate(name.lower()) else text


KIND_ITEMS = tuple(
    (name, label, _told(name, text), "NONE", number) for name, number, label, text in KINDS
)


LABELS = {name: label for name, _, label, _ in KINDS}


class SkinTanRegionMask(bpy.types.PropertyGroup):
    """Like `SkinTanMask`, of where a region lies."""

    source: source_field(
        "Region Mask", "What says where the region lies: 0 is nothing, 1 is all of it"
    )
    image: image_field("black is nothing, white is all of it")
    uv_map: UV_MAP
    channel: CHANNEL
    invert: invert_field("The region lies where the mask is black (0)")
    strength: strength_field(
        "Mask Strength", "How much of the region lies where the mask is 1", update=None
    )


class SkinTanRegion(bpy.types.PropertyGroup):
    enabled: BoolProperty(
        name="On",
        description="This region shows. Turn it off to see the skin without it",
        default=True,
    )
    kind: EnumProperty(
        name="Kind",
        description="What is different here from the skin around it",
        items=KIND_ITEMS,
        default="FRECKLES",
    )
    strength: FloatProperty(
        name="Strength",
        description="How much the region differs from the skin around it: 1 is usual, 0 is not at "
        "all. More of it also brings more spots",
        default=1.0,
        min=0.0,
        max=MOST_STRENGTH,
        subtype="FACTOR",
    )
    painted: BoolProperty(
        name="Painted Spots",
        description="The mask holds the spots themselves. Turn it off for spots that come by "
        "themselves, where the mask is or everywhere",
    )
    mask: PointerProperty(name="Mask", type=SkinTanRegionMask)

    def label(self) -> str:
        """What its kind is called."""
        return LABELS[self.kind]

    def has_spots(self) -> bool:
        """Whether spots come by themselves."""
        return not self.painted and self.kind.lower() in spots()


def is_on(region: Any) -> bool:
    """Whether a region changes the skin where it lies."""
    return region.enabled and region.strength > 0.0


def is_shown(region: Any) -> bool:
    """Whether a region changes anything: it is on, and lies somewhere."""
    return bool(is_on(region) and (region.has_spots() or region.mask.source or region.mask.image))
