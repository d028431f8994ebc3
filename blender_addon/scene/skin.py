"""The tan on an object: its node group, the materials that show it, and copies where others do."""

import itertools
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import bpy

from hylios.errors import InputError

from . import first_version, materials, nodes, recolour, removal, slots
from .changes import Changes
from .ownership import FORMER, MADE, Users, is_local, names, remembered
from .trees import chain, has_nodes, shaders, tan_groups, tree_of

VIEWPORT = "skin_tan_viewport"
"""Custom property of a material of ours: the colour that Solid view was given."""


@dataclass
class Skin:
    """The tan's node group of one object, and what leads to it.

    Attributes
    ----------
    obj : Object
    group : ShaderNodeTree
        Of the object alone.
    users : Users
        As they were before anything was made.
    others : set of ID
        Who else shows the group that was there, and keeps it.
    ticked : mapping
        Materials in the object's slots, and whether they are to tan.
    fresh : list of Material
        The artist's, which get the tan now.
    own : Material or None
        Ours, to go into an empty slot.
    replacing : bool
        Whether fresh ones make room for materials of ours.
    """

    obj: bpy.types.Object
    group: bpy.types.NodeTree
    users: Users
    ticked: dict[bpy.types.Material, bool]
    others: set[bpy.types.ID] = field(default_factory=set)
    fresh: list[bpy.types.Material] = field(default_factory=list)
    own: bpy.types.Material | None = None
    replacing: bool = False
    _chain: list[Any] = field(default_factory=list)
    _copies: dict[Any, Any] = field(default_factory=dict)
    _made: list[Any] = field(default_factory=list)

    def trees(self) -> list[Any]:
        """Node trees of the object alone that may hold the group."""
        blocks = [*(self._copies.get(block, block) for block in self._chain), *self._made]
        distinct = dict.fromkeys(map(tree_of, blocks))
        return [tree for tree in distinct if tree not in (None, self.group)]

    def recolours(self) -> bool:
        """Whether a material of the artist's shows the tan, or will."""
        return bool(self.fresh and not self.replacing) or any(
            recolour.inserted(tree) for tree in self.trees()
        )

    def attach(self, changes: Changes) -> list[str]:
        """Have the object show the group, and return sentences on it."""
        updated = [block for block in self._chain if block in self.ticked]
        self._repoint(self._chain, changes)
        said = [f"Updated {names(self._copies.get(block, block) for block in updated)}."]
        said = said if updated else []
        for tree in self.trees():
            recolour.note_links(tree, changes)
        if self.fresh:
            said += self._replace(changes) if self.replacing else self._recolour(changes)
        self._fill_slots(changes)
        if self.own is not None:
            said.append(self._put_own(changes))
        settings = remembered(self.obj)
        if settings.group != self.group:
            changes.set(settings, "group", self.group)
        ours = [block for block in self._shown() if not recolour.is_in(block)]
        if ours and settings.material not in ours:
            changes.set(settings, "material", ours[0])
        ticked = {self._copies.get(block, block): tans for block, tans in self.ticked.items()}
        slots.remember(self.obj, ticked, changes)
        unticked = [block for block in self._shown() if not ticked.get(block, True)]
        if unticked:
            said += removal.give_back(self.obj, unticked, self.users, changes)
        remarks = (recolour.remarks(block) for block, tans in ticked.items() if tans)
        return [*said, *itertools.chain.from_iterable(remarks), *self._on_replacing(updated)]

    def _on_replacing(self, updated: list[bpy.types.Material]) -> list[str]:
        """Where New Material was switched after materials had got their tan."""
        shown = [self._copies.get(block, block) for block in updated]
        recoloured = [block for block in shown if recolour.is_in(block)]
        new = [block for block in shown if MADE in block and block.get(FORMER) is not None]
        if self.replacing and recoloured:
            return [
                f"New Material is on, but {names(recoloured)} had a tan before; Remove Tan, then "
                "Apply Tan puts in a new one."
            ]
        if new and not self.replacing:
            return [
                f"New Material is off, but {names(new)} took the place of yours before; Remove "
                "Tan, then Apply Tan recolours yours."
            ]
        return []

    def set_viewport_colour(self, colour: Iterable[float], changes: Changes) -> None:
        """Have materials of ours show a linear colour in Solid view, unless the artist set one."""
        for block in self._shown():
            if MADE not in block:
                continue
            given = tuple(block.diffuse_color)
            if block in self._made or given == tuple(block.get(VIEWPORT, ())):
                changes.set(block, "diffuse_color", (*colour, 1.0))
                changes.set_key(block, VIEWPORT, list(block.diffuse_color))

    def _shown(self) -> list[bpy.types.Material]:
        blocks = [*(self._copies.get(block, block) for block in self._chain), *self._made]
        return [block for block in blocks if isinstance(block, bpy.types.Material)]

    def _repoint(self, blocks: Iterable[Any], changes: Changes) -> None:
        """Put copies in place of node groups."""
        for block in blocks:
            tree = tree_of(self._copies.get(block, block))
            for node in tree.nodes if tree else ():
                if getattr(node, "node_tree", None) in self._copies:
                    changes.set(node, "node_tree", self._copies[node.node_tree])

    def _fill_slots(self, changes: Changes) -> None:
        for slot in self.obj.material_slots:
            if slot.material in self._copies:
                slots.put(self.obj, slot, self._copies[slot.material], changes)

    def _replace(self, changes: Changes) -> list[str]:
        for block in self.fresh:
            ours = materials.new_material(self.group, block.name)
            ours[FORMER] = block
            self._copies[block] = ours
            self._made.append(ours)
        return [
            f"{names(self._made)} took the place of {names(self.fresh)}; Remove Tan gives "
            f"{'them' if len(self.fresh) > 1 else 'it'} back."
        ]

    def _recolour(self, changes: Changes) -> list[str]:
        for block in self.fresh:
            if _is_shared(block, self.users, self.obj):
                self.others |= self.users.others(block, self.obj)
                self._copies[block] = _copy(block)
        around = self._own_groups()
        self._repoint([*self.fresh, *around], changes)
        made = [self._copies.get(block, block) for block in self.fresh]
        ends: dict[Any, dict[Any, None]] = {}
        for block in made:
            for path, _, end in shaders(block):
                tree = path[-1] if path else block.node_tree
                ends.setdefault(tree, {}).setdefault(end)
        moved = [
            recolour.insert(tree, inputs, self.group, changes) for tree, inputs in ends.items()
        ]
        self._made += [*made, *(self._copies.get(group, group) for group in around)]
        said = [f"Recoloured {names(made)}."]
        if any(moved):
            said.append("Keys and drivers of a painted colour are on the node Tan beside it now.")
        return said

    def _own_groups(self) -> list[Any]:
        """Groups around shaders of fresh materials; others' are copied for this object first."""
        in_place = {block for block in self.fresh if block not in self._copies}
        around = dict.fromkeys(
            group for block in self.fresh for path, _, _ in shaders(block) for group in path
        )
        for group in around:
            is_free = is_local(group) and not group.asset_data and not self.users.is_former(group)
            if not is_free or not self.users.roots(group) <= in_place:
                self._copies[group] = _copy(group)
        return list(around)

    def _put_own(self, changes: Changes) -> str:
        assert self.own is not None
        obj, own = self.obj, self.own
        added = ""
        if not obj.material_slots:
            added = materials.add_slot(obj, changes)
            self._copies.get(own, own)[slots.ADDED] = True
        empty = [slot for slot in obj.material_slots if _is_free(slot.material)]
        active = obj.material_slots[obj.active_material_index or 0]
        counts = slots.faces_of_slots(obj)
        empty.sort(key=lambda slot: (slot != active, -counts[slot.slot_index]))
        if empty[0].material is not None:
            changes.set(empty[0].material, "use_fake_user", True)
        slots.put(obj, empty[0], self._copies.get(own, own), changes)
        self.ticked[own] = True
        return f"Applied {self._copies.get(own, own).name!r}.{added}"


