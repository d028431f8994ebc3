"""Which links of an artist's tree a tan has taken the place of, also after its nodes were deleted.

A tree remembers them by the names of its nodes, in a custom property.
"""

import json
from collections.abc import Container, Iterable
from typing import Any

from .changes import Changes
from .link_order import NotedLink, make_again, noted
from .nodes import find_input, find_output

LINKS_KEY = "skin_tan_links"
"""Custom property of a tree: by the name of a node of ours, the link that was there, as JSON."""


def remember(tree: Any, factors: Iterable[tuple[Any, int, list[Any]]], changes: Changes) -> None:
    """Note what leads by way of nodes of ours to shaders.

    Parameters
    ----------
    factors : iterable of tuples
        Such a node, the number that its link had in the tree, and the inputs that it leads to.
    """
    stored = _stored(tree)
    for node, place, ends in factors:
        told = [[end.node.name, end.identifier] for end in ends]
        for name in [name for name, link in stored.items() if link["ends"] == told]:
            del stored[name]
        for link in node.inputs[0].links:
            start = [link.from_node.name, link.from_socket.identifier]
            stored[node.name] = {
                "start": start,
                "ends": told,
                "place": place,
                "muted": link.is_muted,
            }
    if stored != _stored(tree):
        changes.set_key(tree, LINKS_KEY, json.dumps(stored))


def restore(tree: Any, present: Container[str] = ()) -> None:
    """Link again what led to shaders by way of nodes that somebody has deleted.

    Parameters
    ----------
    present : container of str
        Names of nodes that are there still.
    """
    for name, link in reversed(_stored(tree).items()):
        for end in link["ends"]:
            nodes = tree.nodes.get(link["start"][0]), tree.nodes.get(end[0])
            if name in present or None in nodes:
                continue
            sockets = find_output(nodes[0], link["start"][1]), find_input(nodes[1], end[1])
            if None not in sockets and not sockets[1].is_linked:
                link_at(tree, link["place"], (*sockets, link["muted"]))


def forget(tree: Any) -> None:
    tree.pop(LINKS_KEY, None)


def link_at(tree: Any, place: int, link: tuple[Any, Any, bool]) -> None:
    """Link two sockets; of the tree's links it gets the number that it had before."""
    linked = noted(tree)
    linked.insert(place if place >= 0 else len(linked), NotedLink(*link))
    make_again(tree, linked)


def _stored(tree: Any) -> dict[str, dict[str, Any]]:
    try:
        return dict(json.loads(tree.get(LINKS_KEY, "{}")))
    except (TypeError, ValueError):
        return {}
