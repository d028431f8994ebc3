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


COLOUR = {
    "peel_colour": StandIn("mixed_colour", "Vector", "A_Color", "Result_Color"),
    "view_colour": StandIn("mixed_colour", "Vector", "A_Color", "Result_Color", "ratio"),
}
NORMAL = {
    "peel_normal": StandIn("normal", "Normal", 0, "Vector"),
    "peel_relief": StandIn("normal", "Normal", "Normal", "Normal"),
}
"""Nodes by role that stand in for one output, in the order in which they follow one another."""


def put_in(group: Any, plans: Mapping[str, StandIn]) -> None:
    """Put the nodes of some roles that there are into the links from the one output they replace.

    They follow one another as the plans do, whichever of them and of what they lead to came first.
    """
    present = [(next(nodes.of_role(group, role), None), plan) for role, plan in plans.items()]
    present = [(node, plan) for node, plan in present if node is not None]
    replaced = next((node for _, plan in present for node in nodes.of_role(group, plan.role)), None)
    if replaced is None:
        return
    starts = [nodes.find_output(replaced, present[0][1].output)]
    starts += [nodes.find_output(node, plan.gives) for node, plan in present]
    kept = [nodes.find_input(node, plan.input) for node, plan in present]
    ends = [
        link.to_socket for start in starts for link in start.links if link.to_socket not in kept
    ]
    for start, end in zip(starts, kept, strict=False):
        group.links.new(start, end)
    for end in ends:
        role = nodes.role_of(end.node)
        led = [
            start for start, (_, plan) in zip(starts[1:], present, strict=True) if plan.but != role
        ]
        group.links.new([starts[0], *led][-1], end)


def take_out(group: Any, plans: Mapping[str, StandIn], roles: Iterable[str]) -> None:
    """Link what was replaced where it was linked before, and remove the nodes of some roles."""
    for role, plan in plans.items():
        for node in nodes.of_role(group, role):
            if not node.inputs:
                continue  # of an earlier layout: a plain colour, which kept nothing
            kept = nodes.find_input(node, plan.input)
            nodes.bridge(group, kept, nodes.find_output(node, plan.gives))
    for node in [node for role in roles for node in nodes.of_role(group, role)]:
        group.nodes.remove(node)
