"""Links of a tan's group whose place those of other nodes take, and that come back without them."""

from collections.abc import Container, Iterable
from typing import Any

from . import nodes
from .plan import ROLE_KEY, Link


def unlink(group: Any, replaced: Iterable[Link]) -> None:
    """Remove links, so that others can be made in their place."""
    for source, _, target, socket in replaced:
        for kept in nodes.of_role(group, target):
            for former in list(nodes.find_input(kept, socket).links):
                if former.from_node.get(ROLE_KEY) == source:
                    group.links.remove(former)


def link_again(group: Any, replaced: Iterable[Link], roles: Container[str]) -> None:
    """Make links again where nodes of some roles have taken their place."""
    for source, output, target, socket in replaced:
        for kept in nodes.of_role(group, target):
            end = nodes.find_input(kept, socket)
            if any(former.from_node.get(ROLE_KEY) in roles for former in end.links):
                for start in nodes.of_role(group, source):
                    group.links.new(nodes.find_output(start, output), end)
