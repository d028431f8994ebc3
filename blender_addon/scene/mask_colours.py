"""Colour attributes that are masks: Blender has brushes for them, white is bare."""

import hashlib
import json
from typing import Any, cast

import bpy
import numpy as np
from numpy.typing import NDArray

from .changes import Changes
from .masks import COLOURS, Source, require_name
from .vertex_groups import mask_names, new_attribute

WRITTEN_KEY = "skin_tan_written"
"""Custom property of a mesh: by the names of attributes that From Clothes made, digests of what it
wrote into them, as JSON. What has been painted on since has another."""


def is_paintable(source: Source | None) -> bool:
    """Whether Blender can paint what a mask reads by vertices."""
    return (
        source is not None
        and source.kind == "ATTRIBUTE"
        and source.data_type in COLOURS
        and source.domain in ("POINT", "CORNER")
    )


def new_colours(
    mesh: bpy.types.Mesh, name: str, shares: NDArray[np.float32], domain: str, changes: Changes
) -> str:
    """Make a grey colour attribute of shares (points,) or (corners,); the name that it got.

    Raises
    ------
    InputError
        If a mask cannot have the name, or Blender makes none.
    """
    require_name(name)
    name = new_attribute(mesh, name, "FLOAT_COLOR", domain, changes)
    _write(mesh, name, shares)
    return name


def written(
    obj: bpy.types.Object, former: str, name: str, shares: NDArray[np.float32], changes: Changes
) -> str:
    """Write shares (points,) into a former attribute if it is as we wrote it, else into a new one.

    What has been painted on, and what other masks read, stays as it is.

    Returns
    -------
    str
        Name of the attribute that holds them.
    """
    mesh = cast(bpy.types.Mesh, obj.data)
    digests = _digests(mesh)
    is_ours = former in mesh.attributes and digests.get(former) == _digest(mesh, former)
    if is_ours and not _is_shared(obj, former):
        values = _read(mesh, former)
        changes.on_failure(_write_colours, mesh, former, values)
        _write(mesh, former, shares)
        name = former
    else:
        name = new_colours(mesh, name, shares, "POINT", changes)
    kept = {key: digest for key, digest in digests.items() if key in mesh.attributes}
    changes.set_key(mesh, WRITTEN_KEY, json.dumps({**kept, name: _digest(mesh, name)}))
    return name


def activate(mesh: bpy.types.Mesh, name: str) -> None:
    """Have Vertex Paint paint on a colour attribute."""
    attributes: Any = mesh.color_attributes
    attributes.active_color_name = name


def _is_shared(obj: bpy.types.Object, name: str) -> bool:
    """Whether a mask besides one of the object's own reads an attribute."""
    if any(
        name in mask_names(other)
        for other in bpy.data.objects
        if other != obj and other.data == obj.data
    ):
        return True
    settings: Any = cast(Any, obj).skin_tan
    masks = [settings.mask, *(item.mask for item in settings.exposures if item.own_mask)]
    masks += [region.mask for region in settings.regions]
    return sum(mask.source == name for mask in masks) > 1


def _digests(mesh: bpy.types.Mesh) -> dict[str, str]:
    try:
        return dict(json.loads(mesh.get(WRITTEN_KEY, "{}")))
    except (TypeError, ValueError):
        return {}


def _digest(mesh: bpy.types.Mesh, name: str) -> str:
    attribute = mesh.attributes[name]
    if (attribute.data_type, attribute.domain) != ("FLOAT_COLOR", "POINT"):
        return ""
    return hashlib.sha256(_read(mesh, name).tobytes()).hexdigest()


def _read(mesh: bpy.types.Mesh, name: str) -> NDArray[np.float32]:
    data = cast(Any, mesh.attributes[name]).data
    values = np.empty(4 * len(data), np.float32)
    data.foreach_get("color", values)
    return values


def _write(mesh: bpy.types.Mesh, name: str, shares: NDArray[np.float32]) -> None:
    colours = np.ones((len(shares), 4), np.float32)
    colours[:, :3] = shares[:, None]
    _write_colours(mesh, name, colours.ravel())


def _write_colours(mesh: bpy.types.Mesh, name: str, values: NDArray[np.float32]) -> None:
    cast(Any, mesh.attributes[name]).data.foreach_set("color", values)
    mesh.update_tag()
