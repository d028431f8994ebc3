"""Which objects show a data-block, and copies of it for one object alone.

Data-blocks are found by the pointers that lead to them, never by name. A data-block that only one
object shows may be changed in place. Where others show it too, the object gets its own copy.
"""

from collections.abc import Iterable
from typing import Any, cast

import bpy

FORMER = "skin_tan_former"
"""Custom property of a copy for one object, or of what stands in its place: the original."""

MADE = "skin_tan_made"
"""Custom property of a material that this add-on made, or of an action: what it made of that."""


class Users:
    """Which data-blocks use which in the file, as it was when this was made."""

    def __init__(self) -> None:
        self._users = bpy.data.user_map(key_types={"IMAGE", "MATERIAL", "MESH", "NODETREE"})

    def others(self, block: bpy.types.ID, obj: bpy.types.Object) -> set[bpy.types.ID]:
        """Objects besides one, worlds and the like, that show a data-block.

        Materials that nothing shows do not count, nor objects that were given another material
        since Apply.
        """
        others, seen, waiting = set(), {block}, [block]
        while waiting:
            used = waiting.pop()
            for user in self._users.get(used, set()) - seen:
                if _is_only_former(used, user):
                    continue
                if isinstance(user, bpy.types.Object):
                    if user != obj and not _is_only_remembered(user, used):
                        others.add(user)
                elif isinstance(user, bpy.types.Material | bpy.types.NodeTree):
                    seen.add(user)
                    waiting.append(user)
                elif isinstance(used, bpy.types.Material) and isinstance(user, bpy.types.Mesh):
                    others |= self._showing(user, used) - {obj}
                else:
                    others.add(user)
        return others

    def roots(self, block: bpy.types.ID) -> set[bpy.types.ID]:
        """Materials, worlds and whatever else uses a node group, maybe through others."""
        roots, seen, waiting = set(), {block}, [block]
        while waiting:
            used = waiting.pop()
            for user in self._users.get(used, set()) - seen:
                if _is_only_former(used, user):
                    continue
                seen.add(user)
                if isinstance(user, bpy.types.NodeTree):
                    waiting.append(user)
                else:
                    roots.add(user)
        return roots

    def is_former(self, block: bpy.types.ID) -> bool:
        """Whether a copy, or what stands in its place, leads back to a data-block."""
        return any(_is_only_former(block, user) for user in self._users.get(block, ()))

    def _showing(self, mesh: bpy.types.Mesh, material: bpy.types.Material) -> set[bpy.types.ID]:
        """Objects of a mesh that have a material in a slot."""
        objects = (user for user in self._users[mesh] if isinstance(user, bpy.types.Object))
        return {user for user in objects if _has_in_slot(user, material)}


def _is_only_former(block: bpy.types.ID, user: bpy.types.ID) -> bool:
    """Whether a material or node group uses another as the one that it was copied from."""
    kinds = (bpy.types.Material, bpy.types.NodeTree)
    return isinstance(user, kinds) and user.get(FORMER) == block


def _has_in_slot(obj: bpy.types.Object, material: bpy.types.ID) -> bool:
    return any(slot.material == material for slot in obj.material_slots)


def _is_only_remembered(obj: bpy.types.Object, block: bpy.types.ID) -> bool:
    """Whether an object has a data-block in its settings from an earlier Apply and nowhere else.

    Where geometry nodes could show it, they do: their inputs may hold a material.
    """
    settings = remembered(obj)
    ticked = (entry.material for entry in settings.materials)
    return block in (settings.group, settings.material, *ticked) and not (
        _has_in_slot(obj, block) or any(modifier.type == "NODES" for modifier in obj.modifiers)
    )


def remembered(obj: bpy.types.Object) -> Any:
    """An object's settings; `group`, `material` and `materials` are those of its last Apply."""
    return cast(Any, obj).skin_tan


def is_local(block: bpy.types.ID) -> bool:
    """Whether a data-block is this file's to change: neither linked nor an override."""
    return block.library is None and block.override_library is None


def names(blocks: Iterable[bpy.types.ID]) -> str:
    """Names for a sentence: three at most."""
    listed = sorted(repr(block.name) for block in blocks)
    more = f" and {len(listed) - 3} more" if len(listed) > 3 else ""
    return ", ".join(listed[:3]) + more
