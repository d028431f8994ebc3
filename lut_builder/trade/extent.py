"""What a measurement of time against error tries, how finely, and at which states."""

from dataclasses import dataclass

import numpy as np

from hylios.adding.solver import NODES
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.skin.skin import MOST_BLOOD
from lut_builder.check import FINE
from lut_builder.reachable import reachable_states, untanned_state
from lut_builder.settings import BANDS_NM

BROAD = np.arange(250.0, 2501.0, 25.0)
"""Wavelengths in nm of the spectra that principal components are to keep."""

COMPONENTS = (1, 2, 3, 4, 8)

BASE_WAVELENGTHS = 8
"""Wavelengths of the colours where something else is varied."""

SECONDS_EACH = 1.5e-3
"""Seconds of one reflectance with the usual number of directions, only to tell the time left."""


@dataclass(frozen=True)
class Extent:
    """What is tried, and how finely the truth is known.

    Attributes
    ----------
    states, profile_states, broad_states, walked_states : int
        Numbers of reachable states between the knots: for colours, profiles, principal
        components and random walks.
    knots, wavelengths, nodes, profile_errors, profile_wavelengths, design_states : tuples
        Values of `Settings`, the last of its `profile_states`; profile errors descend.
    rays : tuple of int
        Of random walks, for each wavelength.
    fine_nodes, fine_profile_wavelengths : int
    fine_profile_error : float
        Of what errors are measured against.
    longest : float
        Seconds of a profile, about, beyond which it is not walked.
    file_knots : tuple of int
        Of a table that is written with numbers of 32 and of 16 bits.
    repeats : int
        Of what is short.
    """

    states: int = 100
    profile_states: int = 16
    broad_states: int = 30
    walked_states: int = 3
    knots: tuple[tuple[int, ...], ...] = (
        (9, 2, 1, 4),
        (12, 3, 3, 4),
        (16, 4, 3, 5),
        (28, 5, 4, 8),
    )
    wavelengths: tuple[int, ...] = (4, 8, 10, 18)
    nodes: tuple[int, ...] = (14, 18, NODES)
    profile_errors: tuple[float, ...] = (0.05, 0.01, 0.005)
    profile_wavelengths: tuple[int, ...] = (8, 12)
    design_states: tuple[int, ...] = (12, 40, 160)
    rays: tuple[int, ...] = (1_000, 10_000, 100_000)
    fine_nodes: int = 30
    fine_profile_wavelengths: int = 16
    fine_profile_error: float = 0.006
    longest: float = 6.0
    file_knots: tuple[int, ...] = (16, 4, 3, 5)
    repeats: int = 2


FULL = Extent()
QUICK = Extent(
    states=12,
    profile_states=4,
    broad_states=12,
    walked_states=1,
    knots=((4, 2, 2, 2), (9, 2, 2, 3)),
    wavelengths=(4, 8),
    nodes=(14, NODES),
    profile_errors=(0.1, 0.05),
    profile_wavelengths=(4,),
    design_states=(10,),
    rays=(1_000,),
    fine_nodes=30,
    fine_profile_wavelengths=6,
    fine_profile_error=0.02,
    longest=10.0,
    file_knots=(5, 2, 2, 2),
    repeats=1,
)
"""To see that it works; what it says of a table is worth little."""


def table_wavelengths(extent: Extent) -> np.ndarray:
    """All wavelengths in nm that a table's colours or bands may use."""
    used = [skin_quadrature(count).wavelengths for count in (*extent.wavelengths, BASE_WAVELENGTHS)]
    return np.unique(np.concatenate([*used, BANDS_NM]))


def fine_wavelengths() -> np.ndarray:
    return np.union1d(FINE, BANDS_NM)


def between_knots(skin: Skin, count: int, seed: int) -> np.ndarray:
    """Tanned states (N, 5) of schedules other than those that chose the axes, of any blood."""
    states = reachable_states(skin, 100, seed)
    tanned = np.abs(np.log(states / untanned_state(skin))).max(axis=1) > 1e-3
    random = np.random.default_rng(seed)
    tans = random.choice(states[tanned], count, replace=False)
    return np.column_stack([tans, np.exp(random.uniform(0.0, np.log(MOST_BLOOD), count))])
