"""The one exception for input that cannot be used, and the checks that raise it."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike


class InputError(ValueError):
    """Input that cannot be used; its message is one sentence with the thing, value and range."""


def shown(text: str | Path) -> str:
    """A text on one line as a terminal can show it; what cannot be printed is escaped.

    A file's name may hold line breaks, a terminal's commands, or bytes that are no text.
    """
    return "".join(
        character if character.isprintable() else character.encode("unicode_escape").decode()
        for character in str(text)
    )


def require_range(name: str, value: float, low: float, high: float, unit: str = "") -> float:
    """Return `value` if it lies in [low, high].

    Raises
    ------
    InputError
        If it does not, or if it is not a number.
    """
    if not _inside(name, value, low, high):
        suffix = f" {unit}" if unit else ""
        raise InputError(f"{name} is {value:g}{suffix}; allowed is {low:g} to {high:g}{suffix}.")
    return value


def require_whole(name: str, value: float, low: int, high: int) -> int:
    """Return `value` as an int if it is a whole number in [low, high].

    Raises
    ------
    InputError
        If it is not.
    """
    given = f"{value:g}" if isinstance(value, float) else value
    if not _inside(name, value, low, high):
        raise InputError(f"{name} is {given}; allowed is {low} to {high}.")
    if value != int(value):
        raise InputError(f"{name} is {given}; allowed are whole numbers, {low} to {high}.")
    return int(value)


def require_kind(name: str, value: Any, kind: type, expected: str) -> None:
    """Raise InputError where a value is not of a kind; `expected` says what is and whence."""
    if not isinstance(value, kind):
        raise InputError(f"{name} is {shown(str(value)[:60])!r}; expected {expected}.")


def as_numbers(name: str, values: ArrayLike) -> np.ndarray:
    """Values as an array of floats of their own, of any shape.

    Raises
    ------
    InputError
        If they are no such array.
    """
    try:
        return np.array(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} are {str(values)[:60]}; expected an array of numbers.") from error


def _inside(name: str, value: float, low: float, high: float) -> bool:
    try:
        return bool(low <= value <= high)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} is {str(value)[:60]!r}; expected a number.") from error


def first_where(bad: Any, *numbers: Any) -> list[float]:
    """The first entry of each of some arrays, or numbers, where `bad` is true."""
    bad, *spread = np.broadcast_arrays(bad, *numbers)
    return [float(number.flat[bad.argmax()]) for number in spread]
