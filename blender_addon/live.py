"""Live: what is changed in the panel shows at once, without Apply.

A handler notices that settings differ from those that a tan shows (`applied`) and registers a
timer; so nothing is changed while Blender evaluates or draws. A new schedule only gets new pixels
in the images of the history, fast and roughly at first; after a rest, and before the file is saved,
they are made exact and lasting. All other changes are applied as the button does, those of
the biology roughly at first, in place if no other object shows the same look.

Blender's undo takes what changed since its last step for unchanged. So pixels change in place, and
Apply is followed by a step of the undo history. After undo and redo pixels are compared with the
settings; what else differs waits for Apply, since a new step would cut the way back.
"""

from contextlib import suppress
from typing import Any, cast

import bpy
from bpy.app.handlers import persistent

from hylios.errors import InputError

from . import applied, timers
from .apply import apply_tan
from .model.history import DRAG, FULL, Precision
from .model.own_colour import offsets
from .model.tan import history_of, look_of, peeling_of
from .props import settings_of
from .scene import images, nodes
from .scene.ownership import Users
from .scene.several import own_history
from .several import (
    fits,
    has_several,
    is_at_hand,
    is_in_place,
    show_day,
    show_exact,
)
from .tannable import tannable

REST_SECONDS = 0.3
"""After so long without a change, a tan is made exact."""

BUSY_SECONDS = 0.2
"""While Blender renders, a change waits so long before it looks again."""

DAY_SECONDS = 0.04
"""While a thread computes the day that shows, a change waits so long before it looks again."""

AHEAD_SECONDS = 0.1
"""While a thread computes, a change waits so long before it looks again."""


@persistent
def notice(scene: bpy.types.Scene, depsgraph: Any) -> None:
    """Handler: see to objects whose settings have just changed."""
    updated = (item.id.original for item in depsgraph.updates)
    objects = [block for block in updated if isinstance(block, bpy.types.Object)]
    if any(_is_stale(obj, scene) for obj in objects):
        timers.wait(show_changes, 0.0)


@persistent
def after_undo(*_: Any) -> None:
    """Handler: pixels are those of the settings to which an undo or a redo has led.

    Without a window no change had shown before Apply, so they are those of the last one.
    """
    scene = _scene()
    for obj in scene.objects:
        settings = settings_of(obj)
        if not (settings.group and settings.live and settings.applied):
            continue
        if timers.are_called():
            text = applied.text_of(obj, scene)
            _restore_look(obj, text)
            _restore(obj, text)
        else:
            look = nodes.own_look(settings.group) or {}
            for image in {*own_history(settings.group), *look.values()}:
                images.show_packed(image)
    timers.wait(make_exact, REST_SECONDS)


@persistent
def after_loading(*_: Any) -> None:
    """Handler: a file that Blender saved by itself may hold what had not been made exact."""
    if _stale(_scene()):
        timers.wait(show_changes, 0.0)


@persistent
def before_saving(*_: Any) -> None:
    """Handler: nothing is saved that only shows until the file is closed."""
    if not bpy.app.background:
        scene = _scene()
        _show(_stale(scene), scene, FULL)


def show_changes() -> float | None:
    """Timer: show what has changed; the seconds until it must be called again."""
    if bpy.app.is_job_running("RENDER"):
        return BUSY_SECONDS
    scene = _scene()
    stale = _stale(scene)
    waiting = [obj for obj in stale if _waits_for_day(obj, scene)]
    _show([obj for obj in stale if obj not in waiting], scene, DRAG)
    if waiting:
        timers.forget(make_exact)
        return DAY_SECONDS
    timers.wait(make_exact, REST_SECONDS)
    return None


def make_exact() -> float | None:
    """Timer: make exact and lasting what has changed; the seconds until it must be called again.

    What takes seconds a thread computes ahead, so that Blender goes on.
    """
    if bpy.app.is_job_running("RENDER"):
        return BUSY_SECONDS
    scene = _scene()
    stale = _stale(scene)
    ready = [obj for obj in stale if not timers.are_called() or _is_ready(obj)]
    _show(ready, scene, FULL)
    return None if len(ready) == len(stale) else AHEAD_SECONDS


