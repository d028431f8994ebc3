"""Taking a tan out of an object's materials: they go back to what they were before Apply.

A material or group that was copied for the object makes room for the original, where it is the
same but for the tan. What the artist has edited since stays, without the tan.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import partial
from typing import Any, cast

import bpy

from . import detail, nodes, recolour, regions, several, slots, vertex_groups, views
from .alike import alike
from .changes import Changes
from .images import MARK
from .ownership import FORMER, MADE, Users, names, remembered
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
    kept : list of Material
        Copies for the object that stay, since they were edited.
    """

    stands_for: dict[Any, Any] = field(default_factory=dict)
    stripped: list[Any] = field(default_factory=list)
    kept: list[Any] = field(default_factory=list)


def take_off(obj: bpy.types.Object, changes: Changes) -> list[str]:
    """Take an object's tan out of all its materials, and return sentences on it."""
    users, settings = Users(), remembered(obj)
    group = settings.group
    shown = slots.materials_of(obj)
    tanned = [block for block in shown if any(tan_groups(tree_of(block))) or recolour.is_in(block)]
    own = settings.material
    said = give_back(obj, tanned, users, changes)
    if settings.material is not None:
        changes.set(settings, "material", None)
    changes.set(settings, "group", None)
    vertex_groups.remove_own(obj, changes)
    made = [] if group is None else [*nodes.made_images(group), *several.made_images(group)]
    several.remove_attributes(obj, group, changes)
    if own is not None and MADE in own:
        changes.at_the_end(partial(_remove_unused, [own]))
    changes.at_the_end(partial(_remove_group, group, made))
    return said


def give_back(
    obj: bpy.types.Object, tanned: list[bpy.types.Material], users: Users, changes: Changes
) -> list[str]:
    """Take the tan out of some of an object's materials, and return sentences on it."""
    ours = [block for block in tanned if _is_ours(obj, block)]
    artist_s = [block for block in tanned if block not in ours and recolour.is_in(block)]
    others = [block for block in tanned if block not in (*ours, *artist_s)]
    back = GivenBack({block: block.get(FORMER) for block in ours})
    _sort_out(obj, artist_s, users, back)
    _fill_slots(obj, back, changes)
    entries = {entry.material: entry.tans for entry in remembered(obj).materials}
    kept = {back.stands_for.get(block, block): tans for block, tans in entries.items()}
    kept.pop(None, None)
    slots.remember(obj, kept, changes)
    changes.at_the_end(partial(_strip, back))
    replaced = [block for block in back.stands_for if back.stands_for[block] not in back.stripped]
    changes.at_the_end(partial(_remove_unused, replaced))
    return _sentences(ours + artist_s, back, others)


def _is_ours(obj: bpy.types.Object, block: bpy.types.Material) -> bool:
    """Whether Apply made a material, and does not only recolour it."""
    return MADE in block or (block == remembered(obj).material and not recolour.is_in(block))


def _sort_out(
    obj: bpy.types.Object, blocks: list[bpy.types.Material], users: Users, back: GivenBack
) -> None:
    """Of recoloured materials and the groups in them, find what goes back to its original."""
    inside = dict.fromkeys(
        group for block in blocks for group in all_nested(tree_of(block)) if recolour.is_in(group)
    )
    around = [group for group in inside if nodes.LAYOUT_KEY not in group]
    for block in (*around, *blocks):
        former = block.get(FORMER)
        if former is not None and not recolour.is_in(former) and _is_unedited(block, former, back):
            back.stands_for[block] = former
    going = {block for block in blocks if not users.others(block, obj)}
    for block in (*around, *blocks):
        if block in back.stands_for:
            continue
        if isinstance(block, bpy.types.Material):
            is_alone = block in going
        else:
            is_alone = users.roots(block) <= going
        if not is_alone:
            back.stands_for[block] = copy = block.copy()
            back.stripped.append(copy)
        else:
            back.stripped.append(block)
            if FORMER in block and isinstance(block, bpy.types.Material):
                back.kept.append(block)


def _is_unedited(block: Any, former: Any, back: GivenBack) -> bool:
    """Whether a copy is the same as its original but for the tan."""
    trial = block.copy()
    try:
        recolour.take_out(tree_of(trial))
        return alike(trial, former, back.stands_for)
    finally:
        _collection(trial).remove(trial)


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
        for key in (FORMER, slots.RELINKED):
            block.pop(key, None)


def _remove_unused(blocks: Iterable[Any]) -> None:
    """Remove materials and groups of ours that nothing shows; the outer ones before the inner."""
    for block in reversed(list(blocks)):
        if _is_valid(block) and block.users == 0:
            _collection(block).remove(block)


def _is_valid(block: Any) -> bool:
    try:
        return bool(block.name)
    except ReferenceError:
        return False


def _remove_group(group: Any, made: list[bpy.types.Image]) -> None:
    """Remove a tan's group and its images, and the relief of skin, where nothing shows them."""
    if group is not None and _is_valid(group) and group.users == 0:
        several.remove_nodes(group)
        regions.remove_nodes(group)
        bpy.data.node_groups.remove(group)
    for image in dict.fromkeys(made):
        if image.users == 0 and MARK in image:
            bpy.data.images.remove(image)
    detail.remove_unused_group()
    views.remove_unused()


def _sentences(
    done: list[bpy.types.Material], back: GivenBack, others: list[bpy.types.Material]
) -> list[str]:
    said = []
    replaced = [back.stands_for[block] for block in done if back.stands_for.get(block)]
    in_place = [block for block in done if block not in back.stands_for]
    if replaced or in_place:
        said.append(f"Gave back {names(dict.fromkeys([*replaced, *in_place]))}.")
    if any(back.stands_for.get(block, block) is None for block in done):
        said.append("Slots that were empty are so again.")
    if back.kept:
        said.append(f"Edited since Apply, so a copy stays: {names(back.kept)}.")
    if others:
        said.append(f"{names(others)} shows the tan by nodes of your own, and stays.")
    return said
