"""The tan in an artist's material: a factor between a colour's source and the shader.

Two kinds of node come into a tree, and say so in a custom property: one that shows the tan's group,
and for every shader one that multiplies its colour by the group's Ratio. In a view a third comes
behind each of these, which shows the view's colour. Taking them out gives back what was there
before, with all that the artist has changed meanwhile.
"""

from collections.abc import Iterable, Iterator
from typing import Any

import bpy

from . import links
from .changes import Changes
from .nodes import bridge, find_input, find_output
from .trees import all_nested, shaders, tree_of

INSERTED, TAN, FACTOR, INSTEAD = "skin_tan_inserted", "tan", "factor", "instead"
"""Custom property of a node in an artist's tree, and what it says the node is for."""

PLACE = "skin_tan_place"
"""Custom property of a factor: which of the tree's links led to the shader's colour, or -1."""


def insert(tree: Any, ends: Iterable[Any], group: bpy.types.NodeTree, changes: Changes) -> None:
    """Multiply what arrives at colour inputs of a tree by a tan's Ratio.

    Nodes of ours that lost the group are given this one.
    """
    changes.may_add_to(tree.nodes)
    changes.may_relink(tree)
    links.restore(tree, {factor.name for factor in inserted(tree, FACTOR)})
    tans, ends = inserted(tree, TAN), list(ends)
    for tan in tans:
        if tan.node_tree is None:
            changes.set(tan, "node_tree", group)
    if not tans:
        tans = [_new(tree, "ShaderNodeGroup", TAN, _beside(ends, (-420, 260)))]
        tans[0].node_tree, tans[0].width, tans[0].label = group, 180, "Skin Tan"
    ratio = tans[0].outputs["Ratio"]
    for factor in inserted(tree, FACTOR):
        if not factor.inputs[1].is_linked:
            tree.links.new(ratio, factor.inputs[1])
    for end in ends:
        if not is_recoloured(end):
            _put_factor(tree, end, ratio)
    note_links(tree, changes)


def note_links(tree: Any, changes: Changes) -> None:
    """Note what leads by way of factors to shaders, for the case that somebody deletes a factor."""
    factors = [
        (factor, int(factor.get(PLACE, -1)), list(_shaders_of(factor)))
        for factor in inserted(tree, FACTOR)
    ]
    links.remember(tree, factors, changes)


def _shaders_of(factor: Any) -> Iterator[Any]:
    """Inputs to which a factor leads, past what a view has put behind it."""
    for link in factor.outputs[0].links:
        if link.to_node.get(INSERTED) == INSTEAD:
            result = find_output(link.to_node, "Result_Color")
            yield from (beyond.to_socket for beyond in result.links)
        else:
            yield link.to_socket


def _put_factor(tree: Any, end: Any, ratio: Any) -> None:
    factor = _new(tree, "ShaderNodeVectorMath", FACTOR, _beside([end], (-200, 120)))
    factor.operation, factor.label = "MULTIPLY", "Tan"
    source = end.links[0] if end.is_linked else None
    factor[PLACE] = list(tree.links).index(source) if source else -1
    factor.inputs[0].default_value = tuple(end.default_value)[:3]
    # Without the group the colour stays as it was painted.
    factor.inputs[1].default_value = (1.0, 1.0, 1.0)
    if source:
        muted, start = source.is_muted, source.from_socket
        tree.links.remove(source)
        tree.links.new(start, factor.inputs[0]).is_muted = muted
    tree.links.new(ratio, factor.inputs[1])
    tree.links.new(factor.outputs[0], end)


def _beside(ends: list[Any], shift: tuple[int, int]) -> tuple[float, float]:
    """A place beside the node of the first of some inputs."""
    x, y = _location(ends[0].node)
    return x + shift[0], y + shift[1]


def _new(tree: Any, kind: str, what: str, location: tuple[float, float]) -> Any:
    node = tree.nodes.new(kind)
    node[INSERTED], node.select = what, False
    node.location = location
    return node


def _location(node: Any) -> tuple[float, float]:
    """Of a node in its tree, whatever frame it is in."""
    x, y = node.location
    while (node := node.parent) is not None:
        x, y = x + node.location[0], y + node.location[1]
    return x, y


