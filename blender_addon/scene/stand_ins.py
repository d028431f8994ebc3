"""Nodes that stand in for what another node gives, and out again.

What is replaced is still linked to one of their inputs. So they can be taken out again, and all is
as it was.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from . import nodes


@dataclass(frozen=True)
class StandIn:
    """What a node replaces: all that a node's output is linked to.

    Attributes
    ----------
    role, output
        Of the replaced node.
    input, gives
        Input that keeps the replaced output, and output that stands in for it.
    but : str
        Role of a node that goes on to show what is replaced.
    """

    role: str
    output: str
    input: str | int
    gives: str
    but: str = ""


def put_in(group: Any, role: str, plan: StandIn) -> None:
    """Put a node into the links from what it replaces, where it is not in them yet."""
    node = next(nodes.of_role(group, role), None)
    replaced = next(nodes.of_role(group, plan.role), None)
    if node is None or replaced is None:
        return
    start = nodes.find_output(replaced, plan.output)
    ends = [
        link.to_socket
        for link in start.links
        if link.to_node != node and (not plan.but or nodes.role_of(link.to_node) != plan.but)
    ]
    for end in ends:
        group.links.new(nodes.find_output(node, plan.gives), end)
    group.links.new(start, nodes.find_input(node, plan.input))


def take_out(group: Any, plans: Mapping[str, StandIn], roles: Iterable[str]) -> None:
    """Link what was replaced where it was linked before, and remove the nodes of some roles."""
    for role, plan in plans.items():
        for node in nodes.of_role(group, role):
            kept = nodes.find_input(node, plan.input)
            nodes.bridge(group, kept, nodes.find_output(node, plan.gives))
    for node in [node for role in roles for node in nodes.of_role(group, role)]:
        group.nodes.remove(node)
