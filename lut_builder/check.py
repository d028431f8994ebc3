"""Checking a table: states between its knots, simulated directly."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hylios.colour import difference
from hylios.errors import InputError
from hylios.specimen import Specimen
from hylios.table import SkinTable
from lut_builder.build import Settings, tanned_appearance
from lut_builder.states import Skin, reachable_states

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
        """Share of the mean squared difference that is noise, 0 to 1."""
        return float(min(1.0, np.mean(self.noise**2) / np.mean(self.differences**2)))


def skin_of(table: SkinTable) -> Skin:
    """The skin that a table was made for, from its header.

    Raises
    ------
    InputError
        If the header lacks a part of it.
    """
    made = table.provenance
    try:
        specimen = Specimen(**made["specimen_parameters"])
        return Skin(specimen, made["pigmentation"], made["mmd_sed"], made["med_sed"])
    except (KeyError, TypeError) as error:
        raise InputError(f"the table does not say for which skin it was made: {error}.") from error


def check(
    table: SkinTable,
    *,
    count: int,
    rays: int,
    seed: int,
    threads: int | None = None,
    progress: Callable[[int], None] | None = None,
) -> Check:
    """Simulate reachable states directly and compare their colour with the table's.

    States come from schedules and random numbers other than those that made the table.
    """
    made_for = skin_of(table)
    settings = check_settings(table, rays)
    random = np.random.default_rng(seed)
    reachable = reachable_states(made_for, 100, seed)
    tanned_ones = reachable[np.abs(reachable[:, 3] - 1.0) + np.abs(reachable[:, :3].sum(1) - 1) > 0]
    states = random.choice(tanned_ones, count, replace=False)
    differences, noise = [], []
    for state in states:
        entry = tanned_appearance(made_for.specimen, state, settings, seed, threads, progress)
        simulated = entry.values[1]
        differences.append(difference(table.plane("total_colour", state), simulated))
        covariance = entry.colour_covariance * (1.0 + rays / table.provenance["rays"])
        draws = random.multivariate_normal(np.zeros(3), covariance, NOISE_DRAWS)
        noise.append(difference(simulated + draws, np.broadcast_to(simulated, draws.shape)))
    return Check(states, np.array(differences), np.array(noise))


def check_settings(table: SkinTable, rays: int) -> Settings:
    """Settings with a table's own wavelengths."""
    wavelengths = table.provenance["wavelengths_nm"]
    return Settings(knots=table.axes.shape, step=wavelengths[1] - wavelengths[0], rays=rays)
