"""Skin that fits: an object's settings from a colour, or from the colour that it is painted in."""

import bpy
import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError

from .model.matching import nearest
from .own_colour import painted_skin
from .props import SkinTanSettings
from .tannable import mesh_object


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
    said = f"Type {match.skin} is nearest: colour distance {match.distance:.1f}"
    if adjust and match.left != match.distance:
        biology = match.biology
        settings.biology.melanin, settings.biology.blood = biology.melanin, biology.blood
        said += f", {match.left:.1f} after adjusting melanin and blood"
    return f"{said} (1 is just seen)."


def own_colour(obj: bpy.types.Object | None) -> NDArray[np.float64]:
    """Linear colour (3,) that an object's skin is painted in, before it tans.

    Raises
    ------
    InputError
        If it is no mesh, or no colour of skin leads to its shaders.
    """
    obj = mesh_object(obj)
    colour = painted_skin(obj)
    if colour is None:
        raise InputError(
            f"No painted colour of skin leads to the shaders of {obj.name!r}; pick a colour in its "
            "place."
        )
    return colour
