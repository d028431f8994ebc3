"""Numbers, lists of numbers and NAME=VALUE, from the texts of a shell's arguments."""

import numpy as np

from hylios.errors import InputError

MOST_WAVELENGTHS = 10_000


def wavelength_range(text: str) -> np.ndarray:
    """Wavelengths in nm from FIRST:LAST:STEP, with both ends, or from a list a,b,c.

    Raises
    ------
    InputError
        If the text is neither, or gives more than `MOST_WAVELENGTHS`.
    """
    return number_range(text, "wavelengths", "nm", MOST_WAVELENGTHS)


def number_range(text: str, what: str, unit: str, most: int) -> np.ndarray:
    """At most so many numbers from FIRST:LAST:STEP, with both ends, or from a list a,b,c.

    Raises
    ------
    InputError
        If the text is neither, or gives more.
    """
    separator = ":" if ":" in text else ","
    try:
        numbers = [plain_number(part) for part in text.split(separator)]
    except ValueError:
        numbers = []
    if separator == "," and 0 < len(numbers) <= most:
        return np.array(numbers)
    if separator == ":" and len(numbers) == 3:
        first, last, step = numbers
        if step > 0 and first <= last and (last - first) / step < most:
            return first + step * np.arange(int((last - first) / step + 1e-9) + 1)
    raise InputError(
        f"{what} are {text!r}; expected FIRST:LAST:STEP with a positive step, or a list of "
        f"numbers, in {unit}, at most {most}."
    )


def named_values(pairs: list[str], what: str) -> dict[str, str]:
    """A dictionary from texts NAME=VALUE.

    Raises
    ------
    InputError
        If a text has no equals sign, or nothing before or after it.
    """
    for pair in pairs:
        if "=" not in pair or not all(pair.split("=", 1)):
            raise InputError(f"{what} is {pair!r}; expected NAME=VALUE.")
    return dict(pair.split("=", 1) for pair in pairs)


def number(text: str, name: str) -> float:
    """A number from a text.

    Raises
    ------
    InputError
        If it is none.
    """
    try:
        return plain_number(text)
    except ValueError as error:
        raise InputError(f"{name} is {text!r}; expected a number.") from error


def plain_number(text: str) -> float:
    """A number as people write it, and not as Python does, where 1_0 is 10.

    Raises
    ------
    ValueError
        If the text is none.
    """
    return float(_without_underscore(text))


def plain_whole(text: str) -> int:
    """A whole number, as `plain_number` has one.

    Raises
    ------
    ValueError
        If the text is none.
    """
    return int(_without_underscore(text))


def _without_underscore(text: str) -> str:
    if "_" in text:
        raise ValueError(f"there is an underscore in {text!r}")
    return text
