"""What points with shares of several masks go through: states and coordinates over the hours."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.sun.doses import Doses
from hylios.tanning import Burns, ErythemaDynamics, Exposures, Kinetics
from hylios.tanning.shares import Energies, retained

from .darkening import Uva
from .days import darkened_coordinates, hours_to_simulate, states_seen

WEIGHTS = np.array([1.0, 0.35, 0.7], np.float32)
"""What errors of u, v and b mean for what is seen."""

CHUNK = 256
"""Points that are simulated at once; of more the numbers do not fit near the processor."""


@dataclass(frozen=True, eq=False)
class Course:
    """What points of several masks go through.

    Attributes
    ----------
    exposures : Exposures
        A row for every mask.
    energies : pair of Retained
    marks : int array
        Hours that are simulated.
    first : int
        The first hour that is told.
    burns : Burns or None
        Of skin that reddens.
    uva : Uva or None
        Of skin that darkens at once.
    """

    exposures: Exposures
    energies: Energies
    marks: NDArray[np.int_]
    first: int
    burns: Burns | None
    uva: Uva | None

    @property
    def hours(self) -> NDArray[np.int_]:
        """Those that are told, (T,)."""
        return self.marks[self.marks >= self.first]

    @property
    def numbers(self) -> int:
        """How many coordinates of a point change."""
        return 2 if self.burns is None else 3

    def states(self, shares: NDArray[np.float64]) -> NDArray[np.floating]:
        """States (T, N, 4), or (T, N, 5) of skin that reddens, of points with shares (N, M)."""
        how = np.float32, self.burns, self.first
        return states_seen(self.energies, shares, self.marks, *how)

    def seen(self, shares: NDArray[np.float64]) -> NDArray[np.float32]:
        """u, v and where skin reddens b of points (N, 2 T or 3 T), as they count."""
        numbers = self.numbers
        curves = np.empty((len(shares), numbers, len(self.hours)), np.float32)
        for start in range(0, len(shares), CHUNK):
            part = slice(start, start + CHUNK)
            states = self.states(shares[part])
            seen = darkened_coordinates(states, self.uva, shares[part], self.hours)[..., :numbers]
            seen *= WEIGHTS[:numbers]
            curves[part] = np.moveaxis(seen, (1, 2), (0, 1))
        return curves.reshape(len(shares), -1)


def course_of(
    received: Sequence[Doses],
    melanin: Kinetics,
    minimal: tuple[float, float],
    days: tuple[float, float],
    rows: int,
    erythema: ErythemaDynamics | None,
    *,
    darkens: bool,
) -> Course:
    """The course of points over some days, told at so many hours at most."""
    first, end = int(24.0 * days[0]), int(np.ceil(24.0 * days[1]))
    exposures = _of_masks(received)
    mmd, med = minimal
    energies = retained(exposures, melanin, mmd=mmd, med=med, hours=end)
    burns = None if erythema is None else Burns.of(exposures, erythema, med)
    uva = Uva.of(received) if darkens else None
    masks = len(received)
    few = np.concatenate([np.eye(masks), 1.0 - np.eye(masks), np.ones((1, masks))])
    marks = hours_to_simulate(energies, few, exposures, (first, end), rows, 3, burns, uva)
    return Course(exposures, energies, marks, first, burns, uva)


def _of_masks(received: Sequence[Doses]) -> Exposures:
    """The doses of all masks, a row for every mask (M, E)."""
    hours = np.concatenate([own.hours for own in received])
    ends = np.cumsum([own.hours.size for own in received])
    melanogenesis, thickening = np.zeros((2, len(received), hours.size))
    for mask, (own, end) in enumerate(zip(received, ends, strict=True)):
        those = slice(end - own.hours.size, end)
        melanogenesis[mask, those], thickening[mask, those] = own.melanogenesis, own.thickening
    return Exposures(hours, melanogenesis, thickening)
