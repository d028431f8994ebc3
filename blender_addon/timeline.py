"""The day on the timeline: a keyed custom property of the object, which needs no script."""

from bpy_extras.anim_utils import action_get_channelbag_for_slot

from hylios.errors import InputError

from .nodes import DAY_PROPERTY

DATA_PATH = f'["{DAY_PROPERTY}"]'


def check_frames(first_frame: int, last_frame: int) -> None:
    """Raise InputError unless the last frame comes after the first."""
    if not last_frame > first_frame:
        raise InputError(
            f"last frame is {last_frame}; allowed is more than the first frame, {first_frame}."
        )


def key_days(obj, scene, days: tuple[float, float], frames: tuple[int, int]) -> None:
    """Key the day on an object, linear between two frames and held outside them.

    Earlier keys of the day are replaced; other animation of the object is left alone.
    """
    _remove_curve(obj)
    for day, frame in zip(days, frames, strict=True):
        obj[DAY_PROPERTY] = float(day)
        obj.keyframe_insert(DATA_PATH, frame=frame)
    curve = _curves(obj).find(DATA_PATH)
    curve.extrapolation = "CONSTANT"
    for key in curve.keyframe_points:
        key.interpolation = "LINEAR"
    obj.id_properties_ui(DAY_PROPERTY).update(description="Day of the tan", precision=2)
    obj[DAY_PROPERTY] = curve.evaluate(scene.frame_current_final)


def _curves(obj):
    animation = obj.animation_data
    bag = action_get_channelbag_for_slot(animation.action, animation.action_slot)
    return bag.fcurves if bag is not None else None


def _remove_curve(obj) -> None:
    if obj.animation_data is None or obj.animation_data.action is None:
        return
    curves = _curves(obj)
    curve = curves.find(DATA_PATH) if curves is not None else None
    if curve is not None:
        curves.remove(curve)
