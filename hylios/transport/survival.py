"""Survival of light that meets a melanosome, tabulated instead of walked.

What a ray meets inside a melanosome (section 4.2.1) does not depend on where it came from: its
orientation and the point hit are drawn anew. So the probability of leaving unabsorbed is one
number for a size, a shape, an absorption coefficient and a ratio of refractive indices. It is the
mean of exp(-mu L) over the lengths L of paths through a melanosome that absorbs nothing.

That is exact where melanosomes are seldom drawn again for overlapping; drawing again favours some
orientations. Measured in S4 with 60 % melanosomes: 1.7 % more absorption in them than walked; at
its own 10 % no difference is seen.
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from hylios.tissue import Stack
from hylios.transport.compiling import kernel
from hylios.transport.generator import stream
from hylios.transport.melanosome import facing_point, long_axis, on_ball, path_in_melanosome

PATHS = 1 << 19
"""Paths sampled; the chance of absorption comes out with a standard error of 0.14 % of itself."""

BINS = 2048
"""Equally filled bins, of which the mean lengths are kept."""

RATIO_STEP = 0.02
"""Spacing of the refractive index ratios between which the survival is interpolated."""


@kernel
def walk_paths(sources):
    """The compiled kernel; its arguments and results are those of `trace`."""

    def trace(state, half_axes, inside, outside, bent, lengths):
        """Lengths of random paths through a melanosome, without absorption; written."""
        _ = sources  # makes the kernel a closure over it, see `compiling`
        ray = (0.0, 0.0, 1.0)
        for index in range(lengths.size):
            axis = long_axis(state, ray, half_axes)
            point = facing_point(state, on_ball(ray, axis, half_axes))
            lengths[index] = path_in_melanosome(
                state, ray, axis, point, half_axes, np.inf, inside, outside, bent
            )

    return trace


@lru_cache(maxsize=256)
def path_lengths(aspect: float, ratio: float, bent: bool) -> np.ndarray:
    """Mean lengths (BINS,), ascending, of equally many paths, in units of the semi-minor axis.

    Parameters
    ----------
    aspect : float
        Semi-minor to semi-major axis.
    ratio : float
        Refractive index inside to outside.
    bent : bool
        Whether rays are refracted as they enter.
    """
    lengths = np.empty(PATHS)
    walk_paths(stream(0), (1.0, 1.0 / aspect), ratio, 1.0, bent, lengths)
    means = np.sort(lengths).reshape(BINS, -1).mean(axis=1)
    means.setflags(write=False)
    return means


def survival(thickness: float, aspect: float, ratio: float, bent: bool = False) -> float:
    """Probability that a ray leaves a melanosome unabsorbed.

    Parameters
    ----------
    thickness : float
        Absorption coefficient times semi-minor axis.
    aspect, ratio, bent
        As in `path_lengths`; linear between ratios `RATIO_STEP` apart.
    """
    step = int(ratio / RATIO_STEP)
    below, above = (
        np.exp(-thickness * path_lengths(aspect, RATIO_STEP * each, bent)).mean()
        for each in (step, step + 1)
    )
    fraction = ratio / RATIO_STEP - step
    return float(below + fraction * (above - below))


def with_survival(stack: Stack) -> Stack:
    """The stack with every layer's survival in one melanosome tabulated."""
    bent = stack.readings["melanosome_entry"] == "refracted"
    layers = [
        replace(
            layer,
            survival=survival(
                layer.melanin_absorption * layer.semi_minor,
                layer.semi_minor / layer.semi_major,
                stack.melanin_index / layer.refractive_index,
                bent,
            ),
        )
        if layer.encounter > 0.0
        else layer
        for layer in stack.layers
    ]
    return replace(stack, layers=tuple(layers))
