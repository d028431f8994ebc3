"""A tan of several masks: its coefficients on the mesh, and the nodes that read them.

The tan's group has one node more, a group that computes the skin's state from colour attributes and
a small image (`blender_addon.model.basis` says how); it takes the place of the image of states. The
mask's nodes then read the share of all doses, which the output Share gives.
"""

import json
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, cast

import bpy
import numpy as np
from numpy.typing import NDArray

from .changes import Changes
from .mask_nodes import NUMBER, ShownMask
from .mask_nodes import show as show_mask
from .mask_values import MaskValues
from .nodes import new_node, of_role
from .ownership import remembered
from .plan import ROLE_KEY, Role
from .vertex_groups import new_attribute, remove_attribute

PREFIX = "skin_tan_basis_"

ATTRIBUTES_KEY = "skin_tan_basis"
"""Custom property of a mesh: names of the attributes that Apply made for several masks, as JSON.
Of a group of nodes: those that it reads."""

IMAGE_KEYS = {"rows": "skin_tan_basis_rows", "days": "skin_tan_basis_days"}
"""Custom properties of a tan's group: the images of its basis."""

BASIS = {"basis": Role("ShaderNodeGroup", "State of several masks", (-300, -150))}

VALUES_OF_ATTRIBUTE = 4


@dataclass(frozen=True, eq=False)
class SampledBasis:
    """What a tan of several masks shows.

    Attributes
    ----------
    coefficients : (N, rank) float32 array
    share : (N,) float32 array
        Of all doses.
    domain : str
        POINT or CORNER: what the N are.
    rows, days : Image
        Mean and shapes by day; where a day lies among the rows.
    """

    coefficients: NDArray[np.float32]
    share: NDArray[np.float32]
    domain: str
    rows: bpy.types.Image
    days: bpy.types.Image

    @property
    def rank(self) -> int:
        return self.coefficients.shape[1]


def shares_of_masks(
    mesh: bpy.types.Mesh, values: Sequence[MaskValues]
) -> tuple[str, NDArray[np.float32]]:
    """Domain, and shares (N, M) of masks; those at points are told at corners where one is so."""
    if all(own.domain == "POINT" for own in values):
        return "POINT", np.stack([own.shares for own in values], axis=1)
    points = np.empty(len(mesh.loops), np.int32)
    cast(Any, mesh.loops).foreach_get("vertex_index", points)
    columns = [own.shares[points] if own.domain == "POINT" else own.shares for own in values]
    return "CORNER", np.stack(columns, axis=1)


def is_shown(group: bpy.types.NodeTree) -> bool:
    """Whether a tan's group shows several masks."""
    return any(of_role(group, "basis"))


def made_images(group: bpy.types.NodeTree) -> list[bpy.types.Image]:
    """The images that were made for a group's basis, as far as they are still in the file."""
    return [image for key in IMAGE_KEYS.values() if (image := group.get(key)) is not None]


def show(
    obj: bpy.types.Object, group: bpy.types.NodeTree, sampled: SampledBasis, changes: Changes
) -> dict[bpy.types.Image, bpy.types.Image]:
    """Have a tan's group show several masks; which new image replaces which former one."""
    replaced = {}
    for role, image in (("rows", sampled.rows), ("days", sampled.days)):
        former = group.get(IMAGE_KEYS[role])
        if former is not None:
            replaced[former] = image
        changes.set_key(group, IMAGE_KEYS[role], image)
    node = next(of_role(group, "basis"), None)
    names = _written(obj, [] if node is None else _names(node.node_tree), sampled, changes)
    tree = _new_tree(f"Skin Tan Masks {obj.name}", sampled, names)
    changes.may_add_to(group.nodes)
    changes.may_relink(group)
    if node is None:
        node = new_node(group, "basis", BASIS)
        node.node_tree = tree
        _bridge(group, "states", "Color", node, "State")
    else:
        former_tree = node.node_tree
        ends = [link.to_socket for link in node.outputs["State"].links]
        changes.set(node, "node_tree", tree)
        for end in ends:
            group.links.new(node.outputs["State"], end)
        changes.at_the_end(partial(_remove_unused, former_tree))
    for row in of_role(group, "row"):
        group.links.new(row.outputs[0], node.inputs["Day"])
    share = ShownMask(attribute=names[-1], weights=NUMBER)
    show_mask(group, share, changes)
    return replaced


