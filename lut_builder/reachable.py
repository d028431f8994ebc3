"""Which tanning states a table spans, and where its knots lie.

A table reaches from skin with hardly any melanin up to a freckle at the height of its tan, and over
blood. Melanin's knots lie where the look changes: closely where there is much to see, more closely
still among the melanin that sunshine can bring about.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hylios.adding import spectra
from hylios.errors import InputError
from hylios.history import history_of_shares, require_last_day
from hylios.skin import Skin, whole_thickening
from hylios.skin.regions import region
from hylios.skin.skin import MOST_BLOOD
from hylios.table import LookAxes
from hylios.tanning import KINETICS, ErythemaDynamics, Exposures, Spread, spread_of

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

LEAST_SPAN = 1e-6
"""Least span of the states along an axis, in the logarithm. A narrower axis comes from rounding and
gets one knot, like the spread's in skin that makes no melanin in the sun."""

LEAST_MELANIN = -6.0
"""Logarithm of the least melanin: a quarter of a percent, which cannot be seen."""

FRECKLE = 2.5
"""Melanin of a freckle relative to the skin's around it. ESTIMATE."""

DEEP = 0.8
"""Part of the logarithm of the most melanin of the measured kinetics which is a deep tan: what is
more takes years of sun without a pause."""

SEEN_NM = (450.0, 550.0, 650.0)
"""Wavelengths by whose lightness melanin's knots are placed."""

PLACES = 41
"""Melanin contents at which it is computed."""

EVENLY = 12.0
"""Lightness that counts as much as a step of 1 in melanin's logarithm."""

WEIGHTS = {"pale": 1.0, "tan": 10.0, "freckle": 2.0}
"""How closely knots lie below the untanned skin's melanin, within that of tans, and beyond."""

RISE = 1.0 / 3.0
"""Where the fourth knot of spread lies, as a share of the farthest state's distance."""

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
    times = np.arange(0, hours + 1, 6)
    return skin.states(Exposures(np.arange(hours), doses), times).reshape(-1, 4)


def reached_states(
    skin: Skin, exposures: Exposures, days: float, erythema: ErythemaDynamics | None = None
) -> np.ndarray:
    """States (N, 4) of a skin anywhere on a body, from day 0 to a last one, by every kinetics.

    With erythema they are (N, 5): of the skin where it reddens, and where it does not.

    Raises
    ------
    InputError
        If the last day is out of range.
    """
    last = 24.0 * require_last_day(days)
    hours = np.append(np.arange(0.0, last, HOURS_BETWEEN), last)
    states = np.concatenate(
        [
            history_of_shares(
                exposures,
                one.melanin_kinetics,
                hours=hours,
                mmd=skin.mmd,
                med=skin.med,
                erythema=erythema,
            ).states
            for one in by_kinetics(skin)
        ]
    )
    if erythema is None:
        return states.reshape(-1, 4)
    without = np.concatenate([states[..., :4], np.ones_like(states[..., 4:])], axis=-1)
    return np.concatenate([without, whole_thickening(states)]).reshape(-1, 5)


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
    parts = [reachable_states(one, SCHEDULES, seed) for one in by_kinetics(skin)]
    thesis, measured = (_sheet(one) for one in by_kinetics(skin))
    axes = LookAxes(thesis, measured, _aside(thesis, parts[0]), 4 * (np.zeros(1),))
    _, thickness, spread, _ = axes.coordinates(np.concatenate(parts)).T
    highest = float(np.log(parts[0][:, :3].sum(axis=1)).max())
    counts = [*knots, 1, 1, 1][:4]
    return replace(
        axes,
        knots=(
            _melanin_knots(skin, axes, highest, counts[0]),
            _knots(thickness.min(), thickness.max(), counts[1]),
            _spread_knots(spread, counts[2]),
            np.linspace(0.0, np.log(MOST_BLOOD), counts[3]),
        ),
    )


def by_kinetics(skin: Skin) -> list[Skin]:
    """The skin with every kinetics, in the order of `KINETICS`: a table serves them all."""
    return [replace(skin, kinetics=name) for name in KINETICS]


def _sheet(skin: Skin) -> Spread:
    return spread_of(skin.melanin_kinetics, mmd=skin.mmd, med=skin.med, evenly=True)


def within(axes: LookAxes, states: np.ndarray) -> LookAxes:
    """Bounded axes over a scene's states (N, 4 or 5), with the whole table's knots between them.

    The untanned skin is a knot.
    """
    places = axes.coordinates(states)
    ends = np.minimum(places.min(axis=0), 0.0), np.maximum(places.max(axis=0), 0.0)
    knots = [
        _knots_within(own, low, high) for own, low, high in zip(axes.knots, *ends, strict=True)
    ]
    return replace(axes, knots=tuple(knots), bounded=True)


def _aside(sheet: Spread, states: np.ndarray) -> np.ndarray:
    """`LookAxes.aside` of the states (N, 4) of the sheet's kinetics."""
    logarithms = np.log(states[:, :3] / sheet.untanned)
    off = logarithms - logarithms.mean(axis=1, keepdims=True)
    off -= sheet.logarithms(np.log(states[:, :3].sum(axis=1)), np.log(states[:, 3]))
    if np.abs(off).max() < LEAST_SPAN:
        return sheet.directions[:, 0]
    direction = np.linalg.svd(off, full_matrices=False)[2][0]
    direction = (direction - direction.mean()) / np.linalg.norm(direction - direction.mean())
    # Rounded, as its last digits depend on where arrays lie in memory.
    direction = np.round(direction, 9)
    # Most of what departs lies on its far side.
    return direction if ((off @ direction) ** 3).sum() <= 0.0 else -direction


def _spread_knots(spread: np.ndarray, count: int) -> np.ndarray:
    """Knots on both sheets and, with three or more, at the farthest state on the side of one.

    A fourth lies on that side too, near the sheet, where a tan's rise begins.
    """
    if spread.max() - spread.min() < LEAST_SPAN or count == 1:
        return np.zeros(1)
    if count == 2 or spread.min() > -LEAST_SPAN:
        return np.linspace(0.0, 1.0, count)
    aside = spread.min() * np.array([1.0, RISE][: count - 2])
    return np.append(aside, np.linspace(0.0, 1.0, count - len(aside)))


def _melanin_knots(skin: Skin, axes: LookAxes, highest: float, count: int) -> np.ndarray:
    """Knots of melanin, one of them 0; `highest` is the most that sunshine brings about.

    Closely by the thesis's kinetics: the measured one reaches further in light skin alone, after
    more than people bear, to where freckles lie.
    """
    if count == 1:
        return np.zeros(1)
    tanned = highest + MARGIN
    low, high = LEAST_MELANIN, max(highest + np.log(FRECKLE), _measured_freckle(axes)) + MARGIN
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


def _measured_freckle(axes: LookAxes) -> float:
    """Logarithm of the melanin of a freckle in a deep tan of the measured kinetics."""
    freckle = region("freckles", 0.0)
    tan = DEEP * float(axes.measured.most.max())
    return float(np.log(freckle.of_state(tan, 0.0)[0]))


def _lightness(skin: Skin, axes: LookAxes, melanin: np.ndarray) -> np.ndarray:
    """Lightness (N, 3), as L*, of three wavelengths at contents of melanin (N,)."""
    states = axes.states(np.stack([melanin, *(3 * [np.zeros_like(melanin)])], axis=-1))
    specimens = [skin.at(state) for state in states]
    return 116.0 / np.sqrt(len(SEEN_NM)) * np.cbrt(spectra(specimens, SEEN_NM).total)


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
