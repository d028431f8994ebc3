"""Members of a list in a panel, by the number that an operator is given."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from hylios.errors import InputError

SELECTED = -1
"""Stands for the member that is selected in the list."""


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


def after_removing(members: Any, selected: int, number: int) -> int:
    """Remove a member by its number, and return the index of the one that is selected then.

    Raises
    ------
    InputError
        If there is none, or it is that of a library, on an override.
    """
    index = index_of(members, selected, number)
    with _own(members, index):
        members.remove(index)
    return max(0, min(selected, len(members) - 1))


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
