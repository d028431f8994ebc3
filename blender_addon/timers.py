"""Timers that wait until nothing has happened for a while."""

from collections.abc import Callable
from typing import Any, cast

import bpy

Timer = Callable[[], float | None]
"""What Blender calls: it returns the seconds until the next call, or None."""


def are_called() -> bool:
    """Whether there is a window: without one Blender calls no timers."""
    return not bpy.app.background


def is_playing() -> bool:
    """Whether a window plays the animation."""
    windows = cast(Any, bpy.context).window_manager.windows
    return any(window.screen.is_animation_playing for window in windows)


def wait(timer: Timer, seconds: float) -> None:
    """Have a timer called in so many seconds, not before, where there is a window."""
    if are_called():
        forget(timer)
        bpy.app.timers.register(timer, first_interval=seconds)


def forget(timer: Timer) -> None:
    """Have a timer called no more."""
    if bpy.app.timers.is_registered(timer):
        bpy.app.timers.unregister(timer)
