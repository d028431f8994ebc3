"""The days of an object's tan on its scene's timeline."""

from functools import partial

import bpy

from hylios.errors import InputError

from . import applied
from .model.curve import curve_of, is_seen
from .model.settings import check_days
from .model.timing import OWN, SCENE, frames_of
from .props import SkinTanSettings, settings_of
from .scene import images, several, timeline
from .scene.changes import Changes

NEAR = 1.0
"""Days by which the frame with the darkest day may miss it."""

NOT_SEEN = "No tan can be seen: this skin hardly tans, or gets too little sun."

Pair = tuple[float, float]
"""First and last."""


def reset(obj: bpy.types.Object, scene: bpy.types.Scene) -> str:
    """Key the day anew by an object's settings, whatever keys it has; a sentence on it.

    Raises
    ------
    InputError
        If the object cannot be keyed, or a setting is out of range.
    """
    timeline.check_day_property(obj)
    settings = settings_of(obj)
    days = settings.first_day, settings.last_day
    check_days(*days)
    with Changes() as changes:
        if settings.timing == OWN:
            changes.set(settings, "timing", SCENE)
        seen = applied.scene_frames(scene)
        at = frames(settings, days, seen)
        _note_own_day(obj, changes)
        _key(obj, scene, days, at, changes)
        _note_frames(obj, scene, seen, changes)
        changes.at_the_end(partial(timeline.remove_modifiers, obj))
    said = f"Day {days[0]:g} is at frame {at[0]:g}, day {days[1]:g} at frame {at[1]:g}."
    if timeline.is_driven(obj):
        return f"{timeline.DRIVEN} They are: {said}"
    return " ".join([said, *timeline.mutings(obj)])


def show_darkest(obj: bpy.types.Object, scene: bpy.types.Scene) -> str:
    """Go to the frame with an object's darkest day, and return a sentence on it.

    Skin that burns and does not tan shows its reddest day.

    Raises
    ------
    InputError
        If the object's day has no keys, or a setting cannot be used.
    """
    values = settings_of(obj).values()
    curve = curve_of(values)
    day, what = curve.darkest_day, "darkest"
    if not is_seen(curve):
        if not curve.burns:
            return NOT_SEEN
        day, what = float(curve.days[curve.redness.argmax()]), "reddest"
    if timeline.is_moved_elsewhere(obj):
        return "A driver or a strip of the NLA governs the day of the tan; the frame stays."
    frame = timeline.frame_of_day(obj, scene, day)
    if frame is None:
        raise InputError(f"The day of {obj.name!r} has no keys; Apply Tan or Reset sets them.")
    scene.frame_set(frame)
    shown = timeline.shown_day(obj)
    if shown is not None and abs(shown - day) > NEAR:
        return (
            f"Frame {frame} shows day {shown:.0f}, the nearest to the {what} day, {day:.0f}, in "
            "this scene's frames."
        )
    return f"Frame {frame} shows the {what} day, day {day:.0f}."


def frames(settings: SkinTanSettings, days: Pair, seen: applied.Frames) -> Pair:
    """Frames of the first and the last day, by a scene's; errors as in `frames_of`."""
    return frames_of(settings.timing_values(), days, seen[:2], seen[2] / seen[3])


def key(
    obj: bpy.types.Object, scene: bpy.types.Scene, days: Pair, at: Pair, changes: Changes
) -> list[str]:
    """Key the days at frames unless the artist keys or drives them; sentences on that."""
    settings = settings_of(obj)
    if timeline.is_driven(obj) and not timeline.has_keys(obj):
        return []  # keys would have no effect
    said = _note_own_day(obj, changes)
    if settings.timing == OWN:
        timeline.set_first_day(obj, days[0], changes)
        return timeline.mutings(obj) if is_timed(obj) else [_without_keys(obj)]
    keyed = tuple(settings.keyed) if any(settings.keyed) else (*days, *at)
    if timeline.has_own_keys(obj, keyed):
        if not timeline.has_keys(obj):
            return [_without_keys(obj)]
        stay = "The keys of the day are your own and stay as they are (Reset sets them)."
        return [stay, *timeline.mutings(obj)]
    _key(obj, scene, days, at, changes)
    return said + timeline.mutings(obj)


def is_timed(obj: bpy.types.Object) -> bool:
    """Whether keys or a driver govern the day of an object."""
    return timeline.is_driven(obj) or timeline.has_keys(obj)


def _without_keys(obj: bpy.types.Object) -> str:
    day = timeline.shown_day(obj) or 0.0
    return (
        f"The day of {obj.name!r} has no keys, so all frames show day {day:g}: key the property "
        f"{timeline.DAY_PROPERTY!r}, or let Reset key it."
    )


def _note_own_day(obj: bpy.types.Object, changes: Changes) -> list[str]:
    """Remember the artist's own number of that name before its first use; a sentence on it."""
    settings = settings_of(obj)
    is_first = not any(settings.keyed) and not settings.applied and settings.group is None
    own = timeline.own_day(obj) if is_first else ""
    if not own:
        return []
    changes.set(settings, "own_day", own)
    return [f"The property {timeline.DAY_PROPERTY!r}, which you had, is the day of the tan now."]


def _key(
    obj: bpy.types.Object, scene: bpy.types.Scene, days: Pair, at: Pair, changes: Changes
) -> None:
    timeline.key_days(obj, scene, changes, days, at)
    changes.set(settings_of(obj), "keyed", (*days, *at))


def _note_frames(
    obj: bpy.types.Object, scene: bpy.types.Scene, seen: applied.Frames, changes: Changes
) -> None:
    """Remember where the days lie now; what else has changed since Apply still has."""
    settings = settings_of(obj)
    if settings.group is None or applied.is_changed(obj, scene):
        return
    applied.note(obj, applied.text_of(obj, scene, seen), changes)
    images.note_content(several.own_history(settings.group), applied.digest(settings.applied))
