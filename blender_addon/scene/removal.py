"""Taking a tan out of an object's materials: they go back to what they were before Apply.

A material or group that was copied for the object makes room for the original, where it is the
same but for the tan. What the artist has edited since stays, without the tan.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any, cast

import bpy

from . import (
    animated,
    detail,
    images,
    nodes,
    peeling_nodes,
    recolour,
    region_nodes,
    several,
    slots,
    vertex_groups,
    waiting,
)
from .alike import alike
from .changes import Changes
from .ownership import FORMER, MADE, Users, is_local, names, remembered
from .trees import all_nested, tan_groups, tree_of


@dataclass
class GivenBack:
    """What becomes of materials that lose their tan.

    Attributes
    ----------
    stands_for : dict
        From materials and groups to what takes their place; None where a slot gets empty.
    stripped : list
        Materials and groups that stay, and from which the tan is taken out.
    originals : dict
        From copies that are the same as their originals but for the tan to these.
    waiting : list
        Of those that stay, the copies whose originals still have a tan.
    kept : list of Material
        Copies for the object that stay, since they were edited.
    """

    stands_for: dict[Any, Any] = field(default_factory=dict)
    stripped: list[Any] = field(default_factory=list)
    originals: dict[Any, Any] = field(default_factory=dict)
    waiting: list[Any] = field(default_factory=list)
    kept: list[Any] = field(default_factory=list)


def take_off(obj: bpy.types.Object, changes: Changes) -> list[str]:
    """Take an object's tan out of all its materials, and return sentences on it."""
    users, settings = Users(), remembered(obj)
    group = settings.group
    shown = slots.materials_of(obj)
    tanned = [block for block in shown if any(tan_groups(tree_of(block))) or recolour.is_in(block)]
    own = settings.material
    left = _left(obj, group, tanned, users)
    tanned += [block for block in left if not left[block]]
    groups = dict.fromkeys(inner for block in tanned for inner in tan_groups(tree_of(block)))
    said = [*give_back(obj, tanned, users, changes), *_elsewhere(left)]
    if settings.material is not None:
        changes.set(settings, "material", None)
    changes.set(settings, "group", None)
    vertex_groups.remove_own(obj, changes)
    several.remove_attributes(obj, None, changes)
    if own is not None and MADE in own:
        changes.at_the_end(partial(_remove_unused, [own]))
    changes.at_the_end(partial(_remove_groups, [group, *groups]))
    return said


def _left(
    obj: bpy.types.Object,
    group: bpy.types.NodeTree | None,
    tanned: list[bpy.types.Material],
    users: Users,
) -> dict[bpy.types.Material, set[bpy.types.ID]]:
    """Materials with an object's tan that it has in no slot any more, and who else shows them."""
    formers = [block.get(FORMER) for block in tanned]
    return {
        block: users.others(block, obj)
        for block in bpy.data.materials
        if is_local(block)
        and (recolour.is_in(block) or MADE in block)
        and (block in formers or group in set(tan_groups(tree_of(block))))
        and block not in slots.materials_of(obj)
    }


def _elsewhere(left: Mapping[bpy.types.Material, set[bpy.types.ID]]) -> list[str]:
    """A sentence on materials that only objects without a tan of their own show now."""
    without = {
        block: others
        for block, others in left.items()
        if others and all(_is_without_tan(other) for other in others)
    }
    if not without:
        return []
    keep = "keep" if len(without) > 1 else "keeps"
    where = names(set().union(*without.values()))
    return [f"{names(without)}, now on {where}, {keep} the tan until Remove Tan there."]


def _is_without_tan(block: bpy.types.ID) -> bool:
    return isinstance(block, bpy.types.Object) and remembered(block).group is None


def give_back(
    obj: bpy.types.Object, tanned: list[bpy.types.Material], users: Users, changes: Changes
) -> list[str]:
    """Take the tan out of some of an object's materials, and return sentences on it."""
    ours = [block for block in tanned if _is_ours(obj, block)]
    artist_s = [block for block in tanned if block not in ours and recolour.is_in(block)]
    others = [block for block in tanned if block not in (*ours, *artist_s)]
    back = GivenBack({block: block.get(FORMER) for block in ours})
    _sort_out(artist_s, {block for block in artist_s if not users.others(block, obj)}, users, back)
    _fill_slots(obj, back, changes)
    entries = {entry.material: entry.tans for entry in remembered(obj).materials}
    kept = {back.stands_for.get(block, block): tans for block, tans in entries.items()}
    kept.pop(None, None)
    slots.remember(obj, kept, changes)
    changes.at_the_end(partial(_strip, back))
    changes.at_the_end(partial(_remove_unused, list(back.stands_for)))
    return _sentences(ours + artist_s, back, others)


def _is_ours(obj: bpy.types.Object, block: bpy.types.Material) -> bool:
    """Whether Apply made a material, and does not only recolour it."""
    return MADE in block or (block == remembered(obj).material and not recolour.is_in(block))


