"""A tan of several masks, in an object's group of nodes.

The group has one node more, a group (`several_nodes`) that reads the masks and computes the skin's
state and the share of all doses; it takes the place of the image of states and of the mask's nodes.

Earlier versions wrote attributes onto the mesh for more than three masks, or an image of which tan
each texel has; both go away at the next Apply.
"""

import json
from collections.abc import Sequence
from functools import partial
from typing import Any, cast

import bpy

from . import nodes, several_nodes
from .changes import Changes
from .images import remove_if_unused
from .mask_nodes import ShownMask
from .nodes import link, new_node, of_role
from .ownership import remembered
from .places import copy_place
from .plan import LINKS, Link, Role
from .replaced import remove_nodes, show_tree
from .several_nodes import ATTRIBUTES_KEY, MASKS_KEY, Basis, Grid
from .vertex_groups import remove_attribute

GRID = "grid_{}"
"""Roles of the images over shares."""

IMAGE_KEYS = {
    role: f"skin_tan_basis_{role}"
    for role in ("rows", "days", "places", "index", *(GRID.format(block) for block in range(5)))
}
"""Custom properties of a tan's group: the images of its basis; one of earlier versions is gone."""

BASIS = {"basis": Role("ShaderNodeGroup", "State of several masks", (-300, -150))}

REPLACED = {"State": ("states", "Color"), "Share": ("share", "Value")}
"""Roles and outputs whose place outputs of the node take."""


def is_shown(group: bpy.types.NodeTree) -> bool:
    """Whether a tan's group shows several masks."""
    return any(of_role(group, "basis"))


def own_images(group: bpy.types.NodeTree, masks: str | None = None) -> dict[str, bpy.types.Image]:
    """The images by which a group shows masks, by role; none where it shows something else.

    Parameters
    ----------
    masks : str, optional
        Which masks it must be, as `show` was given.
    """
    trees = [node.node_tree for node in of_role(group, "basis")]
    kept = {role: image for role, key in IMAGE_KEYS.items() if (image := group.get(key))}
    inner: list[Any] = [node for tree in trees if tree is not None for node in tree.nodes]
    shown = {node.image for node in inner if node.bl_idname == "ShaderNodeTexImage"}
    told = [None if tree is None else tree.get(MASKS_KEY) for tree in trees]
    is_whole = len(told) == 1 and told[0] is not None and masks in (None, told[0])
    return kept if is_whole and set(kept.values()) <= shown else {}


def own_history(group: bpy.types.NodeTree) -> tuple[bpy.types.Image, ...]:
    """The images of a group's history that were made for it: of one mask or of several."""
    own = nodes.own_history(group) or ()
    return (*own_images(group).values(), *own[2:]) if is_shown(group) else own


def made_images(group: bpy.types.NodeTree) -> list[bpy.types.Image]:
    """The images that were made for a group's basis, as far as they are still in the file."""
    return [image for key in IMAGE_KEYS.values() if (image := group.get(key)) is not None]


def show(
    obj: bpy.types.Object,
    group: bpy.types.NodeTree,
    basis: Basis,
    grid: Grid,
    masks: Sequence[ShownMask],
    called: str,
    changes: Changes,
) -> dict[bpy.types.Image, bpy.types.Image]:
    """Have a tan's group show several masks; which new image replaces which former one.

    Parameters
    ----------
    called : str
        Says which masks these are, for `own_images`.
    """
    (*_, rows) = of_role(group, "rows")
    node = next(of_role(group, "basis"), None)
    made = {"rows": basis.rows, "days": basis.days, "places": grid.places}
    made |= {GRID.format(block): image for block, image in enumerate(grid.images)}
    tree = several_nodes.over_shares(f"Skin Tan Masks {obj.name}", basis, grid, masks, changes)
    tree[MASKS_KEY] = called
    remove_attributes(obj, group, changes)
    changes.may_add_to(group.nodes)
    changes.may_relink(group)
    if node is None:
        node = new_node(group, "basis", BASIS)
        node.node_tree = tree
    else:
        was_deleted = node.node_tree is None
        show_tree(group, node, tree, changes)
        if was_deleted:
            link(group, ("basis",), _links("basis"))
    for output, (role, former_output) in REPLACED.items():
        _bridge(group, role, former_output, node, output)
    for day in of_role(group, "day"):
        group.links.new(day.outputs["Fac"], node.inputs["Day"])
    for days in of_role(node.node_tree, several_nodes.DAYS):
        copy_place(rows, days, changes)
    return _replaced(group, made, changes)


