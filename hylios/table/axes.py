"""Coordinates of tanning states."""

from dataclasses import dataclass

import numpy as np

from hylios.errors import InputError

STATE_NAMES = ("basale", "spinosum", "granulosum", "thickness", "blood")
AXIS_UNIT = "natural logarithm of the ratio to the untanned state"

LARGEST_COORDINATE = 30.0
"""Largest coordinate of a knot: a state 1e13 times the untanned one is no skin's."""

LEAST_STEP = 1e-9
"""Least distance of two knots."""


@dataclass(frozen=True)
class StateAxes:
    """Coordinates of tanning states.

    A state is (melanin of basale, spinosum, granulosum, thickness), as `TanningHistory.states`
    has it. Its coordinates are the logarithm of its ratio to the untanned state, projected on
    the orthonormal columns of `basis`; the untanned skin lies at 0.

    Attributes
    ----------
    untanned : (4,) array
    basis : (4, K) array
    knots : K ascending arrays, each with at least one knot
    """

    untanned: np.ndarray
    basis: np.ndarray
    knots: tuple[np.ndarray, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of knots on each axis."""
        return tuple(len(axis) for axis in self.knots)

    def coordinates(self, states: np.ndarray) -> np.ndarray:
        """Coordinates (..., K) of states (..., 4).

        Raises
        ------
        InputError
            If a state has a number that is not above 0.
        """
        if not np.all((states > 0) & np.isfinite(states)):
            raise InputError("a tanning state has a number that is not above 0 and finite.")
        return np.log(states / self.untanned) @ self.basis

    def states(self, coordinates: np.ndarray) -> np.ndarray:
        """States (..., 4) at coordinates (..., K)."""
        return self.untanned * np.exp(coordinates @ self.basis.T)

    def knot_states(self) -> np.ndarray:
        """States at all knots, shape (*shape, 4)."""
        return self.states(np.stack(np.meshgrid(*self.knots, indexing="ij"), axis=-1))


def require_axes(axes: StateAxes) -> None:
    """Raise InputError unless axes could be a skin's."""
    if not (_is_state(axes.untanned) and _is_basis(axes) and all(map(_are_knots, axes.knots))):
        raise InputError(
            "the table's axes are not four positive numbers, 1 to 4 orthonormal directions and "
            f"ascending knots within {LARGEST_COORDINATE:g} of 0."
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
