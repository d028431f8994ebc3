"""Keys and drivers of an input of a node tree, moved to another input and back.

An action that moves other trees too is copied first; the copy says in a custom property of what.
"""

from collections.abc import Iterable, Iterator
from typing import Any

import bpy
from bpy_extras.anim_utils import action_get_channelbag_for_slot

from .changes import Changes
from .ownership import is_local
from .timeline import assign, keys_of

COPIED = "skin_tan_copied"
"""Custom property of an action that was copied for a tree: the former one."""

COLOUR = 3
"""Channels that move; the transparency of a colour is no part of it."""


def move(tree: Any, start: Any, end: Any, changes: Changes) -> bool:
    """Have what animates an input of a tree animate another, and return whether anything does."""
    former, new = _path(start), _path(end)
    animation = tree.animation_data
    if animation is None:
        return False
    curves = list(_of_path(animation.drivers, former))
    if any(_of_path(_of_action(animation), former)):
        changes.on_failure(assign, animation, animation.action, animation.action_slot)
        _make_own(animation)
        curves += _of_path(_of_action(animation), former)
    for curve in curves:
        changes.set(curve, "data_path", new)
    return bool(curves)


def move_back(tree: Any, start: Any, end: Any) -> None:
    """The same at the end, when nothing can fail; an action as it was before comes back."""
    former, new = _path(start), _path(end)
    animation = tree.animation_data
    if animation is None:
        return
    curves = list(_of_path(animation.drivers, former))
    if any(_of_path(_of_action(animation), former)):
        _make_own(animation)
        curves += _of_path(_of_action(animation), former)
    for curve in curves:
        curve.data_path = new
    if curves and animation.action is not None:
        _restore_action(animation)


def part(tree: Any, ends: Iterable[Any]) -> None:
    """Give a copy of a tree keys of its own, where inputs of it are keyed."""
    animation = tree.animation_data
    if animation is not None:
        curves = _of_action(animation)
        if any(any(_of_path(curves, _path(end))) for end in ends):
            _make_own(animation)


def origin(action: bpy.types.Action | None) -> bpy.types.Action | None:
    """What an action was copied of for a tree, or the action itself."""
    return action if action is None else action.get(COPIED) or action


def remove_unused() -> None:
    """Remove actions that were copied for trees and move none any more."""
    for action in list(bpy.data.actions):
        if COPIED in action and action.users == 0 and is_local(action):
            bpy.data.actions.remove(action)


def _path(end: Any) -> str:
    return end.path_from_id("default_value")


def _of_action(animation: Any) -> list[Any]:
    if animation.action is None or animation.action_slot is None:
        return []
    bag = action_get_channelbag_for_slot(animation.action, animation.action_slot)
    return list(bag.fcurves) if bag else []


def _of_path(curves: Any, path: str) -> Iterator[Any]:
    return (curve for curve in curves if curve.data_path == path and curve.array_index < COLOUR)


def _make_own(animation: Any) -> None:
    """Have an action that moves one tree alone: Blender removes a node's keys with the node."""
    action, slot = animation.action, animation.action_slot
    if is_local(action) and len(slot.users()) < 2:
        return
    own = action.copy()
    own[COPIED] = origin(action)
    assign(animation, own, own.slots[slot.identifier])


def _restore_action(animation: Any) -> None:
    action, slot = animation.action, animation.action_slot
    former = action.get(COPIED)
    former_slot = former.slots.get(slot.identifier) if former is not None else None
    if former_slot is None:
        return
    bags = (action_get_channelbag_for_slot(*one) for one in ((action, slot), (former, former_slot)))
    now, before = ([] if bag is None else list(bag.fcurves) for bag in bags)
    if _recorded(now) == _recorded(before):
        assign(animation, former, former_slot)


def _recorded(curves: list[Any]) -> list[Any]:
    return [
        (
            curve.data_path,
            curve.array_index,
            keys_of(curve),
            curve.extrapolation,
            curve.mute,
            [modifier.type for modifier in curve.modifiers],
        )
        for curve in curves
    ]
