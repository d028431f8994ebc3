"""What a plane layer that scatters does to light: reflection and transmission matrices.

All matrices act on values: row i says what becomes of a ray in direction i, so rows of reflection
and transmission sum to 1 where nothing absorbs. A scatterer is described by its Legendre moments
g_l, the means of P_l over the cosine of the angle of scattering.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial.legendre import leggauss

from hylios.adding.directions import Integrals

ORDER = 120
"""Highest Legendre moment kept; what lies above is scattered as the next moment says."""


@lru_cache(maxsize=256)
def melanosome_moments(scale: float, exponential: bool) -> np.ndarray:
    """Moments 0 to ORDER + 1 of algorithm 1, density exp(-x / scale) sin x, or of exp(-x / scale).

    `scale` in radians, above 0.
    """
    longest = min(np.pi, 40.0 * scale)
    place, weight = leggauss(400)
    # points crowd at 0, where all of a narrow density lies
    angle = longest * (0.5 * (1.0 + place)) ** 2
    density = weight * (1.0 + place) * np.exp(-angle / scale)
    if not exponential:
        density *= np.sin(angle)
    cosine = np.cos(angle)
    before, here = np.ones_like(cosine), cosine
    moments = [1.0, density @ cosine / density.sum()]
    for degree in range(1, ORDER + 1):
        before, here = here, ((2 * degree + 1) * cosine * here - degree * before) / (degree + 1)
        moments.append(density @ here / density.sum())
    result = np.array(moments)
    result.setflags(write=False)
    return result


def rayleigh_moments() -> np.ndarray:
    """Moments of Rayleigh scattering, density 3 / 8 (1 + cos^2)."""
    moments = np.zeros(ORDER + 2)
    moments[0], moments[2] = 1.0, 0.1
    return moments


def henyey_greenstein_moments(anisotropy: float) -> np.ndarray:
    """Moments of the Henyey-Greenstein density."""
    return float(anisotropy) ** np.arange(ORDER + 2)


@dataclass(frozen=True)
class Medium:
    """Light between M directions in a scattering layer, before it is known how much scatters.

    In functions of the cosine that are orthonormal with the weight cosine, which `basis` leads
    back to values at the nodes: its columns are those functions, its inverse is `inverse`. Several
    stacks' media are one with a leading dimension.

    Attributes
    ----------
    basis, inverse, mass : (..., M, M) arrays
    even, odd : tuples of (..., M, M) symmetric arrays
        For each kind of scatterer: scattering between functions that are the same for light going
        up and down, and that are opposite.
    """

    basis: np.ndarray
    inverse: np.ndarray
    mass: np.ndarray
    even: tuple[np.ndarray, ...]
    odd: tuple[np.ndarray, ...]


def medium(integrals: Integrals, scatterers: Sequence[np.ndarray]) -> Medium:
    """A medium in a layer's directions.

    Parameters
    ----------
    scatterers : sequence of (ORDER + 2,) arrays
        Legendre moments.
    """
    inverse = np.linalg.cholesky(integrals.slanted).T
    basis = np.linalg.inv(inverse)
    # grazing light first: eigenvectors of graded matrices are accurate in this order
    order = np.argsort(-np.einsum("ji,jk,ki->i", basis, integrals.mass, basis))
    basis, inverse = basis[:, order], inverse[order]
    kernels = [_kernels(integrals, moments) for moments in scatterers]
    even, odd = (tuple(basis.T @ pair[kind] @ basis for pair in kernels) for kind in (0, 1))
    return Medium(basis, inverse, basis.T @ integrals.mass @ basis, even, odd)


def _kernels(integrals: Integrals, moments: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Scattering between even and between odd functions that belong to nodes, (M, M).

    Rows of the even one sum to the integral of the node's function: no light is lost.
    """
    tail = moments[-1]
    strength = (2 * np.arange(ORDER + 1) + 1) * (moments[:-1] - tail)
    even, odd = (
        tail * integrals.mass
        + (integrals.legendre[start::2].T * strength[start::2]) @ integrals.legendre[start::2]
        for start in (0, 1)
    )
    # what rounding leaves
    return even + np.diag(integrals.legendre[0] - even.sum(axis=1)), odd


def stacked(media: Sequence[Medium], which: np.ndarray) -> Medium:
    """Media of S stacks as one; `which` (S,) of the media each has."""
    kinds = range(len(media[0].even))

    def gathered(arrays: list[np.ndarray]) -> np.ndarray:
        return np.stack(arrays)[which]

    return Medium(
        basis=gathered([one.basis for one in media]),
        inverse=gathered([one.inverse for one in media]),
        mass=gathered([one.mass for one in media]),
        even=tuple(gathered([one.even[kind] for one in media]) for kind in kinds),
        odd=tuple(gathered([one.odd[kind] for one in media]) for kind in kinds),
    )


