"""Fits the measured kinetics of melanin to how people's tans come and go.

`python -m hylios.lab.kinetics_fit` prints what was measured beside what the shipped constants
make of it; with `--fit` it fits them anew, all rows at once. A tan is counted in the tans of one
MMD at their peak, which is what can just be seen.
"""

import argparse
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from hylios.skin.kinetics import MOST_GAINS
from hylios.tanning import Exposures, MeasuredDynamics, states_at

BURN = 1.2
"""MMD of 2 MED: 2 over an MMD of 1.9 MED in light and 1.5 in medium and dark skin (Ravnbak et al.,
Photodermatol Photoimmunol Photomed 26:133, 2010)."""

DAYS, HOURS_BETWEEN = 190, 2
LEFT = 0.05
"""Share of a tan's peak with which it has gone."""

SMALL = np.geomspace(0.2, 0.8, 12)
"""Doses in MMD among which the smallest that tans is looked for."""

STARTS, SPREAD, SEED = 6, (0.4, 0.3, 0.3, 0.3, 0.5, 0.3, 0.2), 0
"""Starts of the fit, and how far they lie around the shipped constants, in the logarithm."""


@dataclass(frozen=True)
class Row:
    """What was measured.

    Attributes
    ----------
    name : str
    measured, within : float
        Value, and how far from it one may be; a tolerance is of the ratio for doses.
    source : str
    """

    name: str
    measured: float
    within: float
    source: str

    def off(self, value: float) -> float:
        """How far a value is off, over what it may be."""
        if self.name.startswith("dose"):
            return float(np.log(value / self.measured) / np.log1p(self.within))
        return (value - self.measured) / self.within


SUH, RAVNBAK = "Suh et al. 2007", "Ravnbak et al., Acta Derm Venereol 88:223, 2008"
ROWS = (
    Row("dose of 6 in 3 weeks, of one MMD", 0.5, 0.15, RAVNBAK),
    Row("dose of 12 in 3 weeks, of one MMD", 0.33, 0.15, RAVNBAK),
    Row("darkest after 2 MED, days", 5.5, 1.5, SUH),
    Row("gone after 2 MED, days", 91.0, 15.0, SUH),
    Row("gone after the last of 12, days", 137.0, 15.0, RAVNBAK),
    Row("darkest after 12 in 3 weeks, days", 21.0, 3.0, "Ravnbak et al. 2009"),
    Row(
        "half of the most by one dose, MMD", 2.6, 0.6, "ESTIMATE: not before 2 (graded, Shono 1985)"
    ),
)


def values(dynamics: MeasuredDynamics) -> NDArray[np.float64]:
    """What the dynamics make of `ROWS`, whatever skin they are of."""
    singles = np.array([1.0, BURN, 1.5, 2.0, 2.5, 3.0, 3.5, 10.0])
    doses = [_series(1, dose) for dose in singles]
    doses += [_series(count, dose) for count in (6, 12) for dose in SMALL]
    doses += [_series(12, 0.5)]
    curves = tans(dynamics, np.array(doses))
    peaks = curves.max(axis=1)
    single, six, twelve, last = np.split(peaks, [singles.size, singles.size + SMALL.size, -1])
    half = np.interp(0.5 * single[-1], single, singles)
    smallest = [_dose_of_one(own) for own in (six, twelve)]
    burnt, often = curves[1], curves[-1]
    end = _days(12)[-1]
    return np.array([*smallest, _peak(burnt), _gone(burnt), _gone(often) - end, _peak(often), half])


def tans(dynamics: MeasuredDynamics, doses: np.ndarray) -> NDArray[np.float64]:
    """New melanin (N, T) every `HOURS_BETWEEN` after doses by the hour (N, H) in MMD.

    In tans of one MMD.
    """
    seen = replace(
        dynamics, untanned=(1.0, 0.0, 0.0), places=(1.0, 0.0, 0.0), gain=1.0, most=MOST_GAINS
    )
    hours = doses.shape[1]
    times = np.arange(0, hours, HOURS_BETWEEN)
    exposures = Exposures(np.arange(hours), doses, np.zeros_like(doses))
    return states_at(exposures, seen, times=times, mmd=1.0, med=1.0)[..., 0] - 1.0


def _days(count: int) -> NDArray[np.float64]:
    """Days of so many exposures in 3 weeks."""
    return 21.0 / count * np.arange(count)


def _series(count: int, dose: float) -> NDArray[np.float64]:
    """Doses by the hour: so many in 3 weeks."""
    doses = np.zeros(24 * DAYS)
    doses[(24.0 * _days(count)).astype(int)] = dose
    return doses


def _dose_of_one(peaks: np.ndarray) -> float:
    """The dose of `SMALL` with which the tan is that of one MMD."""
    return float(np.exp(np.interp(0.0, np.log(peaks), np.log(SMALL))))


def _peak(curve: np.ndarray) -> float:
    """Day of the peak, between two values by a parabola."""
    at = int(np.clip(curve.argmax(), 1, curve.size - 2))
    before, there, after = curve[at - 1 : at + 2]
    return HOURS_BETWEEN / 24.0 * (at + 0.5 * (before - after) / (before - 2.0 * there + after))


