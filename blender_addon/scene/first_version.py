"""Node groups of the add-on's first version, which bear no roles: found and taken over.

Their nodes are told by kind, and by label or by what they are linked to, for artists rename and
replace nodes.
"""

from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import bpy

from .changes import Changes
from .images import MARK, stem
from .nodes import complete, find_input, of_role, role_of
from .plan import DAY_PROPERTY, LAYOUT_KEY, PROFILE_KEY, ROLE_KEY, ROLES

NEEDED = ("day", "row", "column", "place", "colour")
FORMER_ROLES = {
    "column": ("ShaderNodeMapRange", "Share to column"),
    "row": ("ShaderNodeMapRange", "Day to row"),
    "place": ("ShaderNodeCombineXYZ", "Place in table"),
}
"""Kinds and labels of nodes of roles that there are none of today."""

IMAGE_NAMES = {"colour": "Skin Tan Colour ", "width": "Skin Tan Width "}
"""How the names of its images begin."""

IMAGE_KEYS = {"colour": "skin_tan_colour", "width": "skin_tan_width"}
"""Where a group says that they are its own."""

LAYOUT = 1
"""The plan of groups with roles that came next."""


def is_tan_group(tree: bpy.types.NodeTree) -> bool:
    """Whether this add-on, or its first version, made a node group."""
    return LAYOUT_KEY in tree or (
        tree.bl_idname == "ShaderNodeTree" and set(NEEDED) <= set(_recognised(tree))
    )


def take_over(group: Any, changes: Changes) -> None:
    """Give a group of the first version roles, and have one say which images are its own.

    What an artist linked stays linked, and what he removed stays away.
    """
    if group.get(LAYOUT_KEY, LAYOUT) != LAYOUT:
        return
    if LAYOUT_KEY not in group:
        _give_roles(group, changes)
    for role, key in IMAGE_KEYS.items():
        for node in of_role(group, role):
            # Groups did not always say which images are theirs.
            if key not in group and _was_made(node.image, role):
                changes.set_key(group, key, node.image)
                changes.set_key(node.image, MARK, node.image.name)


def _give_roles(group: Any, changes: Changes) -> None:
    recognised = _recognised(group)
    for role in ("input", "output"):
        recognised[role] = _of_kind(group, role)
    for role, nodes in recognised.items():
        for node in nodes:
            changes.set_key(node, ROLE_KEY, role)
    changes.set_key(group, PROFILE_KEY, "width" in recognised)
    changes.set_key(group, LAYOUT_KEY, LAYOUT)
    changes.may_add_to(group.nodes)
    changes.may_relink(group)
    if "width" not in recognised and "radius" not in recognised:
        complete(group, ("width", "radius"))
    _put_share_in(group, recognised, changes)


def _put_share_in(group: Any, recognised: dict[str, list[Any]], changes: Changes) -> None:
    """Put the node that lets a mask come and go behind the mask, or in place of a number 1."""
    masks, columns = recognised.get("mask", []), recognised["column"]
    numbers = [] if masks else _labelled(group, "ShaderNodeValue", "Share")
    links = [link for node in masks for link in node.outputs["Fac"].links]
    links += [link for node in numbers for link in node.outputs[0].links if link.to_node in columns]
    if not links:
        return
    ends = [link.to_socket for link in links]
    for link in links:
        group.links.remove(link)
    complete(group, ("share",) if masks else ("mask", "share"))
    share = next(node for node in group.nodes if role_of(node) == "share")
    for end in ends:
        group.links.new(share.outputs["Value"], end)
    for node in numbers:
        if not node.outputs[0].is_linked:
            # Nothing can put a removed node back.
            changes.at_the_end(partial(group.nodes.remove, node))


def _recognised(group: Any) -> dict[str, list[Any]]:
    """Nodes of the first version by their roles; of a role, those with its label come first."""
    nodes_by_role: dict[str, list[Any]] = {}

    def look_for(role: str, is_linked_so: Callable[[Any], bool]) -> None:
        labelled = _labelled(group, _kind(role), _label(role))
        nodes = labelled or [node for node in _of_kind(group, role) if is_linked_so(node)]
        if nodes:
            nodes_by_role[role] = nodes

    def is_of(role: str) -> Callable[[Any], bool]:
        return lambda node: node in nodes_by_role.get(role, ())

    look_for("day", lambda node: node.attribute_name == DAY_PROPERTY)
    look_for("row", lambda node: _is_fed(node, "Value", is_of("day")))
    look_for("place", lambda node: _is_fed(node, "Y", is_of("row")))
    place = nodes_by_role.get("place", [])
    look_for("column", lambda node: any(_is_fed(end, "X", node.__eq__) for end in place))
    look_for("mask", lambda node: _feeds(node, nodes_by_role.get("column", ()), "Value"))
    for role in IMAGE_NAMES:
        look_for(
            role,
            lambda node, role=role: _is_fed(node, "Vector", is_of("place")) and _is(node, role),
        )
    look_for("skin", lambda node: _is_fed(node, "Base Color", is_of("colour")))
    look_for("radius", lambda node: _feeds(node, nodes_by_role.get("skin", ()), "Subsurface Scale"))
    return nodes_by_role


def _kind(role: str) -> str:
    return FORMER_ROLES[role][0] if role in FORMER_ROLES else ROLES[role].kind


def _label(role: str) -> str:
    return FORMER_ROLES[role][1] if role in FORMER_ROLES else ROLES[role].label


def _of_kind(group: Any, role: str) -> list[Any]:
    return [node for node in group.nodes if node.bl_idname == _kind(role)]


def _labelled(group: Any, kind: str, label: str) -> list[Any]:
    return [node for node in group.nodes if (node.bl_idname, node.label) == (kind, label)]


def _is(node: Any, role: str) -> bool:
    """Whether a texture shows colour, or else widths, which are no colours."""
    return node.image is not None and node.image.colorspace_settings.is_data == (role == "width")


def _is_fed(node: Any, socket: str, is_source: Callable[[Any], bool]) -> bool:
    """Whether what arrives at a socket comes from a node, straight or through others."""
    waiting, seen = [find_input(node, socket)], set()
    while waiting:
        for link in waiting.pop().links:
            source = link.from_node
            if is_source(source):
                return True
            if source.name not in seen:
                seen.add(source.name)
                waiting.extend(source.inputs)
    return False


def _feeds(node: Any, targets: Iterable[Any], socket: str) -> bool:
    return any(_is_fed(target, socket, node.__eq__) for target in targets)


def _was_made(image: bpy.types.Image | None, role: str) -> bool:
    """Whether an image is one that the add-on made and nobody renamed or copied."""
    return (
        image is not None
        and image.is_float
        and image.packed_file is not None
        and image.name.startswith(IMAGE_NAMES[role])
        and stem(image.name) == image.name
    )
