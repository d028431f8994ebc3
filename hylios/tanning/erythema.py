"""Sunburn: the blood of the dermis after ultraviolet, in the form of the thesis's own dynamics.

The thesis has no redness. This stands beside its kinetics of melanin and thickness (5.4 to 5.29):
doses in MED leave energy, energy makes signals, signals widen the vessels. ESTIMATE throughout,
but where a source is named; fitted to `hylios/lab/measured_tans.csv`. numpy only.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError, require_range
from hylios.tanning.exposures import Exposures, require_exposures
from hylios.tanning.recurrence import accumulated, in_a_row, in_blocks

MOST_ADDED = 11.0
"""Most blood that may be added, in multiples of the skin's own: what tables hold."""

LARGEST_SHIELD = 1e6
"""Largest factor by which a tan changes the MED."""

LEAST_APART = 1e-3
"""Least difference of two decays: with less, the sum of their powers is rounding."""


@dataclass(frozen=True)
class ErythemaDynamics:
    """How blood responds to doses in MED; decays are per hour.

    Blood relative to the skin's own is 1 + X y / (1 + y), where
    y = q (s_early / w_early + (s_late / w_late)^k). Both signals follow from the energy retained
    (5.21), over a rate (5.22), as the thesis's do, scaled so that a constant energy is the signal
    in the end. There is no threshold as in 5.23: vessels widen measurably below 1 MED, and a jump
    would draw a contour where a mask crosses it.

    The MED rises with the tan. First by the ultraviolet that the tanned epidermis holds back, in
    the form of Beer's law (`hylios.adding.redness` derives both coefficients); then by what people
    show beyond that, up to `most_protection` times. That rest follows the doses of the days before.

    Attributes
    ----------
    energy_decay : float
        As that of thickness (table 6.6), which has the same doses in MED.
    rate_decay, early_decay, late_decay : float
        First redness within 4 hours, the peak after 16 hours (1 MED) to 21 (8 MED), and gone after
        days to a week: PMID 1804291; Man et al. 2002; Suh et al. 2007.
    early_constant, late_constant, late_exponent : float
        w_early, w_late in MED, and k: the change of a* is linear in the logarithm of the dose from
        1 to 4 MED (Farr and Diffey 1985).
    added_blood : float
        X. Redness then fades fastest below 3 times the blood; 1.5 to 2.5 were measured (Wan et al.
        1983).
    sensitivity : float
        q, of the skin: 1 MED is the dose whose redness is just seen after a day.
    melanin_shield, thickness_shield : float
        Logarithm by which the MED rises for each whole of added melanin, and of added thickness.
    protection_decay, protection_rise, protection_constant, protection_exponent, most_protection
        The rest: the logarithm of the MED rises by ln(most) a^n / (a^n + c^n) with doses a in MED
        that decay, and count after a day or two. In people the MED is 1.5 times after 6 and 3.2
        times after 12 days of UVB below 1 MED, and the UVB that the epidermis lets through 30 %
        (Hoffmann et al., Photodermatol. Photoimmunol. Photomed. 15, 133, 1999); of that melanin
        makes 6 to 11 % (Lock-Andersen et al., same journal 11, 213, 1995).

    Raises
    ------
    InputError
        If a number is out of range.

    Examples
    --------
    Redness that fades in half the time; `hylios.erythema` has the numbers of a skin:

    >>> from dataclasses import replace
    >>> import hylios
    >>> skin = replace(hylios.skin_type("II"), thickening="epidermis")
    >>> quick = replace(hylios.erythema(skin), energy_decay=0.97)
    >>> state = skin.states(hylios.Exposures([0], [2 * skin.med]), times=[48], erythema=quick)[0]
    >>> print(f"{state[4]:.1f} times the blood")
    1.6 times the blood
    """

    energy_decay: float = 0.985
    rate_decay: float = 0.7
    early_decay: float = 0.77
    late_decay: float = 0.88
    early_constant: float = 7.4
    late_constant: float = 2.0
    late_exponent: float = 2.7
    added_blood: float = 5.5
    sensitivity: float = 1.0
    melanin_shield: float = 0.0
    thickness_shield: float = 0.0
    protection_decay: float = 0.998
    protection_rise: float = 0.96
    protection_constant: float = 3.2
    protection_exponent: float = 2.0
    most_protection: float = 4.0

    def __post_init__(self):
        decays = ("energy", "rate", "early", "late")
        values = [getattr(self, f"{name}_decay") for name in decays]
        for name, value in zip(decays, values, strict=True):
            require_range(f"{name}_decay of redness", value, 0.0, 1.0 - 1e-9)
        if np.min(np.diff(np.sort(values))) < LEAST_APART:
            raise InputError(
                f"decays of redness are {values}; allowed are four that differ by {LEAST_APART:g} "
                "or more."
            )
        require_range("protection_decay", self.protection_decay, 0.0, 1.0 - 1e-9)
        require_range("protection_rise", self.protection_rise, 0.0, self.protection_decay)
        for name in ("early_constant", "late_constant", "protection_constant"):
            require_range(name, getattr(self, name), 1e-9, 1e12, "MED")
        for name in ("late_exponent", "protection_exponent"):
            require_range(name, getattr(self, name), 1e-3, 100.0)
        require_range("added_blood", self.added_blood, 0.0, MOST_ADDED)
        require_range("sensitivity of redness", self.sensitivity, 0.0, 1e6)
        require_range("melanin_shield", self.melanin_shield, 0.0, 1e3)
        require_range("thickness_shield", self.thickness_shield, 0.0, 1e3)
        require_range("most_protection", self.most_protection, 1.0, 1e3)

    def blood(self, energies: NDArray[np.floating]) -> NDArray[np.floating]:
        """Blood (T, H) relative to the skin's own, from `retained_energies` (T, 4, H)."""
        # No BLAS, which would round one history otherwise than many.
        parts = energies.swapaxes(0, 1)
        early, late = (
            np.maximum(
                sum(float(weight) * part for weight, part in zip(row, parts, strict=True)), 0.0
            )
            for row in self._signal_weights()
        )
        with np.errstate(over="ignore"):
            reached = (
                early / self.early_constant + (late / self.late_constant) ** self.late_exponent
            )
            return 1.0 + self.added_blood * (1.0 - 1.0 / (1.0 + self.sensitivity * reached))

    def retained_energies(
        self, hours: NDArray[np.int_], doses: NDArray[np.floating], marks: NDArray[np.int_]
    ) -> NDArray[np.floating]:
        """What four decays leave of doses (E, H) in MED, at ascending hours (T, 4, H)."""
        decays = (self.energy_decay, self.rate_decay, self.early_decay, self.late_decay)
        return _faded(hours, doses, marks, decays)

    def protection(
        self, hours: NDArray[np.int_], doses: NDArray[np.floating]
    ) -> NDArray[np.floating]:
        """What people's MED has risen by at each dose (E, H) beyond their epidermis's shield."""
        own, place = np.unique(hours, return_inverse=True)
        faded = _faded(hours, doses, own, (self.protection_decay, self.protection_rise))
        acting = faded[:, 0] - faded[:, 1]
        with np.errstate(divide="ignore", over="ignore"):
            reached = (
                self.protection_constant / np.maximum(acting, 0.0)
            ) ** self.protection_exponent
            return (self.most_protection ** (1.0 / (1.0 + reached)))[place.reshape(-1)]

    def shield(
        self, melanin: NDArray[np.floating], thickness: NDArray[np.floating]
    ) -> NDArray[np.floating]:
        """What the MED has risen by in an epidermis with that relative melanin and thickness."""
        depth = self.melanin_shield * (melanin - 1.0) + self.thickness_shield * (thickness - 1.0)
        return np.exp(np.clip(depth, -np.log(LARGEST_SHIELD), np.log(LARGEST_SHIELD)))

    def _signal_weights(self) -> NDArray[np.float64]:
        """Weights (2, 4) of the energies in the early and in the late signal.

        What three decays in a row leave of a dose is a sum of powers of each (partial fractions).
        """
        weights = np.zeros((2, 4))
        energy, rate = self.energy_decay, self.rate_decay
        for signal, own in enumerate((self.early_decay, self.late_decay)):
            scale = (1.0 - rate) * (1.0 - own)
            weights[signal, 0] = scale * energy**2 / ((energy - rate) * (energy - own))
            weights[signal, 1] = scale * rate**2 / ((rate - energy) * (rate - own))
            weights[signal, 2 + signal] = scale * own**2 / ((own - energy) * (own - rate))
        return weights


