"""Members of a list in a panel, by the number that an operator is given."""

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
        If there is none.
    """
    members.remove(index_of(members, selected, number))
    return max(0, min(selected, len(members) - 1))
