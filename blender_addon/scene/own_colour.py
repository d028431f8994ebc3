"""Tan from Own Colour: nodes that a tan's group gets where painted colours say how skin tans.

They tell melanin and blood of the painted colour over those of the skin, from a small image, and
shift the state with them, and likewise the untanned state. So Ratio is what such skin's own tan
does.
"""

from dataclasses import dataclass
from functools import partial
from typing import Any

from . import images, nodes, replaced
from .changes import Changes
from .plan import Link, Role, math_role, vector_role
from .recolour import PAINTED_COLOUR, SHARE_OF_PAINTED
from .sampled import IMAGE_KEYS

LEAST = 0.01
"""Least red and green over those of the usual colour: black has no logarithm."""

EULER = 2.718281828

ROLES = {
    "own_red": vector_role("DOT_PRODUCT", "Red over the usual", (-1300, 1700)),
    "own_green": vector_role("DOT_PRODUCT", "Green over the usual", (-1300, 1550)),
    "own_some_red": math_role("MAXIMUM", "Some red", (-1150, 1700), at_1=LEAST),
    "own_some_green": math_role("MAXIMUM", "Some green", (-1150, 1550), at_1=LEAST),
    "own_log_red": math_role("LOGARITHM", "Logarithm of red", (-1000, 1700), at_1=EULER),
    "own_log_green": math_role("LOGARITHM", "Logarithm of green", (-1000, 1550), at_1=EULER),
    "own_redness": math_role("SUBTRACT", "Green over red", (-850, 1550)),
    "own_tone": Role("ShaderNodeCombineXYZ", "Red, green over red", (-700, 1650)),
    "own_place": vector_role("MULTIPLY_ADD", "Place of the colour", (-550, 1650)),
    "own_image": Role(
        "ShaderNodeTexImage",
        "Melanin and blood of colours",
        (-400, 1700),
        {"interpolation": "Linear", "extension": "EXTEND"},
    ),
    "own_state": Role("ShaderNodeSeparateXYZ", "Own melanin and blood", (-100, 1700)),
    "own_more": math_role("POWER", "Own melanin", (50, 1750)),
    "own_redder": math_role("MULTIPLY", "Own blood", (50, 1600)),
    "own_melanin": math_role("MULTIPLY", "With own melanin", (430, 460)),
    "own_blood": math_role("ADD", "With own blood", (280, -240)),
    "own_untanned": math_role("MULTIPLY", "Own untanned melanin", (200, 1750), at_1=1.0),
    "own_root": math_role("SQRT", "Root of own melanin", (350, 1750)),
    "own_row": Role("ShaderNodeClamp", "Blood of which the look tells", (500, 1600)),
    "own_untanned_place": Role("ShaderNodeCombineXYZ", "Own untanned", (650, 1700)),
    "own_untanned_blood": math_role("ADD", "Own untanned blood", (200, 1600), at_1=0.0),
}

LINKS: tuple[Link, ...] = (
    *(("input", PAINTED_COLOUR, role, 0) for role in ("own_red", "own_green")),
    ("own_red", "Value", "own_some_red", 0),
    ("own_green", "Value", "own_some_green", 0),
    ("own_some_red", "Value", "own_log_red", 0),
    ("own_some_green", "Value", "own_log_green", 0),
    ("own_log_green", "Value", "own_redness", 0),
    ("own_log_red", "Value", "own_redness", 1),
    ("own_log_red", "Value", "own_tone", "X"),
    ("own_redness", "Value", "own_tone", "Y"),
    ("own_tone", "Vector", "own_place", 0),
    ("own_place", "Vector", "own_image", "Vector"),
    ("own_image", "Color", "own_state", "Vector"),
    ("own_state", "X", "own_more", 0),
    ("own_state", "Y", "own_redder", 0),
    *(("input", SHARE_OF_PAINTED, role, 1) for role in ("own_more", "own_redder")),
    ("more_melanin", "Value", "own_melanin", 0),
    ("own_more", "Value", "own_melanin", 1),
    ("own_melanin", "Value", "root", 0),
    ("more_blood", "Value", "own_blood", 0),
    ("own_redder", "Value", "own_blood", 1),
    ("own_blood", "Value", "blood", 1),
    ("own_more", "Value", "own_untanned", 0),
    ("regions", "Melanin", "own_untanned", 1),
    ("own_untanned", "Value", "own_root", 0),
    ("own_root", "Value", "own_untanned_place", "X"),
    ("own_redder", "Value", "own_untanned_blood", 0),
    ("regions", "Blood", "own_untanned_blood", 1),
    ("own_untanned_blood", "Value", "own_row", "Value"),
    ("own_row", "Result", "own_untanned_place", "Y"),
    ("own_untanned_place", "Vector", "untanned", "Vector"),
)

