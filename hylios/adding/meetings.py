"""How light meets melanosomes in a layer of many stacks."""

from dataclasses import replace
from typing import Any

import numpy as np

from hylios.errors import InputError
from hylios.tissue import Layer, Stack
from hylios.tissue.melanosome_encounters import encounters, left_out
from hylios.tissue.melanosome_survival import survival_in_melanosome


def met_in_layer(
    layer: Layer, stacks: Stack
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Rate, shares scattered once and twice (`encounters`), and `left_out`, (S,) each.

    Parameters
    ----------
    layer : Layer
        One of the stacks'; its numbers are arrays (S,).

    Raises
    ------
    InputError
        If the survival in melanosomes is not given and cannot be looked up.
    """
    numbers: dict[str, Any] = vars(layer)
    count = np.size(numbers["encounter"])
    rate, once, twice, factor = np.zeros(count), np.ones(count), np.zeros(count), np.ones(count)
    here = np.flatnonzero(numbers["encounter"] > 0.0)
    if not here.size:
        return rate, once, twice, factor
    by_diameter = stacks.readings["complex_melanosomes"] == "diameter"
    survival = _survivals(numbers, here, stacks)
    sizes = np.stack([numbers[name][here] for name in SIZES], axis=1)
    for size, alike in _distinct(sizes):
        some = here[alike]
        own = {name: number[some] for name, number in numbers.items()}
        one = replace(layer, **{**own, **dict(zip(SIZES, size, strict=True))})
        rate[some], once[some], twice[some] = encounters(one, survival[alike], by_diameter)
        factor[some] = left_out(one)
    return rate, once, twice, factor


SIZES = ("semi_minor", "semi_major", "complex_radius")


def _survivals(numbers: dict[str, Any], here: np.ndarray, stacks: Stack) -> np.ndarray:
    """Survival in a melanosome, of some of the stacks; looked up where it is not given."""
    survival = numbers["survival"][here].copy()
    missing = np.flatnonzero(survival < 0.0)
    if not missing.size:
        return survival
    entry = stacks.readings["melanosome_entry"]
    if entry != "straight":
        raise InputError(
            f"reading melanosome_entry is {entry!r}; allowed for layers without their survival "
            "in a melanosome is 'straight'."
        )
    names = ("semi_minor", "semi_major", "melanin_absorption", "refractive_index")
    rows = np.stack([*(numbers[name] for name in names), stacks.melanin_index], axis=1)[
        here[missing]
    ]
    for row, which in _distinct(rows):
        *own, melanin_index = row
        layer = Layer(thickness=1.0, absorption=0.0, **dict(zip(names, own, strict=True)))
        survival[missing[which]] = survival_in_melanosome(layer, melanin_index)
    return survival


def _distinct(rows: np.ndarray):
    """Distinct rows, and where they stand."""
    if np.all(rows == rows[0]):
        yield rows[0].tolist(), np.arange(len(rows))
        return
    distinct, which = np.unique(rows, axis=0, return_inverse=True)
    for number, row in enumerate(distinct.tolist()):
        yield row, np.flatnonzero(which.reshape(-1) == number)
