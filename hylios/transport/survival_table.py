"""Makes the table of survival in a melanosome, which `hylios.tissue` reads instead of walking.

`python -m hylios.transport.survival_table` writes it anew, in about 5 minutes on one core.
"""

import argparse
import os
from pathlib import Path

import numpy as np

from hylios.tissue.melanosome_survival import (
    ASPECTS,
    POINTS,
    RATIOS,
    TABLE,
    aspects,
    ratios,
)
from hylios.transport.generator import stream
from hylios.transport.melanosome_paths import walk_melanosomes

PATHS = 1 << 19
"""Paths of one stream of random numbers."""

STREAMS = 16
"""Streams of an entry: 8.4 million paths, whose mean length has a standard error of 0.04 %."""

BINS = 1 << 12
"""Equally filled bins of each stream's lengths, of which the means are kept."""


def quadrature(lengths: np.ndarray, points: int) -> tuple[np.ndarray, np.ndarray]:
    """Lengths and weights with the same first 2 x `points` moments as equally likely lengths.

    Gauss's quadrature for the measure that the lengths are, by Lanczos's recurrence (Golub and
    Welsch 1969). Returns two (points,) arrays.
    """
    vectors = [np.full(lengths.size, lengths.size**-0.5)]
    diagonal, beside = [], []
    for _ in range(points):
        onwards = lengths * vectors[-1]
        diagonal.append(onwards @ vectors[-1])
        for vector in vectors:  # against all, for rounding
            onwards = onwards - (onwards @ vector) * vector
        beside.append(np.linalg.norm(onwards))
        vectors.append(onwards / beside[-1])
    matrix = np.diag(diagonal) + np.diag(beside[:-1], 1) + np.diag(beside[:-1], -1)
    values, columns = np.linalg.eigh(matrix)
    return values, columns[0] ** 2


def path_lengths(aspect: float, ratio: float) -> np.ndarray:
    """Mean lengths (STREAMS * BINS,) of equally many paths, in units of the semi-minor axis."""
    lengths = np.empty(PATHS)
    means = []
    for number in range(STREAMS):
        walk_melanosomes(stream(0, number), (1.0, 1.0 / aspect), ratio, 1.0, False, lengths)
        means.append(np.sort(lengths).reshape(BINS, -1).mean(axis=1))
    return np.concatenate(means)


def write(path: Path = TABLE) -> None:
    """Simulate all entries and write the table, beside its place first."""
    names = [f"{what}_{point}" for what in ("length", "weight") for point in range(POINTS)]
    lines = [",".join(["aspect", "ratio", *names])]
    for aspect in aspects():
        for ratio in ratios():
            row = aspect, ratio, *np.concatenate(quadrature(path_lengths(aspect, ratio), POINTS))
            lines.append(",".join(f"{value:.8g}" for value in row))
    beside = path.with_suffix(".part")
    beside.write_text("\n".join(lines) + "\n", encoding="utf-8")
    os.replace(beside, path)


if __name__ == "__main__":
    argparse.ArgumentParser(
        "python -m hylios.transport.survival_table", description=__doc__
    ).parse_args()
    print(f"{ASPECTS} x {RATIOS} entries of {STREAMS * PATHS} paths each")
    write()
    print(f"written to {TABLE}")
