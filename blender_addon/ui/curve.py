"""A picture of the tan over its days."""

import functools
from typing import Any

import bpy.utils.previews

from hylios.errors import InputError

from ..model import curve
from ..model.settings import TanSettings
from ..props import SkinTanSettings
from .lines import draw_lines
from .swatches import shown

SCALE = 7.0
"""Height of the picture in lines of a panel."""


def draw_curve(layout: bpy.types.UILayout, settings: SkinTanSettings) -> None:
    try:
        values = settings.values()
        lines, icon = _drawn(values, curve.table_stamp(values))
    except InputError:
        return  # other lines and Apply say why
    layout.template_icon(icon, scale=SCALE)
    draw_lines(layout, lines, "TIME")


@functools.lru_cache(maxsize=1)
def _drawn(values: TanSettings, stamp: tuple[int, int]) -> tuple[tuple[str, ...], int]:
    """Lines and the picture's number, made anew when something has changed."""
    tan = curve.curve_of(values)
    pixels = curve.picture(tan, shown(tan.colours))
    picture = _picture()
    picture.image_size = pixels.shape[1::-1]
    picture.image_pixels_float = pixels.ravel().tolist()
    return (*curve.key(tan), *curve.words(tan)), picture.icon_id


@functools.cache
def _pictures() -> Any:
    return bpy.utils.previews.new()


def _picture() -> Any:
    return _pictures().get("tan") or _pictures().new("tan")


def forget_curve() -> None:
    """Free the picture."""
    if _pictures.cache_info().currsize:
        bpy.utils.previews.remove(_pictures())
        _pictures.cache_clear()
        _drawn.cache_clear()
