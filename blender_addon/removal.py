"""Remove Tan: an object's materials, slots and animation as they were before Apply."""

import bpy

from hylios.errors import InputError

from .apply import keep_response
from .props import settings_of
from .scene.changes import Changes
from .scene.day_removal import remove_day
from .scene.removal import take_off
from .scene.slots import has_tan
from .scene.timeline import require_no_tweak_mode
from .scene.vertex_groups import remove_own
from .tannable import tannable


def remove_tan(obj: bpy.types.Object | None, *, keep_timing: bool = False) -> str:
    """Take an object's tan off, and return a sentence on what was done.

    Its settings and masks stay, so Apply gives the same tan again. No other object changes its
    look. Nothing in the file is changed where an error is raised.

    Parameters
    ----------
    keep_timing : bool
        Whether the keys of the day stay.

    Raises
    ------
    InputError
        If the object has no tan, or cannot be changed.
    """
    obj = tannable(obj)
    if not has_tan(obj):
        raise InputError(f"{obj.name!r} has no tan; Apply Tan gives it one.")
    settings = settings_of(obj)
    # Keys of the artist's own stay; a file from before Apply noted its keys has only ours.
    takes_day = not keep_timing and (any(settings.keyed) or not settings.applied)
    if takes_day:
        require_no_tweak_mode(obj)
    with Changes() as changes:
        keep_response(settings, changes)
        said = take_off(obj, changes)
        remove_own(obj, changes)
        if takes_day:
            said += remove_day(obj, changes, settings.own_day)
            changes.set(settings, "keyed", (0.0, 0.0, 0.0, 0.0))
        if not keep_timing:
            changes.set(settings, "own_day", "")
        changes.set(settings, "applied", "")
    return " ".join([f"Removed the tan of {obj.name!r}.", *said])
