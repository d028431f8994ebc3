"""Tanning over time: melanin and thickness of the epidermis after ultraviolet doses.

Chapter 5 of the thesis, in steps of one hour. Doses are in SED (1 SED = 100 J/m^2 at 298 nm),
times in hours. Layers are ordered as the thesis numbers them: basale, spinosum, granulosum.
"""

from dataclasses import dataclass, field

import numpy as np

from hylios.errors import InputError, require_range, require_whole

LONGEST_HOURS = 24 * 366 * 100
LARGEST_DOSE = 1e12  # SED; far beyond any, and its sums stay finite


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

    def __post_init__(self):
        for name in ("production", "transfer", "extra_production", "extra_transfer"):
            for rate in getattr(self, name):
                require_range(f"{name} rate of melanin", rate, 0.0, 1.0)
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


PIGMENTATIONS = {
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


@dataclass(frozen=True)
class Exposures:
    """Doses of ultraviolet light.

    Attributes
    ----------
    hours : (E,) int array
        Hour of each dose, 0 to a century, in any order.
    doses : (..., E) float array
        Dose in SED of each exposure. Leading axes are separate histories, such as places on a
        body that different shares of the light reach.
    thickening_doses : (..., E) float array, optional
        Dose in SED as it counts for the thickness, where the light's spectrum has it differ
        (`hylios.dose`); the same as `doses` by default.

    Raises
    ------
    InputError
        If an hour or a dose is out of range or not a number, or the shapes do not agree.
    """

    hours: np.ndarray = field(default_factory=lambda: np.zeros(0, int))
    doses: np.ndarray = field(default_factory=lambda: np.zeros(0))
    thickening_doses: np.ndarray | None = None

    def __post_init__(self):
        hours = np.asarray(self.hours)
        if hours.ndim != 1 or not np.all((hours >= 0) & (hours <= LONGEST_HOURS)):
            raise InputError(
                f"hours of exposure are {hours.tolist()}; allowed are 0 to {LONGEST_HOURS}."
            )
        if not np.all(hours == np.floor(hours)):
            raise InputError(f"hours of exposure are {hours.tolist()}; allowed are whole hours.")
        doses = _checked_doses(self.doses, hours.size)
        thickening = self.thickening_doses
        thickening = doses if thickening is None else _checked_doses(thickening, hours.size)
        if thickening.shape != doses.shape:
            raise InputError(
                f"thickening doses have shape {thickening.shape}; expected {doses.shape}."
            )
        object.__setattr__(self, "hours", hours.astype(int))
        object.__setattr__(self, "doses", doses)
        object.__setattr__(self, "thickening_doses", thickening)


def _checked_doses(given: np.ndarray, exposures: int) -> np.ndarray:
    doses = np.array(given, dtype=float)
    if doses.ndim < 1 or doses.shape[-1] != exposures:
        raise InputError(
            f"doses have shape {doses.shape}; the last axis must match the {exposures} hours."
        )
    if not np.all((doses >= 0) & (doses <= LARGEST_DOSE)):
        raise InputError(
            f"a dose is negative, not finite or too large; allowed is 0 to {LARGEST_DOSE:g} SED."
        )
    return doses


@dataclass(frozen=True)
class TanningHistory:
    """State of the skin over time.

    Attributes
    ----------
    hours : (T,) int array
    melanin : (..., T, 3) float array
        Melanin of basale, spinosum, granulosum relative to the total at hour 0.
    thickness : (..., T) float array
        Thickness of the skin relative to hour 0 (5.29).
    """

    hours: np.ndarray
    melanin: np.ndarray
    thickness: np.ndarray

    @property
    def total(self) -> np.ndarray:
        """Melanin of all layers relative to hour 0, shape (..., T) (5.14)."""
        return self.melanin.sum(axis=-1)

    @property
    def states(self) -> np.ndarray:
        """Melanin of the three layers and thickness side by side, shape (..., T, 4)."""
        return np.concatenate([self.melanin, self.thickness[..., None]], axis=-1)


def hill(signal: np.ndarray, constant: float, exponent: float) -> np.ndarray:
    """Response s^k / (s^k + w^k), without overflow for any signal from 0 on (5.11, 5.26)."""
    with np.errstate(divide="ignore", over="ignore"):
        return 1.0 / (1.0 + (constant / signal) ** exponent)


def simulate(
    exposures: Exposures,
    melanin: MelaninDynamics,
    *,
    mmd: float,
    med: float,
    hours: int,
    thickness: ThicknessDynamics | None = None,
) -> TanningHistory:
    """Simulate melanin and thickness from hour 0 to hour `hours`, every hour.

    Parameters
    ----------
    exposures : Exposures
        Doses with leading shape (...); an exposure after the last hour has no effect.
    melanin, thickness
        Parameters of the skin (`PIGMENTATIONS`, `ThicknessDynamics`).
    mmd, med : float
        Minimal melanogenesis and erythema dose in SED. Melanogenesis is measured against the
        MMD (5.4 with 5.2 as the running text has it; its footnote prints MED), thickening
        against the MED (5.20).
    hours : int
        Last hour, 0 to a century.

    Returns
    -------
    TanningHistory
        With shapes (hours + 1,), (..., hours + 1, 3) and (..., hours + 1). A dose acts from its
        own hour on; only hour 0 is the state without sun whatever falls on it.

    Raises
    ------
    InputError
        If a minimal dose is not positive or `hours` is out of range.
    """
    thickness = thickness or ThicknessDynamics()
    require_range("MMD", mmd, 1e-6, 1e6, "SED")
    require_range("MED", med, 1e-6, 1e6, "SED")
    require_whole("number of hours", hours, 0, LONGEST_HOURS)
    shape = exposures.doses.shape[:-1]
    # Flat even for a single history: numpy's power of arrays and of numbers differ in the last bit.
    received = _doses_by_hour(exposures.hours, exposures.doses, hours)
    thickening_received = _doses_by_hour(exposures.hours, exposures.thickening_doses, hours)
    histories = int(np.prod(shape))

    content = np.empty((hours + 1, histories, 3))
    depth = np.empty((hours + 1, histories))
    content[0] = melanin.steady_state()
    depth[0] = thickness.steady_state()
    melanogenesis = _Signal.none(histories)
    thickening = _Signal.none(histories)
    production, extra_production = np.array(melanin.production), np.array(melanin.extra_production)
    transfer, extra_transfer = np.array(melanin.transfer), np.array(melanin.extra_transfer)

    leaving = None
    for hour in range(hours + 1):
        melanogenesis = melanogenesis.next(received.get(hour, 0.0) / mmd, melanin)
        thickening = thickening.next(thickening_received.get(hour, 0.0) / med, thickness)
        response = hill(melanogenesis.signal, melanin.hill_constant, melanin.hill_exponent)
        growth = hill(thickening.signal, thickness.hill_constant, thickness.hill_exponent)
        if leaving is not None:
            before = content[hour - 1]
            moved = leaving * before
            now = melanin.melanin_decay * (before - moved)
            now += response[..., None] * extra_production + production
            now[..., 1:] += moved[..., :-1]
            content[hour] = now
            made = growth * thickness.extra_production + thickness.production
            depth[hour] = made + depth[hour - 1] * thickness.cell_decay
        leaving = response[..., None] * extra_transfer + transfer

    return TanningHistory(
        hours=np.arange(hours + 1),
        melanin=content.swapaxes(0, 1).reshape(*shape, hours + 1, 3) / melanin.steady_state().sum(),
        thickness=depth.T.reshape(*shape, hours + 1) / thickness.steady_state(),
    )


@dataclass(frozen=True)
class _Signal:
    """Retained energy and the signal substance that it drives (5.5 to 5.8, 5.21 to 5.24)."""

    energy: np.ndarray
    rate: np.ndarray
    signal: np.ndarray

    @staticmethod
    def none(histories: int) -> "_Signal":
        return _Signal(np.zeros(histories), np.zeros(histories), np.zeros(histories))

    def next(self, dose, decays: MelaninDynamics | ThicknessDynamics) -> "_Signal":
        energy = dose + self.energy * decays.energy_decay
        effective = np.where(energy < 1.0, 0.0, energy)
        rate = effective + self.rate * decays.signal_rate_decay
        return _Signal(energy, rate, rate + self.signal * decays.signal_decay)


def _doses_by_hour(when: np.ndarray, doses, hours: int) -> dict[int, np.ndarray]:
    """Dose (histories,) of each hour that has one, up to the last hour."""
    received: dict[int, np.ndarray] = {}
    flat = doses.reshape(int(np.prod(doses.shape[:-1])), when.size)
    for hour, dose in zip(when.tolist(), flat.T, strict=True):
        if hour <= hours:
            received[hour] = received.get(hour, 0.0) + dose
    return received
