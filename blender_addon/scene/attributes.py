"""Attributes of a mesh that can say how much sun reaches each point."""

from typing import cast

import bpy

from hylios.errors import InputError

RESERVED = frozenset(
    """
    N uv generated generated_transform tangent tangent_sign undisplaced_tangent
    undisplaced_tangent_sign vertex_color undeformed undisplaced undisplaced_N particle
    curve_intercept curve_length curve_random point_random ptex_face_id ptex_uv density color flame
    heat temperature velocity velocity_x velocity_y velocity_z pointiness random_per_island
    shadow_transparency motion_P motion_N
    """.split()
)
"""Names under which Cycles shows something of its own and not the mesh's attribute.

From `Attribute::standard_name` in Cycles' sources, less P and radius, which a mesh may use.
"""


def check_mask(obj: bpy.types.Object, name: str) -> None:
    """Raise InputError unless an attribute of a mesh object can hold the share of the dose.

    No name stands for no mask.
    """
    if not name:
        return
    if name in RESERVED:
        raise InputError(
            f"The attribute {name!r} cannot be a mask: Cycles keeps that name for itself; rename "
            "the attribute."
        )
    mesh = cast(bpy.types.Mesh, obj.data)
    attribute = mesh.attributes.get(name)
    if attribute is None:
        usable = [item.name for item in mesh.attributes if _is_mask(item) and not item.is_internal]
        raise InputError(
            f"The mesh has no attribute {name!r}; float attributes of its points: "
            f"{', '.join(usable) or 'none yet'}."
        )
    if not _is_mask(attribute):
        raise InputError(
            f"Attribute {name!r} is of type {attribute.data_type} on domain {attribute.domain}; "
            "allowed is FLOAT on POINT."
        )


def _is_mask(attribute: bpy.types.Attribute) -> bool:
    return attribute.domain == "POINT" and attribute.data_type == "FLOAT"
