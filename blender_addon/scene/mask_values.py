"""The numbers of a mask on a mesh, whatever the mask reads."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, cast

import bpy
import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError

from .mask_images import at_places, of_channel
from .mask_nodes import ShownMask, slope_and_offset
from .masks import (
    COLOURS,
    Mask,
    Source,
    current_depsgraph,
    evaluated_mesh,
    require_usable,
)
from .vertex_groups import weights

LARGEST_IMAGE = 4096 * 4096
"""Apply reads no larger image only to warn of what is in it."""


@dataclass(frozen=True, eq=False)
class MaskValues:
    """The share of the dose at all points or at all corners of a mesh.

    Attributes
    ----------
    domain : str
        POINT or CORNER.
    shares : (points,) or (corners,) float32 array
        From 0 to 1.
    said : tuple of str
        Sentences on numbers that an artist will not have meant.
    """

    domain: str
    shares: NDArray[np.float32]
    said: tuple[str, ...] = ()


def mask_values(
    obj: bpy.types.Object, mask: Mask, depsgraph: bpy.types.Depsgraph | None = None
) -> MaskValues:
    """The share of the dose on an object's own mesh, as the mask's nodes give it.

    Numbers of faces and texels of images are those at corners. What is no number counts as 0.

    Parameters
    ----------
    depsgraph : Depsgraph, optional
        In which modifiers are evaluated; that of the context if not given.

    Raises
    ------
    InputError
        If the mask cannot be used, or cannot be read: in Edit Mode, from an image with tiles, or
        where modifiers that make it change the number of points.
    """
    source = require_usable(obj, mask)
    if source is None:
        count = len(cast(bpy.types.Mesh, obj.data).vertices)
        return MaskValues("POINT", np.ones(count, np.float32))
    domain, numbers = _numbers(obj, mask, source, depsgraph)
    return MaskValues(domain, shares_of(mask, numbers), tuple(_said(mask, numbers)))


def shares_of(mask: Mask, numbers: NDArray[np.float32]) -> NDArray[np.float32]:
    """The share of the dose where a mask reads some numbers."""
    slope, offset = slope_and_offset(mask)
    cut = np.clip(np.where(np.isnan(numbers), 0.0, numbers), 0.0, 1.0)
    return (slope * cut + offset).astype(np.float32)


def remarks(obj: bpy.types.Object, mask: Mask, shown: ShownMask) -> list[str]:
    """Sentences on the one mask of all exposures: on numbers that an artist will not have meant.

    Parameters
    ----------
    shown : ShownMask
        What the nodes read for the mask.
    """
    numbers = _shown_numbers(obj, mask, shown)
    return [] if numbers is None else _said(mask, numbers, ", so nothing tans")


def remarks_on_several(obj: bpy.types.Object, masks: Iterable[Mask]) -> list[str]:
    """Sentences on the masks of several exposures."""
    read = ((mask, _shown_numbers(obj, mask, ShownMask(image=mask.image))) for mask in masks)
    return [said for mask, own in read if own is not None for said in _said(mask, own)]


def _said(mask: Mask, numbers: NDArray[np.float32], where_covered: str = "") -> list[str]:
    """Sentences on a mask's numbers."""
    if not numbers.size:
        return []
    name = mask.image.name if mask.image else mask.source
    said, is_number = [], ~np.isnan(numbers)
    if not is_number.all():
        said.append(
            f"{np.count_nonzero(~is_number)} of {numbers.size} points of the mask {name!r} have "
            "no valid value; they count as 0."
        )
    low, high = (
        np.min(numbers, where=is_number, initial=0),
        np.max(numbers, where=is_number, initial=0),
    )
    if low < -1e-4 or high > 1.0001:
        said.append(
            f"The mask {name!r} holds numbers from {low:.3g} to {high:.3g}; they are cut to 0 to 1."
        )
    shares = shares_of(mask, numbers)
    if shares.max() <= 0.0:
        said.append(f"By the mask {name!r} the whole body is covered{where_covered}.")
    elif shares.min() >= 1.0:
        said.append(f"By the mask {name!r} the whole body is bare.")
    return said


