"""A film of water, oil or sunscreen on the skin: nodes that a tan's group gets when it has one.

The film's face is the coat of both shaders. It follows the skin's relief as far as the liquid does
not fill it. Beneath it the skin has another base colour, and hardly any gloss of its own.
"""

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import bpy

from . import mask_nodes, nodes, stand_ins
from .changes import Changes
from .mask_nodes import ShownMask
from .masks import Mask
from .plan import INDEX, Link, Role, math_role, vector_role

FILM = "Film"
INPUTS = {FILM: (1.0, 1.0, "How much of the skin the object's film covers; link a mask of it here")}

ROLES = {
    "film": math_role("MULTIPLY", "Film", (1000, 1250), at_1=0.0),
    "film_colour": vector_role("MULTIPLY_ADD", "Change by a film", (1250, 1250)),
    "film_level": vector_role("MULTIPLY_ADD", "With a film", (1400, 1250)),
    "film_index": math_role("MULTIPLY_ADD", "Index beneath a film", (1250, 1050)),
    "index": math_role("MULTIPLY_ADD", "Index", (1400, 1050), at_2=INDEX),
    "film_part": math_role("LESS_THAN", "Not all covered", (950, 900), at_1=0.999),
    "film_lobes": math_role("MULTIPLY", "Oil without a film over it", (1100, 900)),
    "film_more": math_role("MULTIPLY_ADD", "More than without a film", (1400, 950), at_2=1.0),
    "film_through": math_role("MULTIPLY", "What a film lets through", (1620, 950)),
    "geometry": Role("ShaderNodeNewGeometry", "Normal of the mesh", (1900, -500)),
    "film_given": vector_role("NORMALIZE", "Normal of the skin", (2050, -700)),
    "film_relief": Role("ShaderNodeMix", "Relief of a film", (2200, -600), {"data_type": "VECTOR"}),
    "film_normal": vector_role("NORMALIZE", "Normal of a film", (2350, -600)),
}

SHADERS = ("skin", "near_skin")

LINKS: tuple[Link, ...] = (
    ("input", FILM, "film", 0),
    ("mixed_colour", "Vector", "film_colour", 0),
    ("film_colour", "Vector", "film_level", 0),
    ("film", "Value", "film_level", 1),
    ("film_level", "Vector", "gain", 2),
    ("facing", "Facing", "film_index", 0),
    ("film_index", "Value", "index", 0),
    ("film", "Value", "index", 1),
    ("film", "Value", "film_part", 0),
    ("input", "Oil", "film_lobes", 0),
    ("film_part", "Value", "film_lobes", 1),
    ("film_lobes", "Value", "two_lobes", 0),
    ("film", "Value", "film_more", 0),
    ("let_through", "Color", "film_through", 0),
    ("film_more", "Value", "film_through", 1),
    ("film_through", "Value", "beneath", 0),
    ("geometry", "Normal", "film_relief", "A_Vector"),
    ("normal", "Normal", "film_given", 0),
    ("film_given", "Vector", "film_relief", "B_Vector"),
    ("film_relief", "Result_Vector", "film_normal", 0),
    *(("index", "Value", role, "IOR") for role in SHADERS),
    *(("film", "Value", role, "Coat Weight") for role in SHADERS),
    *(("film_normal", "Vector", role, "Coat Normal") for role in SHADERS),
)

FILM_KEY = "skin_tan_film"
"""Custom property of a group: the name of the liquid that it shows."""

REPLACED = {"two_lobes": "input", "beneath": "let_through"}
"""Roles whose first input a film takes over, and what is linked there without one."""

UNTOUCHED = {"IOR": INDEX, "Coat Weight": 0.0}
"""Inputs of a shader that a film is linked to where the artist has left them so."""


PREFIX = "film_"
"""Of the roles of nodes that read where the film lies: those that read where the sun reaches."""

FIRST = PREFIX + "mask_value"


@dataclass(frozen=True)
class Film:
    """A film for the group's nodes.

    Attributes
    ----------
    liquid : str
        Its name.
    index, roughness : float
        Of its face.
    relief : float
        Of its face, as a share of the skin's.
    more_through : float
        Share by which film and skin let more light through than dry skin's gloss.
    start, slope : tuples of 3 float
        The base colour beneath it, over that without one, is 1 + start + slope x colour.
    """

    liquid: str
    index: float
    roughness: float
    relief: float
    more_through: float
    start: tuple[float, float, float]
    slope: tuple[float, float, float]


def where(obj: bpy.types.Object, mask: Mask, changes: Changes) -> ShownMask:
    """What nodes read of a mask of a film: as much as its number, and its strength at most.

    Raises
    ------
    InputError
        If the mask cannot be used.
    """
    return mask_nodes.where_it_lies(obj, mask, changes)


