"""Everything the tanning model needs to know about one person's skin.

A specimen, how it makes melanin, and the doses from which it tans and burns. numpy only.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, as_numbers, require_range
from hylios.skin.kinetics import measured_dynamics
from hylios.skin.specimen import (
    EPIDERMIS,
    LAYERS,
    Specimen,
    contents,
    overfull,
    require_specimen,
    tanned,
)
from hylios.tanning import (
    KINETICS,
    PIGMENTATIONS,
    ErythemaDynamics,
    Exposures,
    Kinetics,
    MelaninDynamics,
    TanningHistory,
    minimal_erythema_dose,
    minimal_melanogenesis_dose,
    simulate,
    states_at,
)

USUAL_PIGMENTATION = {"S1": "low", "S2": "low", "S3": "low", "S4": "high"}
"""Set of table 6.4 for each specimen of table 6.1, by that table's caption."""

LEAST_PIGMENTATION, MOST_PIGMENTATION = 0.013, 0.43
"""Melanin fraction of the epidermis within which equations 3.1 and 3.2 hold."""

UNTANNED = {
    "steady_state": "melanin of each layer by the tanning set's steady state (5.16)",
    "own": "the specimen's own melanin of each layer, scaled by m_i(t)/m_i(0)",
}
"""What the skin is without sun: 5.16 as printed, which keeps the specimen's total of melanin but
lays it out by the tanning set, or the specimen itself. The same where the specimen's melanin lies
as the set's, as in `hylios.skin.phototypes`."""

THICKENED = {
    "skin": LAYERS,
    "epidermis": ("corneum", *EPIDERMIS),
}
"""Layers that thicken in the sun: all as 5.29 has it, or corneum and epidermis. People's dermis
does not thicken; scaled with the rest it adds blood, and so the look of redness."""

MOST_BLOOD, ADDED_OXYGENATED = 12.0, 97.0
"""Most blood relative to the untanned skin's, and oxygenated share in % of what is added: arterial.
A proposal for flush and sunburn, marked ESTIMATE: in the thesis blood does not change."""

_PER_LAYER = ("production", "transfer", "extra_production", "extra_transfer")


