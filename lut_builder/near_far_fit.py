"""Near share and far width over a table's states, smoothly, from walks in some of them.

What is fitted is the edge spread (`hylios.near_far`) of all walked states together: the logit of
the near share and the logarithm of the far width are polynomials in what a state holds. So states
help each other, and one whose light says nothing of the width, as in dark skin's blue, takes it
from its neighbours.
"""

from dataclasses import dataclass
from itertools import combinations_with_replacement
from math import comb
from typing import TYPE_CHECKING

import numpy as np

from hylios.near_far import FARTHEST, NEAREST, burley_edge_spread, edge_spread
from hylios.skin import Skin
from hylios.skin.specimen import Specimen
from hylios.table import LookAxes
from hylios.threads import one_thread

if TYPE_CHECKING:
    from scipy.optimize import OptimizeResult

DISTANCES = np.geomspace(NEAREST, FARTHEST, 40)
"""Distances in mm from the edge at which spreads are compared."""

DEGREE = 2

FOR_CUBIC = 4
"""Walked states for each term of a cubic, from which on polynomials are cubic."""

USUAL, SEEN = 0.1, 0.25
"""Spread that counts as it is, and the power by which light counts more where it is fainter. The
eye sees how many times brighter, nearly, so the tail of a spread matters beyond what it holds."""

RIDGE = 0.01
"""Weight of a polynomial's coefficients, for a spread of 1 that is off."""

LEAST_WIDTHS, LARGEST_WIDTH = {2: 0.05, 3: 0.02}, 6.0
"""Limits in mm of what a polynomial makes of the width, the least by its degree: where dark skin's
light ends at once, a square makes more of its few states than they tell."""

MOST_ERROR = 1.0
"""Largest error of the logarithm of the width that is told; beyond, the width says nothing."""

SPREADS = np.linspace(
    np.log(NEAREST / LARGEST_WIDTH), np.log(FARTHEST / min(LEAST_WIDTHS.values())), 1500
)
"""Logarithms of x / d at which Burley's edge spread is tabulated."""


@dataclass(frozen=True)
class NearFar:
    """What a fit makes of N states.

    Attributes
    ----------
    near_share, far_width, near_share_error, far_width_error : (N,) arrays
        The widths in mm.
    """

    near_share: np.ndarray
    far_width: np.ndarray
    near_share_error: np.ndarray
    far_width_error: np.ndarray


def design_places(axes: LookAxes, count: int) -> np.ndarray:
    """Coordinates (count, 4) that fill the axes evenly, melanin as its knots lie.

    The additive recurrence of the generalised golden ratio (M. Roberts, "The unreasonable
    effectiveness of quasirandom sequences", 2018).
    """
    ratio = 1.0
    for _ in range(64):
        ratio = (1.0 + ratio) ** (1.0 / (len(axes.knots) + 1))
    steps = ratio ** -np.arange(1.0, len(axes.knots) + 1)
    shares = (0.5 + np.arange(1, count + 1)[:, None] * steps) % 1.0
    return np.stack(
        [
            np.interp(share, np.linspace(0.0, 1.0, len(knots)), knots)
            for share, knots in zip(shares.T, axes.knots, strict=True)
        ],
        axis=-1,
    )


def degree_of(axes: LookAxes, walked: int) -> int:
    """Degree of the polynomials that so many walked states bear."""
    cubic = comb(sum(len(knots) > 1 for knots in axes.knots) + 3, 3)
    return 3 if walked >= FOR_CUBIC * cubic else DEGREE


def terms(skin: Skin, axes: LookAxes, states: np.ndarray, degree: int = DEGREE) -> np.ndarray:
    """What the polynomials are of, (N, T), at states (N, 5): products of four numbers.

    Of melanin it is the square root: light fades fastest with the first of it. It is that of the
    specimen, not the state's: what would overfill a layer is cut.
    """
    untanned = _melanin(skin.at(skin.untanned_state))
    melanin = np.array([_melanin(skin.at(state)) for state in states])
    relative = np.sqrt(melanin / untanned) if untanned > 0.0 else np.ones(len(states))
    places = axes.coordinates(states)
    numbers = [relative - 1.0]
    for knots, place in zip(axes.knots[1:], places.T[1:], strict=True):
        span = knots[-1] - knots[0]
        if span > 0.0:
            numbers.append(2.0 * (place - knots[0]) / span - 1.0)
    columns = [np.ones(len(states))]
    for power in range(1, degree + 1):
        for some in combinations_with_replacement(numbers, power):
            columns.append(np.prod(some, axis=0))
    return np.stack(columns, axis=-1)


