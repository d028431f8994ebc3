"""The node group of a tan: made by the plan, and told what to show.

A node that this add-on makes has a role, which says what it is for, in its name. Apply writes the
few values that it owns into nodes with a role. It leaves all other nodes, links and values alone.
"""

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import bpy

from hylios.errors import InputError

from . import places
from .changes import Changes
from .images import stem
from .plan import (
    LAYOUT,
    LAYOUT_KEY,
    LIGHT,
    LINKS,
    PROFILE_KEY,
    ROLE_KEY,
    ROLE_PREFIX,
    ROLES,
    Link,
    Role,
)
from .sampled import FORMER_KEYS, IMAGE_KEYS, Sampled

# Cycles' Burley profile has the width d = radius / (4 pi 1.04); in metres.
RADIUS_PER_MILLIMETRE = 4.0 * math.pi * 1.04 * 0.001

INPUTS = {
    "Roughness": (0.45, 1.0, "Of the surface; the default is that of the skin's table"),
    "Specular": (0.5, 1.0, "Strength of the gloss; .5 is that of skin"),
    "Melanin": (1.0, 100.0, "Melanin over that of the tan: 1 leaves it, 0 is skin without any"),
    "Oil": (0.0, 1.0, "Oil on the skin: makes one of its two gloss lobes sharper"),
    "Blood": (1.0, 100.0, "Blood over that of the skin: 1 leaves it, 2 is a flush"),
}
"""Inputs of the group: default, largest value and what they are."""

OUTPUTS = {
    "Surface": ("NodeSocketShader", "The skin"),
    "Colour": ("NodeSocketColor", "Albedo of the light that has been inside the skin"),
    "Far Width": ("NodeSocketVector", "Width in mm of Burley's profile of the far light"),
    "Ratio": ("NodeSocketColor", "Colour over that of the untanned skin"),
    "Near Share": ("NodeSocketVector", "Share of the light that leaves where it entered"),
    "Share": ("NodeSocketFloat", "Share of the sun that arrives here"),
}
"""Outputs of the group: type and what they are."""


def radius_of_millimetre(scene_unit: float) -> float:
    """Subsurface scale by which a far width in mm becomes a radius; a scene unit is in metres."""
    return RADIUS_PER_MILLIMETRE / scene_unit


def require_readable(group: bpy.types.NodeTree) -> None:
    """Raise InputError where a newer version of the add-on made a group."""
    if int(group.get(LAYOUT_KEY, LAYOUT)) > LAYOUT:
        raise InputError(
            f"A newer version of this add-on made the node group {group.name!r}; install that one."
        )


def new_group(name: str) -> bpy.types.NodeTree:
    """A new node group, for `update` to fill with numbers."""
    group = bpy.data.node_groups.new(name, "ShaderNodeTree")
    add_sockets(group)
    complete(group, ROLES)
    group[LAYOUT_KEY] = LAYOUT
    return group


def update(
    group: bpy.types.NodeTree, sampled: Sampled, changes: Changes
) -> dict[bpy.types.Image, bpy.types.Image]:
    """Have a tan's group show other images, and return which new one replaces which former one.

    What an artist changed in it otherwise stays: nodes, links, values.
    """
    replaced = {}
    for role, image in sampled.images.items():
        for node in of_role(group, role):
            if node.image not in (None, image):
                replaced[node.image] = image
            changes.set(node, "image", image)
    for key, image in sampled.made.items():
        changes.set_key(group, key, image)
    for key in FORMER_KEYS:
        changes.at_the_end(partial(group.pop, key, None))
    by_role = places.of_roles(sampled)
    for role, place in by_role.items():
        for node in of_role(group, role):
            shifts = any(role_of(own.from_node) in SHIFTS for own in node.inputs[0].links)
            places.set_place(node, by_role["colour"] if shifts else place, changes)
    for role, values in _values(sampled).items():
        for node in of_role(group, role):
            is_math = node.bl_idname == "ShaderNodeMath" and "From Min" in values
            for socket, value in (_straight(values) if is_math else values).items():
                end = node.outputs[0] if socket == OUT else find_input(node, socket)
                if end is not None:
                    changes.set(end, "default_value", value)
    _set_profile(group, sampled, changes)
    return replaced


def set_bulge(group: bpy.types.NodeTree, thickness: tuple[float, float], bulge: float) -> None:
    """Have a group look thick skin up as the look does whose pixels its images are given."""
    for node in of_role(group, "thickness_slope"):
        for number, value in _slope(thickness, bulge).items():
            node.inputs[number].default_value = value


def made_images(group: bpy.types.NodeTree) -> list[bpy.types.Image]:
    """The images that were made for a group, as far as they are still in the file."""
    keys = (*IMAGE_KEYS.values(), *FORMER_KEYS)
    return [image for key in keys if (image := group.get(key)) is not None]


