"""Peeling: from an object's settings to its nodes."""

import bpy

from . import several
from .model.settings import TanSettings
from .model.tan import peeling_of
from .scene import images, peeling
from .scene.changes import Changes
from .scene.mask_nodes import shown_mask


def show(
    obj: bpy.types.Object,
    group: bpy.types.NodeTree,
    values: TanSettings,
    scene_unit: float,
    changes: Changes,
) -> bpy.types.Image | None:
    """Have a tan's group peel, or not; the image that says what peels.

    Parameters
    ----------
    values : TanSettings
        Of the object.
    scene_unit : float
        Length of a scene unit in metres, on a body of life-size.

    Raises
    ------
    InputError
        If a setting, a mask or the table cannot be used.
    """
    has_several = several.has_several(obj)
    told = peeling_of(values, several.which_masks(obj) if has_several else None)
    image = None
    if told is not None:
        image = images.packed_image(f"Skin Tan Peeling {obj.name}", told, is_colour=False)
    masks = several.distinct_masks(obj) if has_several and image else []
    shown = [shown_mask(obj, mask, changes) for mask in masks]
    peeling.show(group, obj, image, shown, scene_unit, changes)
    return image
