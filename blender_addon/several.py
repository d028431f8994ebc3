"""The tan of an object whose exposures have several masks, from its settings to its nodes."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast

import bpy
import numpy as np

from .model import basis, palette
from .model.grid import MOST_MASKS_READ
from .model.tan import BasisOverShares, basis_of, basis_over_shares
from .props import settings_of
from .scene import images, mask_values, several, several_nodes
from .scene.changes import Changes
from .scene.mask_nodes import ShownMask, shown_mask
from .scene.masks import Mask
from .scene.texels import LARGEST, TexelShares, has_images, texel_shares

ROUGH_TEXELS = 512
"""Texels along a side, at most, while somebody changes a setting."""


@dataclass(frozen=True, eq=False)
class AtPoints:
    """A basis at points of a mesh.

    Attributes
    ----------
    basis : Basis
    on_mesh : OnMesh
    said : tuple of str
        Sentences on the masks.
    """

    basis: basis.Basis
    on_mesh: several.OnMesh
    said: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class AtTexels:
    """A basis at texels.

    Attributes
    ----------
    basis : Basis
    texels : TexelShares
    """

    basis: basis.Basis
    texels: TexelShares


Computed = AtPoints | AtTexels | BasisOverShares


def has_several(obj: bpy.types.Object) -> bool:
    """Whether an object's exposures have several masks."""
    return len(set(settings_of(obj).masks())) > 1


def computed(obj: bpy.types.Object, *, rough: bool = False) -> Computed | None:
    """The basis of an object's masks; None where there is one mask at most.

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
    settings, distinct, which = settings_of(obj), distinct_masks(obj), which_masks(obj)
    if len(distinct) <= MOST_MASKS_READ:
        return basis_over_shares(settings.values(), which, rough=rough)
    if has_images(distinct):
        texels = texel_shares(obj, distinct, ROUGH_TEXELS if rough else LARGEST)
        precision = palette.DRAG_PALETTE if rough else palette.FULL_PALETTE
        made = basis_of(settings.values(), which, texels.shares, precision, texels.counts)
        return AtTexels(made, texels)
    precision = basis.DRAG if rough else basis.FULL
    mesh = cast(bpy.types.Mesh, obj.data)
    values = [mask_values.mask_values(obj, mask) for mask in distinct]
    domain, shares = several.shares_of_masks(mesh, values)
    made = basis_of(settings.values(), which, shares, precision)
    share = (shares @ made.weights).astype(np.float32)
    said = tuple(said for own in values for said in own.said)
    return AtPoints(made, several.OnMesh(made.coefficients, share, domain), said)


def show(
    obj: bpy.types.Object, group: bpy.types.NodeTree, made: Computed | None, changes: Changes
) -> dict[bpy.types.Image, bpy.types.Image]:
    """Have a tan's group show several masks, or one again; new images by former ones."""
    if made is None:
        several.take_out(obj, group, changes)
        return {}
    told = made.basis
    rows = images.packed_image(f"Skin Tan Masks {obj.name}", told.rows, is_colour=False)
    days = images.packed_image(f"Skin Tan Mask Days {obj.name}", told.places, is_colour=False)
    shapes = several_nodes.Basis(told.rank, rows, days)
    if isinstance(made, AtPoints):
        return several.show(obj, group, shapes, made.on_mesh, changes)
    if isinstance(made, AtTexels):
        return several.show(obj, group, shapes, _palette(obj, made), changes)
    name = f"Skin Tan Mask Shares {obj.name}"
    made_images = [images.packed_image(name, own, is_colour=False) for own in made.images]
    grid = several_nodes.Grid(made_images, made.steps, [float(weight) for weight in told.weights])
    shown = [shown_mask(obj, mask, changes) for mask in distinct_masks(obj)]
    return several.show(obj, group, shapes, several.OverShares(grid, shown), changes)


def _palette(obj: bpy.types.Object, made: AtTexels) -> several_nodes.Palette:
    """Images of a basis at texels."""
    told, texels = made.basis, made.texels
    colours = palette.palette_images(told, texels.shares, texels.counts)
    name = f"Skin Tan Mask Palette {obj.name}"
    index = palette.places_in_palette(told.point[texels.number])
    return several_nodes.Palette(
        images.packed_bytes(f"Skin Tan Mask Texels {obj.name}", index),
        [images.packed_image(name, own, is_colour=False) for own in colours],
        texels.uv_map,
    )


def remarks(
    obj: bpy.types.Object, made: Computed | None, shown: ShownMask, *, rough: bool
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
    if isinstance(made, AtPoints):
        said = [*made.said]
    else:
        said = mask_values.remarks_on_several(obj, distinct_masks(obj))
        said += made.texels.said if isinstance(made, AtTexels) else ()
    if made.basis.error > basis.WANTED["most"]:
        said.append(
            f"The masks lead to so many different tans that some points are off by up to "
            f"{made.basis.error:.0%} of their melanin."
        )
    return said


def distinct_masks(obj: bpy.types.Object) -> Sequence[Mask]:
    """The masks that differ, in the order of the exposures."""
    return list(dict.fromkeys(settings_of(obj).masks()))


def which_masks(obj: bpy.types.Object) -> list[int]:
    """Which of these every exposure that counts has."""
    distinct = distinct_masks(obj)
    return [distinct.index(mask) for mask in settings_of(obj).masks()]
