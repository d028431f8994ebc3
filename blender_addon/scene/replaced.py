"""What in a tan's group takes the place of something else, and goes again.

Links whose place those of other nodes take, and that come back without them; groups that a node
shows in place of others.
"""

from collections.abc import Container, Iterable
from functools import partial
from typing import Any

import bpy

from . import nodes
from .changes import Changes
from .plan import Link


def unlink(group: Any, replaced: Iterable[Link]) -> None:
    """Remove links, so that others can be made in their place."""
    for source, _, target, socket in replaced:
        for kept in nodes.of_role(group, target):
            for former in list(nodes.find_input(kept, socket).links):
                if nodes.role_of(former.from_node) == source:
                    group.links.remove(former)


def link_again(group: Any, replaced: Iterable[Link], roles: Container[str | None]) -> None:
    """Make links again where nodes of some roles have taken their place."""
    for source, output, target, socket in replaced:
        for kept in nodes.of_role(group, target):
            end = nodes.find_input(kept, socket)
            if any(nodes.role_of(former.from_node) in roles for former in end.links):
                for start in nodes.of_role(group, source):
                    group.links.new(nodes.find_output(start, output), end)


def show_tree(group: Any, node: Any, tree: Any, changes: Changes) -> None:
    """Have a node of a group show another tree; what its outputs lead to stays, by their names."""
    former = node.node_tree
    ends = [(end.name, link.to_socket) for end in node.outputs for link in end.links]
    changes.set(node, "node_tree", tree)
    for name, end in ends:
        group.links.new(node.outputs[name], end)
    changes.at_the_end(partial(_remove_unused, former))


def remove_nodes(group: Any, going: Iterable[Any]) -> None:
    """Remove nodes from a group, and the trees in them that nothing else shows."""
    for node in list(going):
        tree = getattr(node, "node_tree", None)
        group.nodes.remove(node)
        _remove_unused(tree)


def _remove_unused(tree: Any) -> None:
    if tree is not None and tree.users == 0:
        bpy.data.node_groups.remove(tree)
