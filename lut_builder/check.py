"""Checking a table: states between its knots, simulated directly."""

from dataclasses import dataclass, replace

import numpy as np

from hylios.colour import difference
from hylios.errors import InputError, require_whole
from hylios.skin import UNTANNED, Skin
from hylios.specimen import Specimen
from hylios.table import PLANES, SkinTable, melanin_dynamics
from hylios.transport.simulate import MOST_RAYS, Progress
from lut_builder.build import Settings, tanned_appearance
from lut_builder.states import reachable_states

NOISE_DRAWS = 200


@dataclass(frozen=True)
class Check:
    """How far a table is from the model.

    Attributes
    ----------
    states : (N, 4) array
        Reachable tanning states that are no knots.
    differences : (N,) array
        CIEDE2000 between the table's total colour and a direct simulation's.
    noise : (N, draws) array
        CIEDE2000 that the Monte Carlo error of both would give if the table were exact.
    """

    states: np.ndarray
    differences: np.ndarray
    noise: np.ndarray

    @property
    def noise_share(self) -> float:
        """Mean square of the noise over that of the differences; above 1 only by chance."""
        return float(np.mean(self.noise**2) / np.mean(self.differences**2))


def skin_of(table: SkinTable) -> Skin:
    """The skin that a table was made for, from its header.

    The dynamics are those that the header spells out; where it does not, as in the first tables,
    those of the tanning set that it names.

    Raises
    ------
    InputError
        If the header lacks a part of it or a part cannot be used.
    """
    made = table.provenance
    try:
        return Skin(
            specimen=Specimen(**made["specimen_parameters"]),
            pigmentation=made["pigmentation"],
            mmd=float(made["mmd_sed"]),
            med=float(made["med_sed"]),
            dynamics=melanin_dynamics(made),
            untanned=_untanned(made["untanned_state"]),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"the table does not say for which skin it was made: {error}") from error


def _untanned(sentence: str) -> str:
    """Name of the untanned state that a header describes."""
    names = {said: name for name, said in UNTANNED.items()}
    if sentence not in names:
        raise InputError(
            f"the table's untanned state is {sentence!r}; allowed are {'; '.join(names)}."
        )
    return names[sentence]


def settings_of(table: SkinTable) -> Settings:
    """How a table was built, from its header.

    Raises
    ------
    InputError
        If the header does not say so.
    """
    made = table.provenance
    try:
        visible = tuple(float(each) for each in made["wavelengths_nm"])
        rays = require_whole("the table's number of rays", made["rays"], 1, MOST_RAYS)
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"the table does not say how it was built: {error}") from error
    return Settings(knots=table.axes.shape, visible=visible, rays=rays)


def check(
    table: SkinTable,
    *,
    count: int,
    rays: int,
    seed: int,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Check:
    """Simulate reachable states directly and compare their colour with the table's.

    States come from schedules other than those that chose the table's axes; each has random
    numbers of its own, other than the table's.

    Raises
    ------
    InputError
        If the table's header does not say for what skin and how it was built.
    """
    made_for, made_with = skin_of(table), settings_of(table)
    settings = replace(made_with, rays=rays)
    random = np.random.default_rng(seed)
    states = random.choice(_between_knots(table, reachable_states(made_for, 100, seed)), count)
    differences, noise = [], []
    for index, state in enumerate(states):
        own_seed = int(np.random.SeedSequence((seed, index)).generate_state(1)[0])
        entry = tanned_appearance(
            made_for,
            state,
            settings,
            own_seed,
            threads=threads,
            chosen=table.provenance.get("readings"),
            progress=progress,
        )
        simulated = entry.values[PLANES.index("total_colour")]
        differences.append(difference(table.plane("total_colour", state), simulated))
        covariance = entry.colour_covariance * (1.0 + rays / made_with.rays)
        draws = random.multivariate_normal(np.zeros(3), covariance, NOISE_DRAWS)
        noise.append(difference(simulated + draws, np.broadcast_to(simulated, draws.shape)))
    return Check(states, np.array(differences), np.array(noise))


def _between_knots(table: SkinTable, states: np.ndarray) -> np.ndarray:
    """Those of the states (N, 4) that are no knot of the table."""
    knots = np.log(table.axes.knot_states().reshape(-1, 4))
    apart = np.full(len(states), np.inf)
    for knot in knots:
        apart = np.minimum(apart, np.abs(np.log(states) - knot).max(axis=1))
    return states[apart > 1e-6]
