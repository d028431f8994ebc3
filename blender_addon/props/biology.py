"""What an artist changes in a skin type: sliders that do nothing at their defaults."""

from typing import Any

import bpy
from bpy.props import FloatProperty

from ..model.settings import BIOLOGY_RANGES, Biology

SOFT = {
    "melanin": (0.5, 2.0),
    "blood": (0.3, 3.0),
    "oxygenation": (-40.0, 25.0),
    "thickness": (0.7, 1.4),
    "eumelanin": (0.5, 1.5),
    "pheomelanin": (0.5, 4.0),
}
"""Where the sliders end; typed values may lie beyond, within `BIOLOGY_RANGES`."""


def _slider(name: str, title: str, description: str) -> Any:
    (low, high), (soft_low, soft_high) = BIOLOGY_RANGES[name], SOFT[name]
    is_share = name == "oxygenation"
    return FloatProperty(
        name=title,
        description=description,
        default=0.0 if is_share else 1.0,
        min=low,
        max=high,
        soft_min=soft_low,
        soft_max=soft_high,
        step=100 if is_share else 5,
        precision=1 if is_share else 2,
        subtype="PERCENTAGE" if is_share else "FACTOR",
    )


class SkinTanBiology(bpy.types.PropertyGroup):
    melanin: _slider(
        "melanin",
        "Melanin",
        "How much melanin there is, as a multiple of the skin type's. Above 1 darker and "
        "browner, below 1 paler",
    )
    blood: _slider(
        "blood",
        "Blood",
        "How much blood there is in the skin, as a multiple of the skin type's. Above 1 "
        "redder, below 1 paler",
    )
    oxygenation: _slider(
        "oxygenation",
        "Oxygen",
        "How much more of the blood carries oxygen than in the skin type, in percentage points. "
        "More is rosier, less is bluer",
    )
    thickness: _slider(
        "thickness",
        "Thickness",
        "How thick all layers of the skin are, as a multiple of the skin type's. Melanin stays",
    )
    eumelanin: _slider(
        "eumelanin",
        "Eumelanin",
        "How concentrated the brown-black melanin is, as a multiple of the skin type's",
    )
    pheomelanin: _slider(
        "pheomelanin",
        "Pheomelanin",
        "How concentrated the yellow-red melanin is, as a multiple of the skin type's",
    )

    def values(self) -> Biology:
        """The sliders as plain values.

        Raises
        ------
        InputError
            If one is out of range.
        """
        # what Blender keeps in 32 bits is told as it was typed
        return Biology(**{name: float(f"{getattr(self, name):.6g}") for name in BIOLOGY_RANGES})

    def is_changed(self) -> bool:
        """Whether a slider differs from the skin type."""
        return self.values() != Biology()

    def reset(self) -> None:
        """Put all sliders back."""
        for name in BIOLOGY_RANGES:
            self.property_unset(name)