def fitted(
    walked: np.ndarray,
    light: np.ndarray,
    wanted: np.ndarray,
    error: float = 0.01,
    degree: int = DEGREE,
) -> NearFar:
    """Near share and far width at wanted states, from the light of walked ones.

    Parameters
    ----------
    walked : (S, T) array
        `terms` of the walked states.
    light : (S, B) array
        Their light, as `hylios.transport.shared_profiles.Profiles` has it.
    wanted : (N, T) array
        `terms` of the states to tell.
    error : float
        Of the walks: light that is fainter than twice that does not count still more.
    degree : int
        Of the `terms`.
    """
    from scipy.optimize import least_squares  # slow to import, as numba

    from hylios.transport.simulate import DISTANCE_EDGES

    lit = light.sum(axis=1) > 0.0
    walked, spread = walked[lit], edge_spread(DISTANCE_EDGES, light[lit], DISTANCES)
    count = walked.shape[1]
    brightness = np.maximum(spread, 0.0).mean(axis=0) if lit.any() else np.ones(DISTANCES.size)
    weight = (USUAL / (brightness + 2.0 * error)) ** SEEN / np.sqrt(DISTANCES.size)
    spreads = burley_edge_spread(np.exp(SPREADS))
    slopes = np.gradient(spreads, SPREADS)
    ridge = RIDGE * np.diag(np.arange(2 * count) % count > 0)

    def shapes(parameters: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        far = _share(-walked @ parameters[:count])
        width = np.log(_width(walked @ parameters[count:], degree))
        ratio = np.log(DISTANCES) - width[:, None]
        return far[:, None], np.interp(ratio, SPREADS, spreads), np.interp(ratio, SPREADS, slopes)

    def misfit(parameters: np.ndarray) -> np.ndarray:
        far, shape, _ = shapes(parameters)
        off = (far * shape - spread) * weight
        return np.concatenate([off.ravel(), ridge @ parameters])

    def slope(parameters: np.ndarray) -> np.ndarray:
        far, shape, steepness = shapes(parameters)
        by_share = -far * (1.0 - far) * shape * weight
        by_width = -far * steepness * weight
        rows = [
            (part[:, :, None] * walked[:, None, :]).reshape(-1, count)
            for part in (by_share, by_width)
        ]
        return np.concatenate([np.concatenate(rows, axis=1), ridge])

    with one_thread():
        start = np.zeros(2 * count)
        solution = least_squares(misfit, start, jac=slope, max_nfev=100)  # pyright: ignore
        return _told(solution, len(walked), wanted, degree)


def _told(solution: "OptimizeResult", states: int, wanted: np.ndarray, degree: int) -> NearFar:
    """What the parameters found tell of wanted states, with errors by what the fit leaves over.

    A state's spread tells two numbers.
    """
    count, parameters, slope = wanted.shape[1], solution.x, solution.jac
    share = _share(wanted @ parameters[:count])
    width = _width(wanted @ parameters[count:], degree)
    left = float(np.sum(solution.fun**2)) / max(2 * states - 2 * count, 1)
    covariance = left * np.linalg.pinv(slope.T @ slope)
    errors = [
        np.sqrt(np.maximum(np.einsum("nt,tu,nu->n", wanted, covariance[part, part], wanted), 0.0))
        for part in (slice(0, count), slice(count, 2 * count))
    ]
    return NearFar(
        share,
        width,
        np.minimum(share * (1.0 - share) * errors[0], 1.0),
        width * np.minimum(errors[1], MOST_ERROR),
    )


def _share(logit: np.ndarray) -> np.ndarray:
    """A share from the polynomial of its logit."""
    return 1.0 / (1.0 + np.exp(-logit))


def _width(logarithm: np.ndarray, degree: int) -> np.ndarray:
    """Width in mm from its polynomial."""
    return np.exp(np.clip(logarithm, np.log(LEAST_WIDTHS[degree]), np.log(LARGEST_WIDTH)))


def _melanin(specimen: Specimen) -> float:
    """Melanin of a specimen's epidermis in cm, all layers together."""
    return float(specimen.melanin @ specimen.epidermal_thickness)
