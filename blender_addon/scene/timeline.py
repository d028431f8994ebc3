"""The day of the tan on the timeline: a keyed custom property of the object, without a script."""

import json
from collections.abc import Iterator
from typing import Any, cast

import bpy
from bpy_extras.anim_utils import action_get_channelbag_for_slot

from hylios.errors import InputError

from .changes import Changes
from .ownership import FORMER, MADE
from .plan import DAY_PROPERTY

DATA_PATH = f'["{DAY_PROPERTY}"]'
COORDINATES = ("co", "handle_left", "handle_right")
"""Coordinates of a key and its handles."""

ANIMATION, ACTION, SLOT, BAG, LAYER = "animation", "action", "slot", "channels", "layer"
"""What was made for the day, as an action says in a custom property."""

DRIVEN = "A driver governs the day of the tan, so keys have no effect."

SAME = 1e-3
"""Frames and days no further apart are the same."""


def check_day_property(obj: bpy.types.Object) -> None:
    """Refuse an object whose day cannot be keyed.

    Raises
    ------
    InputError
        In the NLA's tweak mode, in which Blender refuses another action, and where a property of
        the artist's own has the name.
    """
    require_no_tweak_mode(obj)
    day = obj.get(DAY_PROPERTY, 0.0)
    if not isinstance(day, int | float):
        raise InputError(
            f"The custom property {DAY_PROPERTY!r} of {obj.name!r} holds no number, and the day of "
            "the tan needs that name; rename the property."
        )


def require_no_tweak_mode(obj: bpy.types.Object) -> None:
    """Refuse an object in the NLA's tweak mode, in which Blender refuses another action."""
    if obj.animation_data and obj.animation_data.use_tweak_mode:
        raise InputError(
            f"The animation of {obj.name!r} is in tweak mode; leave tweak mode in the Nonlinear "
            "Animation editor (Tab)."
        )


def own_day(obj: bpy.types.Object) -> str:
    """An object's own number called as the day, which no key or driver moves, as JSON; else ""."""
    if not isinstance(obj.get(DAY_PROPERTY), int | float) or is_driven(obj) or any(day_curves(obj)):
        return ""
    appearance = cast(Any, obj).id_properties_ui(DAY_PROPERTY).as_dict()
    return json.dumps([obj[DAY_PROPERTY], appearance])


def give_back(obj: bpy.types.Object, own: str) -> None:
    """Have an object's own number again."""
    obj[DAY_PROPERTY], appearance = json.loads(own)
    if "items" in appearance:  # JSON has no tuples, and Blender takes nothing else
        appearance["items"] = [tuple(item) for item in appearance["items"]]
    _set_appearance(obj, appearance)


def shown_day(obj: bpy.types.Object) -> float | None:
    """The day that an object shows in this frame, if it has one."""
    day = obj.get(DAY_PROPERTY)
    return float(day) if isinstance(day, int | float) else None


def is_driven(obj: bpy.types.Object) -> bool:
    """Whether a driver governs the day, so that keys have no effect."""
    drivers: Any = obj.animation_data.drivers if obj.animation_data else ()
    return any(driver.data_path == DATA_PATH and not driver.mute for driver in drivers)


def has_keys(obj: bpy.types.Object) -> bool:
    """Whether the day has any key."""
    return any(len(curve.keyframe_points) for curve in day_curves(obj))


def mutings(obj: bpy.types.Object) -> list[str]:
    """Sentences on curves of the day that are switched off."""
    curves = list(day_curves(obj))
    muted = [curve for curve in curves if curve.mute or (curve.group and curve.group.mute)]
    return ["The curve of the day is muted, so its keys have no effect."] if muted else []


def has_own_keys(obj: bpy.types.Object, keyed: tuple[float, ...]) -> bool:
    """Whether the day's keys are other than those that Apply sets.

    Parameters
    ----------
    keyed : tuple of 4 float
        First and last day and their frames, as Apply has keyed them last.
    """
    ends = list(zip(keyed[2:], keyed[:2], strict=True))
    return not all(_is_keyed(curve, ends) for curve in day_curves(obj)) or _is_retimed(obj)