NOWHERE = ShownMask(slope=0.0)


def show(
    group: Any,
    trees: Collection[Any],
    film: Film | None,
    mask: ShownMask,
    level: float,
    changes: Changes,
) -> None:
    """Have a tan's group show a film, or none; with a first film it gets the nodes for one.

    A shader of the artist's own, or a coat, stays as it is.

    Parameters
    ----------
    trees
        That may hold nodes which show the group.
    mask : ShownMask
        Where the film lies, from `where`; without a source it is everywhere.
    level : float
        Base colour of a shader over the colour, seen straight on.
    """
    lacks_nodes = not any(nodes.of_role(group, "film"))
    if film is not None and lacks_nodes and not nodes.has_own_shader(group):
        _add(group, trees, changes)
    _show_mask(group, mask if film else NOWHERE, changes)
    if film is not None or FILM_KEY in group:
        changes.set_key(group, FILM_KEY, film.liquid if film else "")
    for role, values in _values(film, level).items():
        for node in nodes.of_role(group, role):
            for socket, value in values.items():
                changes.set(nodes.find_input(node, socket), "default_value", value)
    for node in _coated(group) if film is not None else ():
        for name, value in (("Coat IOR", film.index), ("Coat Roughness", film.roughness)):
            changes.set(nodes.find_input(node, name), "default_value", value)


def _show_mask(group: Any, mask: ShownMask, changes: Changes) -> None:
    """Have nodes read where the film lies; a group gets them with its first such mask."""
    masked = bool(mask.attribute or mask.image)
    if masked and any(nodes.of_role(group, "film")) and not any(nodes.of_role(group, FIRST)):
        changes.may_add_to(group.nodes)
        changes.may_relink(group)
        mask_nodes.added(group, mask, changes, PREFIX)
        nodes.link(group, (PREFIX + "share",), [(PREFIX + "share", "Value", "film", 1)])
        return
    mask_nodes.show(group, mask, changes, PREFIX)


def is_shown(group: Any) -> bool:
    """Whether a shader of the group has a film as its coat."""
    return bool(_coated(group))


def _add(group: Any, trees: Collection[Any], changes: Changes) -> None:
    changes.may_change_sockets(group)
    changes.may_add_to(group.nodes)
    changes.may_relink(group)
    if all(getattr(item, "name", "") != FILM for item in group.interface.items_tree):
        for socket in nodes.add_inputs(group, INPUTS):
            socket.subtype = "FACTOR"
        for tree in trees:
            for node in tree.nodes:
                if getattr(node, "node_tree", None) == group:
                    # Blender gives new inputs of a node 0, whatever their default is.
                    node.inputs[FILM].default_value = INPUTS[FILM][0]
    for role, source in REPLACED.items():
        for node in nodes.of_role(group, role):
            for former in node.inputs[0].links:
                if nodes.role_of(former.from_node) == source:
                    group.links.remove(former)
    nodes.complete(group, ROLES, ROLES, [link for link in LINKS if _is_free(group, link)])
    for plans in (stand_ins.COLOUR, stand_ins.NORMAL):
        stand_ins.put_in(group, plans)


def _is_free(group: Any, link: Link) -> bool:
    """Whether the artist has not given a shader's input another value."""
    _, _, role, socket = link
    return socket not in UNTOUCHED or all(
        abs(nodes.find_input(node, socket).default_value - UNTOUCHED[socket]) < 1e-6
        for node in nodes.of_role(group, role)
    )


def _coated(group: Any) -> list[Any]:
    """Shaders whose coat is the film."""
    return [
        node
        for role in SHADERS
        for node in nodes.of_role(group, role)
        for link in nodes.find_input(node, "Coat Weight").links
        if nodes.role_of(link.from_node) == "film"
    ]


def _values(film: Film | None, level: float) -> dict[str, dict[str | int, Any]]:
    """What nodes are set to, by roles and inputs; with no film only what bare skin needs.

    Beneath the film light meets the skin more steeply than it met the film, so that the skin's own
    gloss is much the same at all angles: an index that falls to 1 with the angle of view does that.
    """
    values: dict[str, dict[str | int, Any]] = {
        "film": {1: float(film is not None)},
        "film_level": {2: (level,) * 3},
    }
    if film is None:
        for role in ("share", "mask_share"):
            values[PREFIX + role] = {1: 0.0, 2: 0.0}
        return values
    beneath = INDEX / film.index
    values["film_colour"] = {
        1: tuple(level * value for value in film.slope),
        2: tuple(level * value for value in film.start),
    }
    values["film_more"] = {1: film.more_through}
    values["film_index"] = {1: 1.0 - beneath, 2: beneath - INDEX}
    values["film_relief"] = {"Factor_Float": film.relief}
    return values
