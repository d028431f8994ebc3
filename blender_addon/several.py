"""The tan of an object whose exposures have several masks, from its settings to its nodes."""

from dataclasses import dataclass
from typing import cast

import bpy

from .model import basis
from .model.tan import basis_of
from .props import settings_of
from .scene import images, several
from .scene.changes import Changes
from .scene.mask_values import mask_values


@dataclass(frozen=True, eq=False)
class Computed:
    """The tan of several masks.

    Attributes
    ----------
    domain : str
        POINT or CORNER: what the basis is told at.
    basis : Basis
    said : tuple of str
        Sentences on the masks.
    """

    domain: str
    basis: basis.Basis
    said: tuple[str, ...]


def has_several(obj: bpy.types.Object) -> bool:
    """Whether an object's exposures have several masks."""
    return len(set(settings_of(obj).masks())) > 1


def computed(obj: bpy.types.Object, *, rough: bool = False) -> Computed | None:
    """The tan of an object's masks; None where there is one mask at most.

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
    made = basis_of(settings.values(), which, shares, precision)
    return Computed(domain, made, tuple(said for own in values for said in own.said))


def show(
    obj: bpy.types.Object,
    group: bpy.types.NodeTree,
    made: Computed | None,
    changes: Changes,
) -> dict[bpy.types.Image, bpy.types.Image]:
    """Have a tan's group show several masks, or one again; new images by former ones."""
    if made is None:
        several.take_out(obj, group, changes)
        return {}
    told = made.basis
    rows = images.packed_image(f"Skin Tan Masks {obj.name}", told.rows, is_colour=False)
    days = images.packed_image(f"Skin Tan Mask Days {obj.name}", told.places, is_colour=False)
    sampled = several.SampledBasis(told.coefficients, told.share, made.domain, rows, days)
    return several.show(obj, group, sampled, changes)


def remarks(made: Computed) -> list[str]:
    """Sentences on the masks, and on whether they are too many to show exactly."""
    if made.basis.error <= basis.WANTED["most"]:
        return [*made.said]
    return [
        *made.said,
        f"The masks lead to so many different tans that some points are off by up to "
        f"{made.basis.error:.0%} of their melanin.",
    ]
