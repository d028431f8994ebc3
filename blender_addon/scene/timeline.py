"""The day of the tan on the timeline: a keyed custom property of the object, without a script."""

from typing import Any, cast

import bpy
from bpy_extras.anim_utils import action_get_channelbag_for_slot

from hylios.errors import InputError

from .nodes import DAY_PROPERTY
from .ownership import NewBlocks

DATA_PATH = f'["{DAY_PROPERTY}"]'


def check_frames(first_frame: int, last_frame: int) -> None:
    """Raise InputError unless the last frame comes after the first."""
    if not last_frame > first_frame:
        raise InputError(
            f"last frame is {last_frame}; allowed is more than the first frame, {first_frame}."
        )


def key_days(
    obj: bpy.types.Object,
    scene: bpy.types.Scene,
    blocks: NewBlocks,
    days: tuple[float, float],
    frames: tuple[int, int],
) -> None:
    """Key the day on an object, linear between two frames and held outside them.

    Earlier keys of the day are replaced; other animation of the object is left alone, and so are
    other objects with the same action: this one gets a copy.
    """
    action, slot = _own_action(obj, blocks)
    curve, is_new = _curve(action, slot)
    curve.keyframe_points.clear()
    curve.keyframe_points.add(len(days))
    for key, day, frame in zip(curve.keyframe_points, days, frames, strict=True):
        key.co, key.interpolation = (frame, day), "LINEAR"
    curve.extrapolation = "CONSTANT"
    curve.update()
    obj[DAY_PROPERTY] = curve.evaluate(scene.frame_current_final)
    cast(Any, obj).id_properties_ui(DAY_PROPERTY).update(description="Day of the tan", precision=2)
    animation = obj.animation_data or obj.animation_data_create()
    if is_new or (animation.action, animation.action_slot) != (action, slot):
        # The assignment has Blender sort out anew what follows what, which takes long in a large
        # scene; without, a strip of the NLA would go on covering a new action.
        animation.action = action
        animation.action_slot = slot
    action.update_tag()
    obj.update_tag()


def _own_action(
    obj: bpy.types.Object, blocks: NewBlocks
) -> tuple[bpy.types.Action, bpy.types.ActionSlot]:
    """An action and a slot of it that move this object alone."""
    animation = obj.animation_data
    action = animation.action if animation else None
    slot = animation.action_slot if animation else None
    if action is None:
        action = blocks.add(bpy.data.actions.new(f"{obj.name}Action"))
        slot = None
    elif slot is not None and any(user != obj for user in slot.users()):
        identifier = slot.identifier
        action = blocks.add(action.copy())
        slot = action.slots[identifier]
    return action, slot or action.slots.new(id_type="OBJECT", name=obj.name)


def _curve(action: bpy.types.Action, slot: bpy.types.ActionSlot) -> tuple[bpy.types.FCurve, bool]:
    """The curve of the day, and whether it is new."""
    bag = action_get_channelbag_for_slot(action, slot)
    if bag is None:
        layer = action.layers[0] if action.layers else action.layers.new("Layer")
        strip: Any = layer.strips[0] if layer.strips else layer.strips.new(type="KEYFRAME")
        bag = strip.channelbag(slot, ensure=True)
    curve = bag.fcurves.find(DATA_PATH)
    return curve or bag.fcurves.new(DATA_PATH), curve is None
