"""Timers that wait until nothing has happened for a while."""

from collections.abc import Callable

import bpy

Timer = Callable[[], float | None]
"""What Blender calls: it returns the seconds until the next call, or None."""


def wait(timer: Timer, seconds: float) -> None:
    """Have a timer called in so many seconds, not before; without a window nothing calls it."""
    if not bpy.app.background:
        forget(timer)
        bpy.app.timers.register(timer, first_interval=seconds)


def forget(timer: Timer) -> None:
    """Have a timer called no more."""
    if bpy.app.timers.is_registered(timer):
        bpy.app.timers.unregister(timer)
