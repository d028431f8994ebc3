"""Keys and drivers of an input of a node tree, moved to another input and back.

Keys lie in the tree's action or in strips of the NLA. An action that moves other trees too is
copied first; the copy says in a custom property of what.
"""

import itertools
from collections.abc import Iterable, Iterator
from typing import Any

import bpy
from bpy_extras.anim_utils import action_get_channelbag_for_slot

from hylios.errors import InputError

from .changes import Changes
from .ownership import is_local
from .timeline import assign, keys_of

COPIED = "skin_tan_copied"
"""Custom property of an action that was copied for a tree: the former one."""

COLOUR = 3
"""Channels that move; the transparency of a colour is no part of it."""


def move(tree: Any, start: Any, end: Any, changes: Changes) -> bool:
    """Have what animates an input of a tree animate another, and return whether anything does.

    Raises
    ------
    InputError
        If keys that other trees share are in the NLA's tweak mode, in which they cannot be copied.
    """
    former, new = _path(start), _path(end)
    animation = tree.animation_data
    if animation is None:
        return False
    keyed = _keyed(animation, former)
    if animation.use_tweak_mode and not all(_is_own(source) for source in keyed):
        raise InputError(
            "Keys of a painted colour are in tweak mode; leave tweak mode in the Nonlinear "
            "Animation editor (Tab)."
        )
    for source in keyed:
        changes.on_failure(assign, source, source.action, source.action_slot)
    _make_own(keyed)
    curves = _curves(animation, keyed, former)
    for curve in curves:
        changes.set(curve, "data_path", new)
    return bool(curves)


def is_moved(tree: Any, end: Any) -> bool:
    """Whether keys or drivers move an input of a tree."""
    animation, path = tree.animation_data, _path(end)
    return animation is not None and bool(_curves(animation, _keyed(animation, path), path))


def move_back(tree: Any, start: Any, end: Any) -> None:
    """The same at the end, when nothing can fail; an action as it was before comes back."""
    former, new = _path(start), _path(end)
    animation = tree.animation_data
    if animation is None:
        return
    keyed = _keyed(animation, former)
    _make_own(keyed)
    for curve in _curves(animation, keyed, former):
        curve.data_path = new
    for source in keyed:
        _restore_action(source)


def part(tree: Any, ends: Iterable[Any]) -> None:
    """Give a copy of a tree keys of its own, where inputs of it are keyed."""
    animation = tree.animation_data
    if animation is not None:
        _make_own([source for end in ends for source in _keyed(animation, _path(end))])


def actions(animation: Any) -> list[bpy.types.Action | None]:
    """Of a tree and the strips that move it, what they are or were copied of."""
    return [origin(source.action) for source in _sources(animation)]


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


def _sources(animation: Any) -> Iterator[Any]:
    """What has an action: the animation itself and the strips of its NLA."""
    yield animation
    for track in animation.nla_tracks:
        yield from _strips(track.strips)


def _strips(strips: Any) -> Iterator[Any]:
    for strip in strips:
        yield strip
        yield from _strips(strip.strips)


def _keyed(animation: Any, path: str) -> list[Any]:
    """What of a tree's animation has keys for a path."""
    return [source for source in _sources(animation) if any(_of_path(_of_action(source), path))]


def _curves(animation: Any, keyed: Iterable[Any], path: str) -> list[Any]:
    """Drivers and keys of a path."""
    of_keys = (_of_path(_of_action(source), path) for source in keyed)
    return [*_of_path(animation.drivers, path), *itertools.chain.from_iterable(of_keys)]


def _of_action(source: Any) -> list[Any]:
    if source.action is None or source.action_slot is None:
        return []
    bag = action_get_channelbag_for_slot(source.action, source.action_slot)
    return list(bag.fcurves) if bag else []


def _of_path(curves: Any, path: str) -> Iterator[Any]:
    return (curve for curve in curves if curve.data_path == path and curve.array_index < COLOUR)


def _is_own(source: Any) -> bool:
    return is_local(source.action) and len(source.action_slot.users()) < 2


def _make_own(keyed: Iterable[Any]) -> None:
    """Have actions that move one tree alone: Blender removes a node's keys with the node."""
    copies: dict[Any, Any] = {}
    for source in keyed:
        action, slot = source.action, source.action_slot
        if action not in copies:
            if _is_own(source):
                continue
            copies[action] = action.copy()
            copies[action][COPIED] = origin(action)
        assign(source, copies[action], copies[action].slots[slot.identifier])


def _restore_action(source: Any) -> None:
    action, slot = source.action, source.action_slot
    former = action.get(COPIED)
    former_slot = former.slots.get(slot.identifier) if former is not None else None
    if former_slot is None:
        return
    bags = (action_get_channelbag_for_slot(*one) for one in ((action, slot), (former, former_slot)))
    now, before = ([] if bag is None else list(bag.fcurves) for bag in bags)
    if _recorded(now) == _recorded(before):
        assign(source, former, former_slot)


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
