"""The links of a node tree in their order, which Blender keeps: noted, and made again."""

from collections.abc import Sequence
from itertools import takewhile
from typing import Any, NamedTuple


class NotedLink(NamedTuple):
    """A link of a node tree.

    Attributes
    ----------
    start, end : NodeSocket
    is_muted : bool
    place : int
        Among the links into an input that takes several.
    """

    start: Any
    end: Any
    is_muted: bool
    place: int = 0


def noted(tree: Any) -> list[NotedLink]:
    """The links of a tree, in their order."""
    return [
        NotedLink(link.from_socket, link.to_socket, link.is_muted, link.multi_input_sort_id)
        for link in tree.links
    ]


def make_again(tree: Any, links: Sequence[NotedLink]) -> None:
    """Give a tree these links in this order and no others; those before the first change stay.

    Blender numbers the links into an input that takes several rightly only where all are new.
    """
    now = noted(tree)
    if now == list(links):
        return
    alike = takewhile(
        lambda both: both[0] == both[1] and not both[1].end.is_multi_input,
        zip(now, links, strict=False),
    )
    kept = len(list(alike))
    for link in list(tree.links)[kept:]:
        tree.links.remove(link)
    made = [(tree.links.new(wanted.start, wanted.end), wanted) for wanted in links[kept:]]
    for link, wanted in made:
        link.is_muted = wanted.is_muted
    several = [both for both in made if both[1].end.is_multi_input]
    for end in {wanted.end for _, wanted in several}:
        _sort([both for both in several if both[1].end == end])


def _sort(made: list[tuple[Any, NotedLink]]) -> None:
    """Give new links into one input their places."""
    links = [link for link, _ in sorted(made, key=lambda both: both[1].place)]
    for place, link in enumerate(links):
        if link.multi_input_sort_id != place:
            link.swap_multi_input_sort_id(
                next(other for other in links if other.multi_input_sort_id == place)
            )
