"""Skin that fits: an object's settings from a colour, or from the colour that it is painted in."""

from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError

from .apply import mesh_object
from .model.matching import Match, nearest
from .props import SkinTanSettings, settings_of
from .scene import skin, slots
from .scene.painted import painted_colour


def match_colour(settings: SkinTanSettings, colour: NDArray, *, adjust: bool) -> str:
    """Set the skin type nearest to a linear Rec.709 colour (3,), and return a sentence on it.

    Parameters
    ----------
    adjust : bool
        Whether to set melanin and blood too, towards the colour.

    Raises
    ------
    InputError
        If a channel is not from 0 to 1.
    """
    match = nearest(colour)
    settings.skin = match.skin
    settings.biology.reset()
    said = f"Type {match.skin} is nearest, {match.distance:.1f} CIEDE2000 away"
    if not adjust or match.left == match.distance:
        return f"{said}."
    return f"{said}; {_adjusted(settings, match)}."


def _adjusted(settings: SkinTanSettings, match: Match) -> str:
    biology = match.biology
    settings.biology.melanin, settings.biology.blood = biology.melanin, biology.blood
    return f"with melanin {biology.melanin:g} and blood {biology.blood:g}, {match.left:.1f}"


def own_colour(obj: bpy.types.Object | None) -> NDArray[np.float64]:
    """Linear colour (3,) that an object's skin is painted in, before it tans.

    Of several materials of skin it is the mean, weighted by their faces.

    Raises
    ------
    InputError
        If it is no mesh, or no colour leads to a shader of its skin.
    """
    obj = mesh_object(obj)
    ticked = slots.ticks(obj, skin.group_of(obj))
    faces: dict[Any, int] = {}
    for slot, count in zip(obj.material_slots, slots.faces_of_slots(obj), strict=False):
        if ticked.get(slot.material):
            faces[slot.material] = faces.get(slot.material, 0) + count
    colours = {material: painted_colour(obj, material) for material in faces}
    painted = {
        material: colour
        for material, colour in colours.items()
        if colour is not None and not _is_ours(obj, material)
    }
    if not painted:
        raise InputError(
            f"No painted colour leads to the skin of {obj.name!r}; pick a colour in its place."
        )
    weights = np.array([max(faces[material], 1) for material in painted], dtype=float)
    return np.average(list(painted.values()), axis=0, weights=weights)


def _is_ours(obj: bpy.types.Object, material: bpy.types.Material) -> bool:
    """Whether a material shows the tan itself, not a painted colour."""
    return material == settings_of(obj).material
