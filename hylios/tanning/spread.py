"""How melanin is spread over the layers of the epidermis, given how much of it there is.

A tan is mostly told by two numbers, how much melanin there is and how thick the skin; how the
melanin is spread over its layers then follows, nearly. So states lie near a sheet, which belongs to
the kinetics and not to the skin's optics. numpy only.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, as_numbers
from hylios.tanning.departures import melanin_departures
from hylios.tanning.exposures import Exposures
from hylios.tanning.kinetics import Kinetics
from hylios.tanning.measured import MeasuredDynamics
from hylios.tanning.recurrence import in_a_row, in_blocks
from hylios.tanning.shares import retained
from hylios.tanning.simulation import hill, states_at

SCHEDULES, DAYS, MOST_EXPOSURES, SEED = 24, 60, 11, 0
LEAST_DOSE, MOST_DOSE = 0.35, 10.5
"""The random schedules simulated: how many, days, most exposures, and doses in MMD."""

SINGLE, LEAST_SINGLE = 24, 1.05
"""Schedules of one exposure alone, besides, and the least dose of them in MMD. Such a tan is the
most usual, and while it rises melanin is spread otherwise than after several exposures."""

HOURS, HOURS_BETWEEN = 24 * DAYS, 12
"""Of the schedules, and between two states."""

ALL_IN_ONE = (1.0, 0.0, 0.0)
"""Melanin by layer, of which one has all."""

DEGREE = 5
"""Degree of the polynomial in melanin and thickness."""

RIDGE, EVEN_RIDGE = 1e-6, 1e-8
"""Weight of the polynomial's coefficients against the states' distance, both squared, per state:
where states weigh alike, and where cells do."""

CELLS = (24, 16)
"""Cells of melanin and of thickness that weigh alike in an even fit."""

STEPS = 16
"""Steps of melanin for each of which a usual thickness is told."""

STRIPS = 8
"""Strips of thickness for each of which it is kept how little and how much melanin was reached."""

LEAST_REACH = 1e-9
"""Span of a logarithm below which nothing changes but by rounding."""


@dataclass(frozen=True, eq=False)
class Spread:
    """The sheet near which the states of one kinetics lie.

    Attributes
    ----------
    untanned : (3,) array
        Melanin of basale, spinosum, granulosum without sun, relative to their total.
    directions : (3, 2) array
        Two orthonormal directions in the logarithms of the three layers' melanin, each with the sum
        0, so that the total does not matter (isometric log-ratios; Egozcue et al., Math. Geol. 35,
        279, 2003). States vary most along the first.
    thicknesses : (K,) ascending array
        In the natural logarithm, of the strips in which melanin's reach is kept.
    least, most : (K,) arrays
        Natural logarithm of the least and the most melanin reached there.
    coefficients : (T, 2) array
        Of the products of powers of the logarithms of melanin and thickness (`powers`).
    """

    untanned: NDArray[np.float64]
    directions: NDArray[np.float64]
    thicknesses: NDArray[np.float64]
    least: NDArray[np.float64]
    most: NDArray[np.float64]
    coefficients: NDArray[np.float64]

    def log_ratios(self, melanin: ArrayLike, thickness: ArrayLike) -> NDArray[np.float64]:
        """How far the spread is from the untanned one along `directions`, (..., 2).

        Parameters
        ----------
        melanin, thickness : (...) arrays
            Natural logarithms, relative to the untanned skin's; both are cut to what is reached.
        """
        v = np.clip(as_numbers("thickness", thickness), self.thicknesses[0], self.thicknesses[-1])
        u = np.clip(
            as_numbers("melanin", melanin),
            np.interp(v, self.thicknesses, self.least),
            np.interp(v, self.thicknesses, self.most),
        )
        u, v = np.broadcast_arrays(u, v)
        return powers(u, v, DEGREE) @ self.coefficients

    def logarithms(self, melanin: ArrayLike, thickness: ArrayLike) -> NDArray[np.float64]:
        """Logarithms (..., 3) of the layers' shares over the untanned ones, but for their mean.

        Parameters as in `log_ratios`.
        """
        return self.log_ratios(melanin, thickness) @ self.directions.T

    def states(
        self, melanin: ArrayLike, thickness: ArrayLike, blood: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Tanning states (..., 5) on the sheet, as `hylios.Skin.at` takes them.

        Parameters
        ----------
        melanin, thickness, blood : (...) arrays
            Natural logarithms of total melanin, thickness and blood, relative to the untanned
            skin's. Beyond what the kinetics reaches the spread is that of the nearest reached; the
            three numbers themselves are kept.

        Raises
        ------
        InputError
            If they are no numbers or their shapes do not fit.
        """
        u, v, b = np.broadcast_arrays(
            *(
                as_numbers(name, given)
                for name, given in (
                    ("melanin", melanin),
                    ("thickness", thickness),
                    ("blood", blood),
                )
            )
        )
        return states_of(self.untanned, self.logarithms(u, v), u, v, b)


