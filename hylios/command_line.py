"""What the project's shell commands share: how they end, and how arguments are read."""

import argparse
import os
import sys
from collections.abc import Callable

import numpy as np

from hylios.errors import InputError


def run(command: Callable[[argparse.Namespace], None], arguments: argparse.Namespace) -> int:
    """Run a command; bad input is one sentence and status 2, Ctrl-C one word and status 130."""
    try:
        command(arguments)
        sys.stdout.flush()
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("cancelled", file=sys.stderr)
        return 130
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    return 0


def wavelength_range(text: str) -> np.ndarray:
    """Wavelengths in nm from FIRST:LAST:STEP, with both ends, or from a list a,b,c.

    Raises
    ------
    InputError
        If the text is neither, or gives more than 10,000 wavelengths.
    """
    try:
        numbers = [float(part) for part in text.replace(":", ",").split(",")]
    except ValueError:
        numbers = []
    if ":" not in text and numbers:
        return np.array(numbers)
    if len(numbers) == 3:
        first, last, step = numbers
        if step > 0 and first <= last and (last - first) / step < 1e4:
            return first + step * np.arange(int((last - first) / step + 1e-9) + 1)
    raise InputError(
        f"wavelengths are {text!r}; expected FIRST:LAST:STEP with a positive step, or a list of "
        "numbers, in nm."
    )


def named_values(pairs: list[str], what: str) -> dict[str, str]:
    """A dictionary from texts NAME=VALUE.

    Raises
    ------
    InputError
        If a text has no equals sign.
    """
    for pair in pairs:
        if "=" not in pair:
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
        return float(text)
    except ValueError as error:
        raise InputError(f"{name} is {text!r}; expected a number.") from error
