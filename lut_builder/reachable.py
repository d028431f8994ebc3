"""Which tanning states a table spans, and where its knots lie.

A table reaches from skin with hardly any melanin up to a freckle at the height of its tan, and over
blood. Melanin's knots lie where the look changes: closely where there is much to see, more closely
still among the melanin that sunshine can bring about.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hylios.adding import solve
from hylios.errors import InputError
from hylios.history import history_of_shares, require_last_day
from hylios.skin import Skin
from hylios.skin.skin import MOST_BLOOD
from hylios.table import LookAxes
from hylios.tanning import Exposures, Spread, spread_of
from hylios.tissue import Stack

DAYS = 60
MOST_EXPOSURES = 11
LEAST_DOSE, MOST_DOSE = 0.35, 10.5
"""Limits of the random schedules: days, exposures, and doses as multiples of the MMD."""

SCHEDULES = 120
"""Schedules by which axes are chosen."""

HOURS_BETWEEN = 2.0
"""Hours between two states of a scene."""

MARGIN = 0.05
"""How far the outermost knots lie beyond the states seen, as a share of their span."""

DEPARTURES, OTHERS = (-0.7, 0.4), 24
"""How far the spread's axis reaches at least, for tans of other kinetics, and schedules of them."""

BEYOND = (1.0, 0.35)
"""Where knots lie on the way to tans of other kinetics that are farther off."""

MOST_LEAN = 10.0
"""Most that the second log-ratio may depart from the sheet where the first does by 1."""

LEAST_SPAN = 1e-6
"""Least span of the states along an axis, in the logarithm. A narrower axis comes from rounding and
gets one knot, like the spread's in skin that makes no melanin in the sun."""

LEAST_MELANIN = -6.0
"""Logarithm of the least melanin: a quarter of a percent, which cannot be seen."""

FRECKLE = 2.5
"""Melanin of a freckle relative to the skin's around it. ESTIMATE."""

SEEN_NM = (450.0, 550.0, 650.0)
"""Wavelengths by whose lightness melanin's knots are placed."""

PLACES = 41
"""Melanin contents at which it is computed."""

EVENLY = 12.0
"""Lightness that counts as much as a step of 1 in melanin's logarithm."""

WEIGHTS = {"pale": 1.0, "tan": 10.0, "freckle": 2.0}
"""How closely knots lie below the untanned skin's melanin, within that of tans, and beyond."""

SHORT = 1.0 / 3.0
"""Part of a step of the whole table's below which a scene's last step is none of its own."""

NEAR = 0.01
"""Least step of a scene's axis, in the logarithm: .09 CIEDE2000 at most."""


def reachable_states(skin: Skin, schedules: int, seed: int) -> np.ndarray:
    """States (N, 4) that random schedules of sunshine lead through, every six hours of 60 days.

    Each schedule has 1 to 11 exposures at random hours, each of 0.35 to 10.5 MMD.
    """
    random = np.random.default_rng(seed)
    hours = 24 * DAYS
    doses = np.zeros((schedules, hours))
    for schedule in doses:
        exposures = random.integers(1, MOST_EXPOSURES + 1)
        when = random.choice(hours, exposures, replace=False)
        schedule[when] = skin.mmd * random.uniform(LEAST_DOSE, MOST_DOSE, exposures)
    history = skin.history(Exposures(np.arange(hours), doses), hours)
    return history.states[:, ::6].reshape(-1, 4)


def reached_states(skin: Skin, exposures: Exposures, days: float) -> np.ndarray:
    """States (N, 4) of a skin anywhere on a body, from day 0 to a last one.

    Raises
    ------
    InputError
        If the last day is out of range.
    """
    last = 24.0 * require_last_day(days)
    history = history_of_shares(
        exposures,
        skin.dynamics,
        hours=np.append(np.arange(0.0, last, HOURS_BETWEEN), last),
        mmd=skin.mmd,
        med=skin.med,
    )
    return history.states.reshape(-1, 4)