@lru_cache(maxsize=32)
def spread_of(dynamics: Kinetics, *, mmd: float, med: float, evenly: bool = False) -> Spread:
    """The sheet of a kinetics, from some simulated schedules; the same for the same arguments.

    Parameters
    ----------
    mmd, med : float
        Minimal melanogenesis and erythema dose in SED.
    evenly : bool
        Whether all that states reach of melanin and thickness weighs alike, for a table that is to
        hold in all of it. Else all times do, and where skin is only for a short time, as in a light
        tan that still comes, the sheet follows what lies around it.

    Raises
    ------
    InputError
        If a minimal dose is out of range, or a layer has no melanin without sun: no ratio to
        nothing tells how it changes.
    """
    steady = dynamics.steady_state()
    untanned = steady / steady.sum()
    if not np.all(untanned > 0.0):
        raise InputError(
            f"melanin without sun is {untanned.tolist()} of basale, spinosum, granulosum; "
            "allowed is more than 0 in each."
        )
    states = _reached(dynamics, mmd, med)
    states = states[np.all(states > 0.0, axis=1)]
    u, v = np.log(states[:, :3].sum(axis=1)), np.log(states[:, 3])
    departures = np.log(states[:, :3] / untanned)
    directions = _directions(departures)
    terms, wanted = powers(u, v, DEGREE), departures @ directions
    if evenly:
        coefficients = fitted(terms, wanted, EVEN_RIDGE, _weights(u, v))
    else:
        coefficients = fitted(terms, wanted, RIDGE)
    return Spread(untanned, directions, *_strips(u, v), coefficients)


