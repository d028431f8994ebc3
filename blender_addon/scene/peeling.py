"""Peeling: nodes that a tan's group gets where burnt skin peels, and loses again.

An image tells how much has peeled, by day and share of the dose. One node, a group of its own,
makes patches of it, and takes from the state of the skin the melanin that has gone with them.
Its loose edges are white, and stand up where the shader is ours.
"""

from collections.abc import Sequence
from functools import partial
from typing import Any

import bpy

from . import nodes, peeling_nodes, several_nodes, stand_ins
from .changes import Changes
from .detail import millimetres
from .mask_nodes import ShownMask
from .plan import LINKS as TAN_LINKS
from .plan import Link, Role, math_role, vector_role
from .sampled import IMAGE_KEYS
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
    "peel_normal": vector_role("NORMALIZE", "Normal of the skin", (2050, -700)),
    "peel_relief": Role("ShaderNodeBump", "Relief of flakes", (2200, -700), {}, {"Strength": 1.0}),
}

OF_MASKS = {
    "peel_row": math_role("MULTIPLY_ADD", "Day to row", (-700, -600)),
    "peel_masks": Role("ShaderNodeGroup", "Peeling of several masks", (-450, -500)),
}

OF_MASKS_LINKS: tuple[Link, ...] = (
    ("day", "Fac", "peel_row", 0),
    ("peel_row", "Value", "peel_masks", "Day"),
    ("peel_masks", "Peeling", "peel", "Peeling"),
)

OF_ONE: Link = ("peel_image", "Color", "peel", "Peeling")

LINKS: tuple[Link, ...] = (
    ("share", "Value", "peel_place", "X"),
    ("day", "Fac", "peel_place", "Y"),
    ("peel_place", "Vector", "peel_image", "Vector"),
    OF_ONE,
    ("peel", "Flakes", "peel_colour", "Factor_Float"),
    ("peel", "Height", "peel_relief", "Height"),
)

STAND_INS = {
    "peel": StandIn("states", "Color", "State", "State"),
    "peel_colour": stand_ins.COLOUR["peel_colour"],
    **stand_ins.NORMAL,
}
OF_SEVERAL = StandIn("basis", "State", "State", "State")
"""What the first stands in for where a tan has several masks."""


def is_shown(group: Any) -> bool:
    """Whether a tan's group peels."""
    return any(nodes.of_role(group, "peel"))


def show(
    group: Any,
    obj: bpy.types.Object,
    image: bpy.types.Image | None,
    masks: Sequence[ShownMask],
    scene_unit: float,
    changes: Changes,
) -> None:
    """Have a tan's group peel, or not; where there is one mask `nodes.update` sets the image.

    Parameters
    ----------
    image : Image or None
        Without it nothing peels.
    masks : sequence of ShownMask
        Several, or none where there is one.
    scene_unit : float
        Length of a scene unit in metres, on a body of life-size.
    """
    _mend(group, changes)
    if image is None:
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
        stand_ins.put_in(group, {"peel": OF_SEVERAL if is_several else STAND_INS["peel"]})
        for plans in (stand_ins.COLOUR, stand_ins.NORMAL):
            stand_ins.put_in(group, plans)
    tree = None
    if masks:
        name = f"Skin Tan Peeling Masks {obj.name}"
        tree = several_nodes.peeling_of_masks(name, image, masks, changes)
    _show_masks(group, tree, changes)
    set_size(group, obj, scene_unit, changes)


def _mend(group: Any, changes: Changes) -> None:
    """Give nodes their tree and links again where the tree was deleted by hand."""
    dead = [node for node in nodes.of_role(group, "peel") if node.node_tree is None]
    if not dead:
        return
    changes.may_relink(group)
    for node in dead:
        changes.set(node, "node_tree", peeling_nodes.shared_group())
    inner = next((own for own in (OF_SEVERAL, STAND_INS["peel"]) if _is_in(group, own)), None)
    given: list[Link] = [
        ("peel", "State", end, taken) for source, _, end, taken in TAN_LINKS if source == "states"
    ]
    taken: list[Link] = [] if inner is None else [(inner.role, inner.output, "peel", inner.input)]
    nodes.link(group, ("peel",), [*OF_MASKS_LINKS, *LINKS, *given, *taken])


def _is_in(group: Any, plan: StandIn) -> bool:
    return any(nodes.of_role(group, plan.role))


def _show_masks(group: Any, tree: Any, changes: Changes) -> None:
    """Have a group read several masks by a tree, or one mask."""
    former = list(nodes.of_role(group, "peel_masks"))
    if tree is None and not former:
        return
    changes.may_add_to(group.nodes)
    changes.may_relink(group)
    for peel in nodes.of_role(group, "peel"):
        for link in list(peel.inputs["Peeling"].links):
            group.links.remove(link)
    if tree is not None:
        for node in former:
            nodes.take_role(node, changes)
        lacking = [role for role in OF_MASKS if not any(nodes.of_role(group, role))]
        nodes.complete(group, lacking, OF_MASKS, OF_MASKS_LINKS)
        for node in nodes.of_role(group, "peel_masks"):
            node.node_tree = tree
        nodes.link(group, OF_MASKS, OF_MASKS_LINKS)
    else:
        former += nodes.of_role(group, "peel_row")
        nodes.link(group, ("peel_image",), (OF_ONE,))
    changes.at_the_end(partial(_remove, group, former))


def _remove(group: Any, going: Sequence[Any]) -> None:
    for node in going:
        tree = getattr(node, "node_tree", None)
        group.nodes.remove(node)
        if tree is not None and tree.users == 0:
            bpy.data.node_groups.remove(tree)


def set_size(group: Any, obj: bpy.types.Object, scene_unit: float, changes: Changes) -> None:
    """Tell the patches of a group how large an object is."""
    for node in nodes.of_role(group, "peel"):
        if "Size" in node.inputs:
            changes.set(node.inputs["Size"], "default_value", millimetres(obj, scene_unit))
    for node in nodes.of_role(group, "peel_relief"):
        changes.set(node.inputs["Distance"], "default_value", 0.001 / scene_unit)


def _take_out(group: Any) -> None:
    _remove(group, [node for role in OF_MASKS for node in nodes.of_role(group, role)])
    stand_ins.take_out(group, STAND_INS, ROLES)
    image = group.pop(IMAGE_KEYS["peel_image"], None)
    if image is not None and image.users == 0:
        bpy.data.images.remove(image)
    peeling_nodes.remove_unused_group()
