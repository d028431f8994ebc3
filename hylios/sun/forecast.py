"""Doses of UV indices over time, as services forecast them and meters keep them."""

from datetime import date

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError, require_kind, require_range
from hylios.readers.uv_forecast import Forecast
from hylios.sun.action_spectra import SED
from hylios.sun.doses import WATTS_PER_UV_INDEX, Doses
from hylios.sun.position import require_day
from hylios.sun.protection import BARE, Protection, require_protection

LONGEST_GAP = 3.0
"""Hours between two UV indices, beyond which there is night between them."""

BRIGHT = 3.0
"""Hours before and after noon that are surely day."""

SHORTEST_NIGHT = 8.0
"""Hours; what is shorter between two indices, of which one is above 0, is taken as day."""

LEAST_COURSE = 0.2
"""Of the indices' weight about noon, 0 to 1, below which they show no noon."""


def of_forecast(
    forecast: Forecast,
    begin: float = 0.0,
    end: float = np.inf,
    *,
    start: date | None = None,
    protection: Protection = BARE,
) -> Doses:
    """Doses by hour of UV indices over time, linear between them, taken as SED.

    Two that are more than three hours apart have night between them.

    Parameters
    ----------
    forecast : Forecast
        As `hylios.readers.uv_forecast.read_forecast` has it.
    begin, end : float
        Hours since the midnight of the forecast's first day, between which the skin is outside.
    start : date, optional
        The day whose midnight is hour 0; the forecast's first by default.
    protection : Protection, optional

    Raises
    ------
    InputError
        If the start lies after the forecast's first day, or all indices are more than three hours
        apart.
    """
    _require_steps(forecast)
    require_protection(protection)
    require_range("hour of sun", begin, -np.inf, np.inf)
    require_range("hour of sun", end, -np.inf, np.inf)
    shift = 24.0 * (forecast.day - require_day(start or forecast.day)).days
    if shift < 0.0:
        raise InputError(
            f"the UV indices of {forecast.name} begin on {forecast.day}, before hour 0, midnight "
            f"of {start}."
        )
    times = forecast.hours
    first, last = max(times[0], begin), min(times[-1], end)
    if not first < last:
        return Doses(*(np.zeros(0) for _ in range(4)))
    edges = np.concatenate([times, np.arange(np.ceil(first), last), [first, last]])
    edges = np.unique(edges[(edges >= first) & (edges <= last)])
    index = np.interp(edges, times, forecast.indices)
    middle = 0.5 * (edges[1:] + edges[:-1])
    gap = np.diff(times)[np.searchsorted(times, middle) - 1] > LONGEST_GAP
    sums = np.where(gap, 0.0, 0.5 * (index[1:] + index[:-1]) * np.diff(edges))
    return _by_hour(np.floor(middle), sums, shift, protection)


def hours_without_index(forecast: Forecast, begin: float, end: float) -> float:
    """Hours by day in a span of which a forecast says nothing, and which so are dark.

    By day is what lies within three hours of noon, the mean time of the indices on whatever clock,
    and steps that are too short for a night.

    Parameters
    ----------
    begin, end : float
        Hours since the midnight of the forecast's first day.
    """
    times, indices = forecast.hours, forecast.indices
    edges = np.concatenate([[min(begin, times[0])], times, [max(end, times[-1])]])
    steps = np.diff(edges)
    is_step = np.arange(steps.size) % times.size > 0  # the first and the last lie outside
    clipped = np.clip(edges, begin, max(begin, end))
    hours = np.diff(_bright_until(clipped, _noon(forecast)))
    has_light = np.concatenate([[0.0], np.maximum(indices[1:], indices[:-1]), [0.0]]) > 0.0
    is_day = has_light & (steps <= SHORTEST_NIGHT)
    hours = np.where(is_step & is_day, np.diff(clipped), hours)
    return float(hours[~(is_step & (steps <= LONGEST_GAP))].sum())


def _require_steps(forecast: Forecast) -> None:
    """Raise InputError where no two indices are near enough to be linear between them."""
    require_kind(
        "the forecast",
        forecast,
        Forecast,
        "that of a file, as hylios.readers.uv_forecast.read_forecast gives it",
    )
    least = np.min(np.diff(forecast.hours))
    if least > LONGEST_GAP:
        raise InputError(
            f"{forecast.name} has UV indices {least:g} hours apart or more; allowed is "
            f"{LONGEST_GAP:g} hours, since beyond there may be night, and a day's greatest index "
            "alone says no dose."
        )


def _noon(forecast: Forecast) -> float | None:
    """Hour of the day about which the indices lie, if they lie about one."""
    turned = np.exp(2j * np.pi * forecast.hours / 24.0) @ forecast.indices
    if abs(turned) <= LEAST_COURSE * forecast.indices.sum():
        return None
    return float(np.angle(turned) * 24.0 / (2.0 * np.pi))


def _bright_until(times: NDArray[np.float64], noon: float | None) -> NDArray[np.float64]:
    """Hours about noon, from some beginning to each of some times (T,); none without a noon."""
    if noon is None:
        return np.zeros(times.size)
    days, since = np.divmod(times - noon + BRIGHT, 24.0)
    return 2.0 * BRIGHT * days + np.minimum(since, 2.0 * BRIGHT)


def _by_hour(
    hours: NDArray[np.float64], sums: NDArray[np.float64], shift: float, protection: Protection
) -> Doses:
    """Doses from hours and the UV index times hours in each of their parts; none where it is 0."""
    whole, place = np.unique(hours, return_inverse=True)
    received = np.bincount(place.reshape(-1), sums) * WATTS_PER_UV_INDEX * 3600.0 / SED
    received = received * protection.of_sunlight()
    some = received > 0.0
    return Doses(whole[some] + shift, received[some], received[some], received[some])
