"""What a fit of skin may change, by what names, and how far."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from hylios.errors import InputError
from hylios.skin.physiology import PHYSIOLOGY
from hylios.skin.specimen import EPIDERMIS, Specimen, parameters

GROUPS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "melanin": tuple(
            f"{layer}_{form}"
            for form in ("melanosomes", "colloidal_melanin")
            for layer in EPIDERMIS
        ),
        "melanosomes": tuple(f"{layer}_melanosomes" for layer in EPIDERMIS),
        "colloidal_melanin": tuple(f"{layer}_colloidal_melanin" for layer in EPIDERMIS),
        "blood": ("papillary_blood", "reticular_blood"),
        "oxygenation": ("oxygenated_blood",),
        "water": ("corneum_water", "epidermis_water", "papillary_water", "reticular_water"),
        "lipids": ("corneum_lipids", "epidermis_lipids", "papillary_lipids", "reticular_lipids"),
        "corneum": ("corneum_thickness",),
        "epidermis": tuple(f"{layer}_thickness" for layer in EPIDERMIS),
        "dermis": ("papillary_thickness", "reticular_thickness"),
        "hypodermis": ("hypodermis_reflectance",),
    }
)
"""Parameters that a fit changes by one common factor."""

USUAL = (
    "melanin",
    "blood",
    "oxygenation",
    "water",
    "corneum",
    "epidermis",
    "dermis",
    "hypodermis",
)
"""What is free unless something else is asked for."""

EXPECTED_SPREAD = 0.25
"""Standard deviation expected of an unknown before any data, as a share of its bounds' distance."""

LEAST_FACTOR = 1e-3
"""Smallest factor of a group whose physiological range begins at 0."""


@dataclass(frozen=True)
class Unknowns:
    """What a fit may change: K parameters or groups, and the bounds of their factors (K,)."""

    start: Specimen
    names: tuple[str, ...]
    low: np.ndarray
    high: np.ndarray

    @property
    def room(self) -> np.ndarray:
        """Distance of the bounds' logarithms."""
        return np.log(self.high / self.low)

    @property
    def expected(self) -> np.ndarray:
        """Standard deviation of the factors' logarithms before any data."""
        return EXPECTED_SPREAD * self.room

    def specimen(self, logarithms: np.ndarray) -> Specimen:
        """The start with factors of some logarithms (K,)."""
        return scaled(self.start, self.names, np.exp(logarithms))


def unknowns_of(start: Specimen, names: tuple[str, ...]) -> Unknowns:
    """The unknowns of a fit by names of `GROUPS` or of parameters.

    Raises
    ------
    InputError
        If there is none, one is not known or named twice, or its parameters are all 0 at the start.
    """
    if not names:
        raise InputError("nothing is free; a fit needs at least one parameter or group to change.")
    low, high = np.array([_bounds(start, name) for name in names]).T
    fields = [field for name in names for field in _fields(name)]
    if len(set(fields)) < len(fields):
        raise InputError(f"free parameters are {', '.join(names)}; allowed is no parameter twice.")
    return Unknowns(start, names, low, high)


def scaled(start: Specimen, names: Sequence[str], factors: np.ndarray) -> Specimen:
    """The specimen with the parameters of each named group multiplied by its factor."""
    changes = {
        field: getattr(start, field) * float(factor)
        for name, factor in zip(names, factors, strict=True)
        for field in _fields(name)
    }
    return replace(start, **changes)


def _fields(name: str) -> tuple[str, ...]:
    single = [parameter.name for parameter in parameters()]
    if name in GROUPS:
        return GROUPS[name]
    if name in single:
        return (name,)
    raise InputError(
        f"there is nothing called {name!r} to fit; there are {', '.join([*GROUPS, *single])}."
    )


def _bounds(start: Specimen, name: str) -> tuple[float, float]:
    """Least and greatest factor that keep a group's parameters in their physiological ranges."""
    low, high = LEAST_FACTOR, np.inf
    for field in _fields(name):
        value, limits = getattr(start, field), PHYSIOLOGY[field]
        if value > 0.0:
            low, high = max(low, limits.low / value), min(high, limits.high / value)
    if not np.isfinite(high):
        raise InputError(f"{name} is 0 at the start of the fit; allowed is more than 0.")
    if not low < high:
        raise InputError(
            f"{name} of {start.name} lies outside its physiological range; allowed is a start "
            "within it."
        )
    return low, high