def _shown_numbers(
    obj: bpy.types.Object, mask: Mask, shown: ShownMask
) -> NDArray[np.float32] | None:
    """What the nodes read, where it can be read in a short time."""
    mesh = cast(bpy.types.Mesh, obj.data)
    image = shown.image
    if image is not None and image.size[0] * image.size[1] > LARGEST_IMAGE:
        return None
    attribute = mesh.attributes.get(shown.attribute) if shown.attribute else None
    try:
        if attribute is not None:  # a vertex group's copy was just made
            return _of_attribute(mesh, shown.attribute, mask.channel)[1]
        source = require_usable(obj, mask)
        return _numbers(obj, mask, source, None)[1] if source else None
    except InputError:
        return None


def _numbers(
    obj: bpy.types.Object, mask: Mask, source: Source, depsgraph: bpy.types.Depsgraph | None
) -> tuple[str, NDArray[np.float32]]:
    if source.kind == "GROUP":
        return "POINT", weights(obj, source.name)
    mesh = cast(bpy.types.Mesh, obj.data)
    if source.kind == "IMAGE":
        image = cast(bpy.types.Image, mask.image)
        return "CORNER", at_places(image, uv_places(obj, mask.uv_map, depsgraph), mask.channel)
    if source.kind == "EVALUATED":
        mesh = _alike(obj, source.name, depsgraph)
    return _of_attribute(mesh, source.name, mask.channel)


def _alike(
    obj: bpy.types.Object, name: str, depsgraph: bpy.types.Depsgraph | None
) -> bpy.types.Mesh:
    """The mesh that modifiers lead to, if its points are those of the object's own."""
    mesh = cast(bpy.types.Mesh, obj.data)
    evaluated = evaluated_mesh(obj, depsgraph or current_depsgraph())
    counts = [(len(item.vertices), len(item.loops)) for item in (mesh, evaluated) if item]
    if len(set(counts)) > 1 or evaluated is None:
        raise InputError(
            f"The modifiers that make {name!r} change the points of {obj.name!r}, so that it "
            "cannot be read on the mesh itself; apply the modifier that makes it."
        )
    return evaluated


def _of_attribute(mesh: bpy.types.Mesh, name: str, channel: str) -> tuple[str, NDArray[np.float32]]:
    attribute: Any = mesh.attributes[name]
    sizes = {"POINT": len(mesh.vertices), "CORNER": len(mesh.loops), "FACE": len(mesh.polygons)}
    count = sizes[attribute.domain]
    if len(attribute.data) != count:
        raise InputError(
            f"The attribute {name!r} of {mesh.name!r} cannot be read in Edit Mode; leave Edit Mode "
            "(Tab)."
        )
    if attribute.data_type in COLOURS:
        colours = np.empty((count, 4), np.float32)
        attribute.data.foreach_get("color", colours.ravel())
        numbers = of_channel(colours, channel)
    else:
        kinds = {"FLOAT": np.float32, "BOOLEAN": np.bool_}
        values = np.empty(count, kinds.get(attribute.data_type, np.int32))
        attribute.data.foreach_get("value", values)
        numbers = values.astype(np.float32)
    if attribute.domain == "FACE":
        totals = np.empty(count, np.int32)
        mesh.polygons.foreach_get("loop_total", totals)
        return "CORNER", np.repeat(numbers, totals)
    return attribute.domain, numbers


def uv_places(
    obj: bpy.types.Object, name: str, depsgraph: bpy.types.Depsgraph | None = None
) -> NDArray[np.float32]:
    """UV coordinates (corners, 2) of a map; without a name, of the one that renders.

    Raises
    ------
    InputError
        If they cannot be read.
    """
    mesh = cast(bpy.types.Mesh, obj.data)
    if not mesh.uv_layers or (name and name not in mesh.uv_layers):
        mesh = _alike(obj, name or "the UV map", depsgraph)
    layers: Any = mesh.uv_layers
    layer = layers[name] if name else next(item for item in layers if item.active_render)
    if len(layer.uv) != len(mesh.loops):
        raise InputError(
            f"The UV map {layer.name!r} of {mesh.name!r} cannot be read in Edit Mode; leave Edit "
            "Mode (Tab)."
        )
    places = np.empty((len(mesh.loops), 2), np.float32)
    layer.uv.foreach_get("vector", places.ravel())
    return places
