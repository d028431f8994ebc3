"""Peeling: nodes that a tan's group gets where burnt skin peels, and loses again.

An image tells how much has peeled, by day and share of the dose. One node, a group of its own,
makes patches of it, and takes from the state of the skin the melanin that has gone with them.
Its loose edges are white, and stand up where the shader is ours.
"""

from functools import partial
from typing import Any

import bpy

from . import nodes, peeling_nodes, stand_ins
from .changes import Changes
from .detail import millimetres
from .plan import Link, Role
from .stand_ins import StandIn

FLAKE = (0.62, 0.55, 0.49, 1.0)
"""Linear Rec.709 of dry skin over air, by eye."""

ROLES = {
    "peel_place": Role("ShaderNodeCombineXYZ", "Place in peeling", (-900, -350)),
    "peel_image": Role(
        "ShaderNodeTexImage",
        "Peeling",
        (-700, -350),
        {"interpolation": "Linear", "extension": "EXTEND"},
    ),
    "peel": Role("ShaderNodeGroup", "Peeling skin", (-150, 150)),
    "peel_colour": Role(
        "ShaderNodeMix", "Flakes", (1350, 500), {"data_type": "RGBA"}, {"B_Color": FLAKE}
    ),
    "peel_relief": Role("ShaderNodeBump", "Relief of flakes", (2200, -700), {}, {"Strength": 1.0}),
}

LINKS: tuple[Link, ...] = (
    ("column", "Value", "peel_place", "X"),
    ("row", "Value", "peel_place", "Y"),
    ("peel_place", "Vector", "peel_image", "Vector"),
    ("peel_image", "Color", "peel", "Peeling"),
    ("peel", "Flakes", "peel_colour", "Factor_Float"),
    ("peel", "Height", "peel_relief", "Height"),
)

STAND_INS = {
    "peel": StandIn("states", "Color", "State", "State"),
    "peel_colour": StandIn("mixed_colour", "Result_Color", "A_Color", "Result_Color"),
    "peel_relief": StandIn("normal", "Vector", "Normal", "Normal"),
}
OF_SEVERAL = StandIn("basis", "State", "State", "State")
"""What the first stands in for where a tan has several masks."""


def is_shown(group: Any) -> bool:
    """Whether a tan's group peels."""
    return any(nodes.of_role(group, "peel"))


def show(
    group: Any, obj: bpy.types.Object, scene_unit: float, changes: Changes, *, is_on: bool
) -> None:
    """Have a tan's group peel, or not; its image is set by `nodes.update`.

    Parameters
    ----------
    scene_unit : float
        Length of a scene unit in metres, on a body of life-size.
    """
    if not is_on:
        if is_shown(group):
            changes.may_relink(group)
            changes.at_the_end(partial(_take_out, group))
        return
    if not is_shown(group):
        changes.may_add_to(group.nodes)
        changes.may_relink(group)
        nodes.complete(group, ROLES, ROLES, ())
        for node in nodes.of_role(group, "peel"):
            node.node_tree = peeling_nodes.shared_group()
        nodes.link(group, ROLES, LINKS)
        is_several = any(nodes.of_role(group, "basis"))
        for role, plan in STAND_INS.items():
            stand_ins.put_in(group, role, OF_SEVERAL if role == "peel" and is_several else plan)
    set_size(group, obj, scene_unit, changes)


def set_size(group: Any, obj: bpy.types.Object, scene_unit: float, changes: Changes) -> None:
    """Tell the patches of a group how large an object is."""
    for node in nodes.of_role(group, "peel"):
        if "Size" in node.inputs:
            changes.set(node.inputs["Size"], "default_value", millimetres(obj, scene_unit))
    for node in nodes.of_role(group, "peel_relief"):
        changes.set(node.inputs["Distance"], "default_value", 0.001 / scene_unit)


def _take_out(group: Any) -> None:
    stand_ins.take_out(group, STAND_INS, ROLES)
    image = group.pop(nodes.IMAGE_KEYS["peel_image"], None)
    if image is not None and image.users == 0:
        bpy.data.images.remove(image)
    peeling_nodes.remove_unused_group()
