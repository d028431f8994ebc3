"""The node group of a tan: made by the plan, and told what to show.

A node that this add-on makes has a role, which says what it is for, in a custom property. Apply
writes the few values that it owns into nodes with a role. It leaves all other nodes, links and
values alone.
"""

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import bpy

from hylios.errors import InputError

from .changes import Changes
from .plan import LAYOUT, LAYOUT_KEY, LINKS, LOOK, PROFILE_KEY, ROLE_KEY, ROLES, Link, Role

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

IMAGE_KEYS = {
    "states": "skin_tan_states",
    "columns": "skin_tan_places",
    **{role: f"skin_tan_{role}" for role in LOOK},
    "own_image": "skin_tan_own_image",
    "peel_image": "skin_tan_peel_image",
}
"""Custom properties of a group: the images that were made for it, whatever its nodes show."""


@dataclass(frozen=True)
class Sampled:
    """The images of a tan, and what their axes mean.

    Attributes
    ----------
    states : Image
        Coordinates of the skin's states over days and shares.
    places : Image
        Where shares and days lie in it.
    look : mapping
        Images by the roles of `LOOK`.
    melanin, blood, thickness : pairs of float
        What the ends of the look's images stand for: square root of melanin, logarithms of blood
        and of thickness.
    bulge : float
        How the share of thick skin follows the thickness: x being how far this lies from thin to
        thick, it is x + bulge x (1 - x).
    level : float
        Base colour of a shader over the colour, seen at 8 degrees.
    near_weight : float
        Of the shader that shows near light.
    through : 4 floats
        Share of light that the gloss lets through, by powers 0, 2, 3 and 4 of 1 less the cosine of
        the angle of view.
    roughness : float
        Of the skin.
    has_profile : bool
        Whether light scatters below the surface.
    first_day, last_day : float
    scene_unit : float
        Length of a scene unit in metres, on a body of life-size.
    own_image : Image or None
        Melanin and blood of painted colours, where these say how skin tans.
    peel_image : Image or None
        What peels over days and shares, where skin peels.
    """

    states: bpy.types.Image
    places: bpy.types.Image
    look: Mapping[str, bpy.types.Image]
    melanin: tuple[float, float]
    blood: tuple[float, float]
    thickness: tuple[float, float]
    bulge: float
    level: float
    near_weight: float
    through: tuple[float, float, float, float]
    roughness: float
    has_profile: bool
    first_day: float
    last_day: float
    scene_unit: float
    own_image: bpy.types.Image | None = None
    peel_image: bpy.types.Image | None = None

    @property
    def images(self) -> dict[str, bpy.types.Image]:
        """Images by the roles that show them."""
        return {
            "states": self.states,
            "columns": self.places,
            "rows": self.places,
            **self.look,
            "thick_colour": self.look["colour"],
            "untanned": self.look["colour"],
            **({"own_image": self.own_image} if self.own_image else {}),
            **({"peel_image": self.peel_image} if self.peel_image else {}),
        }

    def of_history(self) -> list[bpy.types.Image]:
        """The images that come from the history."""
        return [self.states, self.places, *([self.peel_image] if self.peel_image else [])]

    def of_look(self) -> list[bpy.types.Image]:
        """The images that come from the look."""
        return [*self.look.values(), *([self.own_image] if self.own_image else [])]


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
        if role in IMAGE_KEYS:
            changes.set_key(group, IMAGE_KEYS[role], image)
    for role, values in _values(sampled).items():
        for node in of_role(group, role):
            is_math = node.bl_idname == "ShaderNodeMath" and "From Min" in values
            for socket, value in (_straight(values) if is_math else values).items():
                end = node.outputs[0] if socket == OUT else find_input(node, socket)
                changes.set(end, "default_value", value)
    _set_profile(group, sampled, changes)
    return replaced


def made_images(group: bpy.types.NodeTree) -> list[bpy.types.Image]:
    """The images that were made for a group, as far as they are still in the file."""
    return [image for key in IMAGE_KEYS.values() if (image := group.get(key)) is not None]


def own_history(group: bpy.types.NodeTree) -> tuple[bpy.types.Image, ...] | None:
    """Images of states, of places and, if it peels, of that, where all were made for a group."""
    shown = {node.image for role in ("states", "rows", "columns") for node in of_role(group, role)}
    states, places = (group.get(IMAGE_KEYS[role]) for role in ("states", "columns"))
    if states is None or places is None or shown != {states, places}:
        return None
    peeling = {node.image for node in of_role(group, "peel_image")}
    if peeling - {group.get(IMAGE_KEYS["peel_image"])} or None in peeling:
        return None
    return states, places, *peeling


