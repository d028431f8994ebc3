"""How a table's skin makes melanin, as its provenance holds it."""

from collections.abc import Mapping
from dataclasses import MISSING, asdict, fields
from typing import Any

from hylios.errors import InputError
from hylios.tanning import PIGMENTATIONS, MelaninDynamics


def described_dynamics(dynamics: MelaninDynamics) -> dict[str, float | list[float]]:
    """Melanin dynamics as a table's provenance holds them, `melanin_dynamics`."""
    return {
        name: list(value) if isinstance(value, tuple) else value
        for name, value in asdict(dynamics).items()
    }


def melanin_dynamics(provenance: Mapping[str, Any]) -> MelaninDynamics:
    """How a table's skin makes melanin, from its provenance.

    The numbers in `melanin_dynamics`; a table that has none, as the first ones, says the name of
    a set of table 6.4 in `pigmentation`.

    Raises
    ------
    InputError
        If neither can be used.
    """
    if "melanin_dynamics" in provenance:
        return _dynamics_of(provenance["melanin_dynamics"])
    name = provenance.get("pigmentation")
    if not isinstance(name, str) or name not in PIGMENTATIONS:
        allowed = ", ".join(PIGMENTATIONS)
        raise InputError(f"the table's pigmentation is {name!r}; allowed are {allowed}.")
    return PIGMENTATIONS[name]


def _dynamics_of(described: Any) -> MelaninDynamics:
    rates = {each.name: each.default is MISSING for each in fields(MelaninDynamics)}
    if not isinstance(described, dict) or set(described) != set(rates):
        raise InputError(f"the table's melanin dynamics need the rates {', '.join(rates)}.")
    held = {}
    for name, per_layer in rates.items():
        numbers = described[name] if per_layer else [described[name]]
        count = 3 if per_layer else 1
        if not isinstance(numbers, list) or list(map(_is_number, numbers)) != [True] * count:
            expected = "3 numbers" if per_layer else "a number"
            raise InputError(
                f"the table's {name} is {str(described[name])[:40]}; expected {expected}."
            )
        values = [float(each) for each in numbers]
        held[name] = tuple(values) if per_layer else values[0]
    return MelaninDynamics(**held)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e300
