"""A skin's appearance over its tanning states."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, as_numbers
from hylios.table.axes import Axes, LookAxes
from hylios.table.interpolation import between, nodes, sliced
from hylios.tanning import KINETICS


@dataclass(frozen=True)
class SkinTable:
    """A skin's appearance at the knots of its tanning states.

    Attributes
    ----------
    axes : LookAxes, or StateAxes in a table of format 3
    planes : mapping of names to arrays, shape `axes.shape` and then components
        Some of `PLANES`; `docs/table_format.md` says what each holds.
    provenance : dict
        What made the table: specimen, pigmentation, wavelengths, rays, seed, errors, version.
    interpolation : str
        How the table is to be read between its knots, one of `INTERPOLATIONS`.

    Examples
    --------
    The colour of a tan, from a table instead of from the model:

    >>> import hylios
    >>> table = hylios.read_table("III.exr")  # doctest: +SKIP
    >>> states = hylios.skin_type("III").states(hylios.Exposures([0], [30]), times=[0, 240])
    >>> table.plane("total_colour", states)  # doctest: +SKIP
    """

    axes: Axes
    planes: Mapping[str, NDArray[np.float64]]
    provenance: dict[str, Any]
    interpolation: str = "linear"

    @property
    def kinetics(self) -> tuple[str, ...]:
        """Those of `hylios.tanning.KINETICS` by which its states may come about.

        All, but in tables of format 3 and those with a single knot of spread.
        """
        if isinstance(self.axes, LookAxes) and self.axes.tells_measured:
            return tuple(KINETICS)
        return ("thesis",)

    def lookup(
        self,
        states: ArrayLike,
        names: Sequence[str] | None = None,
        blood: ArrayLike | None = None,
    ) -> dict[str, NDArray[np.float64]]:
        """Planes by name, each (..., components), at tanning states (..., 4) or (..., 5).

        All planes, unless some are named. Beyond the outermost knots their value is held. Where
        blood is left out it is the untanned skin's; a table of format 3 knows no other.

        Parameters
        ----------
        blood : (B,) array, optional
            With which all states are looked up in place of their own; planes then are
            (..., B, components), much sooner than of as many states.

        Raises
        ------
        InputError
            If the states have another shape, one has a number that is not above 0, or the table
            has no such plane.
        """
        wanted = tuple(self.planes if names is None else names)
        for name in wanted:
            if name not in self.planes:
                raise InputError(f"the table has no plane {name}; it has {', '.join(self.planes)}.")
        coordinates = self.axes.coordinates(as_numbers("tanning states", states))
        if blood is None:
            return self.at(coordinates, wanted)
        relative = as_numbers("blood", blood)
        if relative.ndim != 1 or not np.all((relative > 0.0) & np.isfinite(relative)):
            raise InputError(f"blood is {str(blood)[:60]}; allowed is a row of numbers above 0.")
        return self.at(coordinates, wanted, np.log(relative))

    def at(
        self, coordinates: np.ndarray, names: tuple[str, ...], blood: np.ndarray | None = None
    ) -> dict[str, NDArray[np.float64]]:
        """As `lookup`, at coordinates (..., K) on the axes.

        `blood` (B,) are logarithms, the last coordinates in place of those given.
        """
        knots, numbers, many = self.axes.knots, self._nodes_of(names), ()
        if blood is not None and isinstance(self.axes, LookAxes):
            knots, numbers = sliced(knots, numbers, blood)
            many = (blood.size,)
        own = coordinates[..., : len(knots)]
        told = between(knots, numbers, own.reshape(-1, len(knots)))
        told = told.reshape(*coordinates.shape[:-1], *many, -1)
        if blood is not None and not many:
            told = told[..., None, :].repeat(blood.size, axis=-2)
        ends = np.cumsum([self.planes[name].shape[-1] for name in names])
        return dict(zip(names, np.split(told, ends[:-1], axis=-1), strict=True))

    def _nodes_of(self, names: tuple[str, ...]) -> np.ndarray:
        """What interpolation needs of some planes side by side; made once."""
        if names not in self._kept:
            joined = np.concatenate([self.planes[name] for name in names], axis=-1)
            self._kept[names] = nodes(self.interpolation, self.axes.knots, joined)
        return self._kept[names]

    @cached_property
    def _kept(self) -> dict[tuple[str, ...], np.ndarray]:
        return {}

    def holds(self, states: ArrayLike) -> NDArray[np.bool_]:
        """Whether the table says something of tanning states (..., 4) or (..., 5), bool (...).

        One for any sun does of all. One for a scene does of those within its outermost knots; in
        format 3 of those that its plane `state`, looked up, gives back: beyond its knots, off its
        axes or where nothing was computed it does not.

        Raises
        ------
        InputError
            If the states have another shape, or one has a number that is not above 0.
        """
        numbers = as_numbers("tanning states", states)
        if isinstance(self.axes, LookAxes):
            return self.axes.hold(numbers)
        if "state" not in self.planes:
            return np.ones(numbers.shape[:-1], bool)
        nearest = self.plane("state", numbers)
        apart = np.abs(nearest[..., :4] - np.log(numbers[..., :4] / self.axes.untanned))
        return apart.max(axis=-1) <= nearest[..., 4]

    def plane(self, name: str, states: ArrayLike) -> NDArray[np.float64]:
        """One plane at tanning states (..., 4) or (..., 5), shape (..., components)."""
        return self.lookup(states, (name,))[name]
