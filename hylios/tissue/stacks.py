"""Many stacks at once: a `Stack` whose numbers are arrays, with an entry for each of N stacks.

Solvers that add up many stacks together take these; making them one by one takes longer than
solving them.
"""

from collections.abc import Sequence
from dataclasses import fields, replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from hylios.errors import InputError
from hylios.skin.specimen import Specimen, require_specimen
from hylios.tissue.layers import Layer, Stack
from hylios.tissue.model import Model

NUMBERS = (
    "roughness",
    "floor_reflectance",
    "index_above",
    "index_below",
    "melanin_index",
    "scattering_angle",
)
"""Numbers of a `Stack`, besides those of its layers."""


def stacks_of(
    specimens: Sequence[Specimen], wavelengths: np.ndarray, model: Model | None = None
) -> Stack:
    """Stacks of S specimens at W wavelengths in nm, N = S W, wavelengths running fastest.

    Their numbers are those of `Stack.of`.

    Raises
    ------
    InputError
        As `Stack.of`, or if the specimens' melanosomes are not arranged alike.
    """
    values = [vars(require_specimen(specimen)) for specimen in specimens]
    arrangements = {own["melanosome_arrangement"] for own in values}
    if len(arrangements) != 1:
        raise InputError(
            f"melanosomes are arranged as {', '.join(sorted(arrangements)) or 'none'}; allowed in "
            "stacks made together is one arrangement."
        )
    together: Any = SimpleNamespace(**{name: _alike(name, values) for name in values[0]})
    row: Any = np.asarray(wavelengths, dtype=float)
    made = Stack.of_alike(together, row, model or Model())
    shape = len(specimens), row.size
    return _each_number(made, lambda number: np.broadcast_to(number, shape).reshape(-1))


def joined(stacks: Sequence[Stack]) -> Stack:
    """Stacks as one; they are alike in all that is no number, and have as many layers."""
    first = stacks[0]
    return replace(
        first,
        layers=tuple(
            Layer(**{name: _row(some, name) for name in _LAYER})
            for some in zip(*(stack.layers for stack in stacks), strict=True)
        ),
        **{name: _row(stacks, name) for name in NUMBERS},
    )


def some_of(stacks: Stack, members: np.ndarray) -> Stack:
    """Some (M,) of stacks, by their numbers."""
    return _each_number(stacks, lambda number: number[members])


_LAYER = tuple(field.name for field in fields(Layer))


def _each_number(stack: Stack, change) -> Stack:
    return replace(
        stack,
        layers=tuple(
            Layer(**{name: change(number) for name, number in vars(layer).items()})
            for layer in stack.layers
        ),
        **{name: change(getattr(stack, name)) for name in NUMBERS},
    )


def _row(many: Sequence[Any], name: str) -> Any:
    return np.array([getattr(one, name) for one in many], dtype=float)


def _alike(name: str, values: list[dict[str, Any]]) -> Any:
    """What all have, or a column (S, 1) of numbers where they differ."""
    own = [one[name] for one in values]
    if isinstance(own[0], str) or own.count(own[0]) == len(own):
        return own[0]
    return np.array(own, dtype=float)[:, None]