def day_curves(obj: bpy.types.Object) -> Iterator[Any]:
    """Curves of the day: of the object's action, and of the strips that move it."""
    for source in (obj.animation_data, *strips(obj)):
        if source is not None and source.action is not None and source.action_slot is not None:
            bag = action_get_channelbag_for_slot(source.action, source.action_slot)
            curve = bag.fcurves.find(DATA_PATH) if bag else None
            if curve is not None:
                yield curve


def strips(obj: bpy.types.Object) -> list[Any]:
    tracks: Any = obj.animation_data.nla_tracks if obj.animation_data else ()
    return [strip for track in tracks if not track.mute for strip in track.strips]


def _is_retimed(obj: bpy.types.Object) -> bool:
    """Whether a strip with the day shows it at other frames than its keys say."""
    for strip in strips(obj):
        bag = strip.action_slot and action_get_channelbag_for_slot(strip.action, strip.action_slot)
        if bag and bag.fcurves.find(DATA_PATH):
            moved = abs(strip.frame_start - strip.action_frame_start) > SAME
            if moved or strip.scale != 1.0 or strip.repeat != 1.0 or strip.use_reverse:
                return True
    return False


def _is_keyed(curve: Any, ends: list[tuple[float, float]]) -> bool:
    """Whether a curve is linear between two ends (frame, day) and nothing else."""
    points = curve.keyframe_points
    return (
        len(points) == len(ends)
        and not curve.modifiers
        and all(point.interpolation == "LINEAR" for point in points)
        and all(
            abs(value - wanted) < SAME
            for point, end in zip(points, ends, strict=True)
            for value, wanted in zip(point.co, end, strict=True)
        )
    )


def remove_modifiers(obj: bpy.types.Object) -> None:
    """Remove the modifiers of the day's curves."""
    for curve in day_curves(obj):
        for modifier in list(curve.modifiers):
            curve.modifiers.remove(modifier)


def set_first_day(obj: bpy.types.Object, day: float, changes: Changes) -> None:
    """Give an object the property of the day without a key, where it has none."""
    if DAY_PROPERTY not in obj:
        _set_day(obj, day, changes)
        obj.update_tag()


def is_moved_elsewhere(obj: bpy.types.Object) -> bool:
    """Whether a driver or a strip of the NLA, not keys of an action, governs the day."""
    animation = obj.animation_data
    of_action = animation is not None and animation.action is not None
    return is_driven(obj) or (not of_action and next(day_curves(obj), None) is not None)


def frame_of_day(obj: bpy.types.Object, scene: bpy.types.Scene, day: float) -> int | None:
    """The frame of the scene that shows a day best, by the object's keys; None without keys."""
    curve = next(day_curves(obj), None)
    if curve is None:
        return None
    frames = range(scene.frame_start, scene.frame_end + 1)
    return min(frames, key=lambda frame: abs(curve.evaluate(frame) - day))


def key_days(
    obj: bpy.types.Object,
    scene: bpy.types.Scene,
    changes: Changes,
    days: tuple[float, float],
    frames: tuple[float, float],
) -> None:
    """Key the day on an object, linear between two frames and held outside them.

    Earlier keys of the day are replaced; other animation of the object is left alone, and so are
    other objects with the same action: this one gets a copy.
    """
    made = [] if obj.animation_data else [ANIMATION]
    action, slot = _own_action(obj, changes, made)
    curve, is_new = _curve(action, slot, changes, made)
    if made and MADE not in action:
        changes.set_key(action, MADE, " ".join(made))
    changes.on_failure(_set_keys, curve, keys_of(curve), curve.extrapolation)
    curve.keyframe_points.clear()
    curve.keyframe_points.add(len(days))
    for key, day, frame in zip(curve.keyframe_points, days, frames, strict=True):
        key.co, key.interpolation = (frame, day), "LINEAR"
    curve.extrapolation = "CONSTANT"
    curve.update()
    _set_day(obj, curve.evaluate(scene.frame_current_final), changes)
    _widen_range(obj, days)
    if obj.animation_data is None:
        changes.on_failure(obj.animation_data_clear)
    animation = obj.animation_data or obj.animation_data_create()
    if is_new or (animation.action, animation.action_slot) != (action, slot):
        # The assignment has Blender sort out anew what follows what, which takes long in a large
        # scene; without, a strip of the NLA would go on covering a new action.
        changes.on_failure(assign, animation, animation.action, animation.action_slot)
        assign(animation, action, slot)
    action.update_tag()
    obj.update_tag()


