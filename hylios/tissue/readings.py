"""Choices that the thesis's text leaves open, and what is taken for each."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from hylios.errors import InputError


@dataclass(frozen=True)
class Reading:
    """A choice that the thesis's text leaves open: what is taken, and what else can be."""

    choices: tuple[str, ...]
    what: str

    @property
    def default(self) -> str:
        """The first choice."""
        return self.choices[0]


READINGS: Mapping[str, Reading] = MappingProxyType(
    {
        "colloidal_melanin": Reading(
            ("as_in_melanosomes", "solid"), "concentration of melanin outside the melanosomes"
        ),
        "complex_content": Reading(
            ("printed", "packed"),
            "v in 4.3 for complexes: the melanosome content as it is, or the volume of the "
            "complexes that hold it with n_m melanosomes in each",
        ),
        "complex_melanosomes": Reading(
            ("chord", "diameter"), "melanosomes met in a complex: those along the chord, or n_m"
        ),
        "melanosome_entry": Reading(("straight", "refracted"), "direction inside a melanosome"),
        "melanosome_scattering": Reading(
            ("algorithm_1", "exponential"),
            "exp(-x) sin(x) as algorithm 1 has it (mean near 10 degrees), or an exponential of "
            "mean 5 degrees as the text says",
        ),
        "rayleigh": Reading(
            ("once_per_traversal", "every_collision"), "scattering in the papillary dermis"
        ),
        "rayleigh_denominator": Reading(
            ("printed", "plus_two"), "eta^2 + 1 in 4.7, or Rayleigh's eta^2 + 2"
        ),
        "inner_fresnel": Reading(
            ("on", "off"), "Fresnel reflection and refraction where two layers meet"
        ),
        "floor": Reading(
            ("normal", "mirrored"), "diffuse about the dermal floor's normal or the mirrored ray"
        ),
    }
)
"""Readings that move a specimen's reflectance by more than .01; the first choice is the default."""


def complete_readings(others: Mapping[str, str] | None = None) -> Mapping[str, str]:
    """All readings by name: those given, and the defaults of the rest.

    Raises
    ------
    InputError
        If there is no such reading or no such choice.
    """
    result = {name: reading.default for name, reading in READINGS.items()}
    for name, choice in (others or {}).items():
        if name not in READINGS:
            raise InputError(f"there is no reading {name!r}; there are {', '.join(READINGS)}.")
        if choice not in READINGS[name].choices:
            allowed = ", ".join(READINGS[name].choices)
            raise InputError(f"reading {name} is {choice!r}; allowed is {allowed}.")
        result[name] = choice
    return MappingProxyType(result)
