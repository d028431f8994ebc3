"""Coordinates of tanning states: what a table's axes are.

`LookAxes` are those of the tables that are written now, `StateAxes` of the earlier format 3.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError
from hylios.tanning.spread import Spread, states_of

STATE_NAMES = ("basale", "spinosum", "granulosum", "thickness", "blood")
AXIS_UNIT = "natural logarithm of the ratio to the untanned state"

LOOK_AXES = ("melanin", "thickness", "spread", "blood")
"""Names of the axes of `LookAxes`, in their order."""

LEAST_APART = 0.01
"""Least distance of the two sheets, in logarithms of shares, across which a state is told."""

ALIKE = 0.003
"""By how much nearer a state must lie to what spread below 0 tells than to the sheets to be told by
it, in logarithms of shares: some measured tans of light skin are told by either."""

LARGEST_COORDINATE = 30.0
"""Largest coordinate of a knot: a state 1e13 times the untanned one is no skin's."""

LEAST_STEP = 1e-9
"""Least distance of two knots."""

SLACK = 0.01
"""How far beyond the outermost knots of bounded axes a state may lie, in the logarithm: .09
CIEDE2000 at most."""


OFF = 0.4
"""How far a layer's melanin of a state that bounded axes hold may be from what they tell of it, in
the logarithm. Tans are within .3."""


