"""Reflectance and time of the two solvers, and the noise of a Monte Carlo colour."""

import time
from collections.abc import Callable, Sequence

import numpy as np

from examples.simplifications.variants import Variant
from hylios.adding import solve
from hylios.lab import colour
from hylios.skin.specimen import Specimen
from hylios.tissue import Stack
from hylios.transport.melanosome_paths import with_survival
from hylios.transport.simulate import count

GRID = np.arange(360.0, 781.0, 5.0)
"""Where the eye sees, in nm; spectra of what absorbs in skin are no finer."""

ANGLE = 8.0
SEED = 1
STEP = 1e-4


def stacks(skins: Sequence[Specimen], wavelengths: np.ndarray, variant: Variant) -> list[Stack]:
    """Layers of each skin at each wavelength in nm, skins one after the other."""
    return [
        with_survival(variant(skin, float(wavelength)))
        for skin in skins
        for wavelength in wavelengths
    ]


def reflectances(
    skins: Sequence[Specimen], wavelengths: np.ndarray, variant: Variant, angle: float = ANGLE
) -> np.ndarray:
    """Total reflectance (S, W) of skins by the solver without noise."""
    solved = solve(stacks(skins, wavelengths, variant), angle)
    return solved.total.reshape(len(skins), -1)


def seconds(work: Callable[[], object]) -> float:
    """Processor time of some work."""
    start = time.process_time()
    work()
    return time.process_time() - start


def walk_seconds(layers: Sequence[Stack], rays: int, angle: float = ANGLE) -> np.ndarray:
    """Processor time (N,) of a random walk through each stack, one thread, the same each time."""

    def walk(index: int) -> None:
        count(layers[index], rays=rays, angle=angle, key=(SEED, index))

    return np.array([seconds(lambda index=index: walk(index)) for index in range(len(layers))])


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


def noise(weights: np.ndarray, reflectance: np.ndarray, colours: np.ndarray, rays: float) -> float:
    """Root mean square CIEDE2000 (one number) that a simulation's chance gives skins' colours.

    Parameters
    ----------
    weights : (3, W) array
        Of the reflectance in a colour, linear Rec.709.
    reflectance : (S, W) array
    colours : (S, 3) array
        Without noise.
    rays : float
        Per wavelength.
    """
    variance = reflectance * (1.0 - reflectance) / rays
    covariance = np.einsum("ik,sk,jk->sij", weights, variance, weights)
    return float(np.sqrt(np.mean(np.einsum("sij,sij->s", metrics(colours), covariance))))
