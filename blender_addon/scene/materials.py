"""A material of our own, for an object that has none."""

from typing import Any, cast

import bpy

from . import detail
from .changes import Changes
from .ownership import MADE, names

PREFIX = "Skin Tan "

NEW_SKIN = {"Relief": 1.0, "Variation": 1.0}
"""Sliders of a new material, which is dry; all 0 is the even skin of the light model."""


def new_material(group: bpy.types.NodeTree, name: str) -> bpy.types.Material:
    """A new material that shows a tan's group."""
    material = bpy.data.materials.new(PREFIX + name)
    material[MADE] = True
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    skin: Any = tree.nodes.new("ShaderNodeGroup")
    skin.node_tree, skin.width, skin.location = group, 200, (0, 0)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    output.location = (260, 0)
    tree.links.new(skin.outputs["Surface"], output.inputs["Surface"])
    detail.add_detail(tree, skin)
    made: Any = tree.nodes
    for node in made:
        for slider in NEW_SKIN.keys() & node.inputs.keys():
            node.inputs[slider].default_value = NEW_SKIN[slider]
    return material


def add_slot(obj: bpy.types.Object, changes: Changes) -> str:
    """Give a mesh its first slot, and return a sentence where others have the mesh too."""
    materials: Any = cast(bpy.types.Mesh, obj.data).materials
    changes.on_failure(materials.clear)
    materials.append(None)
    sharing = [other for other in bpy.data.objects if other.data == obj.data and other != obj]
    if not sharing:
        return ""
    return f" Slots belong to the mesh, so {names(sharing)} got an empty one."
