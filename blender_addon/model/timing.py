"""On which frames a tan's first and last day lie."""

from dataclasses import dataclass

from hylios.errors import InputError, require_range

from .settings import check_frames

SCENE, SPEED, FRAMES, OWN = "SCENE", "SPEED", "FRAMES", "OWN"
"""Ways to lay days on frames: over the scene's, from a frame on at a speed, between two frames, and
by the artist's own keys."""

LEAST_SPEED, LARGEST_SPEED = 1e-3, 1e4
"""Range of days in a second of animation."""


@dataclass(frozen=True)
class Timing:
    """What an artist has set on the timeline.

    Attributes
    ----------
    way : str
        One of the above.
    first_frame, last_frame : int
        Of way FRAMES; of way SPEED, the first.
    days_per_second : float
        Of way SPEED.
    """

    way: str
    first_frame: int
    last_frame: int
    days_per_second: float


def frames_of(
    timing: Timing, days: tuple[float, float], scene: tuple[int, int], frames_per_second: float
) -> tuple[float, float]:
    """Frames of the first and the last day.

    Parameters
    ----------
    days : pair of float
        The first and the last.
    scene : pair of int
        First and last frame of the scene.

    Raises
    ------
    InputError
        If a frame or the speed is out of range, or the last frame does not come after the first.
    """
    if timing.way == SPEED:
        speed = require_range(
            "speed", timing.days_per_second, LEAST_SPEED, LARGEST_SPEED, "days a second"
        )
        check_frames(timing.first_frame, timing.first_frame + 1)
        first = float(timing.first_frame)
        return first, first + (days[1] - days[0]) / speed * frames_per_second
    if timing.way == FRAMES:
        check_frames(timing.first_frame, timing.last_frame)
        return float(timing.first_frame), float(timing.last_frame)
    if timing.way in (SCENE, OWN):
        # A scene of one frame shows the first day.
        return float(scene[0]), float(max(scene[1], scene[0] + 1))
    raise InputError(f"timing is {timing.way!r}; allowed are {SCENE}, {SPEED}, {FRAMES} and {OWN}.")
