"""How bare skin goes over the days of a tan: in numbers, in words and as a picture."""

import functools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.adding.redness import JUST_SEEN
from hylios.colour_difference import lab
from hylios.tanning.spread import spread_of

from . import catalogue
from .biology import table_with
from .history import DRAG, History
from .lines import Line
from .response import melanin_of
from .settings import TanSettings
from .tan import darkest_day, history_of, peeling_of

POINTS = 367
"""Days at which the curve is computed."""

COLOUR = "total_colour"
"""Plane of a table that says how skin looks, gloss included."""

LOOSE = 0.5
"""Share of loose edges with which skin peels plainly."""

PLAIN = 0.3
"""Change of L* below which nobody sees a tan."""


@dataclass(frozen=True, eq=False)
class Curve:
    """A tan of bare skin over its days.

    Attributes
    ----------
    days : (N,) array
    colours : (N, 3) array
        Linear Rec.709 albedo, seen straight on.
    lightness : (N,) array
        CIE L*, were it not red.
    redness : (N,) array
        How much more CIE a* it has than were it not red.
    untanned : float
        L* without sun.
    darkest_day : float
        When skin has most melanin.
    peels : pair of float or None
        First and last day on which edges of peeling skin are loose; nan where it burns too little
        to peel, None where it is not to.
    """

    days: NDArray[np.float64]
    colours: NDArray[np.float64]
    lightness: NDArray[np.float64]
    redness: NDArray[np.float64]
    untanned: float
    darkest_day: float
    peels: tuple[float, float] | None = None

    @property
    def darkest(self) -> int:
        """Index of the darkest day."""
        return int(abs(self.days - self.darkest_day).argmin())

    @property
    def burns(self) -> list[tuple[float, float]]:
        """First and last day of every time in which redness can be seen."""
        red = np.concatenate([[0], self.redness >= JUST_SEEN, [0]]).astype(int)
        first, end = (np.flatnonzero(np.diff(red) == step) for step in (1, -1))
        return [
            (float(self.days[one]), float(self.days[last]))
            for one, last in zip(first, end - 1, strict=True)
        ]

    @property
    def half_gone(self) -> float | None:
        """The day by which half of the darkening is gone; None if it is not gone by the last."""
        return self._lighter_from(0.5 * (self.untanned + self.lightness[self.darkest]))

    @property
    def gone(self) -> float | None:
        """The day from which on no tan is seen; None if one still is on the last."""
        return self._lighter_from(self.untanned - PLAIN)

    def _lighter_from(self, least: float) -> float | None:
        """The day from which on skin stays lighter than that, after the darkest."""
        dark = np.flatnonzero(self.lightness[self.darkest :] < least)
        last = self.darkest + int(dark[-1]) if dark.size else self.darkest
        if not dark.size or last == len(self.days) - 1:
            return None
        low, high = self.lightness[last : last + 2]
        day, after = self.days[last : last + 2]
        return float(day + (least - low) / (high - low) * (after - day))


def table_stamp(settings: TanSettings) -> tuple[int, int]:
    """Numbers that change with the table's file; errors as in `catalogue.stamp`."""
    return catalogue.stamp(settings.table)


def curve_of(settings: TanSettings) -> Curve:
    """The curve of an object's settings.

    Raises
    ------
    InputError
        If a setting or the table cannot be used.
    """
    return _curve(settings, table_stamp(settings))


@functools.lru_cache(maxsize=4)
def _curve(settings: TanSettings, stamp: tuple[int, int]) -> Curve:
    """The curve, kept: Apply and the panel ask for the same."""
    del stamp  # of the table's file, so that another one counts
    history = history_of(settings, DRAG)
    table = table_with(settings.table, settings.biology, kinetics=settings.kinetics, rough=True)
    minimal = settings.minimal_doses(table.provenance)
    days = np.linspace(settings.first_day, settings.last_day, POINTS)
    coordinates = np.concatenate([np.zeros((1, 3)), _of_bare_skin(history, days)])
    kinetics = melanin_of(table, settings.kinetics)
    spread = spread_of(kinetics, mmd=minimal.mmd, med=minimal.med)
    colours = table.lookup(spread.states(*coordinates.T), [COLOUR])[COLOUR]
    shown = tan = lab(colours)
    if coordinates[:, 2].any():
        # With redness the dermis thickens no more, so that what is left is melanin's.
        without = spread.states(coordinates[:, 0], 0.0)
        tan = lab(table.lookup(without, [COLOUR])[COLOUR])
    return Curve(
        days=days,
        colours=colours[1:],
        lightness=tan[1:, 0],
        redness=(shown - tan)[1:, 1],
        untanned=float(shown[0, 0]),
        darkest_day=darkest_day(history),
        peels=_peels(settings),
    )


def _peels(settings: TanSettings) -> tuple[float, float] | None:
    """As in `Curve`, of bare skin."""
    image = peeling_of(settings)
    if image is None:
        return None
    loose = np.flatnonzero(image[:, -1, 2] >= LOOSE)
    if not loose.size:
        return np.nan, np.nan
    first, last = (loose[[0, -1]] + 0.5) / len(image)
    span = settings.last_day - settings.first_day
    return settings.first_day + first * span, settings.first_day + last * span


def _of_bare_skin(history: History, days: NDArray) -> NDArray[np.float64]:
    """Coordinates (N, 3) of skin that gets all of the dose."""
    places = history.places[0, :, 1]
    passed = (days - history.first_day) / (history.last_day - history.first_day)
    place = np.interp(passed, np.linspace(0.0, 1.0, len(places)), places)
    bare = history.coordinates[:, -1]
    rows = place * len(bare) - 0.5
    return np.stack([np.interp(rows, np.arange(len(bare)), bare[:, k]) for k in range(3)], axis=1)


