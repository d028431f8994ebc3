"""Node trees: the groups in them at any depth, and the shaders that a material shows."""

from collections.abc import Iterator
from typing import Any

import bpy

from . import first_version

COLOURS = {
    "ShaderNodeBsdfPrincipled": "Base Color",
    "ShaderNodeEeveeSpecular": "Base Color",
    "ShaderNodeBsdfDiffuse": "Color",
    "ShaderNodeSubsurfaceScattering": "Color",
    "ShaderNodeBsdfTranslucent": "Color",
    "ShaderNodeBsdfToon": "Color",
}
"""Inputs that hold the colour of a surface, by the kind of shader."""

EMISSION = {"ShaderNodeEmission": "Color"}
"""Painted skin that is not lit; counts only where a material has no other shader with a colour."""

TARGETS = ("ALL", "CYCLES", "EEVEE")


def tree_of(block: bpy.types.ID) -> Any:
    """The node tree of a material, or a node group itself."""
    return block.node_tree if isinstance(block, bpy.types.Material) else block


def nested(tree: bpy.types.NodeTree | None) -> Iterator[bpy.types.NodeTree]:
    """Node groups in a tree, each once; Blender lets no group hold itself."""
    inside = (getattr(node, "node_tree", None) for node in (tree.nodes if tree else ()))
    yield from dict.fromkeys(group for group in inside if group is not None)


def all_nested(tree: bpy.types.NodeTree | None) -> Iterator[bpy.types.NodeTree]:
    """Node groups in a tree at any depth, the inner ones first, and none inside a tan's."""
    for group in dict.fromkeys(nested(tree)):
        if not first_version.is_tan_group(group):
            yield from all_nested(group)
        yield group


def tan_groups(tree: bpy.types.NodeTree | None) -> Iterator[bpy.types.NodeTree]:
    """Tan groups in a tree, at any depth."""
    for group in nested(tree):
        if first_version.is_tan_group(group):
            yield group
        else:
            yield from tan_groups(group)


def chain(materials: list[Any], group: bpy.types.NodeTree) -> Iterator[bpy.types.ID]:
    """Materials that show a group, the groups that hold it, and last the group itself."""
    held = {}
    for material in materials:
        if group in tan_groups(tree_of(material)):
            yield material
            held.update(dict.fromkeys(_holding(tree_of(material), group)))
    yield from held
    yield group


def _holding(
    tree: bpy.types.NodeTree | None, group: bpy.types.NodeTree
) -> Iterator[bpy.types.NodeTree]:
    for inner in nested(tree):
        if inner != group and group in tan_groups(inner):
            yield inner
            yield from _holding(inner, group)


def has_nodes(material: bpy.types.Material) -> bool:
    """Whether a material shows its nodes: in Blender 4.5 they can be turned off."""
    return bpy.app.version >= (5, 0, 0) or material.use_nodes


Shader = tuple[tuple[bpy.types.NodeTree, ...], Any, Any]
"""Groups around a shader from the outermost, the shader's node, and the input of its colour."""


def shaders(material: bpy.types.Material) -> list[Shader]:
    """Shaders with a colour that a material shows on its surface, whatever group they are in."""
    tree: Any = material.node_tree
    if tree is None or not has_nodes(material):
        return []
    outputs = dict.fromkeys(map(tree.get_output_node, TARGETS))
    ends = [node.inputs["Surface"] for node in outputs if node is not None]
    reached = list(_reached(tree, ends, (), set()))
    for inputs in (COLOURS, EMISSION):
        coloured = [
            (path, node, end)
            for path, node in reached
            for end in node.inputs
            if end.identifier == inputs.get(node.bl_idname)
        ]
        if coloured:
            return coloured
    return []


def _reached(
    tree: Any, ends: list[Any], path: tuple[Any, ...], seen: set[Any]
) -> Iterator[tuple[tuple[Any, ...], Any]]:
    """Nodes whose light arrives at inputs of a tree, with the groups around them."""
    waiting = list(ends)
    while waiting:
        for link in waiting.pop().links:
            node, output = link.from_node, link.from_socket.identifier
            place = (path, tree.as_pointer(), node.name, output)
            if link.is_muted or place in seen:
                continue
            seen.add(place)
            waiting += [end for end in node.inputs if end.type == "SHADER"]
            inner = getattr(node, "node_tree", None)
            if inner is None:
                yield path, node
            elif not first_version.is_tan_group(inner):
                inside = [
                    end
                    for exit_ in inner.nodes
                    if exit_.bl_idname == "NodeGroupOutput" and exit_.is_active_output
                    for end in exit_.inputs
                    if end.identifier == output
                ]
                yield from _reached(inner, inside, (*path, inner), seen)