def take_out(obj: bpy.types.Object, group: bpy.types.NodeTree, changes: Changes) -> None:
    """Have a tan's group show one mask again, and remove what was made for several."""
    if is_shown(group):
        changes.may_relink(group)
        for node in of_role(group, "basis"):
            for states in of_role(group, "states"):
                for end in [link.to_socket for link in node.outputs["State"].links]:
                    group.links.new(states.outputs["Color"], end)
            changes.at_the_end(partial(_remove_node, group, node))
    images = made_images(group)
    for key in IMAGE_KEYS.values():
        if key in group:
            changes.on_failure(group.__setitem__, key, group[key])
            del group[key]
    changes.at_the_end(partial(_remove_images, images))
    remove_attributes(obj, group, changes)


def remove_attributes(
    obj: bpy.types.Object, group: bpy.types.NodeTree | None, changes: Changes
) -> None:
    """Remove what was made for several masks on an object's mesh, and no other object shows."""
    mesh = cast(bpy.types.Mesh, obj.data)
    own = _own(mesh)
    if not own:
        return
    going = [name for name in own if name not in _of_others(obj)]
    for name in going:
        changes.at_the_end(partial(remove_attribute, mesh, name))
    _remember(mesh, [name for name in own if name not in going], changes)


def _written(
    obj: bpy.types.Object, former: Collection[str], sampled: SampledBasis, changes: Changes
) -> list[str]:
    """Write coefficients, and last the share; the names of the attributes."""
    mesh = cast(bpy.types.Mesh, obj.data)
    active = mesh.attributes.active_color_name, mesh.attributes.default_color_name
    own, others = _own(mesh), _of_others(obj)
    free = [name for name in former if name in own and name not in others]
    count = sampled.rank // VALUES_OF_ATTRIBUTE
    names = []
    for number in range(count + 1):
        is_share = number == count
        stem = PREFIX + ("share" if is_share else str(number))
        kind = "FLOAT" if is_share else "FLOAT_COLOR"
        name = next((name for name in free if name.startswith(stem)), None)
        attribute = None if name is None else mesh.attributes.get(name)
        if attribute is None or (attribute.data_type, attribute.domain) != (kind, sampled.domain):
            name = new_attribute(mesh, stem, kind, sampled.domain, changes)
        first = number * VALUES_OF_ATTRIBUTE
        values = sampled.share
        if not is_share:
            values = sampled.coefficients[:, first : first + VALUES_OF_ATTRIBUTE]
        _write(mesh, str(name), values, changes)
        names.append(str(name))
    # A colour attribute that is new becomes the one to paint on where there is none.
    for end, name in zip(("active_color_name", "default_color_name"), active, strict=True):
        if getattr(mesh.attributes, end) != name:
            changes.set(mesh.attributes, end, name)
    for name in set(own) - {*others, *names}:
        changes.at_the_end(partial(remove_attribute, mesh, name))
    others_s = [name for name in own if name in others]
    _remember(mesh, [*others_s, *names], changes)
    return names


def _write(mesh: bpy.types.Mesh, name: str, values: NDArray[np.float32], changes: Changes) -> None:
    # By name: a reference does not outlive another attribute's making.
    end = "value" if values.ndim == 1 else "color"
    former = np.empty(values.size, np.float32)
    cast(Any, mesh.attributes[name]).data.foreach_get(end, former)
    changes.on_failure(_set, mesh, name, end, former)
    _set(mesh, name, end, np.ascontiguousarray(values).ravel())


def _set(mesh: bpy.types.Mesh, name: str, end: str, values: NDArray[np.float32]) -> None:
    cast(Any, mesh.attributes[name]).data.foreach_set(end, values)
    mesh.update_tag()


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
    elif ATTRIBUTES_KEY in mesh:
        changes.on_failure(mesh.__setitem__, ATTRIBUTES_KEY, mesh[ATTRIBUTES_KEY])
        del mesh[ATTRIBUTES_KEY]


