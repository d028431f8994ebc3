"""Lists in a panel, and operators on one member: the selected one, or that of a number."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
from bpy.props import IntProperty

from hylios.errors import InputError

from .active import active_settings, can_edit

SELECTED = -1
"""Stands for the member that is selected in the list."""


class OnMember:
    """An operator on a member of a list of the active object's settings.

    Attributes
    ----------
    members, selected : str
        Names of the list in the settings, and of the index of its selected member.
    nothing : str
        What `poll` says where the list is empty.
    """

    members = selected = nothing = ""

    index: IntProperty(
        name="Index",
        description="Number in the list, from 0; -1 is the selected one",
        default=SELECTED,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not can_edit(cls, context):
            return False
        if not getattr(active_settings(context), cls.members):
            operator: Any = cls
            operator.poll_message_set(cls.nothing)
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = active_settings(context)
        members, selected = getattr(settings, self.members), getattr(settings, self.selected)
        try:
            index = index_of(members, selected, self.index)
            selected = self.act(members, index, selected)
        except InputError as error:
            operator: Any = self
            operator.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if selected is None:
            return {"CANCELLED"}
        setattr(settings, self.selected, selected)
        return {"FINISHED"}

    def act(self, members: Any, index: int, selected: int) -> int | None:
        """Do it to a member, and return which is selected then; None where there is no need.

        Raises
        ------
        InputError
            If it cannot be done.
        """
        raise NotImplementedError


class RemovesMember(OnMember):
    """An operator that removes a member of a list."""

    def act(self, members: Any, index: int, selected: int) -> int | None:
        with _own(members, index):
            members.remove(index)
        return max(0, min(selected, len(members) - 1))


def index_of(members: Any, selected: int, number: int) -> int:
    """Index of a member by its number.

    Raises
    ------
    InputError
        If there is none.
    """
    last = len(members) - 1
    if number == SELECTED:
        return max(0, min(selected, last))
    if not 0 <= number <= last:
        raise InputError(f"index is {number}; allowed is 0 to {last}, or {SELECTED}: the selected.")
    return number


def move(members: Any, index: int, target: int) -> None:
    """Move a member to another place.

    Raises
    ------
    InputError
        If it is that of a library, on an override.
    """
    with _own(members, index):
        members.move(index, target)


def clear(members: Any) -> int:
    """Remove all members; on an override those of its library are turned off, and counted."""
    members.clear()
    for member in members:
        member.enabled = False
    return len(members)


@contextmanager
def _own(members: Any, index: int) -> Iterator[None]:
    """Say so where Blender refuses to take an override's member from its place."""
    try:
        yield
    except TypeError as error:
        name = f" '{members[index].name}'" if members[index].name else ""
        raise InputError(
            f"Entry {index + 1}{name} of the list is that of the character's own file; allowed "
            "here is to turn it off."
        ) from error
