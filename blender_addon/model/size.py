"""Sizes of what is made of skin, and how many times life-size a model is."""

import math

from .lines import Line

SMALLEST, LARGEST = 0.025, 3.0
"""Lengths in metres between which a person, or a part of one that is shown alone, measures.

The tallest person was 2.72 m, and one of 2.2 m reaches 2.9 m with his arms up; a baby is .5 m, a
head .25 m, an ear 6 cm, lips 5 cm, the last joint of a finger 2.5 cm. A grown body in feet is 4.6
or more, in decimetres 14, in inches 55, in centimetres 140; one of metres in a scene of centimetres
is .02 m."""

USUAL = 1.7
"""Length of a body in metres."""

FACTORS = tuple(
    sign * math.log(factor) for factor in (3.2808, 10.0, 39.37, 100.0, 1000.0) for sign in (1, -1)
)
"""Logarithms of what people take for metres, over metres: feet, decimetres, inches, centimetres."""


def is_a_person_s(length: float) -> bool:
    """Whether a person, or a part of one, can have a length in metres; 0 is that of nothing yet."""
    return length == 0.0 or SMALLEST <= length <= LARGEST


def times_life_size(length: float) -> float:
    """How many times life-size a body of a length in metres is: by a usual unit, if one fits."""
    if is_a_person_s(length):
        return 1.0
    over = math.log(length / USUAL)
    factor = math.exp(min(FACTORS, key=lambda factor: abs(over - factor)))
    return factor if is_a_person_s(length / factor) else length / USUAL


def lines_on(length: float) -> tuple[str, ...]:
    """Short lines on a length in metres that no person has."""
    if is_a_person_s(length):
        return ()
    if length > LARGEST:
        return (
            Line("{length:.3g} m is too large for a person:", length=length),
            "its skin hardly scatters light",
        )
    return (
        Line("{length:.2g} mm is too small for a person:", length=1000.0 * length),
        "its skin glows like wax",
    )
