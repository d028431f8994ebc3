"""The front among points of time against error, and choosing a point of it."""

from collections.abc import Sequence

import numpy as np

from hylios.errors import InputError, require_range
from lut_builder.trade.points import NUMBERS, Point, named

LEAST_GAIN = 0.02
"""Share by which a point of the front has less error than the one before it."""


def nondominated(seconds: np.ndarray, errors: np.ndarray, gain: float = LEAST_GAIN) -> np.ndarray:
    """Numbers of the points of the front, the fastest first.

    Each has an error smaller by the share `gain` than every faster point's.

    Parameters
    ----------
    seconds, errors : (N,) arrays
    """
    kept, least = [], np.inf
    for number in np.lexsort((errors, seconds)):
        if errors[number] < (1.0 - gain) * least:
            kept.append(number)
            least = errors[number]
    return np.array(kept, dtype=int)


def worst(skins: Sequence[Sequence[Point]]) -> list[Point]:
    """Points that hold for all of some skins: of each table the most time and the largest errors.

    Parameters
    ----------
    skins : sequence of sequence of Point
        The same tables of each skin, in the same order.
    """
    return [
        Point(
            alike[0].settings,
            **{name: max(getattr(point, name) for point in alike) for name in NUMBERS},
        )
        for alike in zip(*skins, strict=True)
    ]


def front(points: Sequence[Point]) -> list[Point]:
    """The front of tables with a profile, then that of tables without, each the fastest first.

    The presets stand among them even where others beat them by little.
    """
    kept = []
    for has_profile in (True, False):
        some = [point for point in points if point.settings.has_profile is has_profile]
        seconds = np.array([point.seconds() for point in some])
        errors = np.array([point.error for point in some])
        ahead = {*nondominated(seconds, errors)}
        ahead |= {number for number, point in enumerate(some) if named(point)}
        kept += [some[number] for number in sorted(ahead, key=seconds.__getitem__)]
    return kept


def cheapest(points: Sequence[Point], max_delta_e: float, *, cores: int, profile: bool) -> Point:
    """The point that takes the fewest seconds of those with no larger error.

    Raises
    ------
    InputError
        If there is none.
    """
    limit = require_range("largest difference", max_delta_e, 1e-3, 100.0, "CIEDE2000")
    some = _alike(points, profile)
    good = [point for point in some if point.error <= limit]
    if not good:
        least = min(point.error for point in some)
        raise InputError(
            f"largest difference is {limit:g} CIEDE2000; the best table measured has {least:.3g}."
        )
    return min(good, key=lambda point: point.seconds(cores))


def best(points: Sequence[Point], max_seconds: float, *, cores: int, profile: bool) -> Point:
    """The point of least error of those that take no more seconds.

    Raises
    ------
    InputError
        If there is none.
    """
    limit = require_range("time", max_seconds, 1e-3, 1e7, "s")
    some = _alike(points, profile)
    quick = [point for point in some if point.seconds(cores) <= limit]
    if not quick:
        least = min(point.seconds(cores) for point in some)
        raise InputError(
            f"time is {limit:g} s; the fastest table measured takes {least:.2g} s on {cores} cores."
        )
    return min(quick, key=lambda point: point.error)


def _alike(points: Sequence[Point], profile: bool) -> list[Point]:
    some = [point for point in points if point.settings.has_profile is profile]
    if not some:
        raise InputError(f"the front has no table with{'' if profile else 'out'} a profile.")
    return some