def _sort_out(
    blocks: list[bpy.types.Material], alone: set[Any], users: Users, back: GivenBack
) -> None:
    """Of recoloured materials and the groups in them, find what goes back to its original."""
    inside = dict.fromkeys(
        group for block in blocks for group in all_nested(tree_of(block)) if recolour.is_in(group)
    )
    around = [group for group in inside if nodes.LAYOUT_KEY not in group]
    alone = {*alone, *(group for group in around if users.roots(group) <= alone)}
    for block in (*around, *blocks):
        former = block.get(FORMER)
        if former is None or not _is_unedited(block, former, back.originals):
            continue
        back.originals[block] = former
        if former in alone or not recolour.is_in(former):
            back.stands_for[block] = former
    for block in (*around, *blocks):
        if block in back.stands_for:
            continue
        stays = block
        if block not in alone:
            back.stands_for[block] = stays = block.copy()
            if block not in back.originals:
                stays[FORMER] = block
        back.stripped.append(stays)
        if block in back.originals or block not in alone:
            back.waiting += [stays] if is_local(stays[FORMER]) else []
        elif FORMER in block and isinstance(block, bpy.types.Material):
            back.kept.append(block)


def _is_unedited(block: Any, former: Any, originals: Mapping[Any, Any]) -> bool:
    """Whether a copy is the same as its original but for the tan."""
    trials = block.copy(), former.copy()
    try:
        for trial in trials:
            recolour.take_out(tree_of(trial))
        return alike(*trials, originals)
    finally:
        for trial in trials:
            _collection(trial).remove(trial)
        animated.remove_unused()


def _collection(block: Any) -> Any:
    is_material = isinstance(block, bpy.types.Material)
    return bpy.data.materials if is_material else bpy.data.node_groups


def _fill_slots(obj: bpy.types.Object, back: GivenBack, changes: Changes) -> None:
    mesh_s: Any = cast(bpy.types.Mesh, obj.data).materials
    for slot in obj.material_slots:
        block = slot.material
        if block is None or block not in back.stands_for:
            continue
        new = back.stands_for[block]
        if slots.RELINKED in block and mesh_s[slot.slot_index] == new:
            changes.set(slot, "material", None)
            changes.set(slot, "link", "DATA")
        else:
            slots.put(obj, slot, new, changes)
        if slots.ADDED in block and len(mesh_s) == 1:
            changes.at_the_end(partial(slots.remove_added, obj))


def _strip(back: GivenBack) -> None:
    """Take the tan out of what stays, which then shows what stands for other groups."""
    for block in back.stripped:
        tree = tree_of(block)
        recolour.take_out(tree)
        for node in tree.nodes:
            if getattr(node, "node_tree", None) in back.stands_for:
                node.node_tree = back.stands_for[node.node_tree]
        if block in back.waiting:
            waiting.wait(block)
        else:
            waiting.forget(block)
    waiting.reunite()


def _remove_unused(blocks: Iterable[Any]) -> None:
    """Remove materials and groups of ours that nothing shows; the outer ones before the inner."""
    for block in reversed(list(blocks)):
        if _is_valid(block) and block.users == 0:
            _collection(block).remove(block)
    animated.remove_unused()


def _is_valid(block: Any) -> bool:
    try:
        return bool(block.name)
    except ReferenceError:
        return False


def _remove_groups(groups: Iterable[Any]) -> None:
    """Remove tans' groups that nothing shows, and what was made for tans and shows in none."""
    for group in groups:
        if group is not None and _is_valid(group) and is_local(group) and group.users == 0:
            bpy.data.node_groups.remove(group)
    for tree in list(bpy.data.node_groups):
        is_ours = several.ATTRIBUTES_KEY in tree or region_nodes.SHOWN_KEY in tree
        if is_ours and is_local(tree) and tree.users == 0:
            bpy.data.node_groups.remove(tree)
    detail.remove_unused_group()
    peeling_nodes.remove_unused_group()
    images.remove_unused()


def _sentences(
    done: list[bpy.types.Material], back: GivenBack, others: list[bpy.types.Material]
) -> list[str]:
    said = []
    replaced = [back.stands_for[block] for block in done if back.stands_for.get(block)]
    in_place = [block for block in done if block not in back.stands_for]
    if replaced or in_place:
        said.append(f"Gave back {names(dict.fromkeys([*replaced, *in_place]))}.")
    if any(back.stands_for.get(block, block) is None for block in done):
        said.append("Slots that had no material before the tan have none again.")
    if back.kept:
        said.append(f"Edited since Apply, so a copy stays: {names(back.kept)}.")
    if others:
        show = (
            "show the tan by nodes of your own, and stay"
            if len(others) > 1
            else ("shows the tan by nodes of your own, and stays")
        )
        said.append(f"{names(others)} {show}.")
    return said