def is_seen(curve: Curve) -> bool:
    """Whether a tan can be seen on the darkest day."""
    return bool(curve.untanned - curve.lightness[curve.darkest] >= PLAIN)


def shows_redness(curve: Curve) -> bool:
    """Whether the picture has a line of redness."""
    return bool(curve.redness.max() >= PLAIN)


def words(curve: Curve) -> tuple[str, ...]:
    """Short lines for an artist."""
    red = (*_red_words(curve), *_peeling_words(curve))
    if not is_seen(curve):
        return (*red, "No tan that can be seen")
    first = Line("Darkest on day {darkest:.0f},", darkest=curve.darkest_day)
    half = curve.half_gone
    if half is None:
        return (*red, first, Line("not half gone by day {last:.0f}", last=curve.days[-1]))
    if curve.gone is None:
        return (*red, first, Line("half gone by day {half:.0f}", half=half))
    if curve.gone <= half:
        return (*red, first, Line("gone by day {gone:.0f}", gone=curve.gone))
    both = Line("half gone by day {half:.0f}, all by {gone:.0f}", half=half, gone=curve.gone)
    return (*red, first, both)


def _red_words(curve: Curve) -> tuple[str, ...]:
    """When skin is burnt, where that can be seen."""
    burns = curve.burns
    if not burns:
        return ()
    first, last = burns[0][0], burns[-1][1]
    if len(burns) == 2:
        (_, until), (again, _) = burns
        days = {"first": first, "until": until, "again": again, "last": last}
        return (Line("Burnt on days {first:.0f}-{until:.0f}, {again:.0f}-{last:.0f}", **days),)
    if len(burns) > 2:
        days = {"count": len(burns), "first": first, "last": last}
        return (Line("Burnt {count} times, days {first:.0f}-{last:.0f}", **days),)
    if round(first) == round(last):
        return (Line("Burnt on day {day:.0f}", day=first),)
    return (Line("Burnt on days {first:.0f}-{last:.0f}", first=first, last=last),)


def _peeling_words(curve: Curve) -> tuple[str, ...]:
    """When skin peels, where it is to."""
    if curve.peels is None:
        return ()
    first, last = curve.peels
    if np.isnan(first):
        return (Line("Burns too little to peel"),)
    return (Line("Peels on days {first:.0f}-{last:.0f}", first=first, last=last),)


GRIDS = (
    (7.0, 1.0, "Upright lines: days"),
    (70.0, 7.0, "Upright lines: weeks"),
    (np.inf, 28.0, "Upright lines: 4 weeks"),
)
"""Days of a tan at most, days between the upright lines of its picture, and what these are."""

WIDTH, HEIGHT, STRIP = 240, 200, 36
"""Pixels of the picture, and of the colours along its lower edge."""

MARGIN = 6
LINE = np.array([0.95, 0.6, 0.3, 1.0])
RED_LINE = np.array([0.95, 0.25, 0.3, 1.0])
GRID = np.array([0.5, 0.5, 0.5, 0.45])
"""Colours that stand out from a dark and from a light theme; sRGB and opacity."""


def key(curve: Curve) -> tuple[str, ...]:
    """Short lines on what the picture's lines are."""
    colours = ("Orange: lightness, red: redness",) if shows_redness(curve) else ()
    return (*colours, _grid(curve)[1])


def _grid(curve: Curve) -> tuple[float, str]:
    """Days between the picture's upright lines, few enough to tell apart; what they are."""
    span = curve.days[-1] - curve.days[0]
    return next((apart, name) for most, apart, name in GRIDS if span <= most)


def picture(curve: Curve, shown: NDArray) -> NDArray[np.float32]:
    """The curve over its colours (HEIGHT, WIDTH, 4), sRGB from 0 to 1, the first row at the bottom.

    The orange line falls from that of skin without sun by how much darker skin is, in L*; the red
    one rises from the lower edge by how much redder it is, in a*.

    Parameters
    ----------
    shown : (N, 3) array
        The curve's colours as a screen shows them, sRGB.
    """
    pixels = np.zeros((HEIGHT, WIDTH, 4), np.float32)
    columns = np.linspace(0.0, len(curve.days) - 1.0, WIDTH)
    pixels[:STRIP, :, :3] = shown[np.round(columns).astype(int)]
    pixels[:STRIP, :, 3] = 1.0
    low, high = STRIP + MARGIN, HEIGHT - MARGIN
    darkness = curve.untanned - curve.lightness
    span = max(darkness.max(), curve.redness.max(), 1.0)
    pixels[high - 1 : high + 1] = GRID  # skin without sun
    apart, _ = _grid(curve)
    for day in np.arange(np.ceil(curve.days[0] / apart) * apart, curve.days[-1], apart):
        column = (day - curve.days[0]) / (curve.days[-1] - curve.days[0]) * (WIDTH - 1)
        pixels[low:high, int(column)] = GRID
    rows = np.arange(low - 1, high + 1)[:, None]
    lines = [(RED_LINE, low, curve.redness / span)] if shows_redness(curve) else []
    for colour, start, shares in (*lines, (LINE, high, -darkness / span)):
        own = np.interp(columns, np.arange(len(curve.days)), shares)
        height = start + own * (high - low)
        slope = np.hypot(1.0, np.gradient(height))
        covered = np.clip(1.8 - abs(rows - height) / slope, 0.0, 1.0)[..., None]
        part = pixels[low - 1 : high + 1]
        part[:] = part * (1.0 - covered) + colour * covered
    return pixels.astype(np.float32)
