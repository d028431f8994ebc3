"""What the commands say of doses on standard error: estimates, what files leave out, blisters."""

import argparse
from collections.abc import Sequence
from datetime import date

import numpy as np

from hylios.readers.epw import Weather
from hylios.readers.uv_forecast import Forecast
from hylios.spectra import Spectra, estimates_within
from hylios.sun import file_notes
from hylios.sun.action_spectra import FIRST_NM, LAST_NM
from hylios.sun.doses import Doses
from hylios.sun.protection import NOMINAL_AMOUNT
from hylios.sun.surroundings import GROUNDS
from hylios.tanning import BLISTERING, first_blistering_day
from hylios.tissue import SPECTRA

ESTIMATES = {
    "cloud": "a cloud cover stands for an average of all clouds, an ESTIMATE: single hours are off "
    "by a factor of two",
    "altitude": "that haze thins out by e in 2 km of height is an ESTIMATE",
    "spf": "a sunscreen of an SPF lets all ultraviolet through alike, an ESTIMATE",
    "upf": "cloth of a UPF lets all ultraviolet through alike, an ESTIMATE",
    "glass": "where a window pane begins to let light through is an ESTIMATE",
    "water": "water other than a metre of that which was measured is an ESTIMATE",
}
"""What is said of options that are given and not 0."""


def of_options(arguments: argparse.Namespace) -> list[str]:
    """What of the options of sky, ground and protection is an estimate."""
    notes = [note for option, note in ESTIMATES.items() if getattr(arguments, option)]
    if arguments.ground is not None:
        ground = GROUNDS[arguments.ground]
        notes.append(
            f"that {arguments.ground} reflects {ground.albedo:g} is an ESTIMATE: measured is "
            f"{ground.low:g} to {ground.high:g}"
        )
    if arguments.sunscreen_amount not in (None, NOMINAL_AMOUNT):
        notes.append(
            "that a film of sunscreen protects by the power of its amount is an ESTIMATE: "
            "measurements on people disagree"
        )
    return notes


def of_absorptance(spectra: Spectra, action: str) -> list[str]:
    """What of the skin's absorptance and of an action spectrum is an estimate."""
    light = np.arange(FIRST_NM, LAST_NM + 1.0)
    names = [name for name in SPECTRA if estimates_within(spectra, [name], light)]
    notes = estimates_within(spectra, [action], light)
    if names:
        notes.append(
            f"of what absorbs in skin it is an ESTIMATE: {', '.join(names)}; half or twice as much "
            "of all moves a dose of the sun by less than 3 %"
        )
    return notes


def of_weather(weather: Weather, dark: int) -> list[str]:
    """Of an EPW file which says nothing of so many hours of day."""
    notes = []
    by_clouds = int(np.sum(np.isnan(weather.radiation) & np.isfinite(weather.cover)))
    if np.any(np.isfinite(weather.radiation)):
        notes.append(
            f"the sun's ultraviolet goes by the radiation of {weather.name} to the power of .76, "
            "an ESTIMATE that was measured at three places in Spain"
        )
    if by_clouds:
        notes.append(
            f"{by_clouds} of {weather.radiation.size} hours of {weather.name} have no radiation "
            f"and go by the clouds: {ESTIMATES['cloud']}"
        )
    if weather.altitude:
        notes.append(ESTIMATES["altitude"])
    return notes + file_notes.of_weather(weather, dark)


def of_forecast(
    forecast: Forecast, days: Sequence[tuple[date, float, float]], parts: Sequence[Doses]
) -> list[str]:
    """Of UV indices, and of their doses on some days, or on all where there are none."""
    notes = file_notes.of_forecast(forecast, spans_of(forecast, days))
    if np.any(forecast.indices > 0.0):
        for (day, first, last), doses in zip(days, parts, strict=False):
            if not doses.hours.size:
                notes.append(
                    f"there is no UV index above 0 on {day} from {first:g} to {last:g} h in "
                    f"{forecast.name}"
                )
    return notes


def spans_of(
    forecast: Forecast, days: Sequence[tuple[date, float, float]]
) -> list[tuple[float, float]]:
    """Days with hours as hours since the midnight of a forecast's first day; all without days."""
    if not days:
        return [(float(forecast.hours[0]), float(forecast.hours[-1]))]
    midnights = [(24.0 * (day - forecast.day).days, first, last) for day, first, last in days]
    return [(midnight + first, midnight + last) for midnight, first, last in midnights]


def of_blisters(doses: Doses, med: float) -> list[str]:
    """Of the first day with more sun than skin bears, med being its MED in SED."""
    day = first_blistering_day(doses.hours, doses.thickening / med)
    if day is None:
        return []
    return [
        f"above {BLISTERING:g} MED, first on day {day:g}: skin blisters in life, which the model "
        "does not show"
    ]
