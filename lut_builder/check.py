"""Checking a table: states between its knots, computed directly."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hylios.adding import solve
from hylios.errors import InputError
from hylios.lab.colour import difference, rec709_weights
from hylios.quadrature import MOST, skin_quadrature
from hylios.skin.specimen import Specimen
from hylios.spectra import Spectra
from hylios.table import SkinTable, skin_of
from hylios.tissue import Model, Stack
from hylios.transport.simulate import spectrum as walked
from lut_builder.own_spectra import require_own_spectra
from lut_builder.reachable import reachable_states
from lut_builder.request import ANGLE

FINE = np.arange(400.0, 701.0, 5.0)
"""Wavelengths in nm of a direct colour without noise."""

NOISE_DRAWS = 200

Progress = Callable[[float], object]
"""A function that is told how many more states are done, be it a part of one."""


@dataclass(frozen=True)
class Check:
    """How far a table is from the model.

    Attributes
    ----------
    states : (N, 4) array
        Reachable tanning states that are no knots.
    differences : (N,) array
        CIEDE2000 between the table's total colour and the direct one.
    noise : (N, draws) array or None
        CIEDE2000 that the Monte Carlo error of the direct one alone gives; None without rays.
    """

    states: np.ndarray
    differences: np.ndarray
    noise: np.ndarray | None = None

    @property
    def noise_share(self) -> float:
        """Mean square of the noise over that of the differences; above 1 only by chance."""
        if self.noise is None:
            return 0.0
        return float(np.mean(self.noise**2) / np.mean(self.differences**2))


def check(
    table: SkinTable,
    *,
    count: int,
    seed: int,
    rays: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
    spectra: Spectra | None = None,
) -> Check:
    """Compute reachable states directly and compare their colour with the table's.

    States come from schedules other than those that chose the table's axes.

    Parameters
    ----------
    rays : int
        Per wavelength of a random walk; 0 for the deterministic solver, every 5 nm.
    progress : callable, optional
        Told the number of states, or the part of one, that was done.
    spectra : mapping of names to Spectrum, optional
        In place of published ones, where the table was made so.

    Raises
    ------
    OwnSpectraError
        If these are not the spectra that the table was made with.
    InputError
        If the table's header does not say for what skin it was built, or the table has no colour
        or too few states.
    """
    skin = skin_of(table.provenance)
    model = Model(spectra or {}, table.provenance.get("readings", {}))
    require_own_spectra(table.provenance, model)
    random = np.random.default_rng(seed)
    held = _between_knots(table, reachable_states(skin, 100, seed))
    states = random.choice(held, count, replace=len(held) < count)
    seen = table.plane("total_colour", states)
    specimens = [skin.at(state) for state in states]
    told = progress or (lambda share: None)
    if not rays:
        return Check(states, difference(seen, _solved(specimens, model, told)))
    direct, spread = _walked(specimens, model, rays, seed, threads, told)
    noise = [
        difference(own + random.multivariate_normal(np.zeros(3), covariance, NOISE_DRAWS), own)
        for own, covariance in zip(direct, spread, strict=True)
    ]
    return Check(states, difference(seen, direct), np.array(noise))


def _solved(specimens: list[Specimen], model: Model, told: Progress) -> np.ndarray:
    """Colours (N, 3) by the solver, wavelength by wavelength: so it is fastest."""
    total = np.empty((FINE.size, len(specimens)))
    for row, wavelength in zip(total, FINE, strict=True):
        row[:] = solve(
            [Stack.of(specimen, float(wavelength), model) for specimen in specimens], ANGLE
        ).total
        told(len(specimens) / FINE.size)
    return (rec709_weights(FINE) @ total).T


def _walked(
    specimens: list[Specimen],
    model: Model,
    rays: int,
    seed: int,
    threads: int | None,
    told: Progress,
) -> tuple[np.ndarray, np.ndarray]:
    """Colours (N, 3) by the random walk, and their covariances (N, 3, 3)."""
    few = skin_quadrature(MOST)
    colours, spread = [], []
    for index, specimen in enumerate(specimens):
        spectrum = walked(
            specimen,
            few.wavelengths,
            angle=ANGLE,
            rays=rays,
            seed=int(np.random.SeedSequence((seed, index)).generate_state(1)[0]),
            threads=threads,
            model=model,
        )
        colours.append(few.weights @ spectrum.total)
        spread.append((few.weights * spectrum.standard_error**2) @ few.weights.T)
        told(1)
    return np.array(colours), np.array(spread)


def _computed_states(table: SkinTable) -> np.ndarray:
    """The states (N, 4) that were computed for a table."""
    if "state" not in table.planes:
        return table.axes.knot_states().reshape(-1, 4)
    ratios = np.exp(table.planes["state"][..., :4].reshape(-1, 4))
    return np.unique(table.axes.untanned * ratios, axis=0)


def _between_knots(table: SkinTable, states: np.ndarray) -> np.ndarray:
    """The states, out of (N, 4), that the table holds and that are not its knots."""
    knots = np.log(_computed_states(table))
    apart = np.full(len(states), np.inf)
    for knot in knots:
        apart = np.minimum(apart, np.abs(np.log(states) - knot).max(axis=1))
    between = (apart > 1e-6) & table.holds(states)
    if not between.any():
        raise InputError("the table has no state between its knots that could be checked.")
    return states[between]
