"""What the model makes of people's tans, immediate darkening, thickness and peeling, case by case.

The cases are those of `measured_tans.csv`; `values_of_people` has those of redness too.
"""

from collections.abc import Callable, Mapping
from functools import cache, lru_cache, partial
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from hylios.adding import colours
from hylios.adding.redness import erythema
from hylios.colour_difference import lab
from hylios.lab import kinetics_fit, redness_of_people
from hylios.lab.redness_of_people import after_the_course, farthest
from hylios.skin import Skin
from hylios.skin.phototypes import PHOTOTYPES, skin_type
from hylios.tanning import Exposures, ImmediateDarkening, peeled_shares

TANNING = PHOTOTYPES[1:]
"""Types that tan."""

USUAL = "III"

TWO_WEEKS = 3.75
"""Change in CIELAB of two weeks of sun: the middle of what was measured."""

FLASH = 10.0 / 3600.0
"""Hours of ultraviolet in which a dose is given at once."""


@lru_cache(maxsize=32)
def _melanin_kinetics(kinetics: str) -> Mapping[str, float]:
    return MappingProxyType(
        kinetics_fit.values(skin_type(USUAL, kinetics=kinetics).melanin_kinetics)
    )


def _changes(skin: Skin, melanin: NDArray[np.float64]) -> NDArray[np.float64]:
    """Change of L*a*b* (N, 3) by melanin (N, 3) of the layers alone."""
    states = np.vstack([skin.untanned_melanin, melanin])
    seen = lab(colours(skin, np.column_stack([states, np.ones(len(states))])).total)
    return seen[1:] - seen[0]


def _peaks(skin: Skin, doses: NDArray[np.float64], days: int = 1) -> NDArray[np.float64]:
    """Melanin (N, 3) at its peak after equal doses (N,) in MMD on some days."""
    exposures = Exposures(24 * np.arange(days), np.repeat(doses[:, None], days, axis=1) * skin.mmd)
    melanin = skin.states(exposures, np.arange(0.0, 30.0 * 24.0, 12.0))[..., :3]
    strongest = melanin.sum(axis=-1).argmax(axis=-1)
    return melanin[np.arange(doses.size), strongest]


@lru_cache(maxsize=32)
def _one_mmd(name: str, kinetics: str) -> float:
    """Change of L* at the peak after one MMD."""
    skin = skin_type(name, kinetics=kinetics)
    return float(_changes(skin, _peaks(skin, np.array([1.001])))[0, 0])


def _at_fall(names: tuple[str, ...], fall: float, wanted: float) -> Callable[[str], float]:
    """Change of a* where L* has fallen by so much, or at the deepest tan."""

    def value(kinetics: str) -> float:
        told = []
        for name in names:
            skin = skin_type(name, kinetics=kinetics)
            change = _changes(skin, _peaks(skin, np.geomspace(0.5, 40.0, 14)))
            fallen = -np.minimum.accumulate(change[:, 0])
            told.append(float(np.interp(fall, fallen, change[:, 1])))
        return farthest(told, wanted)

    return value


def _two_weeks(part: int) -> Callable[[str], float]:
    """Change of a* or b* where two weeks of equal doses change the skin by `TWO_WEEKS`."""

    def value(kinetics: str) -> float:
        skin = skin_type(USUAL, kinetics=kinetics)
        doses = np.linspace(0.0, 2.0, 21)
        exposures = Exposures(24 * np.arange(14), np.repeat(doses[:, None], 14, axis=1) * skin.mmd)
        change = _changes(skin, skin.states(exposures, [15.0 * 24.0])[:, 0, :3])
        size = np.maximum.accumulate(np.linalg.norm(change, axis=1))
        return float(np.interp(TWO_WEEKS, size, change[:, part]))

    return value


def _mmd_over_med(name: str, kinetics: str) -> float:
    skin = skin_type(name, kinetics=kinetics)
    return skin.mmd / skin.med


def _darkened(uva: float, *minutes: float) -> NDArray[np.float64]:
    """Darkening, in what is just seen, some minutes after a dose in J/cm^2 given at once."""
    usual = ImmediateDarkening()
    times = FLASH + np.array(minutes) / 60.0
    return np.log(usual.factor([0], [uva], times, FLASH)) / usual.just_seen


def _just_seen(minutes: float) -> float:
    """J/cm^2 whose darkening is just seen after some minutes."""
    doses = np.geomspace(0.1, 100.0, 400)
    return float(np.interp(1.0, [_darkened(dose, minutes)[0] for dose in doses.tolist()], doses))


def _minutes_to_fade() -> float:
    minutes = np.linspace(0.0, 15.0, 301)
    left = _darkened(0.1, *minutes) - _darkened(0.1, 30.0)
    return float(np.interp(-np.exp(-1.0) * left[0], -left, minutes))


