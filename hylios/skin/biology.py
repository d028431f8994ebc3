"""What an artist may change in a skin: how much of what there is in it, relative to its own."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from types import MappingProxyType

from hylios.errors import require_range
from hylios.skin.physiology import MOST_EPIDERMAL_MELANIN, PHYSIOLOGY
from hylios.skin.specimen import EPIDERMIS, LAYERS, Specimen

THICKNESSES = tuple(f"{layer}_thickness" for layer in LAYERS)
MELANIN = tuple(
    f"{layer}_{form}" for layer in EPIDERMIS for form in ("melanosomes", "colloidal_melanin")
)

RANGES: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        "melanin": (0.25, 4.0),
        "blood": (0.25, 8.0),
        "oxygenation": (-50.0, 35.0),
        "thickness": (0.5, 2.0),
        "eumelanin": (0.25, 2.0),
        "pheomelanin": (0.25, 8.0),
    }
)
"""Least and largest value of each, around the spans of `hylios.skin.physiology` for usual skin."""


@dataclass(frozen=True)
class Biology:
    """Changes to a skin; the defaults change nothing.

    What would leave the range of living people (`hylios.skin.physiology`) is held at its end,
    unless the skin itself lies beyond.

    Attributes
    ----------
    melanin : float
        Factor on all melanin of the epidermis.
    blood : float
        Factor on the blood of both layers of the dermis.
    oxygenation : float
        Added to the oxygenated share of the blood, in percentage points.
    thickness : float
        Factor on all layers; the melanin stays.
    eumelanin, pheomelanin : float
        Factors on their concentrations in melanosomes.

    Raises
    ------
    InputError
        If one lies outside `RANGES`.
    """

    melanin: float = 1.0
    blood: float = 1.0
    oxygenation: float = 0.0
    thickness: float = 1.0
    eumelanin: float = 1.0
    pheomelanin: float = 1.0

    def __post_init__(self):
        for field in fields(self):
            low, high = RANGES[field.name]
            unit = "percentage points" if field.name == "oxygenation" else ""
            require_range(field.name, getattr(self, field.name), low, high, unit)

    def changes(self, specimen: Specimen) -> dict[str, float]:
        """New values of those of a specimen's parameters that change, by name."""
        values = {name: self.thickness * getattr(specimen, name) for name in THICKNESSES}
        more = self.melanin / self.thickness
        if specimen.pigmentation > 0.0:
            more = min(more, max(MOST_EPIDERMAL_MELANIN / specimen.pigmentation, 1.0))
        values |= {name: more * getattr(specimen, name) for name in MELANIN}
        for name in ("papillary_blood", "reticular_blood"):
            values[name] = self.blood * getattr(specimen, name)
        values["oxygenated_blood"] = self.oxygenation + specimen.oxygenated_blood
        for name in ("eumelanin", "pheomelanin"):
            field = f"{name}_concentration"
            values[field] = getattr(self, name) * getattr(specimen, field)
        held = {name: _held(name, value, specimen) for name, value in values.items()}
        return {name: value for name, value in held.items() if value != getattr(specimen, name)}

    def of(self, specimen: Specimen) -> Specimen:
        """A specimen with the changes."""
        return replace(specimen, **self.changes(specimen))


def _held(name: str, value: float, specimen: Specimen) -> float:
    """A parameter's value within its physiological range, or between that and the specimen's."""
    own, physiology = getattr(specimen, name), PHYSIOLOGY[name]
    return min(max(value, min(physiology.low, own)), max(physiology.high, own))
