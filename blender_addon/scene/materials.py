"""Materials that show a tan: found through an object's slots, copied if other objects show them."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, cast

import bpy

from . import detail, first_version, nodes
from .changes import Changes
from .ownership import Users, is_local, names, remembered

PREFIX = "Skin Tan "

NEW_SKIN = {"Relief": 1.0, "Variation": 1.0, "Oil": 0.25}
"""Sliders of a new material; all 0 is the even, dry skin of the light model."""


@dataclass
class Skin:
    """The tan's node group of one object, and what leads to it.

    Attributes
    ----------
    group : ShaderNodeTree
        Of the object alone.
    material : Material
        One that shows the group.
    users : Users
        As they were before anything was made.
    others : set of ID
        Who else shows the group that was found, and keeps it.
    """

    group: bpy.types.NodeTree
    material: bpy.types.Material
    users: Users
    others: set[bpy.types.ID] = field(default_factory=set)
    _chain: list[Any] = field(default_factory=list)
    _copies: dict[Any, Any] = field(default_factory=dict)

    def trees(self) -> list[Any]:
        """Node trees of the object alone that may hold the group."""
        blocks = [*(self._copies.get(block, block) for block in self._chain), self.material]
        trees = dict.fromkeys(map(_tree, blocks))
        return [tree for tree in trees if tree not in (None, self.group)]

    def attach(self, obj: bpy.types.Object, changes: Changes) -> str:
        """Have the object show the group, and return a sentence on it."""
        for block in self._chain:
            _repoint(_tree(self._copies.get(block, block)), self._copies, changes)
        settings = remembered(obj)
        if (settings.group, settings.material) != (self.group, self.material):
            changes.set(settings, "group", self.group)
            changes.set(settings, "material", self.material)
        slots = [slot for slot in obj.material_slots if slot.material in self._chain]
        for slot in slots:
            if slot.material in self._copies:
                _set_slot(obj, slot, self._copies[slot.material], changes)
        if slots:
            return f"Updated {self.material.name!r}."
        return _put_in_active_slot(obj, self.material, changes)


def prepare(obj: bpy.types.Object) -> Skin:
    """The object's tan group, to be changed without a change for others; a new one if it has none.

    Nothing that the file had before is changed until `Skin.attach`.

    Raises
    ------
    InputError
        If a newer version of the add-on made the group.
    """
    users = Users()
    materials = list(dict.fromkeys(slot.material for slot in obj.material_slots if slot.material))
    group = _group_of(obj, materials)
    if group is None and remembered(obj).material is not None:
        materials = [remembered(obj).material]
        group = _group_of(obj, materials)
    if group is None:
        return _new_skin(obj, users)
    nodes.require_readable(group)
    chain: list[Any] = list(_chain(materials, group))
    copies: dict[Any, Any] = {
        block: _copy(block, obj)
        for block in chain
        if not is_local(block) or users.others(block, obj)
    }
    return Skin(
        group=copies.get(group, group),
        material=copies.get(chain[0], chain[0]),
        users=users,
        others=users.others(group, obj),
        _chain=chain,
        _copies=copies,
    )


def _copy(block: bpy.types.ID, obj: bpy.types.Object) -> bpy.types.ID:
    copy = block.copy()
    if block.name.startswith(PREFIX):
        # A name for people only: after the object, as that of a new one.
        copy.name = PREFIX + obj.name
    return copy


def _new_skin(obj: bpy.types.Object, users: Users) -> Skin:
    name = PREFIX + obj.name
    group = nodes.new_group(name)
    material = bpy.data.materials.new(name)
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    skin: Any = tree.nodes.new("ShaderNodeGroup")
    skin.node_tree, skin.width, skin.location = group, 200, (0, 0)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    output.location = (260, 0)
    tree.links.new(skin.outputs["Surface"], output.inputs["Surface"])
    detail.add_detail(tree, skin)
    made: Any = tree.nodes
    for node in made:
        for name in NEW_SKIN.keys() & node.inputs.keys():
            node.inputs[name].default_value = NEW_SKIN[name]
    return Skin(group, material, users)


def _group_of(
    obj: bpy.types.Object, materials: list[bpy.types.Material]
) -> bpy.types.NodeTree | None:
    """The tan group in an object's materials: its own, or else the active material's, or any."""
    shown = [group for material in materials for group in _tan_groups(_tree(material))]
    if remembered(obj).group in shown:
        return remembered(obj).group
    if obj.active_material in materials:
        shown = [*_tan_groups(_tree(obj.active_material)), *shown]
    return shown[0] if shown else None


def _tree(block: bpy.types.Material | bpy.types.NodeTree) -> bpy.types.NodeTree | None:
    return block.node_tree if isinstance(block, bpy.types.Material) else block


def _nested(tree: bpy.types.NodeTree | None) -> Iterator[bpy.types.NodeTree]:
    """Node groups in a tree, each once; Blender lets no group hold itself."""
    inside = (getattr(node, "node_tree", None) for node in (tree.nodes if tree else ()))
    yield from dict.fromkeys(group for group in inside if group is not None)


def _tan_groups(tree: bpy.types.NodeTree | None) -> Iterator[bpy.types.NodeTree]:
    """Tan groups in a tree, at any depth."""
    for group in _nested(tree):
        if first_version.is_tan_group(group):
            yield group
        else:
            yield from _tan_groups(group)


def _chain(
    materials: list[bpy.types.Material], group: bpy.types.NodeTree
) -> Iterator[bpy.types.ID]:
    """Materials that show a group, the groups that hold it, and last the group itself."""
    held = {}
    for material in materials:
        if group in _tan_groups(_tree(material)):
            yield material
            held.update(dict.fromkeys(_holding(_tree(material), group)))
    yield from held
    yield group


def _holding(
    tree: bpy.types.NodeTree | None, group: bpy.types.NodeTree
) -> Iterator[bpy.types.NodeTree]:
    for nested in _nested(tree):
        if nested != group and group in _tan_groups(nested):
            yield nested
            yield from _holding(nested, group)


def _repoint(tree: bpy.types.NodeTree | None, copies: dict, changes: Changes) -> None:
    """Put copies in place of node groups."""
    nodes_of_groups: Any = tree.nodes if tree else ()
    for node in nodes_of_groups:
        if getattr(node, "node_tree", None) in copies:
            changes.set(node, "node_tree", copies[node.node_tree])


def _set_slot(obj: bpy.types.Object, slot, material: bpy.types.Material, changes: Changes) -> None:
    if obj.data.users > 1 and slot.link == "DATA":
        # Other objects have this mesh too: they keep their own skin.
        changes.set(slot, "link", "OBJECT")
    changes.set(slot, "material", material)


def _put_in_active_slot(
    obj: bpy.types.Object, material: bpy.types.Material, changes: Changes
) -> str:
    added = "" if obj.material_slots else _add_slot(obj, changes)
    slot = obj.material_slots[obj.active_material_index or 0]
    former = slot.material
    _set_slot(obj, slot, material, changes)
    if former is None:
        return f"Applied {material.name!r}.{added}"
    # An artist's material must not be lost on saving for want of a user.
    changes.set(former, "use_fake_user", True)
    return (
        f"Applied {material.name!r} to slot {slot.slot_index + 1} in place of {former.name!r}; "
        "other slots are unchanged."
    )


def _add_slot(obj: bpy.types.Object, changes: Changes) -> str:
    """Give a mesh its first slot, and return a sentence where others have the mesh too."""
    materials: Any = cast(bpy.types.Mesh, obj.data).materials
    changes.on_failure(materials.clear)
    materials.append(None)
    sharing = [other for other in bpy.data.objects if other.data == obj.data and other != obj]
    if not sharing:
        return ""
    return f" Slots belong to the mesh, so {names(sharing)} got an empty one."


def shown_groups(obj: bpy.types.Object) -> Iterator[bpy.types.NodeTree]:
    """Tan groups that an object's materials show, each once, at any depth."""
    materials = dict.fromkeys(slot.material for slot in obj.material_slots if slot.material)
    if remembered(obj).material is not None:
        materials[remembered(obj).material] = None  # geometry nodes may show it
    yield from dict.fromkeys(group for one in materials for group in _tan_groups(_tree(one)))