@dataclass(frozen=True, eq=False)
class Burns:
    """Doses that redden a skin, and how it responds.

    Attributes
    ----------
    dynamics : ErythemaDynamics
    hours : (E,) ascending int array
    doses : (H, E) array
        In MED of the skin without sun, of H histories or kinds of doses.
    """

    dynamics: ErythemaDynamics
    hours: NDArray[np.int_]
    doses: NDArray[np.float64]

    @classmethod
    def of(cls, exposures: Exposures, dynamics: ErythemaDynamics, med: float) -> "Burns":
        """From exposures, by their doses as they count for the thickness.

        Raises
        ------
        InputError
            If these are no exposures or no dynamics, or the MED in SED is out of range.
        """
        require_exposures(exposures)
        if not isinstance(dynamics, ErythemaDynamics):
            raise InputError(
                f"erythema is {str(dynamics)[:60]!r}; expected ErythemaDynamics, as "
                "hylios.erythema(skin) gives it."
            )
        require_range("MED", med, 1e-6, 1e6, "SED")
        order = np.argsort(exposures.hours, kind="stable")
        shape = exposures.thickening_doses.shape
        given = exposures.thickening_doses.reshape(int(np.prod(shape[:-1])), order.size)
        return cls(dynamics, exposures.hours[order], given[:, order] / med)

    def until(self, hour: int) -> "Burns":
        """Those up to an hour."""
        inside = self.hours <= hour
        return Burns(self.dynamics, self.hours[inside], self.doses[:, inside])

    def on(
        self, tan: NDArray[np.float64], some: slice, marks: NDArray[np.int_]
    ) -> NDArray[np.float64]:
        """As `blood`, of some histories with states (H, E, 4) at the hours of these burns."""
        melanin, thickness = tan[..., :3].sum(axis=-1).T, tan[..., 3].T
        return np.asarray(self.blood(self.doses[some].T, melanin, thickness, marks), float)

    def acting(
        self,
        doses: NDArray[np.floating],
        melanin: NDArray[np.floating],
        thickness: NDArray[np.floating],
    ) -> NDArray[np.floating]:
        """Doses (E, H) in MED of the skin as it is by then; parameters as in `blood`."""
        own = self.dynamics
        risen = own.protection(self.hours, doses) * own.shield(melanin, thickness)
        return (doses / risen).astype(doses.dtype)

    def blood(
        self,
        doses: NDArray[np.floating],
        melanin: NDArray[np.floating],
        thickness: NDArray[np.floating],
        marks: NDArray[np.int_],
    ) -> NDArray[np.floating]:
        """Blood (T, H) at ascending hours (T,), relative to the skin's own, 1 at hour 0.

        Parameters
        ----------
        doses, melanin, thickness : (E, H) arrays
            At the hours of these burns: doses in MED, and the relative melanin and thickness of
            the epidermis that they meet.
        """
        acting = self.acting(doses, melanin, thickness)
        blood = self.dynamics.blood(self.dynamics.retained_energies(self.hours, acting, marks))
        blood[marks == 0] = 1.0
        return blood