def prepare(obj: bpy.types.Object, *, replacing: bool = False) -> Skin:
    """What gets an object's tan, to be changed without a change for others.

    Nothing that the file had before is changed until `Skin.attach`.

    Parameters
    ----------
    replacing : bool
        Whether the artist's materials make room for materials of ours.

    Raises
    ------
    InputError
        If a newer version of the add-on made the object's group, or no material can tan.
    """
    users = Users()
    shown = slots.materials_of(obj)
    group = group_of(obj)
    ticked = slots.ticks(obj, group)
    showing = [] if group is None else _showing(shown, group)
    fresh = [block for block in shown if ticked[block] and block not in showing]
    fresh = _usable([block for block in fresh if not _is_free(block)], replacing)
    own = None
    if not showing and not fresh:
        own = _own_material(obj, group)
    if group is None:
        group = nodes.new_group(materials.PREFIX + obj.name)
        own = own or (None if fresh else materials.new_material(group, obj.name))
        return Skin(obj, group, users, ticked, set(), fresh, own, replacing, _made=_listed(own))
    nodes.require_readable(group)
    if own is None and not showing and not fresh:
        own = materials.new_material(group, obj.name)
    through = list(chain([*showing, *_listed(own)], group))
    copies: dict[Any, Any] = {
        block: _copy_of_shown(block, obj)
        for block in through
        if not is_local(block) or users.others(block, obj)
    }
    return Skin(
        obj,
        copies.get(group, group),
        users,
        ticked,
        users.others(group, obj),
        fresh,
        own,
        replacing,
        through,
        copies,
    )


