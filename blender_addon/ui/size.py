"""What is said where a body has no person's size, or its skin was made for other units."""

import bpy

from hylios.errors import InputError

from ..model.lines import Line
from ..model.size import lines_on
from ..props import settings_of
from ..scene import size
from .lines import draw_lines


def draw_size(layout: bpy.types.UILayout, obj: bpy.types.Object, scene: bpy.types.Scene) -> None:
    lines = size_lines(obj, scene)
    if lines or settings_of(obj).model_scale != 1.0:
        layout.prop(settings_of(obj), "model_scale")
    if lines:
        draw_lines(layout, lines, "ERROR")
        layout.operator("skin_tan.fit_size", icon="DRIVER_DISTANCE")


def size_lines(obj: bpy.types.Object, scene: bpy.types.Scene) -> tuple[str, ...]:
    """Short lines on what is wrong with the size of an object's skin, if anything is."""
    if not size.shows_our_light(obj):
        return ()
    try:
        times = size.light_goes(obj, scene)
        lines = lines_on(size.length(obj, scene))
    except InputError:
        return ()  # Apply says it
    if lines or size.is_right(times):
        return lines
    far = Line("light goes {times:.3g} times too far", times=times)
    if times < 1.0:
        far = Line("light goes {times:.3g} times too short", times=1.0 / times)
    return ("Units or scale changed since Apply:", far)