def own_history(group: bpy.types.NodeTree) -> tuple[bpy.types.Image, ...] | None:
    """Images of states, of places and, if it peels, of that, where all were made for a group."""
    shown = _shown(group, ("states", "rows", "columns"))
    states, places = (group.get(IMAGE_KEYS[name]) for name in ("states", "places"))
    if states is None or places is None or shown != {states, places} or not is_of_today(group):
        return None
    peeling = _shown(group, ("peel_image",))
    if peeling - {group.get(IMAGE_KEYS["peel_image"])} or None in peeling:
        return None
    return states, places, *peeling


def own_look(group: bpy.types.NodeTree) -> dict[str, bpy.types.Image] | None:
    """Images of the look by name, where a group shows those that were made for it."""
    own = {"own_image": ("own_image",)} if any(of_role(group, "own_image")) else {}
    roles = {"colours": ("colour",), "light": LIGHT, **own}
    made = {name: group.get(IMAGE_KEYS[name]) for name in roles}
    for name, image in made.items():
        if image is None or _shown(group, roles[name]) != {image} or not is_of_today(group):
            return None
    return made


def _shown(group: bpy.types.NodeTree, roles: Iterable[str]) -> set[Any]:
    """Images that nodes of some roles show."""
    return {node.image for role in roles for node in of_role(group, role)}


def is_of_today(group: bpy.types.NodeTree) -> bool:
    """Whether a group shows images as Apply makes them today."""
    return group.get(LAYOUT_KEY) == LAYOUT


def missing_roles(group: bpy.types.NodeTree) -> list[str]:
    """Labels of nodes without which a group cannot show the tan, and which it lacks."""
    needed = "day rows share columns states state melanin root look_place colour mixed_colour"
    return [ROLES[role].label for role in needed.split() if not list(of_role(group, role))]


def has_own_shader(group: bpy.types.NodeTree) -> bool:
    """Whether an artist has put something in place of the Principled BSDF."""
    return not list(of_role(group, "skin"))


def bridge(tree: Any, kept: Any, given: Any) -> None:
    """Link what is linked to an input of a node to all that one of its outputs is linked to."""
    ends = [link.to_socket for link in given.links]
    for link in list(kept.links):
        for end in ends:
            tree.links.new(link.from_socket, end)


def of_role(group: bpy.types.NodeTree, role: str) -> Iterator:
    """Nodes of a role: an artist may have duplicated some."""
    return (node for node in group.nodes if role_of(node) == role)


def role_of(node: Any) -> str | None:
    """The role of a node; a copy has that of what it was copied from."""
    name = node.name
    if name.startswith(ROLE_PREFIX):
        return stem(name.removeprefix(ROLE_PREFIX))
    return node.get(ROLE_KEY)


def take_role(node: Any, changes: Changes) -> None:
    """Have a node that goes when all else is done have no role any more."""
    changes.set(node, "name", "Former")
    changes.pop_key(node, ROLE_KEY)


def set_roughness(trees: Collection[Any], group: Any, roughness: float, changes: Changes) -> None:
    """Give the skin's roughness to a group's input, and to its nodes in trees.

    A node that an artist has set to another value than the former default, or linked, keeps it.
    """
    for item in group.interface.items_tree:
        if item.name == "Roughness" and getattr(item, "in_out", "") == "INPUT":
            former = item.default_value
            for tree in trees:
                for node in tree.nodes:
                    end = node.inputs.get("Roughness")
                    if getattr(node, "node_tree", None) == group and end.default_value == former:
                        changes.set(end, "default_value", roughness)
            changes.set(item, "default_value", roughness)


def add_sockets(group: Any) -> list[str]:
    """Give a group those inputs and outputs that it lacks; the names of new inputs."""
    interface = group.interface
    present = {(item.in_out, item.name) for item in interface.items_tree if hasattr(item, "in_out")}
    added = {name: given for name, given in INPUTS.items() if ("INPUT", name) not in present}
    for socket in add_inputs(group, added):
        socket.subtype = "FACTOR"
    if ("INPUT", "Normal") not in present:
        normal = interface.new_socket("Normal", in_out="INPUT", socket_type="NodeSocketVector")
        normal.hide_value = True
    lacking = {name: given for name, given in OUTPUTS.items() if ("OUTPUT", name) not in present}
    add_outputs(group, lacking)
    return list(added)


def add_inputs(group: Any, inputs: Mapping[str, tuple[float, float, str]]) -> list[Any]:
    """New inputs of a group by name: default, largest value and what they are; the least is 0."""
    made = []
    for name, (default, most, says) in inputs.items():
        socket = group.interface.new_socket(
            name, description=says, in_out="INPUT", socket_type="NodeSocketFloat"
        )
        socket.min_value, socket.max_value = 0.0, most
        socket.default_value = default
        made.append(socket)
    return made


def add_outputs(group: Any, outputs: Mapping[str, tuple[str, str]]) -> None:
    """New outputs of a group by name: type and what they are."""
    for name, (kind, says) in outputs.items():
        group.interface.new_socket(name, description=says, in_out="OUTPUT", socket_type=kind)


