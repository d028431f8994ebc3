"""Fits the measured kinetics of melanin to how people's tans come and go.

`python -m hylios.lab.kinetics_fit` prints what was measured beside what the shipped constants
make of it; with `--fit` it fits them anew, all rows at once. A tan is counted in the tans of one
MMD at their peak, which is what can just be seen.
"""

import argparse
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from hylios.lab.measured_tans import rows_of
from hylios.skin.kinetics import MOST_GAINS
from hylios.tanning import Exposures, Kinetics, MeasuredDynamics, states_at

BURN = 1.2
"""MMD of 2 MED: 2 over an MMD of 1.9 MED in light and 1.5 in medium and dark skin (Ravnbak et al.,
Photodermatol Photoimmunol Photomed 26:133, 2010)."""

DAYS, HOURS_BETWEEN = 190, 2
LEFT = 0.05
"""Share of a tan's peak with which it has gone."""

SMALL = np.geomspace(0.2, 1.0, 24)
SMALL_OF_A_JUMP = np.geomspace(0.4, 1.0, 100)
"""Doses in MMD among which the smallest that tans is looked for; by the thesis it jumps."""

STARTS, SPREAD, SEED = 6, (0.4, 0.3, 0.3, 0.3, 0.5, 0.3, 0.2), 0
"""Starts of the fit, and how far they lie around the shipped constants, in the logarithm."""


ROWS = tuple(row for row in rows_of("tan").values() if row.remark == "fitted")
"""What is fitted, of what was measured."""


def values(dynamics: Kinetics) -> dict[str, float]:
    """What the dynamics make of the tans of people, by case, whatever skin they are of.

    These are `ROWS` and other rows that the same tans answer.
    """
    is_measured = isinstance(dynamics, MeasuredDynamics)
    small, often = (SMALL, 0.5) if is_measured else (SMALL_OF_A_JUMP, 1.001)
    singles = np.array([1.001, 0.5, BURN, 1.1, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 10.0])
    doses = [_series(1, dose) for dose in singles]
    doses += [_series(count, dose) for count in (6, 12) for dose in small]
    doses += [_series(count, often) for count in (6, 12)]
    curves = tans(dynamics, np.array(doses))
    curves = curves / (1.0 if is_measured else curves[0].max())
    peaks = curves.max(axis=1)
    single, six, twelve, _ = np.split(peaks, [singles.size, singles.size + small.size, -2])
    order = np.argsort(singles)
    half = np.interp(0.5 * single.max(), single[order], singles[order])
    of_six, of_twelve = (_dose_of_one(own, small) for own in (six, twelve))
    burnt, in_six, in_twelve = curves[2], curves[-2], curves[-1]
    told = {
        "dose of 6 in 3 weeks, of one MMD": of_six,
        "dose of 12 in 3 weeks, of one MMD": of_twelve,
        "darkest after 2 MED, days": _peak(burnt),
        "gone after 2 MED, days": _gone(burnt),
        "gone after the last of 12, days": _gone(in_twelve) - _days(12)[-1],
        "darkest after 12 in 3 weeks, days": _peak(in_twelve),
        "half of the most by one dose, MMD": half,
        "gone after the last of 6, days": _gone(in_six) - _days(6)[-1],
        "tan of half an MMD": single[1],
        "sum of 6 in 3 weeks, in MMD": 6.0 * of_six,
        "sum of 12 in 3 weeks, in MMD": 12.0 * of_twelve,
    }
    return {case: float(value) for case, value in told.items()}


def tans(dynamics: Kinetics, doses: np.ndarray) -> NDArray[np.float64]:
    """New melanin (N, T) every `HOURS_BETWEEN` after doses by the hour (N, H) in MMD.

    By the measured kinetics in tans of one MMD, by the thesis's relative to that without sun.
    """
    seen = dynamics
    if isinstance(dynamics, MeasuredDynamics):
        seen = replace(
            dynamics, untanned=(1.0, 0.0, 0.0), places=(1.0, 0.0, 0.0), gain=1.0, most=MOST_GAINS
        )
    hours = doses.shape[1]
    times = np.arange(0, hours, HOURS_BETWEEN)
    exposures = Exposures(np.arange(hours), doses, np.zeros_like(doses))
    states = states_at(exposures, seen, times=times, mmd=1.0, med=1.0)
    return states[..., :3].sum(axis=-1) - 1.0


def _days(count: int) -> NDArray[np.floating]:
    """Days of so many exposures in 3 weeks."""
    return 21.0 / count * np.arange(count)


def _series(count: int, dose: float) -> NDArray[np.float64]:
    """Doses by the hour: so many in 3 weeks."""
    doses = np.zeros(24 * DAYS)
    doses[(24.0 * _days(count)).astype(int)] = dose
    return doses


def _dose_of_one(peaks: np.ndarray, doses: np.ndarray) -> float:
    """The dose with which the tan is that of one MMD."""
    logarithms = np.log(np.maximum(peaks, 1e-9))
    return float(np.exp(np.interp(0.0, logarithms, np.log(doses))))


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
    """How far `ROWS` are off, over what they may be."""
    told = values(dynamics)
    return np.array([row.off(told[row.case]) for row in ROWS])


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
    told = values(dynamics)
    for row in ROWS:
        value, within = told[row.case], row.high - row.middle
        lines.append(
            f"{row.case:36} {row.middle:8.3g} {within:7.2g} {value:7.3g} "
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
