"""The shader of a tan: a node group that samples two images, and a material around it."""

import math
from dataclasses import dataclass

import bpy

from .tan import Tan

DAY_PROPERTY = "tan_day"
# Cycles' Burley profile has the width d = radius / (4 pi 1.04); in metres.
RADIUS_PER_MILLIMETRE = 4.0 * math.pi * 1.04 * 0.001


@dataclass(frozen=True)
class Sampled:
    """The two images of a tan, and what their axes mean.

    `scene_unit` is the length of one scene unit in metres. Without a mask attribute every place
    gets the full dose; without an image of widths light does not scatter below the surface.
    """

    colour: bpy.types.Image
    profile_width: bpy.types.Image | None
    tan: Tan
    mask_attribute: str
    scene_unit: float


def tan_group(name: str, sampled: Sampled) -> bpy.types.NodeTree:
    """Build the node group of a tan, or fill the local group of that name anew.

    Its sockets stay as they are in a group that exists, so that what was set on them is kept.
    """
    group = bpy.data.node_groups.get((name, None))
    if group is None:
        group = bpy.data.node_groups.new(name, "ShaderNodeTree")
        _add_sockets(group)
    group.nodes.clear()
    _fill(group, sampled)
    return group


def _add_sockets(group) -> None:
    interface = group.interface
    for label, default in (("Roughness", 0.45), ("Specular", 0.5)):
        socket = interface.new_socket(label, in_out="INPUT", socket_type="NodeSocketFloat")
        socket.subtype = "FACTOR"
        socket.min_value, socket.max_value = 0.0, 1.0
        socket.default_value = default
    interface.new_socket("Surface", in_out="OUTPUT", socket_type="NodeSocketShader")
    interface.new_socket("Colour", in_out="OUTPUT", socket_type="NodeSocketColor")
    interface.new_socket("Profile Width", in_out="OUTPUT", socket_type="NodeSocketVector")


def _fill(group, sampled: Sampled) -> None:
    tan, links = sampled.tan, group.links
    rows, columns, _ = tan.colour.shape

    share = _share(group, sampled.mask_attribute)
    day = _attribute(group, "OBJECT", DAY_PROPERTY, label="Day", location=(-1000, 0))
    across = _texel_position(group, share, 0.0, 1.0, columns, label="Share to column")
    across.location = (-800, 250)
    up = _texel_position(group, day, tan.first_day, tan.last_day, rows, label="Day to row")
    up.location = (-800, 0)
    place = _node(group, "ShaderNodeCombineXYZ", label="Place in table", location=(-600, 150))
    links.new(across.outputs["Result"], place.inputs["X"])
    links.new(up.outputs["Result"], place.inputs["Y"])

    colour = _table(group, sampled.colour, place, label="Colour", location=(-400, 250))
    given = _node(group, "NodeGroupInput", location=(-400, 450))
    skin = _node(group, "ShaderNodeBsdfPrincipled", label="Skin", location=(-50, 300))
    skin.subsurface_method = "BURLEY"
    sockets = {socket.identifier: socket for socket in skin.inputs}
    sockets["Subsurface Weight"].default_value = 0.0
    sockets["IOR"].default_value = 1.4
    links.new(colour.outputs["Color"], sockets["Base Color"])
    links.new(given.outputs["Roughness"], sockets["Roughness"])
    links.new(given.outputs["Specular"], sockets["Specular IOR Level"])

    result = _node(group, "NodeGroupOutput", location=(300, 300))
    links.new(skin.outputs["BSDF"], result.inputs["Surface"])
    links.new(colour.outputs["Color"], result.inputs["Colour"])
    if sampled.profile_width is not None:
        width = _table(
            group, sampled.profile_width, place, label="Profile width (mm)", location=(-400, -50)
        )
        _scatter_below(group, sockets, width, RADIUS_PER_MILLIMETRE / sampled.scene_unit)
        links.new(width.outputs["Color"], result.inputs["Profile Width"])


def _scatter_below(group, sockets, width, radius: float) -> None:
    """Subsurface scattering with so many scene units of radius to a millimetre of width."""
    scale = _node(group, "ShaderNodeValue", label="Width to radius", location=(-350, -350))
    scale.outputs[0].default_value = radius
    sockets["Subsurface Weight"].default_value = 1.0
    group.links.new(width.outputs["Color"], sockets["Subsurface Radius"])
    group.links.new(scale.outputs[0], sockets["Subsurface Scale"])


def _node(group, kind: str, *, label: str = "", location: tuple[int, int]):
    node = group.nodes.new(kind)
    node.label = label
    node.location = location
    return node


def _attribute(group, kind: str, name: str, *, label: str, location: tuple[int, int]):
    node = _node(group, "ShaderNodeAttribute", label=label, location=location)
    node.attribute_type = kind
    node.attribute_name = name
    return node.outputs["Fac"]


def _share(group, mask_attribute: str):
    """Output with the share of the dose that reached the skin."""
    location = (-1000, 250)
    if mask_attribute:
        return _attribute(group, "GEOMETRY", mask_attribute, label="Share", location=location)
    node = _node(group, "ShaderNodeValue", label="Share", location=location)
    node.outputs[0].default_value = 1.0
    return node.outputs[0]


def _texel_position(group, value, low: float, high: float, texels: int, *, label: str):
    """Node that maps low to the centre of the first texel and high to that of the last, clamped."""
    node = _node(group, "ShaderNodeMapRange", label=label, location=(0, 0))
    node.clamp = True
    for socket, number in (
        ("From Min", low),
        ("From Max", high),
        ("To Min", 0.5 / texels),
        ("To Max", 1.0 - 0.5 / texels),
    ):
        node.inputs[socket].default_value = number
    group.links.new(value, node.inputs["Value"])
    return node


def _table(group, image, place, *, label: str, location: tuple[int, int]):
    node = _node(group, "ShaderNodeTexImage", label=label, location=location)
    node.image = image
    node.interpolation = "Linear"
    node.extension = "EXTEND"
    group.links.new(place.outputs["Vector"], node.inputs["Vector"])
    return node


def tan_material(name: str, group: bpy.types.NodeTree) -> bpy.types.Material:
    """The material around a tan's node group.

    A local material of that name is kept with all that was changed in it, as long as it still
    holds the group.
    """
    material = bpy.data.materials.get((name, None)) or bpy.data.materials.new(name)
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    if any(getattr(node, "node_tree", None) == group for node in tree.nodes):
        return material
    tree.nodes.clear()
    skin = _node(tree, "ShaderNodeGroup", location=(0, 0))
    skin.node_tree = group
    skin.width = 200
    output = _node(tree, "ShaderNodeOutputMaterial", location=(260, 0))
    tree.links.new(skin.outputs["Surface"], output.inputs["Surface"])
    return material