def untanned_state(skin: Skin) -> np.ndarray:
    """The state (4,) without sun.

    Raises
    ------
    InputError
        If the way the skin tans leaves a layer without melanin: no ratio to nothing is a state.
    """
    if not np.all(skin.untanned_melanin > 0.0):
        raise InputError(
            f"melanin without sun is {skin.untanned_melanin.tolist()} of basale, spinosum, "
            "granulosum; a table needs more than 0 in each."
        )
    return skin.untanned_state


def choose_axes(skin: Skin, knots: Sequence[int], seed: int = 0) -> LookAxes:
    """Axes with numbers of knots of melanin, thickness, spread and blood; those left out have 1.

    The untanned skin, at 0 on every axis, is a knot. An axis along which nothing changes gets one.

    Raises
    ------
    InputError
        As `untanned_state`.
    """
    untanned_state(skin)
    states = reachable_states(skin, SCHEDULES, seed)
    sheet = spread_of(skin.dynamics, mmd=skin.mmd, med=skin.med)
    axes = LookAxes(sheet, np.zeros(1), 4 * (np.zeros(1),))
    melanin, thickness, *_ = axes.coordinates(states).T
    counts = [*knots, 1, 1, 1][:4]
    spread, bend = _spread(skin, sheet, states, counts[2])
    return replace(
        axes,
        bend=bend,
        knots=(
            _melanin_knots(skin, axes, float(melanin.max()), counts[0]),
            _knots(thickness.min(), thickness.max(), counts[1]),
            spread,
            np.linspace(0.0, np.log(MOST_BLOOD), counts[3]),
        ),
    )


def within(axes: LookAxes, states: np.ndarray) -> LookAxes:
    """Bounded axes over the states (N, 4) of a scene, with the whole table's knots between them.

    The untanned skin is a knot, and the bend is that of the scene's own states.
    """
    places = axes.coordinates(states)
    ends = np.minimum(places.min(axis=0), 0.0), np.maximum(places.max(axis=0), 0.0)
    knots = [
        _knots_within(own, low, high) for own, low, high in zip(axes.knots, *ends, strict=True)
    ]
    bend = _lean(*_departures(axes.sheet, states)) * knots[2]
    return replace(axes, bend=bend, knots=tuple(knots), bounded=True)


def _departures(sheet: Spread, states: np.ndarray) -> np.ndarray:
    """How far the two log-ratios of states (N, 4) depart from the sheet, (2, N)."""
    melanin, thickness = np.log(states[:, :3].sum(axis=1)), np.log(states[:, 3])
    ratios = np.log(states[:, :3] / sheet.untanned) @ sheet.directions
    return (ratios - sheet.log_ratios(melanin, thickness)).T


def _lean(first: np.ndarray, second: np.ndarray) -> float:
    """How far the second log-ratio (N,) departs from the sheet where the first (N,) does by 1."""
    if np.ptp(first) < LEAST_SPAN:
        return 0.0
    lean = float(np.clip(first @ second / (first @ first), -MOST_LEAN, MOST_LEAN))
    return round(lean, 6)  # the same wherever in memory the sums were taken