def whole_hours(times: NDArray[np.float64]) -> NDArray[np.int_]:
    """The hours (T,), ascending, before and after some times."""
    if np.all(times == np.floor(times)) and np.all(np.diff(times) > 0.0):
        return times.astype(int)
    return np.unique(np.concatenate([np.floor(times), np.ceil(times)])).astype(int)


def between_hours(
    hours: NDArray[np.int_], values: NDArray[np.float64], times: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Values (T, H) at ascending hours (T,), at times between them (H, N): straight."""
    if np.array_equal(hours, times):
        return values.T
    before = np.maximum(np.searchsorted(hours, times, side="right") - 1, 0)
    after = np.minimum(before + 1, len(hours) - 1)
    fraction = ((times - hours[before]) / np.maximum(hours[after] - hours[before], 1))[:, None]
    return (values[before] * (1.0 - fraction) + values[after] * fraction).T


def _faded(
    hours: NDArray[np.int_],
    doses: NDArray[np.floating],
    marks: NDArray[np.int_],
    decays: tuple[float, ...],
) -> NDArray[np.floating]:
    """What each of D decays leaves of doses (E, H) at ascending hours (T, D, H)."""
    by_kind, (count, histories) = np.array(decays), (len(marks), doses.shape[1])
    amounts = np.zeros((count, by_kind.size, histories), doses.dtype)
    ends = np.searchsorted(marks, hours)
    told = ends < count
    if not np.any(told):
        return amounts
    left = by_kind ** (marks[ends[told]] - hours[told])[:, None]
    np.add.at(amounts, ends[told], left[..., None].astype(doses.dtype) * doses[told, None])
    if count == 1:
        return amounts
    since = np.diff(marks)
    if since.min() == since.max():
        steps, place = since[:1], None
    else:
        steps, place = np.unique(since, return_inverse=True)
    kept = np.repeat((by_kind ** steps[:, None]).astype(doses.dtype), histories, axis=1)
    # Nothing is left before the first mark, so what it keeps does not matter.
    decaying = kept[0] if place is None else in_blocks(kept[np.append(0, place)])
    faded = accumulated(decaying, in_blocks(amounts.reshape(count, -1)))
    return in_a_row(faded, count).reshape(amounts.shape)