def _set_day(obj: bpy.types.Object, day: float, changes: Changes) -> None:
    if DAY_PROPERTY in obj:
        appearance = cast(Any, obj).id_properties_ui(DAY_PROPERTY)
        changes.on_failure(_set_appearance, obj, appearance.as_dict())
    changes.set_key(obj, DAY_PROPERTY, day)
    _set_appearance(obj, {"description": "Day of the tan", "precision": 2})
    # A shot that links the character may key its own days.
    cast(Any, obj).property_overridable_library_set(DATA_PATH, True)


def _widen_range(obj: bpy.types.Object, days: tuple[float, float]) -> None:
    """Have days within the range of the property: Blender cuts what keys say to that."""
    range_ = cast(Any, obj).id_properties_ui(DAY_PROPERTY).as_dict()
    lowest, highest = min(range_["min"], *days), max(range_["max"], *days)
    if (lowest, highest) != (range_["min"], range_["max"]):
        _set_appearance(obj, {"min": lowest, "max": highest})


def _set_appearance(obj: bpy.types.Object, appearance: dict[str, Any]) -> None:
    """How the sidebar shows the day."""
    cast(Any, obj).id_properties_ui(DAY_PROPERTY).update(**appearance)


def assign(animation: Any, action: bpy.types.Action | None, slot: Any) -> None:
    animation.action = action
    if action is not None:
        animation.action_slot = slot


def keys_of(curve: Any) -> dict[str, list[Any]]:
    """All that can be set on the keys of a curve, by name."""
    points = curve.keyframe_points
    names = {rna.identifier for rna in bpy.types.Keyframe.bl_rna.properties if not rna.is_readonly}
    keys: dict[str, list[Any]] = {
        name: [getattr(point, name) for point in points] for name in names - {"co_ui", *COORDINATES}
    }
    for name in COORDINATES:
        keys[name] = [0.0] * (2 * len(points))
        points.foreach_get(name, keys[name])
    return keys


def _set_keys(curve: Any, keys: dict[str, list[Any]], extrapolation: str) -> None:
    points = curve.keyframe_points
    points.clear()
    points.add(len(keys["co"]) // 2)
    for name in set(keys) - set(COORDINATES):
        for point, value in zip(points, keys[name], strict=True):
            setattr(point, name, value)
    # Last, and as arrays: what is set key by key moves handles.
    for name in COORDINATES:
        points.foreach_set(name, keys[name])
    curve.extrapolation = extrapolation


def _own_action(
    obj: bpy.types.Object, changes: Changes, made: list[str]
) -> tuple[bpy.types.Action, bpy.types.ActionSlot]:
    """An action and a slot of it that move this object alone; adds to what was made for that."""
    animation = obj.animation_data
    action = animation.action if animation else None
    slot = animation.action_slot if animation else None
    if action is None:
        action = bpy.data.actions.new(f"{obj.name}Action")
        made.append(ACTION)
        slot = None
    elif action.library or (slot is not None and any(user != obj for user in slot.users())):
        identifier = slot and slot.identifier
        former, action = action, action.copy()
        if FORMER not in action:
            action[FORMER] = former
        slot = action.slots[identifier] if identifier else None
    if slot is None:
        made.append(SLOT)
        changes.may_add_to(action.slots)
        slot = action.slots.new(id_type="OBJECT", name=obj.name)
    return action, slot


def _curve(
    action: bpy.types.Action, slot: bpy.types.ActionSlot, changes: Changes, made: list[str]
) -> tuple[bpy.types.FCurve, bool]:
    """The curve of the day, and whether it is new."""
    bag = action_get_channelbag_for_slot(action, slot)
    if bag is None:
        made += [BAG] if action.layers else [BAG, LAYER]
        changes.may_add_to(action.layers)
        layer = action.layers[0] if action.layers else action.layers.new("Layer")
        changes.may_add_to(layer.strips)
        strip: Any = layer.strips[0] if layer.strips else layer.strips.new(type="KEYFRAME")
        changes.may_add_to(strip.channelbags)
        bag = strip.channelbag(slot, ensure=True)
    curve = bag.fcurves.find(DATA_PATH)
    if curve is not None:
        return curve, False
    changes.may_add_to(bag.fcurves)
    return bag.fcurves.new(DATA_PATH), True