REPLACED: tuple[Link, ...] = (
    ("more_melanin", "Value", "root", 0),
    ("more_blood", "Value", "blood", 1),
    ("untanned_place", "Vector", "untanned", "Vector"),
    ("look_place", "Vector", "untanned", "Vector"),
)
"""Links of a group without these nodes whose place others take; of the last two it has one."""

INPUTS = {
    PAINTED_COLOUR: ("NodeSocketColor", "The colour that Ratio multiplies, which says how it tans"),
    SHARE_OF_PAINTED: (
        "NodeSocketFloat",
        "How far the painted colour says how the skin tans: 0 as all of it, 1 by its own colour",
    ),
}


@dataclass(frozen=True)
class Told:
    """How a painted colour leads to a place in the image of melanin and blood.

    Attributes
    ----------
    red, green : 3 floats
        What the scene's red, green and blue count for red and green over those of the usual colour.
    slope, start : pairs of float
        From logarithms of that red, and of that green over it, to the image's coordinates.
    """

    red: tuple[float, ...]
    green: tuple[float, ...]
    slope: tuple[float, float]
    start: tuple[float, float]


def is_shown(group: Any) -> bool:
    """Whether a tan's group takes account of painted colours."""
    return any(nodes.of_role(group, "own_state"))


def show(group: Any, told: Told | None, changes: Changes) -> None:
    """Have a tan's group take account of painted colours, or not; its image is set by `update`."""
    if told is None:
        _take_out(group, changes)
        return
    if not is_shown(group):
        _add(group, changes)
    elif any(nodes.of_role(group, "regions")):
        changes.may_relink(group)
        nodes.link(group, ("regions",), LINKS)
    for role, number, values in (
        ("own_red", 1, told.red),
        ("own_green", 1, told.green),
        ("own_place", 1, (*told.slope, 1.0)),
        ("own_place", 2, (*told.start, 0.0)),
    ):
        for node in nodes.of_role(group, role):
            changes.set(node.inputs[number], "default_value", values)


def _add(group: Any, changes: Changes) -> None:
    changes.may_change_sockets(group)
    changes.may_add_to(group.nodes)
    changes.may_relink(group)
    for name, (kind, says) in INPUTS.items():
        if all(getattr(item, "name", "") != name for item in group.interface.items_tree):
            socket = group.interface.new_socket(
                name, description=says, in_out="INPUT", socket_type=kind
            )
            if kind == "NodeSocketFloat":
                socket.min_value, socket.max_value, socket.subtype = 0.0, 1.0, "FACTOR"
    replaced.unlink(group, REPLACED)
    nodes.complete(group, ROLES, ROLES, LINKS)


def _take_out(group: Any, changes: Changes) -> None:
    """Have a group be as it was without these nodes; they go when all else is done."""
    if not is_shown(group):
        return
    changes.may_relink(group)
    replaced.link_again(group, REPLACED, ROLES)
    going = [node for role in ROLES for node in nodes.of_role(group, role)]
    changes.at_the_end(partial(_remove, group, going))
    image = changes.pop_key(group, IMAGE_KEYS["own_image"])
    if image is not None:
        changes.at_the_end(partial(images.remove_if_unused, image))


def _remove(group: Any, going: list[Any]) -> None:
    for node in going:
        group.nodes.remove(node)
    for item in list(group.interface.items_tree):
        if item.name in INPUTS and getattr(item, "in_out", "") == "INPUT":
            group.interface.remove(item)