class _Grid:
    """What axes of either kind have in common: knots, and states at them."""

    knots: tuple[np.ndarray, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of knots on each axis."""
        return tuple(len(axis) for axis in self.knots)

    def states(self, coordinates: np.ndarray) -> np.ndarray:
        """States (..., numbers) at coordinates (..., axes)."""
        raise NotImplementedError

    def knot_states(self) -> np.ndarray:
        """States at all knots, shape (*shape, numbers)."""
        return self.states(np.stack(np.meshgrid(*self.knots, indexing="ij"), axis=-1))


@dataclass(frozen=True)
class StateAxes(_Grid):
    """Principal axes of four numbers, as tables of format 3 have them; blood is passed over.

    A state's coordinates are the logarithm of the ratio of its first four numbers to the untanned
    state's, projected on the orthonormal columns of `basis`; the untanned skin lies at 0.

    Attributes
    ----------
    untanned : (4,) array
    basis : (4, K) array
    knots : K ascending arrays, each with at least one knot
    """

    untanned: np.ndarray
    basis: np.ndarray
    knots: tuple[np.ndarray, ...]

    def coordinates(self, states: np.ndarray) -> np.ndarray:
        """Coordinates (..., K) of states (..., 4) or (..., 5).

        Raises
        ------
        InputError
            If the states have another shape, or one has a number that is not above 0.
        """
        return _logarithms(states, self.untanned)[..., :4] @ self.basis

    def states(self, coordinates: np.ndarray) -> np.ndarray:
        """States (..., 4) at coordinates (..., K)."""
        return self.untanned * np.exp(coordinates @ self.basis.T)


@dataclass(frozen=True)
class LookAxes(_Grid):
    """Four axes of what changes a skin's look: melanin, thickness, spread and blood.

    The first, second and last coordinate are the natural logarithms of a state's total melanin,
    thickness and blood, relative to the untanned skin's. The third is how melanin is spread over
    the layers: 0 on the sheet of the skin's thesis kinetics, 1 on that of its measured kinetics,
    between them straight in the logarithms of the layers' shares. Below 0 it is how far the shares
    are from the first sheet on one side, as while the thesis's melanin rises. What lies elsewhere
    counts as the nearest of these.

    Attributes
    ----------
    sheet, measured : Spread
        How melanin is spread, given how much of it there is and how thick the skin, by either
        kinetics; without sun alike.
    aside : (3,) array
        Direction in the logarithms of the layers' shares in which that side lies opposite; of
        length 1, its sum 0.
    knots : four ascending arrays, each with at least one knot
    bounded : bool
        Whether the table says nothing beyond the outermost knots, as one for one scene alone.
    """

    sheet: Spread
    measured: Spread
    aside: np.ndarray
    knots: tuple[np.ndarray, ...]
    bounded: bool = False

    @property
    def tells_measured(self) -> bool:
        """Whether states of the measured kinetics are told too, or new melanin is none."""
        return bool(
            self.bounded or self.knots[2][-1] == 1.0 or self.measured.most.max() < LEAST_APART
        )

    def coordinates(self, states: np.ndarray) -> np.ndarray:
        """Coordinates (..., 4) of states (..., 4), whose blood is the untanned skin's, or (..., 5).

        Raises
        ------
        InputError
            If the states have another shape, or one has a number that is not above 0.
        """
        ratios = _logarithms(states, np.append(self.sheet.untanned, [1.0, 1.0]))
        melanin, thickness = np.log(np.asarray(states)[..., :3].sum(axis=-1)), ratios[..., 3]
        start, across = self._sheets(melanin, thickness)
        off = ratios[..., :3] - ratios[..., :3].mean(axis=-1, keepdims=True) - start
        apart = np.maximum((across**2).sum(axis=-1), LEAST_APART**2)
        spread = np.clip((off * across).sum(axis=-1) / apart, 0.0, 1.0)
        back = np.minimum(off @ self.aside, 0.0)
        left = off - spread[..., None] * across, off - np.multiply.outer(back, self.aside)
        nearer = [(one**2).sum(axis=-1) for one in left]
        spread = np.where(nearer[0] <= nearer[1] + ALIKE**2, spread, back)
        return np.stack([melanin, thickness, spread, ratios[..., 4]], axis=-1)

    def states(self, coordinates: np.ndarray) -> np.ndarray:
        """States (..., 5) at coordinates (..., 4)."""
        melanin, thickness, spread, blood = np.moveaxis(np.asarray(coordinates, dtype=float), -1, 0)
        start, across = self._sheets(melanin, thickness)
        moved = np.maximum(spread, 0.0)[..., None] * across
        moved += np.multiply.outer(np.minimum(spread, 0.0), self.aside)
        return states_of(self.sheet.untanned, start + moved, melanin, thickness, blood)

    def _sheets(self, melanin: np.ndarray, thickness: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Logarithms (..., 3) of layers' shares on the first sheet, and from it to the second."""
        first, second = (one.logarithms(melanin, thickness) for one in (self.sheet, self.measured))
        return first, second - first

    def hold(self, states: np.ndarray) -> NDArray[np.bool_]:
        """Whether states (..., 4) or (..., 5) lie within the outermost knots, bool (...).

        All do where the axes are not bounded.
        """
        if not self.bounded:
            return np.ones(_checked(states).shape[:-1], bool)
        places = self.coordinates(states)
        low, high = (np.array([own[end] for own in self.knots]) for end in (0, -1))
        inside = np.all((places >= low - SLACK) & (places <= high + SLACK), axis=-1)
        told = np.log(_checked(states)[..., :3] / self.states(places)[..., :3])
        return inside & (np.abs(told).max(axis=-1) <= OFF)


Axes = StateAxes | LookAxes
"""The axes that a table may have."""


def _logarithms(states: np.ndarray, untanned: np.ndarray) -> np.ndarray:
    """Logarithms (..., 4 or 5) of states' ratios to the untanned one, as long as that is."""
    states = _checked(states)
    count = min(states.shape[-1], untanned.size)
    ratios = np.zeros((*states.shape[:-1], untanned.size))
    ratios[..., :count] = np.log(states[..., :count] / untanned[:count])
    return ratios


def _checked(states: np.ndarray) -> np.ndarray:
    states = np.asarray(states, dtype=float)
    if states.ndim == 0 or states.shape[-1] not in {4, 5}:
        raise InputError(
            f"tanning states have shape {states.shape}; expected (..., 4) or (..., 5)."
        )
    if not np.all((states > 0) & np.isfinite(states)):
        raise InputError("a tanning state has a number that is not above 0 and finite.")
    return states


def require_axes(axes: Axes) -> None:
    """Raise InputError unless axes could be a skin's."""
    knots_fit = all(map(_are_knots, axes.knots))
    if isinstance(axes, LookAxes):
        if not (knots_fit and len(axes.knots) == len(LOOK_AXES) and _are_sheets(axes)):
            raise InputError(
                "the table's axes are not two sheets of three positive shares of melanin "
                "that sum to 1, a direction, ascending thicknesses and as many reaches of melanin, "
                f"and ascending knots of {', '.join(LOOK_AXES)} within {LARGEST_COORDINATE:g} of 0."
            )
    elif not (_is_state(axes.untanned) and _is_basis(axes) and knots_fit):
        raise InputError(
            "the table's axes are not four positive numbers, 1 to 4 orthonormal directions and "
            f"ascending knots within {LARGEST_COORDINATE:g} of 0."
        )


def _are_sheets(axes: LookAxes) -> bool:
    alike = np.allclose(axes.sheet.untanned, axes.measured.untanned, rtol=0.0, atol=1e-6)
    return (
        bool(alike)
        and _is_sheet(axes.sheet)
        and _is_sheet(axes.measured)
        and _is_direction(axes.aside)
    )


def _is_direction(numbers: np.ndarray) -> bool:
    return bool(abs(numbers @ numbers - 1.0) < 1e-6 and abs(numbers.sum()) < 1e-6)


def _is_sheet(sheet: Spread) -> bool:
    first, strips = sheet.directions[:, 0], sheet.thicknesses
    return bool(
        np.all(sheet.untanned > 1e-6)
        and abs(sheet.untanned.sum() - 1.0) < 1e-6
        and _is_direction(first)
        and _are_knots(strips)
        and sheet.least.shape == sheet.most.shape == strips.shape
        and np.all(sheet.least <= sheet.most)
    )


def _is_state(untanned: np.ndarray) -> bool:
    return untanned.shape == (4,) and bool(np.all((untanned > 1e-6) & (untanned < 1e3)))


def _is_basis(axes: StateAxes) -> bool:
    count = len(axes.knots)
    if count == 0 or axes.basis.shape != (4, count) or not np.all(np.abs(axes.basis) < 1.1):
        return False
    return bool(np.allclose(axes.basis.T @ axes.basis, np.eye(count), rtol=0.0, atol=1e-6))


def _are_knots(knots: np.ndarray) -> bool:
    inside = knots.ndim == 1 and knots.size and np.all(np.abs(knots) <= LARGEST_COORDINATE)
    return bool(inside and np.all(np.diff(knots) >= LEAST_STEP))
