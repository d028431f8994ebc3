"""Node groups by layout 1, which showed images over share and day: taken over.

Their two images gave colour and profile width at once. Since layout 2 a first image gives the
state, and others what it looks like. The nodes that showed the two images show the look of thin
skin now, and what was linked to them is linked to what stands for them.
"""

from collections.abc import Collection
from typing import Any

from . import layout_2
from .changes import Changes
from .nodes import (
    INPUTS,
    add_sockets,
    find_input,
    find_output,
    link,
    new_node,
    of_role,
    role_of,
)
from .plan import INDEX, LAYOUT, LAYOUT_KEY, ROLES, SHADERS

FORMER_ROLES = frozenset(
    "mask share day column row place colour width radius input skin output".split()
)
FORMER_LAYOUT, FORMER_INDEX = 1, 1.4
FORMER_OUTPUT, OUTPUT = "Profile Width", "Far Width"

MOVED = {
    "colour": ("Color", "mixed_colour", "Vector"),
    "skin": ("BSDF", "light", "Shader"),
}
"""Outputs of former nodes, and what gives the same today."""


def take_over(group: Any, trees: Collection[Any], changes: Changes) -> None:
    """Bring a group of this plan, or of the next (`layout_2`), up to today's.

    What an artist linked stays linked, and what he removed stays away. Nodes that show the group
    are in the trees.
    """
    layout_2.take_over(group, changes)
    if group.get(LAYOUT_KEY) != FORMER_LAYOUT:
        return
    changes.may_change_sockets(group)
    changes.may_add_to(group.nodes)
    changes.may_relink(group)
    for item in group.interface.items_tree:
        if item.name == FORMER_OUTPUT and getattr(item, "in_out", "") == "OUTPUT":
            item.name = OUTPUT
    added = add_sockets(group)
    for tree in trees:
        for node in tree.nodes:
            if getattr(node, "node_tree", None) == group:
                # Blender gives new inputs of a node 0, whatever their default is.
                for name in added:
                    node.inputs[name].default_value = INPUTS[name][0]
    has_skin = any(of_role(group, "skin"))
    made = [role for role in ROLES if role not in FORMER_ROLES]
    if not has_skin:
        made = [role for role in made if role not in SHADERS]
    if not any(of_role(group, "colour")):
        made = [role for role in made if not role.endswith("_colour")]
    for role in made:
        new_node(group, role)
    _move_links(group)
    if has_skin:
        _share_with_near_skin(group, changes)
    for role, image in (("column", "columns"), ("row", "rows"), ("place", "")):
        for node in list(of_role(group, role)):
            sources = [former.from_socket for former in node.inputs[0].links]
            for end in (node.inputs["Vector"] for node in of_role(group, image)):
                for source in sources:
                    group.links.new(source, end)
            layout_2.bypass(group, node, [], changes)
    link(group, made, layout_2.EVEN_GLOSS_LINKS)
    layout_2.tint_gloss(group, changes)
    for share in of_role(group, "share"):
        changes.set(share, "operation", ROLES["share"].values["operation"])
        changes.set(share, "label", ROLES["share"].label)
        for output in of_role(group, "output"):
            group.links.new(share.outputs[0], output.inputs["Share"])
    changes.set_key(group, LAYOUT_KEY, LAYOUT)


def _move_links(group: Any) -> None:
    """Have what former nodes fed be fed by what stands for them, and free the former inputs."""
    for role, (output, successor, gives) in MOVED.items():
        ends = [
            former.to_socket
            for node in of_role(group, role)
            for former in find_output(node, output).links
            if role_of(former.to_node) != successor
        ]
        for end in ends:
            if role == "colour" and _is_base(end):
                group.links.remove(end.links[0])
                continue
            for start in _outputs(group, successor, gives):
                group.links.new(start, end)
    for skin in of_role(group, "skin"):
        for former in list(find_input(skin, "Base Color").links):
            # An artist's own colour goes through all that ours does.
            for base in of_role(group, "base"):
                group.links.new(former.from_socket, base.inputs[0])
            group.links.remove(former)
    for role in ("colour", "width"):
        for node in of_role(group, role):
            for former in list(find_input(node, "Vector").links):
                group.links.remove(former)
    for share in of_role(group, "share"):
        for former in list(find_input(share, 0).links):
            if role_of(former.from_node) == "mask":  # an artist's own node in between stays
                group.links.remove(former)


def _outputs(group: Any, role: str, output: str) -> list[Any]:
    return [find_output(node, output) for node in of_role(group, role)]


def _is_base(end: Any) -> bool:
    return role_of(end.node) == "skin" and end.identifier == "Base Color"


def _share_with_near_skin(group: Any, changes: Changes) -> None:
    """Give the second shader what the artist has given to the first, and both today's index.

    A diffuse shader can't have that, so both show their light then, whatever the gloss.
    """
    skin = next(of_role(group, "skin"))
    near = next(of_role(group, "near_skin"))
    index = find_input(skin, "IOR")
    if abs(index.default_value - FORMER_INDEX) < 1e-6:
        changes.set(index, "default_value", INDEX)
    for end in skin.inputs:
        other = find_input(near, end.identifier)
        if other is None or end.identifier.startswith(("Base Color", "Subsurface")):
            continue
        if end.is_linked:
            start = end.links[0].from_socket
            if role_of(start.node) != "input":  # the plan links those
                group.links.new(start, other)
                _show_both(group)
        elif hasattr(end, "default_value"):
            if _numbers(end) != _numbers(other):
                _show_both(group)
            other.default_value = end.default_value


def _show_both(group: Any) -> None:
    for node in of_role(group, "two_lobes"):
        node.inputs[1].default_value = -1.0


def _numbers(end: Any) -> tuple:
    value = end.default_value
    return tuple(value) if hasattr(value, "__len__") else (value,)