def complete(
    group: Any,
    made: Collection[str],
    roles: Mapping[str, Role] = ROLES,
    links: Sequence[Link] = LINKS,
) -> None:
    """Make the nodes of some roles and their links, other than into what is linked already."""
    for role in made:
        new_node(group, role, roles)
    link(group, made, links)


def link(group: Any, made: Collection[str], links: Sequence[Link] = LINKS) -> None:
    """Link nodes of some roles as a plan has it, other than into what is linked already."""
    present = {role_of(node): node for node in group.nodes}
    for source, output, target, socket in links:
        if {source, target} & set(made) and {source, target} <= set(present):
            start = find_output(present[source], output)
            end = find_input(present[target], socket)
            if start is not None and end is not None and not end.is_linked:
                group.links.new(start, end)


def new_node(group: Any, role: str, roles: Mapping[str, Role] = ROLES) -> Any:
    """A new node of a role, not linked yet."""
    plan = roles[role]
    node = group.nodes.new(plan.kind)
    node.label, node.location, node.name = plan.label, plan.location, ROLE_PREFIX + role
    for name, value in plan.values.items():
        setattr(node, name, value)
    for socket, value in plan.inputs.items():
        find_input(node, socket).default_value = value
    return node


def find_input(node: Any, socket: str | int) -> Any:
    """An input by number, identifier or name: a Principled BSDF hides the names of some sockets."""
    return _find(node.inputs, socket)


def find_output(node: Any, socket: str | int) -> Any:
    """An output by number, identifier or name."""
    return _find(node.outputs, socket)


def _find(sockets: Any, socket: str | int) -> Any:
    if isinstance(socket, int):
        return sockets[socket]
    by_identifier = {item.identifier: item for item in sockets}
    return by_identifier.get(socket) or sockets.get(socket)


SHIFTS = ("untanned_place", "own_untanned_place")
"""Roles of nodes that lead to untanned skin which is not everywhere the same."""

OUT = "output"
"""Stands for a node's first output, whose value is the node's."""


def _values(sampled: Sampled) -> dict[str, dict[str | int, Any]]:
    """The values that Apply owns, by roles and inputs."""
    low, high = (max(weight, 1e-6) for weight in (sampled.near_weight, 1.0 - sampled.near_weight))
    days = places.of_roles(sampled)["rows"]
    # Groups made before `two_lobes` have no link into the factor of `lobes` and `far_scaled`.
    return {
        "thickness": _between(sampled.thickness, 0.0, 1.0),
        "thickness_slope": _slope(sampled.thickness, sampled.bulge),
        "peel_row": {1: days.scale[0], 2: days.start[0]},
        **dict.fromkeys(("look_row", "region_row", "own_row"), _cut(sampled.blood)),
        "gain": {2: (sampled.level,) * 3},
        "near_scaled": {"Scale": 1.0 / low if sampled.near_weight > 0.0 else 0.0},
        "far_scaled": {"Scale": 1.0 / high},
        "lobes": {0: 1.0 - sampled.near_weight},
        "far_weight": {1: -sampled.near_weight},
        "far_factor": {1: 1.0 / high - 1.0},
        "radius": {OUT: radius_of_millimetre(sampled.scene_unit)},
    }


def _slope(thickness: tuple[float, float], bulge: float) -> dict[str | int, float]:
    """Values of the node that has the share of thick skin bulge."""
    span = thickness[1] - thickness[0]
    return {1: -bulge / span**2, 2: (1.0 + bulge) / span}


def _cut(ends: tuple[float, float]) -> dict[str | int, float]:
    """Values of a node that cuts to two ends; one of earlier versions mapped them to places."""
    low, high = ends
    kept = ends if high > low else (0.0, 1.0)
    return {"Min": low, "Max": high, **_between(kept, *kept)}


def _between(ends: tuple[float, float], low: float, high: float) -> dict[str | int, float]:
    """Values of a node that maps the ends to two places."""
    return {"From Min": ends[0], "From Max": ends[1], "To Min": low, "To Max": high}


def _straight(ends: Mapping[str | int, float]) -> dict[str | int, float]:
    """The same for a node that multiplies and adds; beyond their ends images hold their edge."""
    slope = (ends["To Max"] - ends["To Min"]) / (ends["From Max"] - ends["From Min"])
    return {1: slope, 2: ends["To Min"] - slope * ends["From Min"]}


def _set_profile(group: Any, sampled: Sampled, changes: Changes) -> None:
    """Turn subsurface on or off, but only where the table brings a change: it may be edited."""
    if bool(group.get(PROFILE_KEY)) != sampled.has_profile:
        for node in of_role(group, "skin"):
            weight = find_input(node, "Subsurface Weight")
            changes.set(weight, "default_value", float(sampled.has_profile))
    changes.set_key(group, PROFILE_KEY, sampled.has_profile)
