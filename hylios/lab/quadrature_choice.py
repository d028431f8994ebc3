"""How to choose the wavelengths and weights that give the right colours of given spectra."""

from dataclasses import dataclass

import numpy as np

from hylios.errors import require_whole
from hylios.quadrature import Quadrature


@dataclass(frozen=True)
class Colours:
    """Spectra whose colours a quadrature is to meet, and what counts as a difference.

    Attributes
    ----------
    wavelengths : (N,) ascending array, nm
        Of a grid fine enough to give the right colour.
    weights : (3, N) array
        That give it (`hylios.lab.colour.rec709_weights`); each row's sum is 1.
    reflectances : (S, N) array
        0 to 1.
    metrics : (S, 3, 3) array
        Symmetric; a small error e of a colour has the squared difference e @ metric @ e.
    """

    wavelengths: np.ndarray
    weights: np.ndarray
    reflectances: np.ndarray
    metrics: np.ndarray

    def curvature(self) -> np.ndarray:
        """Matrix (3, N, 3, N) that turns an error of the weights into a mean squared difference."""
        weighed = np.einsum("sij,sa->siaj", self.metrics, self.reflectances)
        return np.einsum("siaj,sb->iajb", weighed, self.reflectances) / len(self.reflectances)

    def noise(self) -> np.ndarray:
        """The same (3, 3, N) for the error of one ray at a wavelength, p (1 - p)."""
        variance = self.reflectances * (1.0 - self.reflectances)
        return np.einsum("sij,sa->ija", self.metrics, variance) / len(self.reflectances)


def choose(
    colours: Colours, most: int, *, rays: float = 1e7, allowed: np.ndarray | None = None
) -> list[Quadrature]:
    """Quadratures of 1, 2, ... wavelengths of a grid that meet the given colours best.

    Least is the mean squared difference of the colours, from the missing wavelengths and from
    the noise of a Monte Carlo simulation together: without the latter, many wavelengths would get
    large weights of either sign. Each set is the one before with the best wavelength added; then
    each in turn is exchanged for the best other, until none can be bettered.

    Parameters
    ----------
    most : int
        Largest number of wavelengths, at most those allowed.
    rays : float
        Of the simulation, all wavelengths together, the same for each.
    allowed : (N,) bool array, optional
        Wavelengths of the grid to choose from; all by default.

    Raises
    ------
    InputError
        If `most` is out of range.
    """
    grid = np.arange(colours.wavelengths.size)
    candidates = grid if allowed is None else grid[allowed]
    require_whole("number of wavelengths", most, 1, candidates.size)
    problem = _Problem(colours.weights, colours.curvature(), colours.noise() / rays)
    nodes = np.zeros(0, int)
    made = []
    for _ in range(most):
        others = np.setdiff1d(candidates, nodes)
        nodes, error = _with_the_best(problem, nodes, others)
        former = np.inf
        while error < former * (1.0 - 1e-9):
            former = error
            for node in nodes:
                rest = nodes[nodes != node]
                nodes, error = _with_the_best(problem, rest, np.setdiff1d(candidates, rest))
        nodes = np.sort(nodes)
        (weights,), _ = problem.best_weights(nodes[None])
        made.append(Quadrature(colours.wavelengths[nodes], weights))
    return made


def _with_the_best(problem: "_Problem", nodes: np.ndarray, others: np.ndarray):
    """Some nodes and that of the others with which the error is least, and that error."""
    sets = np.column_stack([np.tile(nodes, (others.size, 1)), others])
    _, errors = problem.best_weights(sets)
    best = int(np.argmin(errors))
    return sets[best], float(errors[best])


@dataclass(frozen=True)
class _Problem:
    """Mean squared difference as a quadratic function of the weights.

    `full` (3, N) are the weights that have no error, `curvature` (3, N, 3, N) and `noise`
    (3, 3, N) as in `Colours`, the latter over the number of rays.
    """

    full: np.ndarray
    curvature: np.ndarray
    noise: np.ndarray

    def best_weights(self, sets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Weights (B, 3, n) of least error for sets (B, n) of nodes, and the errors (B,).

        Lagrange's multipliers hold the sum of each channel's weights at 1.
        """
        batch, count = sets.shape
        unknowns = 3 * count
        channel = np.repeat(np.arange(3), count)
        node = np.tile(sets, 3)
        matrix = np.zeros((batch, unknowns + 3, unknowns + 3))
        matrix[:, :unknowns, :unknowns] = self.curvature[
            channel[:, None], node[:, :, None], channel, node[:, None, :]
        ]
        same = np.equal.outer(np.tile(np.arange(count), 3), np.tile(np.arange(count), 3))
        rays_each = self.noise[channel[:, None], channel, node[:, :, None]]
        matrix[:, :unknowns, :unknowns] += count * same * rays_each
        matrix[:, unknowns + channel, np.arange(unknowns)] = 1.0
        matrix[:, np.arange(unknowns), unknowns + channel] = 1.0
        pull = np.tensordot(self.curvature, self.full, 2)
        target = np.concatenate([pull[channel, node], np.ones((batch, 3))], axis=1)
        weights = np.linalg.solve(matrix, target[..., None])[:, :unknowns, 0]
        quadratic = np.einsum(
            "bi,bij,bj->b", weights, matrix[:, :unknowns, :unknowns], weights, optimize=True
        )
        linear = np.sum(weights * pull[channel, node], axis=1)
        errors = quadratic - 2.0 * linear + np.sum(self.full * pull)
        return weights.reshape(batch, 3, count), errors
