"""Attributes of a mesh that can say how much sun reaches each point."""

import bpy

from hylios.errors import InputError


def check_mask(mesh: bpy.types.Mesh, name: str) -> None:
    """Raise InputError unless an attribute can hold the share of the dose, or none is named."""
    if not name:
        return
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