def _spread(
    skin: Skin, sheet: Spread, states: np.ndarray, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Knots of the spread, evenly apart on either side of the sheet, and the bend at them.

    Where tans of the measured kinetics lie far off, as in dark skin, the knots are as near as the
    skin's own states (N, 4), and two more lie out there.
    """
    first, second = _departures(sheet, states)
    if np.ptp(first) < LEAST_SPAN or count == 1:
        return np.zeros(1), np.zeros(1)
    others = reachable_states(replace(skin, kinetics="measured"), OTHERS, 0)
    far, along = _departures(sheet, others)
    low, high = DEPARTURES
    if far.min() > low:
        knots = _knots(min(first.min(), low), max(first.max(), high), count)
        return knots, _lean(first, second) * knots
    knots = _knots(first.min(), first.max(), count)
    bend = _lean(first, second) * knots
    beyond = np.round((1.0 + MARGIN) * float(far.min()) * np.array(BEYOND), 6)
    return np.append(beyond, knots), np.append(_lean(far, along) * beyond, bend)


def _melanin_knots(skin: Skin, axes: LookAxes, highest: float, count: int) -> np.ndarray:
    """Knots of melanin, one of them 0; `highest` is the most that sunshine brings about."""
    if count == 1:
        return np.zeros(1)
    tanned = highest + MARGIN
    low, high = LEAST_MELANIN, highest + np.log(FRECKLE) + MARGIN
    if count == 2:
        return np.array([0.0, high])
    places = np.linspace(low, high, PLACES)
    middle = 0.5 * (places[1:] + places[:-1])
    weight = np.select(
        [middle < 0.0, middle < tanned],
        [WEIGHTS["pale"], WEIGHTS["tan"] if highest > LEAST_SPAN else WEIGHTS["freckle"]],
        WEIGHTS["freckle"],
    )
    lightness = _lightness(skin, axes, places)
    steps = np.hypot(np.linalg.norm(np.diff(lightness, axis=0), axis=1), EVENLY * np.diff(places))
    length = np.concatenate([[0.0], np.cumsum(weight * steps)])
    untanned = float(np.interp(0.0, places, length))
    below = min(max(round((count - 1) * untanned / length[-1]), 1), count - 2)
    marks = (
        np.linspace(0.0, untanned, below + 1)[:-1],
        np.linspace(untanned, length[-1], count - below)[1:],
    )
    before, after = (np.interp(mark, length, places) for mark in marks)
    return np.concatenate([before, [0.0], after])


def _lightness(skin: Skin, axes: LookAxes, melanin: np.ndarray) -> np.ndarray:
    """Lightness (N, 3), as L*, of three wavelengths at contents of melanin (N,)."""
    states = axes.states(np.stack([melanin, *(3 * [np.zeros_like(melanin)])], axis=-1))
    specimens = [skin.at(state) for state in states]
    total = [solve([Stack.of(one, nm) for one in specimens]).total for nm in SEEN_NM]
    return 116.0 / np.sqrt(len(SEEN_NM)) * np.cbrt(np.transpose(total))


def _knots(lowest: float, highest: float, count: int) -> np.ndarray:
    """Knots over [lowest, highest], evenly spaced on either side of 0, with one at 0.

    A side that is hardly reached at all, such as less thickness than the untanned skin's, gets
    none.
    """
    if highest - lowest < LEAST_SPAN or count == 1:
        return np.zeros(1)
    wider = MARGIN * (highest - lowest)
    low = lowest - wider if lowest < -wider else 0.0
    high = highest + wider if highest > wider else 0.0
    if count < 3:
        return np.sort([0.0, high if high >= -low else low])
    below = round((count - 1) * -low / (high - low))
    if low < 0.0 < high:
        below = min(max(below, 1), count - 2)
    parts = [np.linspace(low, 0.0, below + 1), np.linspace(0.0, high, count - below)[1:]]
    return np.concatenate(parts)


def _knots_within(own: np.ndarray, low: float, high: float) -> np.ndarray:
    """Knots from `low` to `high`, which have 0 between them: those, 0, and an axis's own inside."""
    if len(own) == 1:
        return np.zeros(1)
    ends = np.array([low if low < -NEAR else 0.0, high if high > NEAR else 0.0])
    steps = np.diff(own)
    inner = own[1:-1][
        (own[1:-1] - ends[0] > SHORT * steps[:-1]) & (ends[1] - own[1:-1] > SHORT * steps[1:])
    ]
    knots = np.unique(np.concatenate([ends, [0.0], inner]))
    return knots if len(knots) != 2 else np.linspace(knots[0], knots[1], min(3, len(own)))
