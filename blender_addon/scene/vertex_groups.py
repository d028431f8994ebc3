"""Copies of vertex groups as attributes, which all engines of all versions can show.

EEVEE shows vertex groups from Blender 5.2 on only. A copy belongs to the mesh, which says so in a
custom property.
"""

import hashlib
import json
from collections.abc import Collection
from functools import partial
from typing import Any, cast

import bmesh
import bpy
import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError

from .changes import Changes
from .masks import COPIES_KEY
from .ownership import remembered

PREFIX = "skin_tan_"


def weights(obj: bpy.types.Object, name: str) -> NDArray[np.float32]:
    """Weights (points,) of a vertex group; 0 where a point is not in it.

    Raises
    ------
    InputError
        In Edit Mode, in which they cannot be read.
    """
    if obj.mode == "EDIT":
        raise InputError(
            f"{obj.name!r} is in Edit Mode, in which its vertex group {name!r} cannot be read; "
            "leave Edit Mode (Tab)."
        )
    index = obj.vertex_groups[name].index
    mesh = bmesh.new()
    try:
        mesh.from_mesh(cast(bpy.types.Mesh, obj.data), face_normals=False, vertex_normals=False)
        layer = mesh.verts.layers.deform.active
        if layer is None:
            return np.zeros(len(mesh.verts), np.float32)
        values = (vertex[layer].get(index, 0.0) for vertex in mesh.verts)
        return np.fromiter(values, np.float32, len(mesh.verts))
    finally:
        mesh.free()


def copied(obj: bpy.types.Object, name: str, changes: Changes) -> str:
    """Bring the copy of a vertex group up to date, and return its attribute's name.

    Raises
    ------
    InputError
        In Edit Mode, or if Blender makes no attribute.
    """
    values = weights(obj, name)
    mesh = cast(bpy.types.Mesh, obj.data)
    copies = _copies(mesh)
    attribute = next((copy for copy, group in copies.items() if group == name), None)
    if attribute is None:
        attribute = new_attribute(mesh, _copy_name(name), "FLOAT", "POINT", changes)
        changes.set_key(mesh, COPIES_KEY, json.dumps({**copies, attribute: name}))
    else:
        changes.on_failure(_write, mesh, attribute, _read(mesh, attribute))
    _write(mesh, attribute, values)
    return attribute


def refresh(obj: bpy.types.Object, names: Collection[str]) -> bool:
    """Bring copies of vertex groups up to date; whether any has changed."""
    mesh = cast(bpy.types.Mesh, obj.data)
    changed = False
    for attribute, group in _copies(mesh).items():
        if group in names and group in obj.vertex_groups:
            values = weights(obj, group)
            if not np.array_equal(values, _read(mesh, attribute)):
                _write(mesh, attribute, values)
                changed = True
    return changed


def new_attribute(
    mesh: bpy.types.Mesh, name: str, data_type: str, domain: str, changes: Changes
) -> str:
    """Make an attribute of a name that is free, and return the name that it got.

    Which colours the mesh shows by default, and which a brush paints on, stays as it was: Blender
    would have its first colours be both.

    Raises
    ------
    InputError
        If Blender makes none.
    """
    attributes: Any = mesh.attributes
    stem, number = name, 0
    while name in attributes:
        number += 1
        name = f"{stem}.{number:03d}"
    colours = attributes.active_color_name, attributes.default_color_name
    made = attributes.new(name, data_type, domain)
    if made is None:
        raise InputError(f"Blender makes no attribute {name!r} on the mesh {mesh.name!r}.")
    name = made.name
    changes.on_failure(remove_attribute, mesh, name)
    attributes.active_color_name, attributes.default_color_name = colours
    return name


def remove_own(obj: bpy.types.Object, changes: Changes) -> None:
    """Remove the copies on an object's mesh, other than those that other objects' masks need."""
    mesh = cast(bpy.types.Mesh, obj.data)
    if COPIES_KEY not in mesh:
        return
    copies = _copies(mesh)
    needed = {
        name
        for other in bpy.data.objects
        if other != obj and other.data == mesh
        for name in mask_names(other)
    }
    left = {attribute: group for attribute, group in copies.items() if group in needed}
    for attribute in set(copies) - set(left):
        changes.at_the_end(partial(remove_attribute, mesh, attribute))
    if left:
        changes.set_key(mesh, COPIES_KEY, json.dumps(left))
    else:
        changes.pop_key(mesh, COPIES_KEY)


def mask_names(obj: bpy.types.Object) -> set[str]:
    """Names of all sources of an object's masks."""
    settings = remembered(obj)
    own = (exposure.mask.source for exposure in settings.exposures if exposure.own_mask)
    sources = settings.mask.source, settings.mask_attribute, settings.film_mask.source
    regions = (region.mask.source for region in settings.regions)
    return {*sources, *own, *regions} - {""}


def _copies(mesh: bpy.types.Mesh) -> dict[str, str]:
    """The vertex groups by the attributes that are their copies and are there still."""
    try:
        stored = json.loads(mesh.get(COPIES_KEY, "{}"))
    except (TypeError, ValueError):
        return {}
    return {
        attribute: group
        for attribute, group in stored.items()
        if (item := mesh.attributes.get(attribute)) is not None
        and (item.data_type, item.domain) == ("FLOAT", "POINT")
    }


def _copy_name(group: str) -> str:
    """It fits into the 67 bytes that Blender 4.5 gives a name, and is none of Cycles' own."""
    if len(group.encode()) <= 50:
        return PREFIX + group
    return PREFIX + hashlib.sha256(group.encode()).hexdigest()[:16]


def _read(mesh: bpy.types.Mesh, name: str) -> NDArray[np.float32]:
    data = cast(Any, mesh.attributes[name]).data
    values = np.empty(len(data), np.float32)
    data.foreach_get("value", values)
    return values


def _write(mesh: bpy.types.Mesh, name: str, values: NDArray[np.float32]) -> None:
    # By name: a reference does not outlive another attribute's making.
    cast(Any, mesh.attributes[name]).data.foreach_set("value", values)
    mesh.update_tag()


def remove_attribute(mesh: bpy.types.Mesh, name: str) -> None:
    """Remove an attribute, if it is there."""
    attributes: Any = mesh.attributes
    if name in attributes:
        attributes.remove(attributes[name])