def _replaced(
    group: bpy.types.NodeTree, made: dict[str, bpy.types.Image], changes: Changes
) -> dict[bpy.types.Image, bpy.types.Image]:
    """Remember the images of a basis; by the former ones, what takes their place."""
    replaced = {}
    for role, key in IMAGE_KEYS.items():
        image = made.get(role)
        if image is None:
            _forget(group, key, changes)
        else:
            if (former := group.get(key)) is not None:
                replaced[former] = image
            changes.set_key(group, key, image)
    return replaced


def _forget(group: Any, key: str, changes: Changes) -> None:
    image = changes.pop_key(group, key)
    if image is not None:
        changes.at_the_end(partial(remove_if_unused, image))


def take_out(obj: bpy.types.Object, group: bpy.types.NodeTree, changes: Changes) -> None:
    """Have a tan's group show one mask again, and remove what was made for several."""
    if is_shown(group):
        changes.may_relink(group)
        for node in of_role(group, "basis"):
            for output, (role, own) in REPLACED.items():
                _hand_back(group, node, output, role, own)
            if node.node_tree is None:
                link(group, [role for role, _ in REPLACED.values()], _links())
            changes.at_the_end(partial(remove_nodes, group, [node]))
    for key in IMAGE_KEYS.values():
        _forget(group, key, changes)
    remove_attributes(obj, group, changes)


def remove_attributes(
    obj: bpy.types.Object, group: bpy.types.NodeTree | None, changes: Changes
) -> None:
    """Remove what earlier versions made on an object's mesh, and no other object shows.

    Parameters
    ----------
    group : NodeTree or None
        That the object will have; until `Skin.attach` it may have one that others show too.
    """
    mesh = cast(bpy.types.Mesh, obj.data)
    own = _own(mesh)
    if not own:
        return
    others = _of_others(obj, group)
    going = [name for name in own if name not in others]
    for name in going:
        changes.at_the_end(partial(remove_attribute, mesh, name))
    _remember(mesh, [name for name in own if name not in going], changes)


def _own(mesh: bpy.types.Mesh) -> list[str]:
    """Attributes of a mesh that were made for several masks and are there still."""
    try:
        stored = json.loads(mesh.get(ATTRIBUTES_KEY, "[]"))
    except (TypeError, ValueError):
        return []
    return [name for name in stored if isinstance(name, str) and name in mesh.attributes]


def _remember(mesh: bpy.types.Mesh, names: Sequence[str], changes: Changes) -> None:
    if names:
        changes.set_key(mesh, ATTRIBUTES_KEY, json.dumps(names))
    else:
        changes.pop_key(mesh, ATTRIBUTES_KEY)


def _of_others(obj: bpy.types.Object, own: bpy.types.NodeTree | None) -> set[str]:
    """Attributes that other objects of the same mesh show by groups other than the object's own."""
    names: set[str] = set()
    for other in bpy.data.objects:
        if other == obj or other.data != obj.data:
            continue
        group = remembered(other).group
        if group is not None and group != own:
            for node in of_role(group, "basis"):
                names.update(_names(node.node_tree))
    return names


def _names(tree: bpy.types.NodeTree | None) -> list[str]:
    """Attributes that a basis' nodes read."""
    try:
        return list(json.loads("[]" if tree is None else tree.get(ATTRIBUTES_KEY, "[]")))
    except (TypeError, ValueError):
        return []


def _links(start: str = "") -> list[Link]:
    """What `REPLACED` leads to in a group, from a node or as without it."""
    of_peeling = ("states", "Color", "peel", "State"), ("share", "Value", "peel_place", "X")
    led: list[Link] = [*of_peeling, *LINKS]
    return [
        (start or role, output if start else own, end, taken)
        for output, (role, own) in REPLACED.items()
        for source, given, end, taken in led
        if (source, given) == (role, own)
    ]


def _bridge(group: Any, role: str, output: str, node: Any, own: str) -> None:
    """Link a node to all that nodes of a role are linked to."""
    for source in of_role(group, role):
        for end in [own.to_socket for own in source.outputs[output].links]:
            group.links.new(node.outputs[own], end)


def _hand_back(group: Any, node: Any, output: str, role: str, own: str) -> None:
    """Link nodes of a role to all that a node is linked to."""
    given = node.outputs.get(output)  # earlier versions had no share
    for end in [own.to_socket for own in given.links] if given else []:
        for source in of_role(group, role):
            group.links.new(source.outputs[own], end)
