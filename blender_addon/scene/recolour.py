"""The tan in an artist's material: a factor between a colour's source and the shader.

Two kinds of node come into a tree, and say so in a custom property: one that shows the tan's group,
and for every shader one that multiplies its colour by the group's Ratio. In a view a third comes
behind each of these, which shows the view's colour. Taking them out gives back what was there
before, with all that the artist has changed meanwhile.

Where the painted colour says how skin tans, every painted colour has a node of its own that shows
the group, since it is told that colour.
"""

from collections.abc import Iterable, Iterator
from functools import partial
from typing import Any

import bpy

from . import animated, links
from .changes import Changes
from .nodes import bridge, find_input, find_output
from .trees import all_nested, shaders, tree_of

INSERTED, TAN, FACTOR, INSTEAD = "skin_tan_inserted", "tan", "factor", "instead"
"""Custom property of a node in an artist's tree, and what it says the node is for."""

PLACE = "skin_tan_place"
"""Custom property of a factor: which of the tree's links led to the shader's colour, or -1."""

PAINTED_COLOUR, SHARE_OF_PAINTED = "Painted Colour", "Own Colour"
"""Inputs of the tan's group, where it takes account of painted colours."""

IS_TOLD, IS_MORE = "skin_tan_told", "skin_tan_more"
"""Custom properties of a node that shows the tan's group: whether it is told a painted colour, and
whether it was made for that alone."""


def insert(tree: Any, ends: Iterable[Any], group: bpy.types.NodeTree, changes: Changes) -> bool:
    """Multiply what arrives at colour inputs of a tree by a tan's Ratio.

    Nodes of ours that lost the group are given this one. Returns whether a colour is animated: its
    keys and drivers go to the node that multiplies it.
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
    fresh = [end for end in ends if not is_recoloured(end)]
    moved = [_put_factor(tree, end, ratio, changes) for end in fresh]
    note_links(tree, changes)
    return any(moved)


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


def _put_factor(tree: Any, end: Any, ratio: Any, changes: Changes) -> bool:
    """Multiply what arrives at an input, and return whether that is a value which is animated."""
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
    return source is None and animated.move(tree, end, factor.inputs[0], changes)


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
        _give_keys_back(tree, factor)
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
        tan = _tan_of(factor)
        if tan is None:
            continue
        x, y = factor.location
        node = _new(tree, "ShaderNodeMix", INSTEAD, (x + 20, y - 40))
        node.data_type, node.label, node.parent = "RGBA", "In place of the colour", factor.parent
        find_input(node, "Factor_Float").default_value = 1.0
        for end in [link.to_socket for link in factor.outputs[0].links]:
            tree.links.new(find_output(node, "Result_Color"), end)
        tree.links.new(factor.outputs[0], find_input(node, "A_Color"))
        tree.links.new(tan.outputs[output], find_input(node, "B_Color"))


def show_painted(tree: Any) -> None:
    """Have a tree's shaders show the painted colour again."""
    for node in inserted(tree, INSTEAD):
        bridge(tree, find_input(node, "A_Color"), find_output(node, "Result_Color"))
        tree.nodes.remove(node)


def tell_painted(tree: Any, changes: Changes) -> bool:
    """Tell the tan's group in a tree the colours that it multiplies.

    What an artist has linked to the inputs for that, or set there, stays. Returns whether such a
    colour is animated, which is told as it is at this frame; one that is linked is followed.
    """
    changes.may_add_to(tree.nodes)
    changes.may_relink(tree)
    tans: dict[Any, Any] = {}
    is_animated = False
    for factor in inserted(tree, FACTOR):
        tan = _tan_of(factor)
        if tan is None or PAINTED_COLOUR not in tan.inputs:
            continue
        given = factor.inputs[0]
        is_animated |= not given.is_linked and animated.is_moved(tree, given)
        colour = _painted(factor)
        if colour not in tans:
            is_taken = tan.name in {other.name for other in tans.values()}
            tans[colour] = _another(tree, tan, factor) if is_taken else tan
        if tans[colour] != tan:
            _show_by(tree, factor, tans[colour])
        _tell(tree, tans[colour], factor, changes)
    return is_animated