def _darkened_lightness(kinetics: str) -> float:
    told = []
    for name in TANNING:
        skin = skin_type(name, kinetics=kinetics)
        darker = np.exp(ImmediateDarkening().just_seen) * skin.untanned_melanin
        told.append(float(_changes(skin, darker[None])[0, 0]))
    return farthest(told, -0.8)


def _off_first_order() -> float:
    left = [ImmediateDarkening().most - _darkened(dose, 0.0)[0] for dose in (0.0, 2.0, 4.0)]
    return 100.0 * abs(float(left[1] / left[0] / (left[2] / left[1]) - 1.0))


def _thickness(hours: NDArray[np.floating], dose: float, time: float, kinetics: str) -> float:
    """Thickness at an hour after doses in MED."""
    skin = skin_type(USUAL, kinetics=kinetics)
    doses = np.full(hours.size, dose * skin.med)
    return float(skin.states(Exposures(hours.astype(int), doses), [time])[0, 3])


@cache
def _peeling(kinetics: str) -> tuple[float, float]:
    """Days after 8 MED when peeling begins, and how many it lasts to the most."""
    skin, hours = skin_type(USUAL, kinetics=kinetics), np.arange(30.0 * 24.0)
    share = peeled_shares(
        Exposures([0], [8.0 * skin.med]),
        skin.melanin_kinetics,
        erythema(skin),
        times=hours,
        mmd=skin.mmd,
        med=skin.med,
    )
    first, last = hours[share > 0.05][0], hours[share.argmax()]
    return float(first) / 24.0, float(last - first) / 24.0


def _tan_values() -> dict[str, Callable[[str], float]]:
    values: dict[str, Callable[[str], float]] = {
        case: lambda kinetics, case=case: _melanin_kinetics(kinetics)[case]
        for case in _melanin_kinetics("measured")
    }
    same = {
        "darkest after narrowband, days": "darkest after 2 MED, days",
        "darkest after UVA and UVB, days": "darkest after 2 MED, days",
        "gone after narrowband, days": "gone after 2 MED, days",
        "gone after 12 of UVA, days": "gone after the last of 12, days",
    }
    values |= {case: values[other] for case, other in same.items()}
    falls = {name: partial(_one_mmd, name) for name in TANNING}
    return values | {
        "gain independent of the skin": lambda kinetics: (
            min(fall(kinetics) for fall in falls.values())
            / max(fall(kinetics) for fall in falls.values())
        ),
        "fall of L* by one MMD": lambda kinetics: farthest(
            [fall(kinetics) for fall in falls.values()], -0.8
        ),
        "MMD over MED, light": partial(_mmd_over_med, "II"),
        "MMD over MED, medium and dark": partial(_mmd_over_med, "IV"),
        "MMD over MED, very brown": partial(_mmd_over_med, "VI"),
        "a* after two weeks of sun": _two_weeks(1),
        "b* after two weeks of sun": _two_weeks(2),
        "a* of tanned light skin": _at_fall(("II", "III", "IV"), 4.0, 1.05),
        "a* of tanned dark skin": _at_fall(("V", "VI"), 4.6, -0.1),
    }


def values_of_people() -> dict[str, Mapping[str, Callable[[str], float]]]:
    """Functions from a kinetics to the model's value, by subject and case.

    A case that is not there is one that the model has nothing to say of.
    """
    return {
        "redness": redness_of_people.VALUES,
        "tan": _tan_values(),
        "immediate darkening": {
            "immediate threshold": lambda kinetics: _just_seen(0.0),
            "persistent threshold": lambda kinetics: _just_seen(30.0),
            "fading of the first part": lambda kinetics: _minutes_to_fade(),
            "fall of L* at the threshold": _darkened_lightness,
            "dose response": lambda kinetics: _off_first_order(),
            "after 4 J/cm2": lambda kinetics: float(
                100.0 * _darkened(4.0, 30.0)[0] / _darkened(4.0, 0.0)[0]
            ),
            "after 18 J/cm2": lambda kinetics: float(_darkened(18.0, 1440.0)[0]),
        },
        "thickness and peeling": {
            "three daily doses of 1.5 MED": partial(
                _thickness, np.array([0.0, 24.0, 48.0]), 1.5, 72.0
            ),
            "15.7 MED in three weeks": partial(
                _thickness, np.arange(12) * 42.0, 15.7 / 12.0, 504.0
            ),
            "ultraviolet let through": lambda kinetics: 1.0 / after_the_course(kinetics)[1],
            "peeling begins": lambda kinetics: _peeling(kinetics)[0],
            "peeling lasts": lambda kinetics: _peeling(kinetics)[1],
        },
    }
