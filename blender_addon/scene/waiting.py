"""Copies without a tan whose originals still have theirs, on other objects.

Where objects have shown one tanned material, and one of them loses its tan, that one needs a copy
without. The copy makes room for the original as soon as that has no tan either.
"""

from typing import Any, cast

import bpy

from . import recolour, slots
from .alike import alike
from .ownership import FORMER, is_local
from .trees import all_nested, tree_of

WAITS = "skin_tan_waits"
"""Custom property of a copy that waits for its original: its name. With another it is artist's."""


def wait(copy: Any) -> None:
    """Have a copy wait for the original that it remembers."""
    copy[WAITS] = copy.name


def forget(copy: Any) -> None:
    """Have a copy or an original be the artist's own."""
    for key in (FORMER, WAITS, slots.RELINKED):
        copy.pop(key, None)


def reunite() -> None:
    """Have originals without a tan take the place of copies that wait for them."""
    blocks: list[Any] = [*bpy.data.node_groups, *bpy.data.materials]
    waiting = [block for block in blocks if WAITS in block and is_local(block)]
    waiting.sort(key=lambda block: len(list(all_nested(tree_of(block)))))  # the inner ones first
    for copy in waiting:
        original = copy.get(FORMER)
        if recolour.is_in(copy) or (original is not None and recolour.is_in(original)):
            continue
        is_unedited = (
            original is not None
            and copy.name == copy[WAITS]
            and not (copy.use_fake_user or copy.asset_data)
            and alike(copy, original, {})
        )
        if is_unedited:
            _put_in_place(original, copy)
        else:
            forget(copy)


def _put_in_place(original: Any, copy: Any) -> None:
    if slots.RELINKED in copy:
        for obj in bpy.data.objects:
            for slot in obj.material_slots:
                if slot.material == copy and _of_mesh(obj, slot) == original:
                    slot.material = None
                    slot.link = "DATA"
    copy.user_remap(original)
    is_material = isinstance(copy, bpy.types.Material)
    blocks: Any = bpy.data.materials if is_material else bpy.data.node_groups
    blocks.remove(copy)


def _of_mesh(obj: bpy.types.Object, slot: Any) -> Any:
    """The material that the mesh has for a slot."""
    return cast(Any, obj.data).materials[slot.slot_index]