def stop_telling(tree: Any, changes: Changes) -> None:
    """Have one node show the tan's group in a tree again, as before `tell_painted`."""
    tans = inserted(tree, TAN)
    told = [tan for tan in tans if IS_TOLD in tan]
    if not told:
        return
    changes.may_relink(tree)
    first = next((tan for tan in tans if IS_MORE not in tan), tans[0])
    for factor in inserted(tree, FACTOR):
        if _tan_of(factor) not in (None, first):
            _show_by(tree, factor, first)
    for tan in told:
        for link in list(tan.inputs[PAINTED_COLOUR].links):
            tree.links.remove(link)
        for key in (IS_TOLD, IS_MORE):
            changes.pop_key(tan, key)
        if tan != first:
            changes.at_the_end(partial(tree.nodes.remove, tan))


def _tan_of(factor: Any) -> Any:
    """The node of the tan whose Ratio a factor multiplies by; None where that was cut."""
    sources = [link.from_node for link in factor.inputs[1].links]
    return sources[0] if sources and sources[0].get(INSERTED) == TAN else None


def _painted(factor: Any) -> Any:
    """What tells one painted colour from another."""
    given = factor.inputs[0]
    if given.is_linked:
        start = given.links[0].from_socket
        return start.node.name, start.identifier
    return tuple(given.default_value)


def _another(tree: Any, tan: Any, factor: Any) -> Any:
    """Another node that shows the tan's group with the same values, for a factor."""
    more = _new(tree, "ShaderNodeGroup", TAN, _beside([factor.inputs[0]], (-220, 140)))
    more.node_tree, more.width, more.label = tan.node_tree, tan.width, tan.label
    more[IS_MORE] = True
    for end, former in zip(more.inputs, tan.inputs, strict=True):
        if former.name != PAINTED_COLOUR:
            if hasattr(former, "default_value"):
                end.default_value = former.default_value
            for link in former.links:
                tree.links.new(link.from_socket, end)
    if IS_TOLD in tan:
        more[IS_TOLD] = True
    return more


def _show_by(tree: Any, factor: Any, tan: Any) -> None:
    """Have a factor, and what a view shows in its place, show the tan by another node."""
    tree.links.new(tan.outputs["Ratio"], factor.inputs[1])
    for link in factor.outputs[0].links:
        if link.to_node.get(INSERTED) == INSTEAD:
            end = find_input(link.to_node, "B_Color")
            for former in list(end.links):
                tree.links.new(tan.outputs[former.from_socket.name], end)


def _tell(tree: Any, tan: Any, factor: Any, changes: Changes) -> None:
    if IS_TOLD not in tan:
        changes.set_key(tan, IS_TOLD, True)
        changes.set(tan.inputs[SHARE_OF_PAINTED], "default_value", 1.0)
    given, end = factor.inputs[0], tan.inputs[PAINTED_COLOUR]
    if given.is_linked:
        if not end.is_linked:
            tree.links.new(given.links[0].from_socket, end).is_muted = given.links[0].is_muted
    else:
        changes.set(end, "default_value", (*given.default_value, 1.0))


def _has_instead(factor: Any) -> bool:
    return any(link.to_node.get(INSERTED) == INSTEAD for link in factor.outputs[0].links)


def part_keys(tree: Any) -> None:
    """Give a copy of a recoloured tree colours' keys of its own."""
    animated.part(tree, [factor.inputs[0] for factor in inserted(tree, FACTOR)])


def _give_keys_back(tree: Any, factor: Any) -> None:
    ends = [link.to_socket for link in factor.outputs[0].links]
    end = next((end for end in ends if end.type == "RGBA"), None)
    if end is not None and not factor.inputs[0].is_linked:
        animated.move_back(tree, factor.inputs[0], end)


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
