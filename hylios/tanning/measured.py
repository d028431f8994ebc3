"""How people's melanin follows ultraviolet: a kinetics beside the thesis's, fitted to people.

Doses act without a threshold, the response is graded, melanin forms over days and is lost at two
rates over months. The numbers below come from `python -m hylios.lab.kinetics_fit`, which prints
what was measured beside them. numpy only.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from hylios.errors import InputError, require_range


@dataclass(frozen=True)
class MeasuredDynamics:
    """Parameters of the measured melanin dynamics, per hour; tuples are per layer.

    The signal s of doses in MMD follows the thesis's 5.5 and 5.8, without the threshold of 5.7; the
    response h is its Hill factor (5.11). New melanin f + g forms from c, which follows h late:

        c(t) = forming_decay c(t - 1) + (1 - forming_decay) h(t)
        f(t) = fast_decay f(t - 1) + made ((1 - slow_share) c(t) - f(t - 1) c(t - 1) / most)
        g(t) = slow_decay g(t - 1) + made (slow_share c(t) - g(t - 1) c(t - 1) / most)

    with made = production gain. Of both a layer holds its share `places`, beside what it has
    without sun.

    Attributes
    ----------
    untanned : tuple
        Melanin of basale, spinosum, granulosum without sun, relative to their total.
    places : tuple
        Shares of new melanin by layer; their sum is 1, and a layer that loses has one below 0.
    gain : float
        New melanin at the peak after one MMD, relative to the untanned total.
    most : float
        New melanin that no sun exceeds, relative to the untanned total.

    Raises
    ------
    InputError
        If a number is out of range, or the shares' sum is not 1.
    """

    untanned: tuple[float, float, float]
    places: tuple[float, float, float]
    gain: float
    most: float
    energy_decay: float = 0.92135
    signal_decay: float = 0.92135
    hill_exponent: float = 2.287
    hill_constant: float = 11.71
    forming_decay: float = 0.97804
    production: float = 0.5682
    slow_share: float = 0.1094
    fast_decay: float = 0.995999
    slow_decay: float = 0.999526

    threshold: ClassVar[float] = 0.0
    """Energy in MMD below which nothing acts."""

    signal_rate_decay: ClassVar[float] = 0.0
    """Of 5.6: the signal is made of the energy at once."""

    def __post_init__(self):
        for name in ("untanned", "places"):
            total = sum(getattr(self, name))
            if not abs(total - 1.0) < 1e-9:
                raise InputError(f"the sum of {name} is {total:g}; allowed is 1.")
        for share in self.untanned:
            require_range("share of melanin without sun", share, 0.0, 1.0)
        for share in self.places:
            require_range("share of new melanin", share, -10.0, 10.0)
        require_range("gain of melanin", self.gain, 0.0, 1e3)
        require_range("most new melanin", self.most, 1e-9, 1e3)
        require_range("slow_share", self.slow_share, 0.0, 1.0)
        require_range("production", self.production, 0.0, 1.0)
        require_range("hill_exponent", self.hill_exponent, 1e-3, 100.0)
        require_range("hill_constant", self.hill_constant, 1e-9, 1e12)
        for name in ("energy", "signal", "forming", "fast", "slow"):
            require_range(f"{name}_decay", getattr(self, f"{name}_decay"), 0.0, 1.0 - 1e-9)

    def steady_state(self) -> np.ndarray:
        """Relative melanin per layer without sun, shape (3,), sum 1."""
        return np.array(self.untanned)
