"""How long a picture of the skin takes, beside a plain Principled BSDF with subsurface."""

from collections.abc import Mapping, Sequence

import numpy as np

from examples.truth.outcome import Outcome, Row
from examples.truth.shots import Shot

ROUNDS = 5
MOST = 1.2


def shots() -> list[Shot]:
    """A ball of skin and a plain one by turns."""
    return [
        Shot(_name(turn, plain), "ball", "III", "dark", size=(160, 160), samples=64, plain=plain)
        for turn in range(ROUNDS)
        for plain in (True, False)
    ]


def _name(turn: int, plain: bool) -> str:
    return f"{'plain' if plain else 'skin'} {turn}"


def read(taken: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> Outcome:
    """Ratio of the shortest processor times, and the largest of a turn."""
    skin, plain = (
        np.array([lights[shot.name]["seconds"] for shot in taken if shot.plain == kind])
        for kind in (False, True)
    )
    ratio, largest = float(skin.min() / plain.min()), float((skin / plain).max())
    what = "processor time, of a plain Principled BSDF's"
    return Outcome([Row("cost", what, "times", ratio, largest, MOST)])