def _of_others(obj: bpy.types.Object) -> set[str]:
    """Attributes that other objects of the same mesh show by groups of their own."""
    own = remembered(obj).group
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


def _new_tree(name: str, sampled: SampledBasis, names: Sequence[str]) -> bpy.types.NodeTree:
    """Nodes that add up the mean and the shapes by the coefficients."""
    tree: Any = bpy.data.node_groups.new(name, "ShaderNodeTree")
    tree[ATTRIBUTES_KEY] = json.dumps(list(names))
    interface = tree.interface
    interface.new_socket("Day", in_out="INPUT", socket_type="NodeSocketFloat")
    interface.new_socket("State", in_out="OUTPUT", socket_type="NodeSocketVector")
    given, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    given.location, end.location = (-1000, 0), (300 + 200 * sampled.rank, 0)
    days = _image(tree, sampled.days, "Rows of days", (-800, 0))
    tree.links.new(given.outputs["Day"], days.inputs["Vector"])
    row = _node(tree, "ShaderNodeSeparateXYZ", "Row", (-500, 0))
    tree.links.new(days.outputs["Color"], row.inputs[0])
    total = _line(tree, sampled, row, 0).outputs["Color"]
    for number, attribute in enumerate(names[:-1]):
        place = (200, -400 - 400 * number)
        read = _node(tree, "ShaderNodeAttribute", f"Coefficients {number + 1}", place)
        read.attribute_type, read.attribute_name = "GEOMETRY", attribute
        parts = _node(tree, "ShaderNodeSeparateXYZ", "Coefficients", (400, place[1]))
        tree.links.new(read.outputs["Color"], parts.inputs[0])
        for own, coefficient in enumerate((*parts.outputs, read.outputs["Alpha"])):
            k = 1 + VALUES_OF_ATTRIBUTE * number + own
            more = _node(tree, "ShaderNodeVectorMath", "Add shape", (200 + 200 * k, 0))
            more.operation = "MULTIPLY_ADD"
            tree.links.new(_line(tree, sampled, row, k).outputs["Color"], more.inputs[0])
            tree.links.new(coefficient, more.inputs[1])
            tree.links.new(total, more.inputs[2])
            total = more.outputs[0]
    tree.links.new(total, end.inputs["State"])
    return tree


def _line(tree: Any, sampled: SampledBasis, row: Any, k: int) -> Any:
    """The mean, for k = 0, or a shape by day."""
    place = _node(tree, "ShaderNodeCombineXYZ", f"Column {k}", (-300, 300 * k))
    place.inputs["X"].default_value = (k + 0.5) / (sampled.rank + 1)
    tree.links.new(row.outputs["Y"], place.inputs["Y"])
    image = _image(tree, sampled.rows, f"Shape {k}" if k else "Mean", (-100, 300 * k))
    tree.links.new(place.outputs[0], image.inputs["Vector"])
    return image


def _image(tree: Any, image: bpy.types.Image, label: str, place: tuple[int, int]) -> Any:
    node = _node(tree, "ShaderNodeTexImage", label, place)
    node.image, node.interpolation, node.extension = image, "Linear", "EXTEND"
    return node


def _node(tree: Any, kind: str, label: str, place: tuple[int, int]) -> Any:
    node = tree.nodes.new(kind)
    node.label, node.location, node[ROLE_KEY] = label, place, "basis"
    return node


def _bridge(group: Any, role: str, output: str, node: Any, own: str) -> None:
    """Link a node to all that nodes of a role are linked to."""
    for source in of_role(group, role):
        for end in [link.to_socket for link in source.outputs[output].links]:
            group.links.new(node.outputs[own], end)


def _remove_node(group: Any, node: Any) -> None:
    tree = node.node_tree
    group.nodes.remove(node)
    _remove_unused(tree)


def _remove_unused(tree: Any) -> None:
    if tree is not None and tree.users == 0:
        bpy.data.node_groups.remove(tree)


def _remove_images(images: Sequence[bpy.types.Image]) -> None:
    for image in images:
        if image.users == 0:
            bpy.data.images.remove(image)
