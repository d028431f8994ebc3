"""Live: what is changed in the panel shows at once, without Apply.

A handler notices that settings differ from those that a tan shows (`applied`) and registers a
timer; so nothing is changed while Blender evaluates or draws. A new schedule only gets new pixels
in the images of the history, fast and roughly; when nothing has changed for a while, and before the
file is saved, Apply makes it exact and lasting. Undo and redo bring settings and what was applied
back together, so the same comparison finds what they left stale.
"""

from typing import Any, cast

import bpy
from bpy.app.handlers import persistent

from hylios.errors import InputError

from . import applied
from .apply import apply_tan, tannable
from .model.history import DRAG
from .model.tan import history_of
from .props import settings_of
from .scene import images, nodes
from .scene.ownership import Users

REST_SECONDS = 0.3
"""After so long without a change, a tan is made exact."""

BUSY_SECONDS = 0.2
"""While Blender renders, a change waits so long before it looks again."""


@persistent
def notice(scene: bpy.types.Scene, depsgraph: Any = None) -> None:
    """Handler: see to objects whose settings have just changed."""
    if depsgraph is None:
        objects = list(scene.objects)
    else:
        updated = (item.id.original for item in depsgraph.updates)
        objects = [block for block in updated if isinstance(block, bpy.types.Object)]
    if any(_is_stale(obj, scene) for obj in objects) and not bpy.app.background:
        _wait(show_changes, 0.0)


@persistent
def before_saving(*_: Any) -> None:
    """Handler: nothing that only shows until the file is closed is saved."""
    make_exact()


def show_changes() -> float | None:
    """Timer: show what has changed, roughly; the seconds until it must be called again."""
    if bpy.app.is_job_running("RENDER"):
        return BUSY_SECONDS
    scene = _scene()
    for obj in _stale(scene):
        try:
            show(obj, scene)
        except InputError:
            pass  # Apply says why, when the artist wants to know
    _wait(make_exact, REST_SECONDS)
    return None


def show(obj: bpy.types.Object, scene: bpy.types.Scene) -> None:
    """Show an object's settings: a new schedule roughly, all else as Apply does.

    Raises
    ------
    InputError
        If Apply would refuse.
    """
    group = settings_of(obj).group
    shown = None if Users().others(group, obj) else nodes.own_history(group)
    if shown is None or not applied.is_only_schedule_changed(obj, scene):
        apply_tan(obj, scene)
        return
    tannable(obj)
    history = history_of(settings_of(obj).values(), DRAG)
    states, places = shown
    images.swap_pixels(states, history.coordinates)
    images.swap_pixels(places, history.places)


def make_exact() -> float | None:
    """Timer: apply what has changed; the seconds until it must be called again."""
    if bpy.app.is_job_running("RENDER"):
        return BUSY_SECONDS
    scene = _scene()
    for obj in _stale(scene):
        try:
            apply_tan(obj, scene)
        except InputError:
            pass
    return None


def _scene() -> bpy.types.Scene:
    return cast(Any, bpy.context).scene


def _stale(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    return [obj for obj in scene.objects if _is_stale(obj, scene)]


def _is_stale(obj: bpy.types.Object, scene: bpy.types.Scene) -> bool:
    settings = settings_of(obj)
    return bool(settings.group) and settings.live and applied.is_changed(obj, scene)


def _wait(timer: Any, seconds: float) -> None:
    """Have a timer called in so many seconds, not before."""
    if bpy.app.timers.is_registered(timer):
        bpy.app.timers.unregister(timer)
    bpy.app.timers.register(timer, first_interval=seconds)


HANDLERS = (
    ("depsgraph_update_post", notice),
    ("undo_post", notice),
    ("redo_post", notice),
    ("save_pre", before_saving),
)


def register() -> None:
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).remove(handler)
    for timer in (show_changes, make_exact):
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
