"""Chooses the wavelengths that hylios ships: `python -m examples.simplifications.quadrature`.

Writes hylios/quadrature.csv and the components of skin's spectra hylios/lab/skin_spectra.csv, in
some minutes and the same every time.
"""

import argparse
import csv
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.polynomial import legendre

import hylios
from examples.simplifications.light import GRID, metrics, reflectances
from examples.simplifications.skins import random_skins
from examples.simplifications.variants import whole
from hylios.files import written_beside
from hylios.lab import colour, skin_spectra
from hylios.lab.quadrature_choice import Colours, choose
from hylios.quadrature import COLUMNS, FEWEST, MOST, TABLE, Quadrature

FIRST, LAST = 400.0, 700.0
"""First and last wavelength to choose from: beyond, the eye sees little and spectra are guesses."""

SKINS = 300

WALKED = 16
"""Most wavelengths that are chosen for random walks too; more are for the solver alone, which has
no noise, and for flushed skin too."""

FLUSHED = 30.0
"""Most blood of flushed skin in %."""

WITHOUT_NOISE = 1e9
"""Rays that stand for a solver without noise; still more bring nothing."""


def skin_colours(count: int = SKINS, seed: int = 1, most_blood: float = 5.0) -> Colours:
    """Random skins, none of them among those that anything is measured on."""
    weights = colour.rec709_weights(GRID)
    light = reflectances(random_skins(count, seed, most_blood), GRID, whole)
    return Colours(GRID, weights, light, metrics(light @ weights.T))


def gauss(count: int) -> Quadrature:
    """Gauss's quadrature for what the eye sees of daylight, to compare with.

    Nodes are those of Gauss for the weight (x + y + z) D65 on `GRID`, weights those that give
    each channel of a polynomial reflectance of a degree below `count` exactly.
    """
    full = colour.rec709_weights(GRID)
    weight = colour.xyz_weights(GRID).sum(axis=0)
    place = np.interp(GRID, (GRID[0], GRID[-1]), (-1.0, 1.0))
    polynomials = legendre.legvander(place, count - 1)
    orthonormal, _ = np.linalg.qr(np.sqrt(weight)[:, None] * polynomials)
    nodes = np.linalg.eigvalsh(orthonormal.T @ (place[:, None] * orthonormal))
    moments = full @ polynomials
    weights = np.linalg.solve(legendre.legvander(nodes, count - 1).T, moments.T).T
    return Quadrature(np.interp(nodes, (-1.0, 1.0), (GRID[0], GRID[-1])), weights)


def write(quadratures: Sequence[Quadrature], path: Path) -> None:
    """Write quadratures as CSV."""
    with written_beside(path) as beside, beside.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for quadrature in quadratures:
            for wavelength, weights in zip(
                quadrature.wavelengths, quadrature.weights.T, strict=True
            ):
                numbers = [f"{weight:.9f}" for weight in weights]
                writer.writerow([quadrature.wavelengths.size, f"{wavelength:g}", *numbers])


def write_components(reflectances: np.ndarray, path: Path) -> None:
    """Write the components of skin's spectra (S, N) on `GRID` as CSV."""
    parts = skin_spectra.components(reflectances)
    with written_beside(path) as beside, beside.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["wavelength_nm", *range(1, parts.shape[1] + 1)])
        for wavelength, row in zip(GRID, parts, strict=True):
            writer.writerow([f"{wavelength:g}", *(f"{number:.6f}" for number in row)])


def main() -> None:
    """Choose and write."""
    allowed = (GRID >= FIRST) & (GRID <= LAST)
    skins = skin_colours()
    package = Path(hylios.__file__).parent
    write_components(skins.reflectances, package / "lab" / skin_spectra.TABLE)
    flushed = skin_colours(most_blood=FLUSHED)
    made = choose(skins, WALKED, allowed=allowed)[FEWEST - 1 :]
    made += choose(flushed, MOST, rays=WITHOUT_NOISE, allowed=allowed)[WALKED:]
    write(made, package / TABLE)
    print(f"wrote {package / TABLE} and {package / 'lab' / skin_spectra.TABLE}")


if __name__ == "__main__":
    argparse.ArgumentParser(
        "python -m examples.simplifications.quadrature", description=__doc__
    ).parse_args()
    main()
