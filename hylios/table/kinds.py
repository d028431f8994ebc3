"""What a value of a table's header may be: numbers in a range, texts, lists and objects of them.

A kind is a function of the value's name in the header and the value. It raises InputError with one
sentence where the value does not fit. The sentence shows no text of a file raw, for that may hold
codes that a terminal obeys.
"""

import math
from collections.abc import Callable, Collection, Mapping
from typing import Any

from hylios.errors import InputError

Kind = Callable[[str, Any], None]

LONGEST_TEXT = 10_000
DEEPEST = 20
"""Most objects and lists nested in each other."""

LARGEST_NUMBER = 1e300


def unfit(name: str, value: Any, expected: str) -> InputError:
    """The exception for a value that does not fit."""
    return InputError(f"the table's {name} is {brief(value)}; expected {expected}.")


def brief(value: Any, most: int = 40) -> str:
    """The beginning of a value, in ASCII that prints."""
    try:
        text = ascii(value)
    except ValueError:  # a whole number of very many digits
        text = type(value).__name__
    return text if len(text) <= most else text[:most] + "..."


def is_number(value: Any) -> bool:
    """Whether a value is a finite number, and neither a truth value nor a text."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return abs(value) <= LARGEST_NUMBER and not math.isnan(value)


def number(low: float, high: float, unit: str = "") -> Kind:
    """A number from `low` to `high`."""

    def check(name: str, value: Any) -> None:
        if not is_number(value) or not low <= value <= high:
            raise unfit(name, value, f"a number, {low:g} to {high:g}{unit and ' '}{unit}")

    return check


def whole(low: int, high: int) -> Kind:
    """A whole number from `low` to `high`."""

    def check(name: str, value: Any) -> None:
        if not is_number(value) or value != int(value) or not low <= value <= high:
            raise unfit(name, value, f"a whole number, {low} to {high}")

    return check


def truth(name: str, value: Any) -> None:
    """True or false."""
    if not isinstance(value, bool):
        raise unfit(name, value, "true or false")


def text(name: str, value: Any) -> None:
    """A text that prints."""
    if not isinstance(value, str):
        raise unfit(name, value, "a text")
    if len(value) > LONGEST_TEXT:
        raise unfit(name, value, f"at most {LONGEST_TEXT} characters")
    if not value.isprintable():
        raise unfit(name, value, "characters that print")


def choice(allowed: Collection[str]) -> Kind:
    """One of some texts."""

    def check(name: str, value: Any) -> None:
        if not isinstance(value, str) or value not in allowed:
            raise InputError(
                f"the table's {name} is {brief(value)}; allowed are {', '.join(allowed)}."
            )

    return check


def optional(kind: Kind) -> Kind:
    """Something, or null."""

    def check(name: str, value: Any) -> None:
        if value is not None:
            kind(name, value)

    return check


def list_of(kind: Kind, least: int, most: int) -> Kind:
    """A list of `least` to `most` of a kind."""
    counts = f"{least}" if least == most else f"{least} to {most}"

    def check(name: str, value: Any) -> None:
        if not isinstance(value, list | tuple) or not least <= len(value) <= most:
            raise unfit(name, value, f"a list of {counts}")
        for place, one in enumerate(value):
            kind(f"{name}[{place}]", one)

    return check


def mapping_of(kind: Kind) -> Kind:
    """An object, all of whose values are of a kind."""

    def check(name: str, value: Any) -> None:
        _require_object(name, value)
        for key, one in value.items():
            text(f"{name}'s key", key)
            kind(f"{name}.{key}", one)

    return check


def holding(required: Mapping[str, Kind], others: Mapping[str, Kind] | None = None) -> Kind:
    """An object that has the required keys and may have others; keys unknown here say nothing."""
    kinds = {**required, **(others or {})}

    def check(name: str, value: Any) -> None:
        _require_object(name, value)
        missing = [key for key in required if key not in value]
        if missing:
            raise InputError(f"the table's {name} has no {missing[0]}.")
        for key, kind in kinds.items():
            if key in value:
                kind(f"{name}.{key}", value[key])

    return check


def require_plain(name: str, value: Any, depth: int = 0) -> None:
    """Raise InputError unless all texts in a value print and all its numbers are finite."""
    if depth > DEEPEST:
        raise InputError(f"the table's {name.split('.')[0]} is nested more than {DEEPEST} deep.")
    if isinstance(value, Mapping):
        for key, one in value.items():
            text(f"{name}'s key", key)
            require_plain(f"{name}.{key}"[:100], one, depth + 1)
    elif isinstance(value, list | tuple):
        for one in value:
            require_plain(name, one, depth + 1)
    elif isinstance(value, str):
        text(name, value)
    elif not (value is None or isinstance(value, bool) or is_number(value)):
        raise unfit(name, value, "a finite number, a text, true, false or null")


def _require_object(name: str, value: Any) -> None:
    if not isinstance(value, Mapping):
        raise unfit(name, value, "an object")
