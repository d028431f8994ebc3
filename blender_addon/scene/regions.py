"""Regions of the skin: nodes that a tan's group gets when it has some, and loses with the last.

One node, a group of its own, tells how much melanin and blood the regions have over the skin around
them, and how much they tan. It shifts the state from which the skin's look follows, and likewise
the untanned state, so that Ratio is what a region's own tan does. What of a region's colour melanin
and blood do not tell multiplies all colours of the skin's look.
"""

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from functools import partial
from typing import Any

import bpy

from . import mask_nodes, nodes, region_nodes, replaced
from .changes import Changes
from .detail import millimetres
from .masks import Mask
from .ownership import is_local
from .plan import Link, Role, math_role, vector_role
from .region_nodes import Region

ROLES = {
    "regions": Role("ShaderNodeGroup", "Regions", (0, 500)),
    "region_tan": math_role("MULTIPLY", "Tan of regions", (100, 420)),
    "region_melanin": math_role("MULTIPLY", "Melanin of regions", (250, 420)),
    "region_blood": math_role("ADD", "Blood of regions", (400, -220)),
    "region_root": math_role("SQRT", "Root of untanned melanin", (200, 900)),
    "region_row": Role("ShaderNodeClamp", "Blood of which the look tells", (400, 700)),
    "untanned_place": Role("ShaderNodeCombineXYZ", "Untanned", (700, 800)),
    "region_burn": math_role("MINIMUM", "What does not tan does not redden", (0, -250), at_1=1.0),
    "region_redness": math_role("MULTIPLY", "Redness of regions", (200, -250)),
    "region_light": vector_role("MULTIPLY", "Light of regions", (1100, 600)),
    "region_thick_light": vector_role("MULTIPLY", "Light of regions, thick skin", (1100, 300)),
    "region_untanned_light": vector_role("MULTIPLY", "Light of regions, untanned", (1200, 850)),
}

LIGHTS = {
    "region_light": ("colour", ("mixed_colour", 2)),
    "region_thick_light": ("thick_colour", ("mixed_colour", 0)),
    "region_untanned_light": ("untanned", ("ratio", 1)),
}
"""Roles that multiply a colour of the skin's look, of which image, and what it leads to."""

UNTANNED: Link = ("untanned_place", "Vector", "untanned", "Vector")

LINKS: tuple[Link, ...] = (
    ("state", "X", "region_tan", 0),
    ("regions", "Tan", "region_tan", 1),
    ("region_tan", "Value", "melanin", 0),
    ("melanin", "Value", "region_melanin", 0),
    ("regions", "Melanin", "region_melanin", 1),
    ("region_melanin", "Value", "more_melanin", 0),
    ("blood", "Value", "region_blood", 0),
    ("regions", "Blood", "region_blood", 1),
    ("region_blood", "Value", "look_row", "Value"),
    ("regions", "Melanin", "region_root", 0),
    ("region_root", "Value", "untanned_place", "X"),
    ("regions", "Blood", "region_row", "Value"),
    ("region_row", "Result", "untanned_place", "Y"),
    UNTANNED,
    ("regions", "Tan", "region_burn", 0),
    ("state", "Z", "region_redness", 0),
    ("region_burn", "Value", "region_redness", 1),
    ("region_redness", "Value", "blood", 0),
    *((image, "Color", role, 0) for role, (image, _) in LIGHTS.items()),
    *(("regions", region_nodes.LIGHT, role, 1) for role in LIGHTS),
    *((role, "Vector", *end) for role, (_, end) in LIGHTS.items()),
)

LATER = (*LIGHTS, "region_burn", "region_redness")
"""Roles that groups made by earlier versions do not have."""

OF_LATER: tuple[Link, ...] = (
    ("state", "Z", "blood", 0),
    *((image, "Color", *end) for image, end in LIGHTS.values()),
)

REPLACED: tuple[Link, ...] = (
    ("state", "X", "melanin", 0),
    ("melanin", "Value", "more_melanin", 0),
    ("blood", "Value", "look_row", "Value"),
    ("look_place", "Vector", "untanned", "Vector"),
    *OF_LATER,
)
"""Links of a group without regions whose place others take."""