@dataclass(frozen=True)
class Skin:
    """A specimen with the way it tans.

    Attributes
    ----------
    specimen : Specimen
    pigmentation : str
        Set of table 6.4 that the dynamics come from: low, intermediate or high.
    mmd, med : float
        Minimal melanogenesis and erythema dose in SED.
    dynamics : MelaninDynamics
        The set's, or a variation of it.
    untanned : str
        One of `UNTANNED`: which skin the state without sun is.
    kinetics : str
        One of `KINETICS`: how melanin follows the sun, "thesis" or "measured".
    thickening : str
        One of `THICKENED`: which layers thicken. Tables have the thesis's; `whole_thickening`
        tells where they hold the look of the other.

    Examples
    --------
    Day 10 after 30 SED:

    >>> import hylios
    >>> skin = hylios.Skin.of(hylios.specimen("S3"))
    >>> state = skin.states(hylios.Exposures([0], [30]), times=[240])[0]
    >>> print(f"melanin {state[:3].sum():.2f}, thickness {state[3]:.2f}")
    melanin 1.83, thickness 1.16
    """

    specimen: Specimen
    pigmentation: str
    mmd: float
    med: float
    dynamics: MelaninDynamics
    untanned: str = "steady_state"
    kinetics: str = "thesis"
    thickening: str = "skin"

    def __post_init__(self):
        if self.pigmentation not in PIGMENTATIONS:
            raise InputError(
                f"pigmentation is {self.pigmentation!r}; allowed is {', '.join(PIGMENTATIONS)}."
            )
        if self.untanned not in UNTANNED:
            raise InputError(
                f"the untanned skin is {self.untanned!r}; allowed is {', '.join(UNTANNED)}."
            )
        if self.kinetics not in KINETICS:
            raise InputError(f"kinetics are {self.kinetics!r}; allowed is {', '.join(KINETICS)}.")
        if self.thickening not in THICKENED:
            raise InputError(
                f"thickening is {self.thickening!r}; allowed is {', '.join(THICKENED)}."
            )
        require_range("MMD", self.mmd, 0.01, 1000.0, "SED")
        require_range("MED", self.med, 0.01, 1000.0, "SED")

    @classmethod
    def of(
        cls,
        specimen: Specimen,
        pigmentation: str | None = None,
        mmd: float | None = None,
        med: float | None = None,
        *,
        tanning: Mapping[str, float] | None = None,
        untanned: str = "steady_state",
        kinetics: str = "thesis",
    ) -> "Skin":
        """A skin, with what is not given from table 6.1's caption and equations 3.1 and 3.2.

        Melanin outside the equations' range, such as none at all, counts as the range's end.

        Parameters
        ----------
        mmd, med : float, optional
            SED.
        tanning : mapping, optional
            Changes to the set's dynamics; see `varied`.

        Raises
        ------
        InputError
            If that is no specimen, a minimal dose is out of range, there is no such tanning set or
            kinetics, or a change to it or the untanned state cannot be used.
        """
        require_specimen(specimen)
        level = min(max(specimen.pigmentation, LEAST_PIGMENTATION), MOST_PIGMENTATION)
        pigmentation = pigmentation or USUAL_PIGMENTATION.get(specimen.name, "low")
        if pigmentation not in PIGMENTATIONS:
            raise InputError(
                f"pigmentation is {pigmentation!r}; allowed is {', '.join(PIGMENTATIONS)}."
            )
        return cls(
            specimen=specimen,
            pigmentation=pigmentation,
            mmd=minimal_melanogenesis_dose(level) if mmd is None else mmd,
            med=minimal_erythema_dose(level) if med is None else med,
            dynamics=varied(PIGMENTATIONS[pigmentation], tanning or {}),
            untanned=untanned,
            kinetics=kinetics,
        )

    @property
    def melanin_kinetics(self) -> Kinetics:
        """What melanin follows: `dynamics`, or by measured kinetics `measured_dynamics` of it.

        What simulates a skin takes this (`hylios.tanning`, `hylios.history`).
        """
        if self.kinetics == "thesis":
            return self.dynamics
        return measured_dynamics(self.specimen, self.dynamics, self.pigmentation)

    @property
    def untanned_melanin(self) -> NDArray[np.float64]:
        """Melanin of basale, spinosum, granulosum without sun, relative to their total (3,)."""
        steady = self.dynamics.steady_state()
        return steady / steady.sum()

    @property
    def untanned_state(self) -> NDArray[np.float64]:
        """The state without sun (4,): `untanned_melanin`, and thickness 1."""
        return np.append(self.untanned_melanin, 1.0)

    def at(self, state: ArrayLike) -> Specimen:
        """The specimen in a tanning state; see `hylios.skin.specimen.tanned`.

        Blood scales both layers of the dermis alike, and what is added is arterial: of m times
        the blood, (S + `ADDED_OXYGENATED` (m - 1)) / m % is oxygenated where the specimen's own
        S % is.

        Parameters
        ----------
        state : (4,) or (5,) array
            Melanin of basale, spinosum, granulosum relative to the total without sun, thickness
            relative to that without sun, and blood relative to the specimen's, 1 to `MOST_BLOOD`;
            1 where it is left out.

        Raises
        ------
        InputError
            If the state has another shape, or one of its numbers is out of range.
        """
        melanin, thickness, blood = _parts(state)
        layers = THICKENED[self.thickening]
        return flushed(tanned(self.specimen, melanin, thickness, self._kept, layers), blood)

    def overfull(self, state: ArrayLike) -> bool:
        """Whether `at` cuts melanin in a state, as it takes them, that would overfill a layer."""
        return overfull(self.specimen, *_parts(state)[:2], self._kept)

    def contents(self, states: ArrayLike) -> NDArray[np.float64]:
        """Melanin content (..., 3) of basale, spinosum, granulosum, as volume fraction.

        Parameters
        ----------
        states : (..., 4) or (..., 5) array
            As `at` takes them.
        """
        numbers = as_numbers("tanning states", states)
        return contents(self.specimen, numbers[..., :3], numbers[..., 3], self._kept)

    def states(
        self,
        exposures: Exposures,
        times: ArrayLike,
        *,
        erythema: ErythemaDynamics | None = None,
        step: int = 1,
    ) -> NDArray[np.float64]:
        """Tanning states after exposures, as `at` takes them, at times (T,) in hours.

        They are (..., T, 4), or (..., T, 5) with erythema. Parameters and errors as in
        `hylios.tanning.states_at`.
        """
        return states_at(
            exposures,
            self.melanin_kinetics,
            times=times,
            mmd=self.mmd,
            med=self.med,
            erythema=erythema,
            step=step,
        )

    def history(
        self,
        exposures: Exposures,
        hours: int,
        *,
        erythema: ErythemaDynamics | None = None,
        step: float = 1,
    ) -> TanningHistory:
        """The skin over time after exposures, from hour 0 to `hours`.

        Parameters and errors as in `hylios.tanning.simulate`.
        """
        return simulate(
            exposures,
            self.melanin_kinetics,
            mmd=self.mmd,
            med=self.med,
            hours=hours,
            erythema=erythema,
            step=step,
        )

    @property
    def _kept(self) -> np.ndarray | None:
        return self.untanned_melanin if self.untanned == "own" else None


