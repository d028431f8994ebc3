"""What an artist sets of one region of the skin."""

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, PointerProperty, StringProperty

from ..model.regions import MOST_STRENGTH, kinds
from .mask import CHANNEL, UV_MAP, show_mask, take_image, take_source, usable_names

KINDS = (
    ("FRECKLES", "Freckles", "Spots of 1 to 3 mm that tan more than the skin around them"),
    ("MOLES", "Moles", "Dark spots of 2 to 5 mm that do not tan"),
    ("PALMS", "Palms and Soles", "Redder skin, in darker people paler, that does not tan"),
    ("LIPS", "Lips", "Much more blood; the melanin is that of the skin around them"),
    ("FLUSH", "Flush", "More blood, as in cheeks, nose and ears"),
    ("VITILIGO", "Vitiligo", "No melanin, so no tan"),
)
"""Kinds of region, the names of `model.regions.kinds` in capitals."""


def _told(name: str, text: str) -> str:
    """With a word on what nobody has measured."""
    return f"{text}. How much is an estimate" if kinds()[name.lower()].is_estimate else text


KIND_ITEMS = tuple((name, label, _told(name, text)) for name, label, text in KINDS)


LABELS = {name: label for name, label, _ in KINDS}


class SkinTanRegionMask(bpy.types.PropertyGroup):
    """Like `SkinTanMask`, of where a region lies."""

    source: StringProperty(
        name="Region Mask",
        description="What says where the region lies: 0 is nothing, 1 is all of it. A vertex "
        "group, an attribute of points, corners or faces, or an image",
        search=usable_names,
        update=take_source,
    )
    image: PointerProperty(
        name="Image",
        description="The image that is the mask: black is nothing, white is all of it",
        type=bpy.types.Image,
        update=take_image,
    )
    uv_map: UV_MAP
    channel: CHANNEL
    invert: BoolProperty(
        name="Invert",
        description="What is 1 is nothing, what is 0 is all of it",
        update=show_mask,
    )
    strength: FloatProperty(
        name="Mask Strength",
        description="How much of the region lies where the mask is 1",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )


class SkinTanRegion(bpy.types.PropertyGroup):
    enabled: BoolProperty(
        name="On",
        description="Whether this region shows",
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
        description="1 is usual, 0 is nothing. Of spots there are more, too, with more of it",
        default=1.0,
        min=0.0,
        max=MOST_STRENGTH,
        subtype="FACTOR",
    )
    painted: BoolProperty(
        name="Painted Spots",
        description="The mask holds the spots themselves. Without this, spots come by themselves, "
        "where the mask is or everywhere",
    )
    mask: PointerProperty(name="Mask", type=SkinTanRegionMask)

    def label(self) -> str:
        """What its kind is called."""
        return LABELS[self.kind]

    def has_spots(self) -> bool:
        """Whether spots come by themselves."""
        return not self.painted and kinds()[self.kind.lower()].spots is not None


def is_shown(region: Any) -> bool:
    """Whether a region changes anything: it is on, and lies somewhere."""
    lies = region.has_spots() or region.mask.source or region.mask.image
    return bool(region.enabled and region.strength > 0.0 and lies)
