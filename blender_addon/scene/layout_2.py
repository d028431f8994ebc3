"""Node groups by layouts 2 and 3: taken over.

Nodes of layout 2 led coordinates to places in images, which nodes of images do themselves since,
and others computed what the gloss lets through, which an image tells since. An image held the
colour of thick skin, not by how much it differs. In both the gloss was the same at all angles of
view, and a normal was computed.
"""

from functools import partial
from typing import Any

from . import regions
from .changes import Changes
from .nodes import complete, find_input, find_output, link, new_node, of_role, role_of, take_role
from .plan import LAYOUT, LAYOUT_KEY, LINKS, ROLE_KEY, ROLE_PREFIX, ROLES, TINT

PLACES_LAYOUT, EVEN_GLOSS_LAYOUT = 2, 3

PLACES = "column row look_column thick_place middle_place region_column own_column".split()
"""Roles of the nodes that led to places."""

GLOSS = ("quadratic", "cubic", "square")
"""Roles of the nodes of which `through` computed what the gloss lets through."""

NORMAL = ("given", "without", "own_normal")
"""Roles of the nodes by which `normal` was that of the mesh where none was given."""

SHADERS = ("skin", "near_skin")
TINT_LINKS = [own for own in LINKS if own[-1] == TINT]
EVEN_GLOSS_LINKS = [own for own in LINKS if own not in TINT_LINKS]


def take_over(group: Any, changes: Changes) -> None:
    """Bring a group of either layout up to today's.

    What an artist linked stays linked: a node of ours that leads to one of the artist's stays.
    """
    former = group.get(LAYOUT_KEY)
    if former not in (PLACES_LAYOUT, EVEN_GLOSS_LAYOUT):
        return
    changes.may_add_to(group.nodes)
    changes.may_relink(group)
    if former == PLACES_LAYOUT:
        _take_over_places(group, changes)
    _simplify_normal(group, changes)
    tint_gloss(group, changes)
    changes.set_key(group, LAYOUT_KEY, LAYOUT)


def _simplify_normal(group: Any, changes: Changes) -> None:
    """Have one node give the normal, where arithmetic did; a film goes on with the mesh's own."""
    roles = NORMAL if any(of_role(group, "film_relief")) else (*NORMAL, "geometry")
    for role in roles:
        for node in of_role(group, role):
            bypass(group, node, [], changes)
    for former in list(of_role(group, "normal")):
        take_role(former, changes)
        node = new_node(group, "normal")
        for own in former.inputs[0].links:
            group.links.new(own.from_socket, node.inputs["Normal"])
        for own in list(former.outputs[0].links):
            group.links.new(node.outputs["Normal"], own.to_socket)
        changes.at_the_end(partial(group.nodes.remove, former))


def tint_gloss(group: Any, changes: Changes) -> None:
    """Have the gloss change with the angle of view, unless an artist has tinted it.

    What tints it in a view was a colour, which would be in the way of that.
    """
    for node in list(of_role(group, "view_tint")):
        take_role(node, changes)
        for former in list(node.outputs[0].links):
            group.links.remove(former)
        changes.at_the_end(partial(group.nodes.remove, node))
    tints = [find_input(node, TINT) for role in SHADERS for node in of_role(group, role)]
    if all(min(tint.default_value) > 1.0 - 1e-6 for tint in tints):
        link(group, ["let_through"], TINT_LINKS)


def _take_over_places(group: Any, changes: Changes) -> None:
    for role in PLACES:
        for node in of_role(group, role):
            bypass(group, node, [former.from_socket for former in node.inputs[0].links], changes)
    _part_untanned(group, changes)
    _add_difference(group, changes)
    complete_thickness(group, changes)
    if any(of_role(group, "beneath")):
        new_node(group, "let_through")
        link(group, ["let_through"], EVEN_GLOSS_LINKS)
        (gives,) = (node.outputs["Color"] for node in of_role(group, "let_through"))
        goes = [bypass(group, node, [gives], changes) for node in of_role(group, "through")]
        for role in GLOSS if all(goes) else ():
            for node in of_role(group, role):
                bypass(group, node, [], changes)


def _part_untanned(group: Any, changes: Changes) -> None:
    """Keep the place of the untanned skin where regions or painted colours shift it."""
    has_regions, is_own = (any(of_role(group, role)) for role in ("regions", "own_state"))
    for node in list(of_role(group, "untanned_place")):
        if is_own:
            changes.pop_key(node, ROLE_KEY)
            changes.set(node, "name", f"{ROLE_PREFIX}own_untanned_place")
        elif not has_regions:
            looks = [place.outputs[0] for place in of_role(group, "look_place")]
            bypass(group, node, looks, changes)
    if has_regions and is_own:
        complete(group, ["untanned_place"], regions.ROLES, regions.LINKS)


def _add_difference(group: Any, changes: Changes) -> None:
    """Have what thick skin differs by be added, where its colour was mixed."""
    for former in list(of_role(group, "mixed_colour")):
        take_role(former, changes)
        node = new_node(group, "mixed_colour")
        for name, number in (("B_Color", 0), ("Factor_Float", 1), ("A_Color", 2)):
            for own in find_input(former, name).links:
                group.links.new(own.from_socket, node.inputs[number])
        for own in list(find_output(former, "Result_Color").links):
            group.links.new(node.outputs[0], own.to_socket)
        changes.at_the_end(partial(group.nodes.remove, former))


def complete_thickness(group: Any, changes: Changes) -> None:
    """Have the share of thick skin be cut, and give it the node by which it may bulge."""
    for thickness in list(of_role(group, "thickness")):
        if thickness.bl_idname == ROLES["thickness"].kind:
            changes.set(thickness, "use_clamp", True)
            if not thickness.inputs[1].is_linked and not any(of_role(group, "thickness_slope")):
                complete(group, ["thickness_slope"])


def bypass(group: Any, node: Any, sources: list[Any], changes: Changes) -> bool:
    """Have sockets feed those nodes of ours that a node feeds; it goes if it feeds no others."""
    links = [former for output in node.outputs for former in output.links]
    ours = [former.to_socket for former in links if role_of(former.to_node) is not None]
    for source in sources:
        for end in ours:
            group.links.new(source, end)
    if len(ours) < len(links):
        return False
    changes.at_the_end(partial(group.nodes.remove, node))
    return True