def _showing(
    blocks: list[bpy.types.Material], group: bpy.types.NodeTree
) -> list[bpy.types.Material]:
    return [block for block in blocks if group in tan_groups(tree_of(block))]


def _listed(block: bpy.types.Material | None) -> list[bpy.types.Material]:
    return [] if block is None else [block]


def _usable(blocks: list[bpy.types.Material], replacing: bool) -> list[bpy.types.Material]:
    """Those of some ticked materials that can be recoloured."""
    usable = [block for block in blocks if replacing or shaders(block)]
    plain = [block for block in blocks if not has_nodes(block)]
    if plain and not usable:
        have = "have" if len(plain) > 1 else "has"
        raise InputError(f"{names(plain)} {have} no nodes; turn on Use Nodes, or New Material.")
    if blocks and not usable:
        raise InputError(
            f"{names(blocks)} cannot be recoloured: no Principled BSDF or other shader with a "
            "colour leads to the surface; allowed is one that has one, or New Material."
        )
    return usable


def _own_material(
    obj: bpy.types.Object, group: bpy.types.NodeTree | None
) -> bpy.types.Material | None:
    """The object's own material of an earlier Apply, which is in no slot now."""
    if obj.material_slots and not any(_is_free(slot.material) for slot in obj.material_slots):
        raise InputError(f"No material of {obj.name!r} is ticked to tan; tick those that are skin.")
    former = remembered(obj).material
    if group is not None and former is not None and group in tan_groups(tree_of(former)):
        return former
    return None


def _is_free(material: bpy.types.Material | None) -> bool:
    """Whether a slot with a material can take ours: it is empty, or lost its tan's group."""
    return material is None or bool(
        material.get(MADE) and not any(tan_groups(tree_of(material))) and not shaders(material)
    )


def _is_shared(block: bpy.types.Material, users: Users, obj: bpy.types.Object) -> bool:
    """Whether a material is not the object's alone to change."""
    return (
        not is_local(block)
        or block.asset_data is not None
        or users.is_former(block)
        or bool(users.others(block, obj))
    )


def _copy(block: Any) -> Any:
    copy = block.copy()
    copy[FORMER] = block
    return copy


def _copy_of_shown(block: Any, obj: bpy.types.Object) -> Any:
    """A copy of what shows a tan, or of its group."""
    is_artist_s = not first_version.is_tan_group(tree_of(block)) and recolour.is_in(block)
    copy = _copy(block) if is_artist_s and FORMER not in block else block.copy()
    recolour.part_keys(tree_of(copy))
    if block.name.startswith(materials.PREFIX):
        # A name for people only: after the object, as that of a new one.
        copy.name = materials.PREFIX + obj.name
    return copy


def group_of(obj: bpy.types.Object) -> bpy.types.NodeTree | None:
    """The object's tan group: of its last Apply, or in the active material, or in any."""
    shown = slots.materials_of(obj)
    inside = [group for block in shown for group in tan_groups(tree_of(block))]
    last = remembered(obj).group
    if last in inside:
        return last
    if obj.active_material in shown:
        inside = [*tan_groups(tree_of(obj.active_material)), *inside]
    if inside:
        return inside[0]
    return last if last is not None and first_version.is_tan_group(last) else None
