"""Taking the day of the tan off an object: property, keys, and what was made for them."""

from functools import partial
from typing import Any

import bpy
from bpy_extras.anim_utils import action_get_channelbag_for_slot

from .changes import Changes
from .ownership import FORMER, MADE
from .plan import DAY_PROPERTY
from .timeline import (
    ACTION,
    ANIMATION,
    BAG,
    DATA_PATH,
    LAYER,
    SLOT,
    assign,
    give_back,
    is_driven,
    keys_of,
    shown_day,
    strips,
)


def remove_day(obj: bpy.types.Object, changes: Changes, own: str = "") -> list[str]:
    """Take the day off an object, and return sentences on what stays.

    Other animation stays. Where others are moved by the same action, they keep theirs.

    Parameters
    ----------
    own : str
        The artist's own number of that name, as `own_day` told it before Apply.
    """
    animation: Any = obj.animation_data
    if animation is not None and _curve(animation) is not None:
        _leave(obj, animation, changes)
    stay = [strip for strip in strips(obj) if _curve(strip) is not None]
    said = [f"The strip {strip.name!r} of the NLA, which held the day, stays." for strip in stay]
    for strip in stay:
        if not _others(obj, strip.action_slot):
            changes.at_the_end(partial(_empty, strip.action, strip.action_slot))
    if is_driven(obj):
        return [*said, f"A driver governs the property {DAY_PROPERTY!r}, which stays."]
    if shown_day(obj) is None and DAY_PROPERTY in obj:
        return [*said, f"The property {DAY_PROPERTY!r} holds no day and stays."]
    changes.at_the_end(partial(_remove_property, obj, own))
    if own:
        said.append(f"The property {DAY_PROPERTY!r} is again what it was before Apply.")
    return said


def _remove_property(obj: bpy.types.Object, own: str) -> None:
    obj.pop(DAY_PROPERTY, None)
    if own:
        give_back(obj, own)
    obj.update_tag()


def _bag(source: Any) -> Any:
    if source.action is None or source.action_slot is None:
        return None
    return action_get_channelbag_for_slot(source.action, source.action_slot)


def _curve(source: Any) -> Any:
    bag = _bag(source)
    return bag.fcurves.find(DATA_PATH) if bag else None


def _others(obj: bpy.types.Object, slot: Any) -> bool:
    return any(user != obj for user in slot.users())


def _leave(obj: bpy.types.Object, animation: Any, changes: Changes) -> None:
    """Have no curve of the day in the action that moves an object."""
    action, slot = animation.action, animation.action_slot
    changes.on_failure(assign, animation, action, slot)
    former = action.get(FORMER)
    former_slot = former.slots.get(slot.identifier) if former is not None else None
    if former_slot is not None and _is_same_but_day(_bag(animation), former, former_slot):
        assign(animation, former, former_slot)
        changes.at_the_end(partial(_remove_unused, action))
    elif not _others(obj, slot):
        changes.at_the_end(partial(_take_out, obj, action, slot))
    elif len(_bag(animation).fcurves) > 1:
        own = action.copy()
        assign(animation, own, own.slots[slot.identifier])
        changes.at_the_end(partial(_empty, own, own.slots[slot.identifier]))
    else:
        assign(animation, None, None)
        if ANIMATION in str(action.get(MADE, "")).split():
            changes.at_the_end(partial(_clear_empty, obj))


def _is_same_but_day(bag: Any, former: Any, slot: Any) -> bool:
    """Whether an action has what a slot of its former one moves, and the day besides."""
    other = action_get_channelbag_for_slot(former, slot)
    now, before = ({} if one is None else _recorded(one) for one in (bag, other))
    return (DATA_PATH, 0) not in before and {**now, (DATA_PATH, 0): None} == {
        **before,
        (DATA_PATH, 0): None,
    }


def _recorded(bag: Any) -> dict[tuple[str, int], Any]:
    return {
        (curve.data_path, curve.array_index): (
            keys_of(curve),
            curve.extrapolation,
            curve.mute,
            [modifier.type for modifier in curve.modifiers],
        )
        for curve in bag.fcurves
    }


def _empty(action: Any, slot: Any) -> None:
    """Remove the curve of the day, and what was made for it and holds nothing now."""
    made = str(action.get(MADE, "")).split()
    bag: Any = action_get_channelbag_for_slot(action, slot)
    if bag is not None:
        bag.fcurves.remove(bag.fcurves.find(DATA_PATH))
    if bag is None or not len(bag.fcurves):
        for layer in list(action.layers):
            for strip in layer.strips:
                if BAG in made and strip.channelbag(slot) is not None:
                    strip.channelbags.remove(strip.channelbag(slot))
            if LAYER in made and not any(len(strip.channelbags) for strip in layer.strips):
                action.layers.remove(layer)
        if SLOT in made:
            action.slots.remove(slot)
    for key in (MADE, FORMER):
        action.pop(key, None)


def _take_out(obj: bpy.types.Object, action: Any, slot: Any) -> None:
    """The same for the action that moves an object, which goes where it holds nothing."""
    made = str(action.get(MADE, "")).split()
    _empty(action, slot)
    if ACTION not in made or len(action.slots):
        return
    for copy in bpy.data.actions:
        if copy.get(FORMER) == action:
            del copy[FORMER]
    animation: Any = obj.animation_data
    animation.action = None
    if ANIMATION in made:
        _clear_empty(obj)
    _remove_unused(action)


def _clear_empty(obj: bpy.types.Object) -> None:
    animation = obj.animation_data
    if animation is not None and not (
        animation.action or animation.nla_tracks or animation.drivers
    ):
        obj.animation_data_clear()


def _remove_unused(action: bpy.types.Action) -> None:
    if action.users == 0:
        bpy.data.actions.remove(action)
