"""Tan from Own Colour: an object's painted colours say how its skin tans, texel by texel."""

from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from mathutils import Color
from numpy.typing import NDArray

from .model.look import Look, untanned_colour
from .model.own_colour import SLOPE, START, offsets
from .props import settings_of
from .scene import images, nodes, own_colour, recolour, slots
from .scene import skin as skins
from .scene.changes import Changes
from .scene.ownership import names
from .scene.painted import is_like_skin, painted_colour, weighted_median
from .scene.trees import tree_of


def painted_skin(obj: bpy.types.Object) -> NDArray[np.float64] | None:
    """Median linear colour (3,) over the area of an object's skin, as painted, if it has one."""
    ticked = slots.ticks(obj, skins.group_of(obj))
    colours = {material: painted_colour(obj, material) for material, tans in ticked.items() if tans}
    skin = {block: colour for block, colour in colours.items() if is_like_skin(colour)}
    areas = slots.areas(obj)
    if not skin:
        return None
    return weighted_median(np.array([*skin.values()]), np.array([areas[block] for block in skin]))


def prepare(
    obj: bpy.types.Object, skin: skins.Skin, look: Look, sampled: nodes.Sampled, changes: Changes
) -> tuple[nodes.Sampled, list[str]]:
    """Have an object's tan take account of painted colours, where that is set and there are some.

    Returns
    -------
    sampled, said
        With the image that it needs then; and sentences.
    """
    if not settings_of(obj).own_colour or not skin.recolours():
        own_colour.show(skin.group, None, changes)
        return sampled, []
    said = _take_usual(obj, look, changes)
    own_colour.show(skin.group, _told(settings_of(obj).usual_colour), changes)
    image = images.shared_image("Skin Tan Own Colour", offsets(look), is_colour=False)
    return replace(sampled, own_image=image), said


def tell(
    obj: bpy.types.Object, group: bpy.types.NodeTree, changes: Changes, *, is_on: bool
) -> list[str]:
    """Tell a tan's group the colours that an object's materials multiply, or no longer.

    Returns a sentence where one is told only as it is at this frame.
    """
    trees = list(slots.shown_trees(obj, group))
    if not is_on:
        for tree in trees:
            recolour.stop_telling(tree, changes)
        return []
    owners = {tree_of(material): material for material in slots.materials_of(obj)}
    moved = [owners.get(tree, tree) for tree in trees if recolour.tell_painted(tree, changes)]
    if not moved:
        return []
    return [
        f"A painted colour in {names(moved)} is animated, and skin tans by what it is at this "
        "frame; put the keys on an RGB node that is linked to Base Color, and the tan follows."
    ]


def _take_usual(obj: bpy.types.Object, look: Look, changes: Changes) -> list[str]:
    """Where no usual colour is set, take that of the painted skin; a sentence where it fails."""
    settings = settings_of(obj)
    if any(settings.usual_colour):
        return []
    painted = painted_skin(obj)
    told = untanned_colour(look) if painted is None else painted
    usual: Any = Color(tuple(told)).from_rec709_linear_to_scene_linear()
    changes.set(settings, "usual_colour", tuple(usual))
    if painted is not None:
        return []
    return [
        f"No painted colour of skin was found on {obj.name!r}, so its Usual Colour is that of the "
        "skin type; pick it from the texture."
    ]


def _told(usual: Any) -> own_colour.Told:
    """How painted colours are told beside a usual one, both of the scene's working space."""
    axes: list[Any] = [
        Color(axis).from_scene_linear_to_rec709_linear() for axis in np.eye(3).tolist()
    ]
    rec709: Any = Color(usual).from_scene_linear_to_rec709_linear()
    red, green = (
        tuple(axis[channel] / max(rec709[channel], 1e-4) for axis in axes) for channel in (0, 1)
    )
    return own_colour.Told(red, green, SLOPE, START)