def _is_ready(obj: bpy.types.Object) -> bool:
    """Whether an object's settings are made exact at once, as those that are refused are."""
    try:
        return is_at_hand(obj)
    except InputError:
        return True


def _waits_for_day(obj: bpy.types.Object, scene: bpy.types.Scene) -> bool:
    """Whether a thread computes the day that shows, of an object with several masks."""
    text = applied.text_of(obj, scene)
    is_one = not has_several(obj) or not _is_schedule(obj, text) or not _is_alone(obj)
    if is_one or (settings_of(obj).applied == text and _lasts(obj, text)):
        return False
    with suppress(InputError):
        tannable(obj)
        # Every frame that plays would be another day, so that none came to an end.
        any_day = timers.is_playing()
        return not show_day(obj, applied.content(text, rough=True), any_day=any_day)
    return False


def _show(objects: list[bpy.types.Object], scene: bpy.types.Scene, precision: Precision) -> None:
    """Show objects' settings: those of one whose Apply would refuse stay as they are."""
    has_applied = False
    for obj in objects:
        try:
            has_applied |= _show_one(obj, scene, precision)
        except InputError:
            pass  # Apply says why, when the artist wants to know
    if has_applied:
        bpy.ops.ed.undo_push(message="Apply Tan")


def _show_one(obj: bpy.types.Object, scene: bpy.types.Scene, precision: Precision) -> bool:
    """Show an object's settings, and return whether Apply did it; else pixels were changed."""
    settings, text = settings_of(obj), applied.text_of(obj, scene)
    if settings.applied == text and _is_alone(obj) and _lasts(obj, text):
        _restore_look(obj, text)
        _restore(obj, text)
    elif _is_schedule(obj, text) and _is_alone(obj) and _can_show(obj, text, precision):
        _restore_look(obj, text)
        show_schedule(obj, text, precision)
    elif precision is DRAG and _is_only_look_changed(obj, text):
        show_look(obj, text, rough=True)
    else:
        takes_longer = settings.biology.is_changed() or has_several(obj)
        apply_tan(obj, scene, rough=precision is DRAG and takes_longer, live=True)
        return True
    return False


def _is_schedule(obj: bpy.types.Object, text: str) -> bool:
    """Whether no setting but the schedule differs from those that Apply has last shown."""
    former = settings_of(obj).applied
    return text == former or applied.is_only_schedule_changed(former, text)


def _can_show(obj: bpy.types.Object, text: str, precision: Precision) -> bool:
    """Whether another schedule goes into the images that are there."""
    former = settings_of(obj).applied
    if precision is DRAG:
        # Of the settings that were applied last a rough history would count as exact, and stay.
        return text != former or has_several(obj)
    is_moved = applied.is_sensitivity_changed(former, text)
    return not is_moved and (not has_several(obj) or fits(obj))


def _lasts(obj: bpy.types.Object, text: str) -> bool:
    """Whether the packed files of an object's history come from the settings of a text."""
    return all(image.get(images.LASTING) == applied.digest(text) for image in _history(obj))


def show_schedule(obj: bpy.types.Object, text: str, precision: Precision) -> None:
    """Put an object's schedule into the images of its history; lasting if it is exact.

    Parameters
    ----------
    text : str
        Of its settings, as `applied.text_of` has it.

    Raises
    ------
    InputError
        If Apply would refuse.
    """
    tannable(obj)
    settings = settings_of(obj)
    if has_several(obj):
        # A picture at once has come from a thread (`show_day`).
        if precision is FULL:
            show_exact(obj, applied.digest(text))
    else:
        values = settings.values()
        history, peeling = history_of(values, precision), peeling_of(values)
        told = [history.coordinates, history.lines, *([] if peeling is None else [peeling])]
        for image, values in zip(_history(obj), told, strict=True):
            images.swap_pixels(image, values, applied.digest(text), pack=precision is FULL)
    if precision is FULL:
        settings.applied = text