@dataclass(frozen=True)
class Placed:
    """A region as an artist has set it, before its mask is looked up.

    Attributes
    ----------
    region : Region
    mask : Mask
        Where it lies; without one it is everywhere.
    """

    region: Region
    mask: Mask


def where(obj: bpy.types.Object, mask: Mask, changes: Changes) -> mask_nodes.ShownMask | None:
    """What nodes read of a region's mask: as much as its number; None for everywhere.

    Raises
    ------
    InputError
        If the mask cannot be used.
    """
    return mask_nodes.where_it_lies(obj, mask, changes) if mask else None


def show(
    obj: bpy.types.Object,
    group: Any,
    placed: Iterable[Placed],
    scene_unit: float,
    changes: Changes,
) -> None:
    """Have a tan's group show regions, or none.

    The nodes of regions that have not changed stay as they are, with what an artist edited there.

    Parameters
    ----------
    scene_unit : float
        Length of a scene unit in metres, on a body of life-size.

    Raises
    ------
    InputError
        If a mask cannot be used.
    """
    shown = [(item.region, where(obj, item.mask, changes)) for item in placed]
    if not shown:
        take_out(group, changes)
        return
    node = next(nodes.of_role(group, "regions"), None)
    if node is None or not _is_up_to_date(node.node_tree, shown):
        tree = region_nodes.new_tree(f"Skin Tan Regions {obj.name}", shown, changes)
        node = _added(group, tree, changes) if node is None else _replaced(group, tree, changes)
    set_size(group, obj, scene_unit, changes)


def set_size(group: Any, obj: bpy.types.Object, scene_unit: float, changes: Changes) -> None:
    """Tell the spots of a group's regions how large an object is."""
    for node in nodes.of_role(group, "regions"):
        if node.node_tree is not None:
            for inner in nodes.of_role(node.node_tree, region_nodes.PLACE):
                changes.set(inner.inputs[1], "default_value", millimetres(obj, scene_unit))


def take_out(group: Any, changes: Changes) -> None:
    """Have a tan's group show no regions; it is as it was before the first one."""
    if not any(nodes.of_role(group, "regions")):
        return
    changes.may_relink(group)
    ours = {role: list(nodes.of_role(group, role)) for role in ROLES}
    replaced.link_again(group, REPLACED, ROLES)
    going = [node for made in ours.values() for node in made]
    changes.at_the_end(partial(replaced.remove_nodes, group, going))


def _is_up_to_date(tree: Any, shown: list) -> bool:
    """Whether a group for regions is that of these, and of one tan alone."""
    return (
        tree is not None
        and is_local(tree)
        and tree.users == 1
        and tree.get(region_nodes.SHOWN_KEY) == region_nodes.told(shown)
    )


def _added(group: Any, tree: Any, changes: Changes) -> Any:
    changes.may_add_to(group.nodes)
    changes.may_relink(group)
    for role in ROLES:
        nodes.new_node(group, role, ROLES)
    node = next(nodes.of_role(group, "regions"))
    node.node_tree = tree
    _link(group, ROLES, REPLACED)
    return node


def _link(group: Any, made: Collection[str], former: Iterable[Link]) -> None:
    """Link new nodes in place of what they replace."""
    replaced.unlink(group, former)
    nodes.link(group, made, LINKS)


def _replaced(group: Any, tree: Any, changes: Changes) -> Any:
    changes.may_relink(group)
    is_early = False
    for node in nodes.of_role(group, "regions"):
        is_early |= node.node_tree is not None and region_nodes.LIGHT not in node.outputs
        replaced.show_tree(group, node, tree, changes)
    nodes.link(group, ("regions",), LINKS)  # those of one whose tree was deleted are gone
    if is_early:
        _add_later(group, changes)
    return next(nodes.of_role(group, "regions"))


def _add_later(group: Any, changes: Changes) -> None:
    """Give the nodes of `LATER` to a group whose regions were made before there were any."""
    changes.may_add_to(group.nodes)
    for role in LATER:
        nodes.new_node(group, role, ROLES)
    _link(group, LATER, OF_LATER)
