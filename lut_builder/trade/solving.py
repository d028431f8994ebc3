"""What light in single states takes on one core, by either solver: seconds of the processor."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from hylios.adding import spectra
from hylios.lab.colour import rec709_weights
from hylios.skin import Skin
from hylios.transport.simulate import spectrum as walked
from lut_builder.reachable import reachable_states
from lut_builder.request import ANGLE, ANGLES, STATES_TOGETHER, WATER

UNSEEN = np.array([401.7, 433.1, 468.3, 507.9, 541.7, 583.3, 611.9, 653.1])
"""Wavelengths in nm that no table uses, so that nothing of them is kept from before."""


@dataclass(frozen=True)
class Cost:
    """Seconds of the solver: of a reflectance, and how much more of the first at a wavelength."""

    later: float
    first: float

    def seconds(self, states: int, wavelengths: int) -> float:
        """Seconds of a table's colours and bands."""
        return wavelengths * (self.first + states * self.later)


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds and result."""
    start = time.process_time()
    result = work()
    return time.process_time() - start, result


def reflectances(skin: Skin, states: np.ndarray, wavelengths: np.ndarray, nodes: int) -> np.ndarray:
    """Total reflectance (N, W) of states by the solver, as pieces of a table compute it."""
    parts = []
    for first in range(0, len(states), STATES_TOGETHER):
        some = [skin.at(state) for state in states[first:][:STATES_TOGETHER]]
        # with a film beside: its directions are the table's
        light = spectra(some, wavelengths, angle=ANGLE, nodes=nodes, film=(None, WATER))
        parts.append(light.total[0])
    return np.concatenate(parts)


def table_light(skin: Skin, states: np.ndarray, wavelengths: np.ndarray, nodes: int) -> None:
    """Solve as a table needs it: at all its angles, and wet."""
    specimens = [skin.at(state) for state in states]
    spectra(specimens, wavelengths, angle=ANGLES, nodes=nodes, film=(None, WATER))


def solver_cost(skin: Skin, nodes: int, repeats: int) -> Cost:
    """What a state costs at a wavelength with so many nodes.

    Of some runs the fastest counts: other work can only slow one down.
    """
    states = reachable_states(skin, 1, 1)[:: 240 // STATES_TOGETHER][:STATES_TOGETHER]
    firsts, later = [], []
    for repeat in range(repeats):
        unseen = UNSEEN + 0.1 * repeat
        first, _ = timed(lambda at=unseen: table_light(skin, states[:1], at, nodes))
        rest, _ = timed(lambda at=unseen: table_light(skin, states, at, nodes))
        firsts.append(first / UNSEEN.size)
        later.append(rest / UNSEEN.size / len(states))
    return Cost(min(later), max(min(firsts) - min(later), 0.0))


def walk(
    skin: Skin, states: np.ndarray, wavelengths: np.ndarray, rays: int, seed: int
) -> tuple[float, np.ndarray]:
    """Seconds of a reflectance by random walk, and total reflectances (N, W)."""

    def light(state: np.ndarray) -> np.ndarray:
        specimen = skin.at(state)
        return walked(specimen, wavelengths, angle=ANGLE, rays=rays, seed=seed, threads=1).total

    light(states[0])  # compiles or loads the kernels
    seconds, reflectance = timed(lambda: np.array([light(state) for state in states]))
    return seconds / reflectance.size, reflectance


def colours(reflectance: np.ndarray, wavelengths: np.ndarray) -> np.ndarray:
    """Linear Rec.709 (N, 3) of reflectance (N, W) every 5 nm from 400 to 700 nm."""
    return reflectance @ rec709_weights(wavelengths).T