def show_look(obj: bpy.types.Object, text: str, *, rough: bool) -> None:
    """Put an object's biology into the images of its look; else as `show_schedule`."""
    tannable(obj)
    settings = settings_of(obj)
    look = look_of(settings.values(), rough=rough)
    content = applied.look_digest(text, rough=rough)
    for role, image in (nodes.own_look(settings.group) or {}).items():
        values = offsets(look) if role == "own_image" else getattr(look, role)
        images.swap_pixels(image, values, content, pack=True)
    nodes.set_bulge(settings.group, look.thickness, look.bulge)


def _is_only_look_changed(obj: bpy.types.Object, text: str) -> bool:
    """Whether only biology changed, in a look that no other object shows."""
    settings = settings_of(obj)
    look = nodes.own_look(settings.group)
    if look is None or not applied.is_only_biology_changed(settings.applied, text):
        return False
    users = Users()
    return not any(users.others(image, obj) for image in look.values())


def _restore_look(obj: bpy.types.Object, text: str) -> None:
    """Have the images of a look show what they hold, which must be that of the biology."""
    look = nodes.own_look(settings_of(obj).group)
    if look is None:
        return
    former = settings_of(obj).applied
    wanted = applied.look_digest(text)
    shown = {image.get(images.SHOWN) for image in look.values()}
    if shown == {None} and wanted == applied.look_digest(former):
        shown = {wanted}
    for image in look.values():
        images.reread(image)
    is_its_own = wanted == applied.look_digest(former) or _is_only_look_changed(obj, text)
    if shown != {wanted} and is_its_own:
        with suppress(InputError):
            show_look(obj, text, rough=False)


def _restore(obj: bpy.types.Object, text: str) -> None:
    """Have a history be that of settings; where that takes another look it stays as it was."""
    settings = settings_of(obj)
    is_moved = applied.is_sensitivity_changed(settings.applied, text)
    if is_moved or not _is_schedule(obj, text) or not _is_alone(obj):
        settings.undone = text
        for image in _history(obj):
            images.show_packed(image)
        return
    restored = [images.restore(image, applied.digest(text)) for image in _history(obj)]
    if not all(restored) and has_several(obj):
        timers.wait(show_changes, 0.0)
    elif not all(restored):
        try:
            show_schedule(obj, text, FULL)
        except InputError:
            settings.undone = text


def _is_alone(obj: bpy.types.Object) -> bool:
    """Whether an object shows its history alone, in the images that Apply made for its masks."""
    return is_in_place(obj) and not Users().others(settings_of(obj).group, obj)


def _history(obj: bpy.types.Object) -> tuple[bpy.types.Image, ...]:
    return own_history(settings_of(obj).group)


def _scene() -> bpy.types.Scene:
    return cast(Any, bpy.context).scene


def _stale(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    return [obj for obj in scene.objects if _is_stale(obj, scene)]


def _is_stale(obj: bpy.types.Object, scene: bpy.types.Scene) -> bool:
    settings = settings_of(obj)
    if not (settings.group and settings.live and settings.applied):
        return False
    text = applied.text_of(obj, scene)
    if settings.applied != text:
        return settings.undone != text
    return not _is_right(obj, text)


def _is_right(obj: bpy.types.Object, text: str) -> bool:
    """Whether pixels come from the settings of a text, not from a drag that has ended there."""
    look = nodes.own_look(settings_of(obj).group) or {}
    of_history = {image.get(images.SHOWN) for image in _history(obj)}
    of_look = {image.get(images.SHOWN) for image in look.values()}
    return of_history <= {None, applied.digest(text)} and of_look <= {
        None,
        applied.look_digest(text),
    }


HANDLERS = (
    ("depsgraph_update_post", notice),
    ("undo_post", after_undo),
    ("redo_post", after_undo),
    ("load_post", after_loading),
    ("save_pre", before_saving),
)


def register() -> None:
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).remove(handler)
    for timer in (show_changes, make_exact):
        timers.forget(timer)
