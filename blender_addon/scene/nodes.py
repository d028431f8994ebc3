"""The node group of a tan: it samples two images by day and share of the dose.

A node that this add-on makes has a role, which says what it is for, in a custom property. Apply
writes the few values that it owns into nodes with a role. It leaves all other nodes, links and
values alone.
"""

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass

import bpy

from hylios.errors import InputError

from .changes import Changes

DAY_PROPERTY = "tan_day"
# Cycles' Burley profile has the width d = radius / (4 pi 1.04); in metres.
RADIUS_PER_MILLIMETRE = 4.0 * math.pi * 1.04 * 0.001

LAYOUT_KEY, LAYOUT = "skin_tan_layout", 1
"""Custom property of a group that says that this add-on made it, and by which plan."""

PROFILE_KEY = "skin_tan_profile"
"""Custom property of a group: whether its table has a profile, so that light scatters below."""

ROLE_KEY = "skin_tan_role"

IMAGE_KEYS = {"colour": "skin_tan_colour", "width": "skin_tan_width"}
"""Custom properties of a group: the images that were made for it, whatever its nodes show."""


@dataclass(frozen=True)
class Role:
    """A kind of node in the group; the label tells it in files without roles."""

    kind: str
    label: str
    location: tuple[int, int]


ROLES = {
    "mask": Role("ShaderNodeAttribute", "Share", (-1200, 250)),
    "share": Role("ShaderNodeMath", "Share or all", (-1000, 250)),
    "day": Role("ShaderNodeAttribute", "Day", (-1000, 0)),
    "column": Role("ShaderNodeMapRange", "Share to column", (-800, 250)),
    "row": Role("ShaderNodeMapRange", "Day to row", (-800, 0)),
    "place": Role("ShaderNodeCombineXYZ", "Place in table", (-600, 150)),
    "colour": Role("ShaderNodeTexImage", "Colour", (-400, 250)),
    "width": Role("ShaderNodeTexImage", "Profile width (mm)", (-400, -50)),
    "radius": Role("ShaderNodeValue", "Width to radius", (-350, -350)),
    "input": Role("NodeGroupInput", "", (-400, 450)),
    "skin": Role("ShaderNodeBsdfPrincipled", "Skin", (-50, 300)),
    "output": Role("NodeGroupOutput", "", (300, 300)),
}
LINKS = (
    ("mask", "Fac", "share", 0),
    ("share", "Value", "column", "Value"),
    ("day", "Fac", "row", "Value"),
    ("column", "Result", "place", "X"),
    ("row", "Result", "place", "Y"),
    ("place", "Vector", "colour", "Vector"),
    ("place", "Vector", "width", "Vector"),
    ("colour", "Color", "skin", "Base Color"),
    ("width", "Color", "skin", "Subsurface Radius"),
    ("radius", "Value", "skin", "Subsurface Scale"),
    ("input", "Roughness", "skin", "Roughness"),
    ("input", "Specular", "skin", "Specular IOR Level"),
    ("skin", "BSDF", "output", "Surface"),
    ("colour", "Color", "output", "Colour"),
    ("width", "Color", "output", "Profile Width"),
)


@dataclass(frozen=True)
class Sampled:
    """The two images of a tan, and what their axes mean.

    Attributes
    ----------
    colour, width : Image
        Of colour, and of profile width in mm.
    has_profile : bool
        Whether light scatters below the surface; without, `width` is one black pixel.
    first_day, last_day : float
        Of the first and the last row.
    mask_attribute : str
        With the share of the dose at each point; without one every place gets all of it.
    scene_unit : float
        Length of a scene unit in metres.
    """

    colour: bpy.types.Image
    width: bpy.types.Image
    has_profile: bool
    first_day: float
    last_day: float
    mask_attribute: str
    scene_unit: float


def require_readable(group: bpy.types.NodeTree) -> None:
    """Raise InputError where a newer version of the add-on made a group."""
    if group.get(LAYOUT_KEY, LAYOUT) != LAYOUT:
        raise InputError(
            f"A newer version of this add-on made the node group {group.name!r}; install that one."
        )


def new_group(name: str) -> bpy.types.NodeTree:
    """A new node group, for `update` to fill with numbers."""
    group = bpy.data.node_groups.new(name, "ShaderNodeTree")
    _add_sockets(group)
    complete(group, ROLES)
    group[LAYOUT_KEY] = LAYOUT
    return group


def update(
    group: bpy.types.NodeTree, sampled: Sampled, changes: Changes
) -> dict[bpy.types.Image, bpy.types.Image]:
    """Have a tan's group show other images, and return which new one replaces which former one.

    What an artist changed in it otherwise stays: nodes, links, values.
    """
    replaced = {
        node.image: image
        for role, image in (("colour", sampled.colour), ("width", sampled.width))
        for node in of_role(group, role)
        if node.image is not None
    }
    _set_numbers(group, sampled, changes)
    _set_profile(group, sampled, changes)
    return replaced


