"""Members of a list in a panel, by the number that an operator is given."""

from typing import Any

SELECTED = -1
"""Stands for the member that is selected in the list."""


def index_of(members: Any, selected: int, number: int) -> int:
    """Index of a member by its number; beyond the last is the last."""
    wanted = selected if number == SELECTED else number
    return max(0, min(wanted, len(members) - 1))


def after_removing(members: Any, selected: int, number: int) -> int:
    """Remove a member by its number, and return the index of the one that is selected then."""
    members.remove(index_of(members, selected, number))
    return max(0, min(selected, len(members) - 1))
