"""Pictures of the skin types' colours, drawn from their tables."""

import functools
from typing import Any

import bpy.utils.previews
import numpy as np

from ..model.fitting import type_colours

SIDE = 32
"""Pixels along a side."""

TO_A_ROW = 3


def draw_types(layout: bpy.types.UILayout, skin: str) -> None:
    """Buttons that choose a skin type, with its colour without sun."""
    pictures = swatches()
    column = layout.column(align=True)
    row: Any = column
    for number, (name, picture) in enumerate(pictures.items()):
        if number % TO_A_ROW == 0:
            row = column.row(align=True)
        button: Any = row.operator(
            "skin_tan.choose_type", text=name, icon_value=picture.icon_id, depress=name == skin
        )
        button.type = name


@functools.cache
def swatches() -> Any:
    """The pictures by type, made when they are first drawn."""
    pictures = bpy.utils.previews.new()
    for name, colour in type_colours().items():
        picture = pictures.new(name)
        picture.icon_size = (SIDE, SIDE)
        picture.icon_pixels_float = np.tile([*shown(colour), 1.0], SIDE * SIDE).tolist()
    return pictures


def forget_swatches() -> None:
    """Free the pictures."""
    if swatches.cache_info().currsize:
        bpy.utils.previews.remove(swatches())
        swatches.cache_clear()


def shown(linear: np.ndarray) -> np.ndarray:
    """sRGB of a linear Rec.709 colour."""
    linear = np.clip(linear, 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
