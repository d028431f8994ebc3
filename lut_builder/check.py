"""Checking a table: states between its knots, computed directly."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hylios.adding import solve
from hylios.errors import InputError
from hylios.lab.colour import difference
from hylios.quadrature import MOST, skin_quadrature
from hylios.skin.specimen import Specimen
from hylios.spectra import Spectra
from hylios.table import LookAxes, SkinTable, skin_of
from hylios.tissue import Model, Stack
from hylios.transport.simulate import spectrum as walked
from lut_builder.lighting import Lighting, lighting_of
from lut_builder.own_spectra import require_own_spectra
from lut_builder.reachable import by_kinetics, reachable_states
from lut_builder.request import ANGLE, WATER

FINE = np.arange(400.0, 701.0, 5.0)
"""Wavelengths in nm of a direct colour without noise."""

COLOURS = {ANGLE: "total_colour", 45.0: "total_colour_45"}
"""Planes that are checked, by the angle of incidence in degrees."""

NOISE_DRAWS = 200

Progress = Callable[[float], object]
"""A function that is told how many more states are done, be it a part of one."""


@dataclass(frozen=True)
class Check:
    """How far a table is from the model.

    Attributes
    ----------
    states : (N, 5) array
        Reachable tanning states that are no knots, of any blood that the table spans.
    differences : (N,) array
        CIEDE2000 between the table's total colour and the direct one; (0,) where the table has
        bands alone.
    slanting : (N,) array or None
        The same of light that comes in at 45 degrees; None where the table has no such colour, or
        with rays.
    bands : (N, B) array or None
        By how much the table's reflectance in single bands is off; None as before.
    noise : (N, draws) array or None
        CIEDE2000 that the Monte Carlo error of the direct one alone gives; None without rays.
    """

    states: np.ndarray
    differences: np.ndarray
    slanting: np.ndarray | None = None
    bands: np.ndarray | None = None
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
        If the table's header does not say for what skin it was built, the table has no state
        between its knots, or neither a colour nor bands; with rays, if it has no colour.
    """
    skin = skin_of(table.provenance)
    model = Model(spectra or {}, table.provenance.get("readings", {}))
    require_own_spectra(table.provenance, model)
    random = np.random.default_rng(seed)
    tans = [
        reachable_states(one, 100, seed)
        for one in by_kinetics(skin)
        if one.kinetics in table.kinetics
    ]
    held = _between_knots(table, np.concatenate(tans))
    some = random.choice(held, count, replace=len(held) < count)
    states = np.column_stack([some, np.exp(random.uniform(0.0, _most_blood(table), count))])
    specimens = [skin.at(state) for state in states]
    told = progress or (lambda share: None)
    if not rays and ("band_reflectance" in table.planes or "total_colour" in table.planes):
        return _checked(table, states, specimens, model, told)
    seen = table.plane("total_colour", states)
    lighting = lighting_of(table.provenance)
    direct, spread = _walked(specimens, model, lighting, rays, seed, threads, told)
    noise = [
        difference(own + random.multivariate_normal(np.zeros(3), covariance, NOISE_DRAWS), own)
        for own, covariance in zip(direct, spread, strict=True)
    ]
    return Check(states, difference(seen, direct), noise=np.array(noise))


def _checked(
    table: SkinTable, states: np.ndarray, specimens: list[Specimen], model: Model, told: Progress
) -> Check:
    """The comparison with the solver, wavelength by wavelength: so it is fastest."""
    angles = [angle for angle, plane in COLOURS.items() if plane in table.planes]
    bands = table.provenance.get("bands_nm", []) if "band_reflectance" in table.planes else []
    fine = FINE if angles else FINE[:0]
    total = np.empty((fine.size + len(bands), max(1, len(angles)), len(specimens)))
    for row, wavelength in zip(total, [*fine, *bands], strict=True):
        stacks = [Stack.of(specimen, float(wavelength), model) for specimen in specimens]
        # with a film beside: its directions make the skin without one more accurate
        row[:] = solve(stacks, angles or [ANGLE], film=(None, WATER)).total[0]
        told(len(specimens) / len(total))
    seen = table.lookup(states)
    off = seen["band_reflectance"] - total[fine.size :, 0].T if bands else None
    if not angles:
        return Check(states, np.empty(0), bands=off)
    direct = np.einsum(
        "cw,was->asc", lighting_of(table.provenance).fine_weights(fine), total[: fine.size]
    )
    apart = {
        angle: difference(seen[COLOURS[angle]], colour)
        for angle, colour in zip(angles, direct, strict=True)
    }
    return Check(states, apart[ANGLE], apart.get(45.0), off)


def _walked(
    specimens: list[Specimen],
    model: Model,
    lighting: Lighting,
    rays: int,
    seed: int,
    threads: int | None,
    told: Progress,
) -> tuple[np.ndarray, np.ndarray]:
    """Colours (N, 3) by the random walk, and their covariances (N, 3, 3)."""
    few, weights = skin_quadrature(MOST), lighting.weights(MOST)
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
        colours.append(weights @ spectrum.total)
        spread.append((weights * spectrum.standard_error**2) @ weights.T)
        told(1)
    return np.array(colours), np.array(spread)


def _most_blood(table: SkinTable) -> float:
    """Natural logarithm of the most blood that a table spans."""
    return float(table.axes.knots[-1][-1]) if isinstance(table.axes, LookAxes) else 0.0


def _between_knots(table: SkinTable, states: np.ndarray) -> np.ndarray:
    """The states, out of (N, 4), that the table holds and that are not its knots."""
    apart = np.max(
        [
            np.abs(place[:, None] - knots).min(axis=1)
            for place, knots in zip(table.axes.coordinates(states).T, table.axes.knots, strict=True)
        ],
        axis=0,
    )
    between = (apart > 1e-6) & table.holds(states)
    if not between.any():
        raise InputError("the table has no state between its knots that could be checked.")
    return states[between]
