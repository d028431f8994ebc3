"""The tan of an object whose exposures have several masks, from its settings to its nodes."""

from typing import cast

import bpy

from .model import basis
from .model.tan import basis_of
from .props import settings_of
from .scene import images, several
from .scene.changes import Changes
from .scene.mask_values import mask_values


def has_several(obj: bpy.types.Object) -> bool:
    """Whether an object's exposures have several masks."""
    return len(set(settings_of(obj).masks())) > 1


def computed(obj: bpy.types.Object, *, rough: bool = False) -> tuple[str, basis.Basis] | None:
    """Domain and basis of an object's masks; None where there is one mask at most.

    Parameters
    ----------
    rough : bool
        Whether it is for a picture while somebody changes a setting.

    Raises
    ------
    InputError
        If a mask cannot be read, there are too many, or a setting cannot be used.
    """
    if not has_several(obj):
        return None
    precision = basis.DRAG if rough else basis.FULL
    settings = settings_of(obj)
    masks = settings.masks()
    distinct = list(dict.fromkeys(masks))
    mesh = cast(bpy.types.Mesh, obj.data)
    values = [mask_values(obj, mask) for mask in distinct]
    domain, shares = several.shares_of_masks(mesh, values)
    which = [distinct.index(mask) for mask in masks]
    return domain, basis_of(settings.values(), which, shares, precision)


def show(
    obj: bpy.types.Object,
    group: bpy.types.NodeTree,
    made: tuple[str, basis.Basis] | None,
    changes: Changes,
) -> dict[bpy.types.Image, bpy.types.Image]:
    """Have a tan's group show several masks, or one again; new images by former ones."""
    if made is None:
        several.take_out(obj, group, changes)
        return {}
    domain, told = made
    rows = images.packed_image(f"Skin Tan Masks {obj.name}", told.rows, is_colour=False)
    days = images.packed_image(f"Skin Tan Mask Days {obj.name}", told.places, is_colour=False)
    sampled = several.SampledBasis(told.coefficients, told.share, domain, rows, days)
    return several.show(obj, group, sampled, changes)


def remarks(made: tuple[str, basis.Basis] | None) -> list[str]:
    """A sentence where the masks are too many to show exactly."""
    if made is None or made[1].error <= basis.WANTED["most"]:
        return []
    return [
        f"The masks lead to so many different tans that some points are off by up to "
        f"{made[1].error:.0%} of their melanin."
    ]
