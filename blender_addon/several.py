"""The tan of an object whose exposures have several masks, from its settings to its nodes."""

from collections.abc import Sequence

import bpy

from .model import basis, grid
from .model.ahead import Ahead
from .model.basis import Basis
from .model.tan import basis_of
from .props import settings_of
from .scene import images, mask_values, several, several_nodes
from .scene.changes import Changes
from .scene.mask_nodes import ShownMask, shown_mask
from .scene.masks import Mask

AHEAD = Ahead(basis_of)


def has_several(obj: bpy.types.Object) -> bool:
    """Whether an object's exposures have several masks."""
    return len(set(settings_of(obj).masks())) > 1


def computed(obj: bpy.types.Object, *, rough: bool = False) -> Basis | None:
    """The basis of an object's masks; None where there is one mask at most.

    Parameters
    ----------
    rough : bool
        Whether it is for a picture while somebody changes a setting.

    Raises
    ------
    InputError
        If there are too many masks, or a setting cannot be used.
    """
    if not has_several(obj):
        return None
    return basis_of(settings_of(obj).values(), which_masks(obj), rough=rough)


def is_at_hand(obj: bpy.types.Object) -> bool:
    """Whether `computed` takes no time; else a thread begins with it."""
    if not has_several(obj):
        return True
    return AHEAD.is_at_hand(settings_of(obj).values(), tuple(which_masks(obj)))


def show(
    obj: bpy.types.Object, group: bpy.types.NodeTree, made: Basis | None, changes: Changes
) -> dict[bpy.types.Image, bpy.types.Image]:
    """Have a tan's group show several masks, or one again; new images by former ones."""
    if made is None:
        several.take_out(obj, group, changes)
        return {}

    def image(name: str, values) -> bpy.types.Image:
        return images.packed_image(f"Skin Tan Mask{name} {obj.name}", values, is_colour=False)

    shapes = several_nodes.Basis(
        made.rank,
        parts=made.parts,
        step=basis.ROWS,
        rows=image("s", made.rows),
        days=image(" Days", made.places),
    )
    over_shares = several_nodes.Grid(
        images=[image(" Shares", own) for own in grid.images_of(made.coefficients)],
        places=image(" Places", grid.places_among(made.knots)),
        strides=grid.strides_of(made.knots),
        weights=[float(weight) for weight in made.weights],
    )
    shown = [shown_mask(obj, mask, changes) for mask in distinct_masks(obj)]
    return several.show(obj, group, shapes, over_shares, shown, changes)


def remarks(
    obj: bpy.types.Object, made: Basis | None, shown: ShownMask, *, rough: bool
) -> list[str]:
    """Sentences on an object's masks, and on whether they are too many to show exactly.

    Parameters
    ----------
    shown : ShownMask
        What the nodes read where there is one mask.
    rough : bool
        Whether it is for a picture while somebody changes a setting.
    """
    if made is None:
        return mask_values.remarks(obj, settings_of(obj).shown_mask(), shown)
    if rough:
        return []
    said = mask_values.remarks_on_several(obj, distinct_masks(obj))
    if made.error > basis.SAID:
        said.append(
            f"The masks lead to so many different tans that some points are off by up to "
            f"{made.error:.0%} of their melanin."
        )
    return said


def distinct_masks(obj: bpy.types.Object) -> Sequence[Mask]:
    """The masks that differ, in the order of the exposures."""
    return list(dict.fromkeys(settings_of(obj).masks()))


def which_masks(obj: bpy.types.Object) -> list[int]:
    """Which of these every exposure that counts has."""
    distinct = distinct_masks(obj)
    return [distinct.index(mask) for mask in settings_of(obj).masks()]