def inserted(tree: Any, what: str | None = None) -> list[Any]:
    """Nodes that `insert` put into a tree, in that order."""
    if tree is None:
        return []
    return [node for node in tree.nodes if INSERTED in node and what in (None, node[INSERTED])]


def is_in(block: bpy.types.ID) -> bool:
    """Whether a material or a node group was recoloured, maybe in a group inside.

    It was so too where somebody has deleted the nodes since.
    """
    tree = tree_of(block)
    trees = [inner for inner in (tree, *all_nested(tree)) if inner is not None]
    return any(inserted(inner) or links.LINKS_KEY in inner for inner in trees)


def remarks(material: bpy.types.Material) -> Iterator[str]:
    """Sentences on where a recoloured material does not show the tan, since its tree was edited."""
    if not is_in(material):
        return
    unseen = sum(not is_recoloured(end) for _, _, end in shaders(material))
    if unseen:
        yield (
            f"In {material.name!r} the tan does not reach {unseen} of the shaders, new ones or "
            "such whose nodes of the tan were removed; Remove Tan, then Apply Tan puts them in."
        )


def is_recoloured(end: Any) -> bool:
    """Whether a factor with a tan lies in what leads to an input within its tree."""
    waiting, seen = [end], set()
    while waiting:
        for link in waiting.pop().links:
            node = link.from_node
            if node.get(INSERTED) == FACTOR and _is_fed_by_tan(node):
                return True
            if node.name not in seen:
                seen.add(node.name)
                waiting += node.inputs
    return False


def _is_fed_by_tan(factor: Any) -> bool:
    return any(link.from_node.get(INSERTED) == TAN for end in factor.inputs for link in end.links)


def take_out(tree: Any) -> None:
    """Take what `insert` put into a tree out again; the colours' sources lead to the shaders."""
    show_painted(tree)
    for factor in reversed(inserted(tree, FACTOR)):
        _take_out_factor(tree, factor)
    for tan in inserted(tree, TAN):
        tree.nodes.remove(tan)
    links.restore(tree)
    links.forget(tree)


def show_instead(tree: Any, output: str, changes: Changes) -> None:
    """Have a tree's shaders show an output of the tan's group in place of the painted colour."""
    plain = [factor for factor in inserted(tree, FACTOR) if not _has_instead(factor)]
    if not plain:
        return
    changes.may_add_to(tree.nodes)
    changes.may_relink(tree)
    for factor in plain:
        tans = [link.from_node for link in factor.inputs[1].links]
        if not tans or tans[0].get(INSERTED) != TAN:
            continue
        x, y = factor.location
        node = _new(tree, "ShaderNodeMix", INSTEAD, (x + 20, y - 40))
        node.data_type, node.label, node.parent = "RGBA", "In place of the colour", factor.parent
        find_input(node, "Factor_Float").default_value = 1.0
        for end in [link.to_socket for link in factor.outputs[0].links]:
            tree.links.new(find_output(node, "Result_Color"), end)
        tree.links.new(factor.outputs[0], find_input(node, "A_Color"))
        tree.links.new(tans[0].outputs[output], find_input(node, "B_Color"))


def show_painted(tree: Any) -> None:
    """Have a tree's shaders show the painted colour again."""
    for node in inserted(tree, INSTEAD):
        bridge(tree, find_input(node, "A_Color"), find_output(node, "Result_Color"))
        tree.nodes.remove(node)


def _has_instead(factor: Any) -> bool:
    return any(link.to_node.get(INSERTED) == INSTEAD for link in factor.outputs[0].links)


def _take_out_factor(tree: Any, factor: Any) -> None:
    """Give what a factor multiplies to what it leads to."""
    given, place = factor.inputs[0], int(factor.get(PLACE, -1))
    colour = tuple(given.default_value)
    source = (given.links[0].from_socket, given.links[0].is_muted) if given.is_linked else None
    ends = [link.to_socket for link in factor.outputs[0].links]
    tree.nodes.remove(factor)
    for end in ends:
        if source is None:
            _set_colour(end, colour)
        else:
            links.link_at(tree, place, (source[0], end, source[1]))


def _set_colour(end: Any, colour: tuple[float, ...]) -> None:
    if end.type == "RGBA":
        end.default_value = (*colour, end.default_value[3])
    elif end.type == "VECTOR":
        end.default_value = colour
    elif end.type == "VALUE":
        end.default_value = sum(colour) / 3.0