@lru_cache(maxsize=32)
def usual_thickness(
    dynamics: Kinetics, *, mmd: float, med: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Melanin (K,), ascending, and the mean thickness (K,) of skin with so much, in logarithms.

    Parameters and errors as in `spread_of`.
    """
    states = _reached(dynamics, mmd, med)
    u, v = np.log(np.maximum(states[:, :3].sum(axis=1), 1.0)), np.log(states[:, 3])
    most = max(u.max(), LEAST_REACH)
    place = STEPS * u / most
    low = np.minimum(place.astype(int), STEPS - 1)
    part = place - low
    counts, sums = (
        np.bincount(low, (1.0 - part) * own, STEPS + 1)
        + np.bincount(low + 1, part * own, STEPS + 1)
        for own in (np.ones_like(v), v)
    )
    held = np.flatnonzero(counts > LEAST_REACH)
    return most * held / STEPS, sums[held] / counts[held]


def _reached(dynamics: Kinetics, mmd: float, med: float) -> np.ndarray:
    """States (N, 4) that seeded schedules, and those of one exposure, lead through."""
    if not isinstance(dynamics, MeasuredDynamics):
        return _simulated(dynamics, mmd, med)
    # Of the most new melanin the share that there is hangs on gain / most alone: skins that differ
    # in how much they make and where have it in common, and all have what leads to it.
    alike = replace(dynamics, untanned=ALL_IN_ONE, places=ALL_IN_ONE, gain=0.0, most=1.0)
    share = _new_melanin(alike, float(f"{dynamics.gain / dynamics.most:.15g}"), mmd, med)
    thickness = _simulated(alike, mmd, med)[:, 3:]
    untanned = dynamics.steady_state()
    melanin = untanned + dynamics.most * share[:, None] * dynamics.places
    return np.concatenate([np.maximum(melanin, 0.0) / untanned.sum(), thickness], axis=1)


def _schedules(mmd: float) -> Exposures:
    """The seeded schedules, then those of one exposure, with doses in SED."""
    random = np.random.default_rng(SEED)
    doses = np.zeros((SCHEDULES + SINGLE, HOURS))
    doses[SCHEDULES:, 0] = mmd * np.geomspace(LEAST_SINGLE, MOST_DOSE, SINGLE)
    for schedule in doses[:SCHEDULES]:
        count = random.integers(1, MOST_EXPOSURES + 1)
        when = random.choice(HOURS, count, replace=False)
        schedule[when] = mmd * random.uniform(LEAST_DOSE, MOST_DOSE, count)
    return Exposures(np.arange(HOURS), doses)


@lru_cache(maxsize=8)
def _simulated(dynamics: Kinetics, mmd: float, med: float) -> np.ndarray:
    """States (N, 4) of the schedules."""
    times = np.arange(0, HOURS, HOURS_BETWEEN)
    states = states_at(_schedules(mmd), dynamics, times=times, mmd=mmd, med=med).reshape(-1, 4)
    states.setflags(write=False)
    return states


@lru_cache(maxsize=8)
def _new_melanin(dynamics: MeasuredDynamics, gain: float, mmd: float, med: float) -> np.ndarray:
    """New melanin (N,) in the schedules' states, all in one layer, with another gain."""
    one_layer = replace(dynamics, gain=gain)
    new = in_a_row(melanin_departures(_response(dynamics, mmd, med), one_layer)[0], HOURS)
    new = new[::HOURS_BETWEEN].T.ravel()
    new.setflags(write=False)
    return new


@lru_cache(maxsize=4)
def _response(dynamics: MeasuredDynamics, mmd: float, med: float) -> np.ndarray:
    """The Hill factor of 5.11 after the schedules by the hour, laid out in blocks."""
    energies, _ = retained(_schedules(mmd), dynamics, mmd=mmd, med=med, hours=HOURS - 1)
    signal = in_blocks(energies.signals().T)
    response = hill(signal, dynamics.hill_constant, dynamics.hill_exponent)
    response.setflags(write=False)
    return response


def _directions(departures: np.ndarray) -> np.ndarray:
    """Principal directions (3, 2) of logarithms (N, 3) without what all layers have in common."""
    centred = departures - departures.mean(axis=1, keepdims=True)
    if np.abs(centred).max() < LEAST_REACH:
        centred = np.array([[1.0, 0.0, -1.0]])
    first = np.linalg.svd(centred, full_matrices=False)[2][0]
    first = first * np.sign(first[np.abs(first).argmax()])
    return across(first)


def _strips(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Thicknesses (K,), and the least and most melanin reached near each (K,), in logarithms."""
    if np.ptp(v) < LEAST_REACH:
        return np.array([v.mean()]), np.array([u.min()]), np.array([u.max()])
    thicknesses = np.linspace(v.min(), v.max(), STRIPS)
    width = thicknesses[1] - thicknesses[0]
    near = np.abs(v - thicknesses[:, None]) <= width
    least = np.where(near, u, np.inf).min(axis=1)
    most = np.where(near, u, -np.inf).max(axis=1)
    return thicknesses, least, most


def _weights(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Weights (N,) with which all `CELLS` that states lie in weigh alike, 1 in the mean."""
    places = [
        np.minimum(count * (own - own.min()) / max(np.ptp(own), LEAST_REACH), count - 1).astype(int)
        for own, count in zip((u, v), CELLS, strict=True)
    ]
    cells = places[0] * CELLS[1] + places[1]
    weights = 1.0 / np.bincount(cells)[cells]
    return weights / weights.mean()


def powers(first: np.ndarray | float, thickness: np.ndarray | float, degree: int) -> np.ndarray:
    """Products (..., T) of powers of two logarithms (...), up to a degree in all; 0 without sun.

    In the order of the first's power, then of the thickness's, which is taken four times: it
    changes by a quarter as much.
    """
    own, other = np.broadcast_arrays(
        np.asarray(first, dtype=float), 4.0 * np.asarray(thickness, dtype=float)
    )
    # multiplied up: numpy takes ten times as long for whole powers of an array
    by_own, by_other = ([np.ones_like(own)] for _ in range(2))
    for _ in range(degree):
        by_own.append(by_own[-1] * own)
        by_other.append(by_other[-1] * other)
    pairs = _pairs(degree)
    terms = np.empty((*own.shape, len(pairs)))
    for number, (power, other_power) in enumerate(pairs):
        np.multiply(by_own[power], by_other[other_power], out=terms[..., number])
    return terms


@lru_cache(maxsize=8)
def _pairs(degree: int) -> tuple[tuple[int, int], ...]:
    """Powers of the two in the terms."""
    pairs = product(range(degree + 1), repeat=2)
    return tuple((own, other) for own, other in pairs if 0 < own + other <= degree)


def fitted(
    terms: np.ndarray, values: np.ndarray, ridge: float, weights: np.ndarray | float = 1.0
) -> NDArray[np.float64]:
    """Coefficients (T, ...) with which terms (N, T) come nearest to values (N, ...), weighted."""
    weighted = terms.T * weights
    normal = weighted @ terms + ridge * len(terms) * np.eye(terms.shape[1])
    return np.linalg.solve(normal, weighted @ values)


TERMS = powers(0.0, 0.0, DEGREE).size
"""Number of the polynomial's terms."""


def across(direction: np.ndarray) -> NDArray[np.float64]:
    """A direction (3,) of log-ratios and the one across it, as columns (3, 2)."""
    return np.stack([direction, np.cross(np.full(3, 1.0 / np.sqrt(3.0)), direction)], axis=1)


def states_of(
    untanned: np.ndarray,
    logarithms: np.ndarray,
    melanin: np.ndarray,
    thickness: np.ndarray,
    blood: np.ndarray,
) -> NDArray[np.float64]:
    """States (..., 5) of skin whose melanin is spread as told.

    Parameters
    ----------
    untanned : (3,) array
        The layers' shares of melanin in untanned skin.
    logarithms : (..., 3) array
        Of the layers' shares over those, but for their mean.
    melanin, thickness, blood : (...) arrays
        Natural logarithms of the totals, relative to the untanned skin's.
    """
    shares = untanned * np.exp(logarithms)
    shares /= shares.sum(axis=-1, keepdims=True)
    totals = np.exp(np.stack([thickness, blood], axis=-1))
    return np.concatenate([np.exp(melanin)[..., None] * shares, totals], axis=-1)
