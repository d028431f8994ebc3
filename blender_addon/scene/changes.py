"""Changes to a file that are taken back where an exception stops them halfway.

What is to be changed is noted first and changed then, so that an exception between two lines, a
full memory or Ctrl+C among them, finds all that it has to take back.
"""

from collections.abc import Callable
from contextlib import ExitStack, suppress
from types import TracebackType
from typing import Any

import bpy
from mathutils import Color, Vector

from .link_order import make_again, noted

MADE = ("images", "materials", "node_groups", "actions")
"""Collections of `bpy.data` into which Apply puts new data-blocks."""


class Changes:
    """A `with` that an exception leaves with the file as it was before.

    Data-blocks made in it are removed then, and what went through the methods is restored, the
    last change first.
    """

    def __init__(self) -> None:
        self._undo = ExitStack()
        self._last: list[Callable[[], Any]] = []
        self._present: set[int] = set()

    def __enter__(self) -> "Changes":
        self._present = {block.session_uid for block in _made()}
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if kind is None:
            self._undo.pop_all()
            for step in self._last:
                # On a block that a step before has removed there is nothing left to do.
                with suppress(ReferenceError):
                    step()
            return
        try:
            self._undo.close()
        finally:
            bpy.data.batch_remove(
                [block for block in _made() if block.session_uid not in self._present]
            )

    def on_failure(self, step: Callable[..., Any], *arguments: Any) -> None:
        """Take a change back by a call."""
        self._undo.callback(step, *arguments)

    def at_the_end(self, step: Callable[[], Any]) -> None:
        """A call that cannot fail nor be taken back, for when all else is done."""
        self._last.append(step)

    def set(self, owner: Any, name: str, value: Any) -> None:
        """Set an attribute."""
        former: Any = getattr(owner, name)
        if isinstance(former, bpy.types.bpy_prop_array | Color | Vector):
            former = tuple(former[:])  # it would follow the change
        self.on_failure(setattr, owner, name, former)
        setattr(owner, name, value)

    def set_key(self, owner: Any, key: str, value: Any) -> None:
        """Set a custom property."""
        if key in owner:
            self.on_failure(owner.__setitem__, key, owner[key])
        else:
            self.on_failure(owner.pop, key, None)
        owner[key] = value

    def pop_key(self, owner: Any, key: str) -> Any:
        """Remove a custom property, and return what it was; None where there is none."""
        former = owner.get(key)
        if key in owner:
            self.on_failure(owner.__setitem__, key, former)
            del owner[key]
        return former

    def may_add_to(self, collection: Any) -> None:
        """Take out of a collection again what is added to it from now on."""
        present = {member.as_pointer() for member in collection}
        self.on_failure(_remove_others, collection, present)

    def may_relink(self, tree: Any) -> None:
        """Restore the links of a node tree, whatever is linked from now on."""
        self.on_failure(make_again, tree, noted(tree))

    def may_change_sockets(self, group: Any) -> None:
        """Restore the inputs and outputs of a node group, whatever is renamed or added."""
        former = {item.as_pointer(): item.name for item in group.interface.items_tree}
        self.on_failure(_restore_sockets, group.interface, former)


def _made() -> list[Any]:
    return [block for name in MADE for block in getattr(bpy.data, name)]


def _remove_others(collection: Any, present: set[int]) -> None:
    for member in list(collection):
        if member.as_pointer() not in present:
            collection.remove(member)


def _restore_sockets(interface: Any, former: dict[int, str]) -> None:
    for item in list(interface.items_tree):
        if item.as_pointer() in former:
            item.name = former[item.as_pointer()]
        else:
            interface.remove(item)