def response(through: Medium, thickness, extinction, kept):
    """Reflection and transmission of a homogeneous layer, the same from both sides.

    With s and d the sum and difference of a value for light going down and up, s' = B d and
    d' = A s along the depth: A even, B odd scattering. What comes out of a layer of thickness h
    that is lit alike from both sides, s even about its middle, is (1 - Y) / (1 + Y), with
    Y = A F, F = tanh(sqrt(B A) h / 2) / sqrt(B A); lit oppositely, -(1 - Z) / (1 + Z) with
    Z = F B. In the medium's basis A and B are symmetric, so B A has eigenvalues that are squares of
    real numbers. (The discrete ordinates of Stamnes et al. 1988, for values instead of
    intensities, and without a case apart where nothing absorbs.)

    Parameters
    ----------
    thickness, extinction : (S,) arrays
    kept : sequence of (S,) arrays
        Of the extinction, what goes on in directions by each kind of scattering in the medium.

    Returns
    -------
    reflection, transmission : (S, M, M) arrays
    """
    wide = (..., None, None)
    sums, differences = (
        extinction[wide] * through.mass
        - sum(share[wide] * kernel for share, kernel in zip(kept, kinds, strict=True))
        for kinds in (through.even, through.odd)
    )
    lower = _cholesky(differences)
    squares, vectors = np.linalg.eigh(lower.swapaxes(1, 2) @ sums @ lower)
    roots = np.sqrt(np.maximum(squares, 0.0))
    half = 0.5 * thickness[:, None]
    small = roots * half < 1e-4
    function = np.where(
        small, half * (1.0 - (roots * half) ** 2 / 3.0), np.tanh(roots * half) / (roots + small)
    )
    turned = lower @ vectors
    onwards = (turned * function[:, None, :]) @ turned.swapaxes(1, 2)
    unit, raised = np.eye(sums.shape[1]), lower.swapaxes(1, 2)
    # Y by its transpose, F' A, for it is symmetric: so light that A does not absorb is not lost to
    # the rounding of F, which grows with grazing nodes. F' is divided by the factor of B, and so
    # both sides are multiplied by that.
    alike = np.linalg.solve(
        raised + (vectors * function[:, None, :]) @ (turned.swapaxes(1, 2) @ sums), raised
    )
    opposite = np.linalg.inv(unit + onwards)
    return (
        through.basis @ (alike - opposite) @ through.inverse,
        through.basis @ (alike + opposite - unit) @ through.inverse,
    )


def _cholesky(matrix: np.ndarray) -> np.ndarray:
    """Lower factors of symmetric matrices, of which some are 0 or less by rounding.

    The share of light that comes back does not depend on what is added here: odd scattering only
    exchanges light between directions.
    """
    scale = np.trace(matrix, axis1=1, axis2=2)[:, None, None] * np.eye(matrix.shape[1]) + 1e-30
    for exponent in range(-16, 0):
        try:
            return np.linalg.cholesky(matrix + 10.0**exponent * scale)
        except np.linalg.LinAlgError:
            continue
    raise RuntimeError("a layer scatters more light than it meets")


def once_per_traversal(cosine, weight, thickness, absorption, rayleigh):
    """Reflection and transmission of one traversal with at most one Rayleigh event.

    The integrals over where it happens are closed.

    Parameters
    ----------
    cosine, weight : (S, M) arrays
    thickness, absorption, rayleigh : (S,) arrays

    Returns
    -------
    reflection, transmission : (S, M, M) arrays
    """
    squared = cosine * cosine
    here, there = squared[:, :, None], squared[:, None, :]
    phase = (3.0 - here - there + 3.0 * here * there) * weight[:, None, :]
    phase *= 0.5 / phase.sum(axis=2, keepdims=True)
    slant = thickness[:, None] / cosine
    before = ((absorption + rayleigh)[:, None] * slant)[:, :, None]
    after = (absorption[:, None] * slant)[:, None, :]
    met = phase * (rayleigh[:, None] * slant)[:, :, None]
    reflection = met * _mean_decay(before + after)
    # exp(-after) times the integral of exp(-(before - after) t), t from 0 to 1
    least = np.minimum(before, after)
    transmission = met * np.exp(-least) * _mean_decay(np.abs(before - after))
    straight = np.exp(-before[:, :, 0])
    return reflection, transmission + straight[:, :, None] * np.eye(cosine.shape[1])


def _mean_decay(rate: np.ndarray) -> np.ndarray:
    """Integral of exp(-rate t) over t from 0 to 1."""
    small = rate < 1e-8
    return np.where(small, 1.0, -np.expm1(-rate) / np.where(small, 1.0, rate))