def own_look(group: bpy.types.NodeTree) -> dict[str, bpy.types.Image] | None:
    """Images of the look by role, where a group shows those that were made for it."""
    own = ["own_image"] if any(of_role(group, "own_image")) else []
    made = {role: group.get(IMAGE_KEYS[role]) for role in (*LOOK, *own)}
    for role, image in made.items():
        if image is None or {node.image for node in of_role(group, role)} != {image}:
            return None
    return made


def missing_roles(group: bpy.types.NodeTree) -> list[str]:
    """Labels of nodes without which a group cannot show the tan, and which it lacks."""
    needed = (
        "day row rows row_place share column columns column_place place states state "
        "melanin root look_column look_place colour mixed_colour"
    )
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
    return (node for node in group.nodes if node.get(ROLE_KEY) == role)


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
    present = {node[ROLE_KEY]: node for node in group.nodes if ROLE_KEY in node}
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
    node.label, node.location, node[ROLE_KEY] = plan.label, plan.location, role
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


OUT = "output"
"""Stands for a node's first output, whose value is the node's."""


def _values(sampled: Sampled) -> dict[str, dict[str | int, Any]]:
    """The values that Apply owns, by roles and inputs."""
    columns, rows = sampled.look["colour"].size
    steps = sampled.places.size[0]
    half = 0.5 / rows
    melanin = _between(sampled.melanin, 0.5 / columns, 1.0 - 0.5 / columns)
    blood = _between(sampled.blood, half, 0.5 - half)
    if sampled.blood[0] == sampled.blood[1]:
        blood = _between((0.0, 1.0), half, half)
    low, high = (max(weight, 1e-6) for weight in (sampled.near_weight, 1.0 - sampled.near_weight))
    days = (sampled.first_day, sampled.last_day)
    span = sampled.thickness[1] - sampled.thickness[0]
    # Groups made before `two_lobes` have no link into the factor of `lobes` and `far_scaled`.
    return {
        "column": _between((0.0, 1.0), 0.5 / steps, 1.0 - 0.5 / steps),
        "row": _between(days, 0.5 / steps, 1.0 - 0.5 / steps),
        "look_column": melanin,
        "look_row": blood,
        "thickness": _between(sampled.thickness, 0.0, 1.0),
        "thickness_slope": {1: -sampled.bulge / span**2, 2: (1.0 + sampled.bulge) / span},
        **dict.fromkeys(("region_column", "own_column"), melanin),
        **dict.fromkeys(("region_row", "own_row"), blood),
        "untanned_place": {"X": _mapped(melanin, 1.0), "Y": _mapped(blood, 0.0)},
        "gain": {2: (sampled.level,) * 3},
        "near_scaled": {"Scale": 1.0 / low if sampled.near_weight > 0.0 else 0.0},
        "far_scaled": {"Scale": 1.0 / high},
        "lobes": {0: 1.0 - sampled.near_weight},
        "far_weight": {1: -sampled.near_weight},
        "far_factor": {1: 1.0 / high - 1.0},
        "cubic": {1: sampled.through[3], 2: sampled.through[2]},
        "quadratic": {2: sampled.through[1]},
        "through": {2: sampled.through[0]},
        "radius": {OUT: radius_of_millimetre(sampled.scene_unit)},
    }


def _between(ends: tuple[float, float], low: float, high: float) -> dict[str | int, float]:
    """Values of a node that maps the ends to two places."""
    return {"From Min": ends[0], "From Max": ends[1], "To Min": low, "To Max": high}


def _straight(ends: Mapping[str | int, float]) -> dict[str | int, float]:
    """The same for a node that multiplies and adds; beyond their ends images hold their edge."""
    slope = (ends["To Max"] - ends["To Min"]) / (ends["From Max"] - ends["From Min"])
    return {1: slope, 2: ends["To Min"] - slope * ends["From Min"]}


def _mapped(ends: Mapping[str | int, float], value: float) -> float:
    """What a node with these values maps a value to."""
    part = (value - ends["From Min"]) / (ends["From Max"] - ends["From Min"])
    return ends["To Min"] + min(max(part, 0.0), 1.0) * (ends["To Max"] - ends["To Min"])


def _set_profile(group: Any, sampled: Sampled, changes: Changes) -> None:
    """Turn subsurface on or off, but only where the table brings a change: it may be edited."""
    if bool(group.get(PROFILE_KEY)) != sampled.has_profile:
        for node in of_role(group, "skin"):
            weight = find_input(node, "Subsurface Weight")
            changes.set(weight, "default_value", float(sampled.has_profile))
    changes.set_key(group, PROFILE_KEY, sampled.has_profile)