def _gone(curve: np.ndarray) -> float:
    """Day on which `LEFT` of the peak is left, or one beyond the last."""
    peak = int(curve.argmax())
    left = curve[peak:] / curve[peak]
    day = HOURS_BETWEEN / 24.0
    if left[-1] > LEFT:
        return day * curve.size + 300.0 * (left[-1] - LEFT)
    return day * (peak + float(np.interp(-LEFT, -left, np.arange(left.size))))


FREE = ("hours", "forming", "exponent", "constant", "slow_share", "fast", "slow")
"""What is fitted, in the logarithm: hours that energy and signal last, hours to form, the Hill
factor's exponent and constant (in signals of one MMD at their peak), share that fades slowly,
and days in which either fades."""


def of_numbers(logarithms: np.ndarray) -> MeasuredDynamics:
    """Dynamics from the logarithms of `FREE`; the production is such that one MMD tans by one."""
    own = dict(zip(FREE, np.exp(logarithms), strict=True))
    decay = float(np.exp(-1.0 / own["hours"]))
    lasting = np.arange(400)
    signal = float(((lasting + 1.0) * decay**lasting).max())
    dynamics = MeasuredDynamics(
        untanned=(1.0, 0.0, 0.0),
        places=(1.0, 0.0, 0.0),
        gain=1.0,
        most=MOST_GAINS,
        energy_decay=decay,
        signal_decay=decay,
        hill_exponent=float(own["exponent"]),
        hill_constant=signal * float(own["constant"]),
        forming_decay=float(np.exp(-1.0 / own["forming"])),
        production=0.01,
        slow_share=float(min(own["slow_share"], 1.0)),
        fast_decay=float(np.exp(-1.0 / (24.0 * own["fast"]))),
        slow_decay=float(np.exp(-1.0 / (24.0 * own["slow"]))),
    )
    one = np.zeros((1, 24 * 25))
    one[0, 0] = 1.0
    for _ in range(4):
        dynamics = replace(
            dynamics, production=min(dynamics.production / float(tans(dynamics, one).max()), 1.0)
        )
    return dynamics


def numbers(dynamics: MeasuredDynamics) -> NDArray[np.float64]:
    """The logarithms of `FREE` (7,) of dynamics."""
    lasting = np.arange(400)
    signal = float(((lasting + 1.0) * dynamics.energy_decay**lasting).max())
    hours = [-1.0 / np.log(getattr(dynamics, f"{name}_decay")) for name in ("energy", "forming")]
    fading = [
        -1.0 / (24.0 * np.log(getattr(dynamics, f"{name}_decay"))) for name in ("fast", "slow")
    ]
    own = [
        *hours,
        dynamics.hill_exponent,
        dynamics.hill_constant / signal,
        dynamics.slow_share,
        *fading,
    ]
    return np.log(own)


def residuals(dynamics: MeasuredDynamics) -> NDArray[np.float64]:
    """How far all rows are off, over what they may be."""
    return np.array([row.off(value) for row, value in zip(ROWS, values(dynamics), strict=True)])


def fitted(start: MeasuredDynamics, starts: int = STARTS) -> MeasuredDynamics:
    """The dynamics that meet all rows best, from some starts; the same for the same arguments.

    Rows count by the square of how far they are off, so that the worst counts most.
    """
    middle, random = numbers(start), np.random.default_rng(SEED)

    def misfit(logarithms: np.ndarray) -> NDArray[np.float64]:
        off = residuals(of_numbers(logarithms))
        return np.append(np.sign(off) * off**2, 0.05 * (logarithms - middle))

    begun = [middle, *(middle + random.normal(0.0, SPREAD) for _ in range(starts - 1))]
    results = [least_squares(misfit, one, diff_step=1e-2, max_nfev=25) for one in begun]
    return of_numbers(min(results, key=lambda result: result.cost).x)


def text(dynamics: MeasuredDynamics) -> str:
    """The constants, and every row with its residual."""
    names = (
        "energy_decay signal_decay hill_exponent hill_constant forming_decay production "
        "slow_share fast_decay slow_decay"
    ).split()
    lines = [f"{name} = {getattr(dynamics, name):.6g}" for name in names]
    lines += ["", f"{'row':36} {'measured':>8} {'within':>7} {'model':>7} {'off':>6}  source"]
    for row, value in zip(ROWS, values(dynamics), strict=True):
        lines.append(
            f"{row.name:36} {row.measured:8.3g} {row.within:7.2g} {value:7.3g} "
            f"{row.off(value):6.2f}  {row.source}"
        )
    return "\n".join(lines)


def main() -> int:
    """Print the rows, of the shipped constants or of a new fit."""
    parser = argparse.ArgumentParser(description="the measured kinetics of melanin beside people")
    parser.add_argument("--fit", action="store_true", help="fit the constants anew (a minute)")
    arguments = parser.parse_args()
    shipped = MeasuredDynamics((1.0, 0.0, 0.0), (1.0, 0.0, 0.0), 1.0, MOST_GAINS)
    print(text(fitted(shipped) if arguments.fit else shipped))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
