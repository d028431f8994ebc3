"""How a skin tans: the parameters of chapter 5 (tables 6.4 to 6.6), and minimal doses."""

from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar

import numpy as np

from hylios.errors import InputError, require_range


@dataclass(frozen=True)
class MelaninDynamics:
    """Parameters of the melanin dynamics (tables 6.4 and 6.5), per hour; tuples are per layer.

    `production` and `transfer` are the constitutive rates m_p,i,c and m_t,i,c;
    `extra_production` and `extra_transfer` the facultative ones m_p,i,f and m_t,i,f.
    """

    production: tuple[float, float, float]
    transfer: tuple[float, float, float]
    extra_production: tuple[float, float, float]
    extra_transfer: tuple[float, float, float]
    energy_decay: float = 0.98
    signal_rate_decay: float = 0.99
    signal_decay: float = 0.985
    melanin_decay: float = 0.99
    hill_exponent: float = 0.7
    hill_constant: float = 500.0

    threshold: ClassVar[float] = 1.0
    """Energy in MMD below which nothing acts (5.7)."""

    def __post_init__(self):
        for name in ("production", "transfer", "extra_production", "extra_transfer"):
            for rate in getattr(self, name):
                require_range(f"{name} rate of melanin", rate, 0.0, 1.0)
        for constitutive, facultative in zip(self.transfer, self.extra_transfer, strict=True):
            require_range("transfer with extra transfer", constitutive + facultative, 0.0, 1.0)
        _require_decays(self, "melanin_decay")
        if not self.steady_state().sum() > 0:
            raise InputError("melanin production is 0 in every layer; allowed is more than that.")

    def steady_state(self) -> np.ndarray:
        """Relative melanin per layer without sun, shape (3,), sum 1 (5.13).

        The thesis prints m_t,i of the layer itself for what arrives from below in 5.12 and
        m_t,i-1 in 5.13. Only the latter, used in both here, makes the sets of table 6.4 sum to 1.
        """
        production, transfer = np.array(self.production), np.array(self.transfer)
        content = np.zeros(3)
        for layer in range(3):
            arriving = transfer[layer - 1] * content[layer - 1] if layer else 0.0
            leaving = 1.0 - self.melanin_decay * (1.0 - transfer[layer])
            content[layer] = (production[layer] + arriving) / leaving
        return content


@dataclass(frozen=True)
class ThicknessDynamics:
    """Parameters of the thickness dynamics (table 6.6), per hour."""

    energy_decay: float = 0.985
    signal_rate_decay: float = 0.2
    signal_decay: float = 0.98
    cell_decay: float = 0.9
    hill_exponent: float = 1.0
    hill_constant: float = 20.0
    production: float = 0.1
    extra_production: float = 0.025

    threshold: ClassVar[float] = 1.0
    """Energy in MED below which nothing acts (5.23)."""

    def __post_init__(self):
        require_range("production of thickness", self.production, 1e-9, 1e9)
        require_range("extra production of thickness", self.extra_production, 0.0, 1e9)
        _require_decays(self, "cell_decay")

    def steady_state(self) -> float:
        """Thickness without sun, in the model's own unit (5.28)."""
        return self.production / (1.0 - self.cell_decay)


def _require_decays(dynamics, own: str) -> None:
    for name in ("energy_decay", "signal_rate_decay", "signal_decay", own):
        require_range(name, getattr(dynamics, name), 0.0, 1.0 - 1e-9)
    require_range("hill_exponent", dynamics.hill_exponent, 1e-3, 100.0)
    require_range("hill_constant", dynamics.hill_constant, 1e-9, 1e12)


PIGMENTATIONS = MappingProxyType(
    {
        "low": MelaninDynamics(
            production=(0.0100, 0.0, 0.0),
            transfer=(0.0081, 0.0051, 0.0004),
            extra_production=(0.0110, 0.0, 0.0),
            extra_transfer=(0.0450, 0.0200, 0.0),
        ),
        "intermediate": MelaninDynamics(
            production=(0.0080, 0.0030, 0.0),
            transfer=(0.0051, 0.0090, 0.0064),
            extra_production=(0.0075, 0.0150, 0.0),
            extra_transfer=(0.0250, 0.0010, 0.0900),
        ),
        "high": MelaninDynamics(
            production=(0.0080, 0.0020, 0.0),
            transfer=(0.0018, 0.0029, 0.0003),
            extra_production=(0.0085, 0.0065, 0.0),
            extra_transfer=(0.0300, 0.0010, 0.0700),
        ),
    }
)
"""The three sets of table 6.4 by constitutive pigmentation."""

TYPICAL_PIGMENTATION = {"low": 0.0235, "intermediate": 0.10, "high": 0.25}
"""Melanin fraction of the epidermis that stands for a set where nothing else is known: S3's, one
between, and S4's. ESTIMATE."""


def minimal_erythema_dose(pigmentation: float) -> float:
    """MED in SED of skin with the given melanin fraction of its epidermis, 0.013 to 0.43 (3.1)."""
    require_range("pigmentation level", pigmentation, 0.013, 0.43)
    return 2.1973 * float(np.exp(7.4043 * pigmentation))


def minimal_melanogenesis_dose(pigmentation: float) -> float:
    """MMD in SED of skin with the given melanin fraction of its epidermis, 0.013 to 0.43 (3.2)."""
    require_range("pigmentation level", pigmentation, 0.013, 0.43)
    return 4.3132 * float(np.exp(5.1295 * pigmentation))