def whole_thickening(states: NDArray[np.floating]) -> NDArray[np.floating]:
    """States (..., 5) of skin all of which thickens, that look as these of a thickened epidermis.

    A thicker dermis looks as more blood does, so as much blood is taken off; where there is less
    than that above the skin's own, the skin is left thinner. Over the shipped types, after one
    burn to two weeks of sun, that is within CIEDE2000 .07 in the mean and .18 at most of the skin.

    Parameters
    ----------
    states : (..., 4) or (..., 5) array
        As `Skin.at` takes them.

    Raises
    ------
    InputError
        If they have another shape.
    """
    states = np.asarray(states)
    if states.ndim == 0 or states.shape[-1] not in {4, 5}:
        raise InputError(
            f"tanning states have shape {states.shape}; expected (..., 4) or (..., 5)."
        )
    if states.shape[-1] == 4:
        states = np.concatenate([states, np.ones_like(states[..., :1])], axis=-1)
    thickness, blood = states[..., 3], states[..., 4]
    kept = np.clip(thickness, 1.0, np.maximum(blood, 1.0))
    kept = np.where(thickness < 1.0, thickness, kept)
    told = [kept, blood / np.maximum(kept, 1.0)]
    return np.concatenate([states[..., :3], np.stack(told, axis=-1)], axis=-1)


def _parts(state: ArrayLike) -> tuple[np.ndarray, float, float]:
    """Melanin (3,), thickness and blood of a tanning state (4,) or (5,)."""
    numbers = as_numbers("tanning state", state)
    if numbers.shape not in {(4,), (5,)}:
        raise InputError(f"a tanning state has shape {numbers.shape}; expected (4,) or (5,).")
    blood = float(numbers[4]) if numbers.size == 5 else 1.0
    if not 1.0 - 1e-9 <= blood <= MOST_BLOOD * (1.0 + 1e-9):
        raise InputError(f"relative blood is {blood:g}; allowed is 1 to {MOST_BLOOD:g}.")
    return numbers[:3], float(numbers[3]), blood


def flushed(specimen: Specimen, blood: float) -> Specimen:
    """The specimen with `blood` times its blood."""
    if blood == 1.0:
        return specimen
    added = ADDED_OXYGENATED * (blood - 1.0)
    return replace(
        specimen,
        papillary_blood=blood * specimen.papillary_blood,
        reticular_blood=blood * specimen.reticular_blood,
        oxygenated_blood=min((specimen.oxygenated_blood + added) / blood, 100.0),
    )


def varied(dynamics: MelaninDynamics, values: Mapping[str, float]) -> MelaninDynamics:
    """The dynamics with some rates set by name, as the thesis varies tanning ability.

    A name is a layer's and a rate's, such as `basale_extra_production` (m_p,i,f of table 6.4;
    0.0858 in figure 6.27), or one of table 6.5's, such as `melanin_decay`.

    Raises
    ------
    InputError
        If there is no such rate or a value is out of range.
    """
    layers = tuple(reversed(EPIDERMIS))
    rates = {
        f"{layer}_{name}": (name, row) for name in _PER_LAYER for row, layer in enumerate(layers)
    }
    scalars = [rate.name for rate in fields(MelaninDynamics) if rate.name not in _PER_LAYER]
    changes: dict[str, list[float] | float] = {}
    for name, value in values.items():
        if name in rates:
            rate, row = rates[name]
            whole = changes.setdefault(rate, list(getattr(dynamics, rate)))
            whole[row] = value  # type: ignore[index]  # the rates per layer are lists
        elif name in scalars:
            changes[name] = value
        else:
            raise InputError(
                f"there is no rate {name!r} of tanning; there are {', '.join([*rates, *scalars])}."
            )
    return replace(
        dynamics,
        **{
            name: tuple(value) if isinstance(value, list) else value
            for name, value in changes.items()
        },
    )
