"""What the model makes of people's redness, as `measured_tans.csv` has it, case by case."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from hylios.adding import colours
from hylios.adding.redness import erythema
from hylios.colour_difference import lab
from hylios.skin import Skin
from hylios.skin.phototypes import PHOTOTYPES, skin_type
from hylios.tanning import Burns, Exposures

HOURS = (1, 4, 6, 8, 12, 24, 48, 72, 96, 192)
MJ_PER_MED = 30.0
"""mJ/cm^2 of broadband UVB of one MED. ESTIMATE"""

UVB_HOURS, TWO_MED_HOURS = (4, 8, 24, 48, 192), (4, 8, 24, 48, 72)
"""When people were measured (PMID 1804291; Suh et al.)."""

SIGNIFICANT = 1.0
"""Rise of a* taken as significant. ESTIMATE"""

COURSE = np.repeat([1 / 3, 2 / 3, 1.0], 4)
"""Daily doses in MED of Hoffmann et al."""


@dataclass(frozen=True)
class Redness:
    """A skin type after one dose.

    Attributes
    ----------
    name, kinetics : str
    dose : float
        In MED.
    """

    name: str
    dose: float
    kinetics: str

    @property
    def skin(self) -> Skin:
        """Of which only the epidermis thickens."""
        return replace(skin_type(self.name, kinetics=self.kinetics), thickening="epidermis")

    def states(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """States (T, 5) at times in hours."""
        skin = self.skin
        return skin.states(
            Exposures([0], [self.dose * skin.med]), times, erythema=erythema(self.skin)
        )

    @cached_property
    def blood(self) -> NDArray[np.float64]:
        """Blood by the hour (241,)."""
        return self.states(np.arange(241.0))[:, 4]

    @cached_property
    def course(self) -> NDArray[np.float64]:
        """Change of L*a*b* at `HOURS`, the tan included (T, 3)."""
        seen = lab(colours(self.skin, self.states(np.array([0.0, *HOURS]))).total)
        return seen[1:] - seen[0]

    def at(self, hour: int) -> NDArray[np.float64]:
        """Change of L*a*b* (3,) at one of `HOURS`."""
        return self.course[HOURS.index(hour)]

    def hour_of(self, part: int, hours: tuple[int, ...], sign: float = 1.0) -> float:
        """Of some of `HOURS`, when L*, a* or b* is highest, or with -1 lowest."""
        return float(max(hours, key=lambda hour: sign * self.at(hour)[part]))


@lru_cache(maxsize=256)
def after(name: str, dose: float, kinetics: str) -> Redness:
    """A skin type after a dose in MED."""
    return Redness(name, dose, kinetics)


def farthest(values: list[float], of: float) -> float:
    """The value that is farthest from a number."""
    return float(max(values, key=lambda value: abs(value - of)))


def _threshold(kinetics: str) -> float:
    return farthest([after(name, 1.0, kinetics).at(24)[1] for name in PHOTOTYPES[:4]], 2.5)


def _step_of_index(kinetics: str) -> float:
    """The index of redness is the logarithm of reflectance in the red over that in the green."""
    off = []
    for name in ("I", "II", "III"):
        states = np.array(
            [after(name, dose, kinetics).states(np.array([24.0]))[0] for dose in (1.0, 2.0, 4.0)]
        )
        skin = after(name, 1.0, kinetics).skin
        green, red = colours(skin, states, bands=[560.0, 650.0]).bands.T
        steps = np.diff(np.log(red / green))
        off.append(100.0 * float(np.abs(steps / steps.mean() - 1.0).max()))
    return max(off)


def _turns(kinetics: str) -> float:
    doses = 2.0 ** np.arange(-6.0, 7.0)
    slopes = np.diff([after("II", float(dose), kinetics).blood[24] for dose in doses])
    return float(np.count_nonzero(np.diff(np.sign(np.diff(slopes)))))


def _fastest_fading(kinetics: str) -> float:
    reached = []
    for dose in (4.0, 8.0):
        left = after("II", dose, kinetics).blood[30:]
        reached.append(float(left[np.diff(np.log(left)).argmin()]))
    return farthest(reached, 2.0)


def _onset(kinetics: str) -> float:
    risen = [hour for hour in HOURS if after("II", 1.0, kinetics).at(hour)[1] >= SIGNIFICANT]
    return float(risen[0])


def _peak_of_uvb(*energies: float) -> Callable[[str], float]:
    """Hour of the most blood after mJ/cm^2, the farthest from a day."""

    def value(kinetics: str) -> float:
        sampled = np.array(UVB_HOURS)
        curves = [after("II", energy / MJ_PER_MED, kinetics).blood for energy in energies]
        return farthest([float(sampled[curve[sampled].argmax()]) for curve in curves], 24.0)

    return value


def _raised_on_day_8(kinetics: str) -> float:
    raised = []
    for energy in (60.0, 120.0, 240.0):
        own = after("II", energy / MJ_PER_MED, kinetics)
        states = [[*own.skin.untanned_melanin, 1.0, share] for share in (own.blood[192], 1.0)]
        seen = lab(colours(own.skin, np.array(states)).total)[:, 1]
        raised.append(float(seen[0] - seen[1]))
    return min(raised)


def _not_oxygenated(kinetics: str) -> float:
    skin = skin_type("II", kinetics=kinetics)
    usual, burnt = (skin.at([*skin.untanned_melanin, 1.0, share]) for share in (1.0, 3.0))
    whole = np.array([usual.papillary_blood, burnt.papillary_blood])
    oxygenated = 0.01 * whole * np.array([usual.oxygenated_blood, burnt.oxygenated_blood])
    return 100.0 * float(np.diff(whole - oxygenated)[0] / np.diff(whole)[0])


def _share_of_peak(name: str, doses: tuple[float, ...], hour: int) -> Callable[[str], float]:
    def value(kinetics: str) -> float:
        courses = [after(name, dose, kinetics) for dose in doses]
        return min(100.0 * float(own.at(hour)[1] / own.course[:, 1].max()) for own in courses)

    return value


def _med_at_12(kinetics: str) -> float:
    doses = np.array([0.5, 1.0, 2.0])
    told = [
        np.interp(2.5, [after("II", dose, kinetics).at(hour)[1] for dose in doses.tolist()], doses)
        for hour in (12, 24)
    ]
    return float(told[0] / told[1])


def _slope_off(kinetics: str) -> float:
    slopes = np.array(
        [
            after("II", 4.0, kinetics).at(hour)[1] - after("II", 1.0, kinetics).at(hour)[1]
            for hour in (8, 24, 48)
        ]
    )
    return 100.0 * float(np.abs(slopes / slopes.mean() - 1.0).max())


def _day_1(part: int) -> Callable[[str], float]:
    def value(kinetics: str) -> float:
        told = [
            after(name, dose, kinetics).at(24)[part]
            for name in PHOTOTYPES[:4]
            for dose in (1.0, 2.0, 4.0)
        ]
        return float(min(told, key=abs))

    return value


def _peaks(kinetics: str) -> float:
    """Peaks of the blood after 133 to 400 mJ/cm^2: the most."""
    curves = [after("II", energy / MJ_PER_MED, kinetics).blood for energy in (133.0, 400.0)]
    return float(max(np.count_nonzero(np.diff(np.sign(np.diff(curve))) < 0) for curve in curves))


def _risen_med(days: int) -> Callable[[str], float]:
    """What the MED of type III has risen to after some days of `COURSE`."""

    def value(kinetics: str) -> float:
        risen, shield = after_the_course(kinetics, days)
        return risen * shield

    return value


def after_the_course(kinetics: str, days: int = 12) -> tuple[float, float]:
    """Factors by which the MED of type III has risen: people's rest, and the epidermis's shield."""
    skin = skin_type("III", kinetics=kinetics)
    dynamics = erythema(skin)
    course = Exposures(24 * np.arange(days), skin.med * COURSE[:days])
    state = skin.states(course, [24.0 * days])[0]
    tested = Exposures([*course.hours, 24 * days], [*course.doses, 0.0])
    burns = Burns.of(tested, dynamics, skin.med)
    risen = dynamics.protection(burns.hours, burns.doses.T)[-1, 0]
    return float(risen), float(dynamics.shield(state[:3].sum(), state[3]))


def _steepness(kinetics: str) -> float:
    """Rise of a* from 1 to 4 MED over that of the next lighter type, the largest."""
    rises = np.array(
        [
            after(name, 4.0, kinetics).at(24)[1] - after(name, 1.0, kinetics).at(24)[1]
            for name in PHOTOTYPES
        ]
    )
    return float((rises[1:] / rises[:-1]).max())


def _redness(dose: float) -> Callable[[str], float]:
    return lambda kinetics: float(after("II", dose, kinetics).at(24)[1])


VALUES: Mapping[str, Callable[[str], float]] = MappingProxyType(
    {
        "threshold": _threshold,
        "linear in log dose": _step_of_index,
        "sigmoid": _turns,
        "blood a day after 1 MED": lambda kinetics: farthest(
            [float(after(name, 1.0, kinetics).blood[24]) for name in PHOTOTYPES], 2.0
        ),
        "blood 8 to 72 h after 1 MED": lambda kinetics: float(
            after("II", 1.0, kinetics).blood[8:73].min()
        ),
        "fading": _fastest_fading,
        "onset": _onset,
        "peak of oxyhaemoglobin": _peak_of_uvb(6.0, 15.0, 30.0, 60.0, 120.0),
        "peak of small doses": _peak_of_uvb(36.0),
        "peak of large doses": _peak_of_uvb(42.0, 60.0, 120.0),
        "persistence": _raised_on_day_8,
        "oxygenation": _not_oxygenated,
        "narrowband peak": _share_of_peak("II", (1.0, 2.0), 12),
        "narrowband MED": _med_at_12,
        "slope": _slope_off,
        "broadband peak": lambda kinetics: after("II", 2.0, kinetics).hour_of(1, TWO_MED_HOURS),
        "narrowband peak at 2 MED": lambda kinetics: after("II", 2.0, kinetics).hour_of(
            1, TWO_MED_HOURS
        ),
        "a* of type III at 6 h": _share_of_peak("III", (2.0,), 6),
        "lowest L* of type III": lambda kinetics: after("III", 2.0, kinetics).hour_of(
            0, TWO_MED_HOURS, -1.0
        ),
        "highest a* of type III": lambda kinetics: after("III", 2.0, kinetics).hour_of(
            1, TWO_MED_HOURS
        ),
        "L* on day 1": _day_1(0),
        "a* on day 1": _day_1(1),
        "b* on day 1": _day_1(2),
        "blood after four days": lambda kinetics: float(
            after("II", 133.0 / MJ_PER_MED, kinetics).blood[96]
        ),
        "peaks of flow": _peaks,
        "flow": lambda kinetics: float(after("II", 3.0, kinetics).blood[12]),
        "flow back": lambda kinetics: float(after("II", 3.0, kinetics).blood[96]),
        "MED after 6 days": _risen_med(6),
        "MED after 12 days": _risen_med(12),
        "darker skin": _steepness,
        "a* after 2 MED": _redness(2.0),
        "a* after 4 MED": _redness(4.0),
        "a* after 8 MED": _redness(8.0),
    }
)
"""The model's value of a case, by the kinetics of its melanin."""
