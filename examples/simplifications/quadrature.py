"""Chooses the wavelengths that hylios ships: `python -m examples.simplifications.quadrature`.

A minute's work, the same every time; writes hylios/quadrature.csv.
"""

import csv
import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np

import hylios
from examples.simplifications.skins import random_skins, unscattered
from hylios import colour
from hylios.quadrature import COLUMNS, FEWEST, MOST, TABLE, Colours, Quadrature, choose

GRID = np.arange(360.0, 781.0, 5.0)
"""Where the eye sees, in nm; the figures of what absorbs in skin are no finer."""

FIRST, LAST = 400.0, 700.0
"""Of the wavelengths to choose from: beyond, the eye sees little and the figures are guesses."""

SKINS = 300
STEP = 1e-4


def metrics(linear: np.ndarray) -> np.ndarray:
    """Symmetric matrices (..., 3, 3) of colours (..., 3): a small error e has the squared
    CIEDE2000 e @ matrix @ e. All in linear Rec.709.
    """

    def squared(direction: np.ndarray) -> np.ndarray:
        return (colour.difference(linear, linear + STEP * direction) / STEP) ** 2

    axes = np.eye(3)
    along = [squared(axis) for axis in axes]
    made = np.empty((*linear.shape, 3))
    for i in range(3):
        for j in range(3):
            both = along[i] if i == j else 0.5 * (squared(axes[i] + axes[j]) - along[i] - along[j])
            made[..., i, j] = both
    return made


def skin_colours(count: int = SKINS, seed: int = 1) -> Colours:
    """Random skins, none of them among those that anything is measured on."""
    weights = colour.rec709_weights(GRID)
    reflectances = np.array([unscattered(each, GRID) for each in random_skins(count, seed)])
    return Colours(GRID, weights, reflectances, metrics(reflectances @ weights.T))


def write(quadratures: Sequence[Quadrature], path: Path) -> None:
    """Write quadratures as CSV."""
    unfinished = path.with_suffix(".unfinished")
    with unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for each in quadratures:
            for wavelength, weights in zip(each.wavelengths, each.weights.T, strict=True):
                numbers = [f"{weight:.9f}" for weight in weights]
                writer.writerow([each.wavelengths.size, f"{wavelength:g}", *numbers])
    os.replace(unfinished, path)


def main() -> None:
    """Choose and write."""
    allowed = (GRID >= FIRST) & (GRID <= LAST)
    made = choose(skin_colours(), MOST, allowed=allowed)
    path = Path(hylios.__file__).parent / TABLE
    write(made[FEWEST - 1 :], path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
