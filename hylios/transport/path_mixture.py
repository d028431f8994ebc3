"""Paths walked in several stacks, weighted for states that share them.

A path (`hylios.transport.paths`) counts for a state with its density there over the sum of its
densities in all stacks in which rays were spent, times their rays: the balance heuristic of
E. Veach and L. Guibas 1995, "Optimally combining sampling techniques for Monte Carlo rendering".
Where rays are spent in a state itself, no weight exceeds what these alone would give.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hylios.threads import in_order
from hylios.tissue import Layer, Stack
from hylios.tissue.melanosome_encounters import encounters
from hylios.transport.paths import Paths, log_density, rescaled, total_thickness, walk_paths
from hylios.transport.simulate import CHUNK, DISTANCE_EDGES

LIGHTER = 0.6
"""Absorption with which shared paths are walked, relative to the state's own: more of them come
out, and weigh less. The fewest seconds per effective path, flatly, at .5 to .7 for S3 and S4."""

PILOT_RAYS, PILOT_PATHS, PILOT_ROUNDS = 64, 512, 48
"""The trial before rays are allocated: rays per state and round, paths wanted, most rounds."""

BLOCK = 4096
"""Paths weighted at once."""


@dataclass(frozen=True)
class Mixture:
    """S states in one geometry, and the stacks in which paths are walked for them, one each.

    Attributes
    ----------
    walked : tuple of Stack
    columns : (C,) int array
        Of a path's sums, those that matter.
    proposed, wanted : (C, S) arrays
        `log_density` of the walked stacks and of the states, less that of the first walked one.
    scale : (S,) array
        Thickness of the states relative to that of the walked stacks.
    """

    walked: tuple[Stack, ...]
    columns: np.ndarray
    proposed: np.ndarray
    wanted: np.ndarray
    scale: np.ndarray

    @classmethod
    def of(cls, stacks: Sequence[Stack]) -> "Mixture":
        """A mixture of states of any thickness; paths are walked in the middle one's."""
        thickness = np.array([total_thickness(stack) for stack in stacks])
        middle = float(np.sort(thickness)[thickness.size // 2])
        states = [rescaled(stack, middle) for stack in stacks]
        walked = tuple(_lightened(state) for state in states)
        proposed, wanted = (
            np.array([log_density(stack).ravel() for stack in some]).T for some in (walked, states)
        )
        first = proposed[:, :1]
        proposed, wanted = proposed - first, wanted - first
        columns = np.flatnonzero(proposed.any(axis=1) | wanted.any(axis=1))
        return cls(walked, columns, proposed[columns], wanted[columns], thickness / middle)

    def densities(self, paths: Paths) -> tuple[np.ndarray, np.ndarray]:
        """Densities (N, S) of paths in the walked stacks and in the states, to a factor each."""
        sums = paths.table[:, self.columns]
        proposed, wanted = sums @ self.proposed, sums @ self.wanted
        largest = proposed.max(axis=1, keepdims=True)
        return np.exp(proposed - largest), np.exp(wanted - largest)


def try_paths(
    mixture: Mixture, angle: float, key: tuple[int, ...], threads: int | None
) -> tuple[np.ndarray, np.ndarray]:
    """Densities (N, S) of some paths in walked stacks and states, over that of being tried.

    As many rays are tried in every stack.
    """
    densities: list[tuple[np.ndarray, np.ndarray]] = []
    for turn in range(PILOT_ROUNDS):
        keys = ((*key, turn, number) for number in range(len(mixture.walked)))

        def one(stream: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
            paths = walk_paths(mixture.walked[stream[-1]], PILOT_RAYS, angle, stream)
            return mixture.densities(paths)

        densities += in_order(one, keys, threads)
        if sum(proposed.shape[0] for proposed, _ in densities) >= PILOT_PATHS:
            break
    proposed = np.concatenate([walked for walked, _ in densities])
    wanted = np.concatenate([states for _, states in densities])
    rounds = len(densities) // len(mixture.walked)
    tried = rounds * PILOT_RAYS * proposed.sum(axis=1, keepdims=True)
    return proposed / tried, wanted / tried


def pool_paths(
    mixture: Mixture, rays: np.ndarray, angle: float, key: tuple[int, ...], threads: int | None
) -> np.ndarray:
    """Light and squares (2, S, B) of `Profiles` from so many rays (S,) in each walked stack.

    Paths are weighted as they come.
    """
    tasks = (
        (mixture.walked[number], min(CHUNK, int(rays[number]) - first), (*key, number, first))
        for number in np.flatnonzero(rays)
        for first in range(0, int(rays[number]), CHUNK)
    )

    def piece(task):
        return _weighted(mixture, rays, walk_paths(task[0], task[1], angle, task[2]))

    total = np.zeros((2, mixture.scale.size, DISTANCE_EDGES.size))
    for sums in in_order(piece, tasks, threads):
        total += sums
    return total


def _weighted(mixture: Mixture, rays: np.ndarray, paths: Paths) -> np.ndarray:
    """Sums (2, S, B) of weights of paths, and of their squares, by exit distance."""
    total = np.zeros((2, mixture.scale.size, DISTANCE_EDGES.size))
    order = np.argsort(paths.distance, kind="stable")
    for first in range(0, order.size, BLOCK):
        some = order[first : first + BLOCK]
        block = replace(paths, distance=paths.distance[some], sums=paths.sums[some])
        proposed, wanted = mixture.densities(block)
        weight = wanted / (proposed @ rays)[:, None]
        starts = np.searchsorted(block.distance, DISTANCE_EDGES / mixture.scale[:, None])
        for row, power in zip(total, (weight, weight**2), strict=True):
            up_to = np.concatenate([np.zeros((1, mixture.scale.size)), np.cumsum(power, axis=0)])
            before = np.take_along_axis(up_to.T, starts, axis=1)
            row += np.diff(before, axis=1, append=up_to[-1][:, None])
    return total


def _lightened(stack: Stack) -> Stack:
    """The stack with `LIGHTER` of its absorption."""

    def lightened(layer: Layer) -> Layer:
        survival = layer.survival**LIGHTER if layer.encounter > 0.0 else layer.survival
        return replace(layer, absorption=LIGHTER * layer.absorption, survival=survival)

    return replace(stack, layers=tuple(lightened(layer) for layer in stack.layers))


def straightened(stack: Stack) -> Stack:
    """The stack with melanosomes that turn no light as absorbers, as they are for light then."""
    if stack.scattering_angle > 0.0:
        return stack
    by_diameter = stack.readings["complex_melanosomes"] == "diameter"

    def absorbing(layer: Layer) -> Layer:
        if layer.encounter == 0.0:
            return layer
        rate, once, twice = encounters(layer, layer.survival, by_diameter)
        lost = rate * (1.0 - once - twice)
        return replace(layer, absorption=layer.absorption + lost, encounter=0.0)

    return replace(stack, layers=tuple(absorbing(layer) for layer in stack.layers))