def made_images(group: bpy.types.NodeTree) -> list[bpy.types.Image]:
    """The images that were made for a group, as far as they are still in the file."""
    return [image for key in IMAGE_KEYS.values() if (image := group.get(key)) is not None]


def missing_roles(group: bpy.types.NodeTree) -> list[str]:
    """Labels of nodes without which a group cannot show the tan, and which it lacks."""
    needed = ("day", "row", "column", "place", "colour", "share")
    return [ROLES[role].label for role in needed if not list(of_role(group, role))]


def has_own_shader(group: bpy.types.NodeTree) -> bool:
    """Whether an artist has put something in place of the Principled BSDF."""
    return not list(of_role(group, "skin"))


def of_role(group: bpy.types.NodeTree, role: str) -> Iterator:
    """Nodes of a role: an artist may have duplicated some."""
    return (node for node in group.nodes if node.get(ROLE_KEY) == role)


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


def complete(group, made: Collection[str]) -> None:
    """Make the nodes of some roles and their links, other than into what is linked already."""
    present = {node[ROLE_KEY]: node for node in group.nodes if ROLE_KEY in node}
    for role in made:
        present[role] = _new_node(group, role)
    for source, output, target, socket in LINKS:
        if {source, target} & set(made) and {source, target} <= set(present):
            start = present[source].outputs.get(output)
            end = find_input(present[target], socket)
            if start is not None and end is not None and not end.is_linked:
                group.links.new(start, end)


def _new_node(group, role: str):
    plan = ROLES[role]
    node = group.nodes.new(plan.kind)
    node.label, node.location, node[ROLE_KEY] = plan.label, plan.location, role
    if role in ("column", "row"):
        node.clamp = True
    elif role in ("colour", "width"):
        node.interpolation, node.extension = "Linear", "EXTEND"
    elif role == "share":
        node.operation = "MAXIMUM"
    elif role == "day":
        node.attribute_type, node.attribute_name = "OBJECT", DAY_PROPERTY
    elif role == "mask":
        node.attribute_type = "GEOMETRY"
    elif role == "skin":
        node.subsurface_method = "BURLEY"
        find_input(node, "Subsurface Weight").default_value = 0.0
        find_input(node, "IOR").default_value = 1.4
    return node


def find_input(node, socket: str | int):
    """An input by number, identifier or name: a Principled BSDF hides the names of some sockets."""
    if isinstance(socket, int):
        return node.inputs[socket]
    by_identifier = {item.identifier: item for item in node.inputs}
    return by_identifier.get(socket) or node.inputs.get(socket)


def _set_numbers(group, sampled: Sampled, changes: Changes) -> None:
    for node in of_role(group, "mask"):
        changes.set(node, "attribute_name", sampled.mask_attribute)
    for node in of_role(group, "share"):
        changes.set(node.inputs[1], "default_value", 0.0 if sampled.mask_attribute else 1.0)
    columns, rows = sampled.colour.size
    for node in of_role(group, "column"):
        _map_to_texels(node, (0.0, 1.0), columns, changes)
    for node in of_role(group, "row"):
        _map_to_texels(node, (sampled.first_day, sampled.last_day), rows, changes)
    for role, image in (("colour", sampled.colour), ("width", sampled.width)):
        for node in of_role(group, role):
            changes.set(node, "image", image)
        changes.set_key(group, IMAGE_KEYS[role], image)
    for node in of_role(group, "radius"):
        radius = RADIUS_PER_MILLIMETRE / sampled.scene_unit
        changes.set(node.outputs[0], "default_value", radius)


def _map_to_texels(node, ends: tuple[float, float], texels: int, changes: Changes) -> None:
    """Map the ends to the centres of the first and the last texel."""
    numbers = (*ends, 0.5 / texels, 1.0 - 0.5 / texels)
    for name, number in zip(("From Min", "From Max", "To Min", "To Max"), numbers, strict=True):
        changes.set(node.inputs[name], "default_value", number)


def _set_profile(group, sampled: Sampled, changes: Changes) -> None:
    """Turn subsurface on or off, but only where the table brings a change: it may be edited."""
    if bool(group.get(PROFILE_KEY)) != sampled.has_profile:
        for node in of_role(group, "skin"):
            weight = find_input(node, "Subsurface Weight")
            changes.set(weight, "default_value", float(sampled.has_profile))
    changes.set_key(group, PROFILE_KEY, sampled.has_profile)
