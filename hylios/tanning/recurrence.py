"""Recurrences x(t) = decay(t) x(t - 1) + added(t) over many steps, without a long loop.

Time is laid out in blocks: step t of T lies in row t % BLOCK and column t // BLOCK of an array
(BLOCK, blocks, histories). Rows are computed one after the other, for all blocks at once. What a
block hands on to the next is then a recurrence of the same kind with fewer steps.

All arithmetic is element by element and in the same order however many histories there are and
however many steps follow: so a history in a batch equals the same history alone, and a longer one
begins as a shorter one, to the last bit.
"""

import numpy as np
from numpy.typing import DTypeLike

BLOCK = 24
"""Steps to a block: a year of hours is 24 rows of 366 blocks, then 24 of 16, then 16."""


def in_blocks(values: np.ndarray) -> np.ndarray:
    """Values (T, H) laid out in blocks, filled up with 0."""
    steps, histories = values.shape
    laid_out = no_steps(steps, histories, values.dtype)
    by_step = laid_out.swapaxes(0, 1)
    whole = steps // BLOCK
    by_step[:whole] = values[: whole * BLOCK].reshape(whole, BLOCK, histories)
    by_step[whole:, : steps % BLOCK] = values[None, whole * BLOCK :]
    return laid_out


def in_a_row(laid_out: np.ndarray, steps: int) -> np.ndarray:
    """Values (T, H) of so many steps that are laid out in blocks."""
    return laid_out.swapaxes(0, 1).reshape(-1, laid_out.shape[2])[:steps]


def no_steps(steps: int, histories: int, dtype: DTypeLike = float) -> np.ndarray:
    """Zeros for so many steps, laid out in blocks."""
    return np.zeros((BLOCK, -(-steps // BLOCK), histories), dtype)


def where(steps: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Index of steps in an array laid out in blocks."""
    return steps % BLOCK, steps // BLOCK


def previous(laid_out: np.ndarray) -> np.ndarray:
    """The value of the step before, 0 for the first."""
    result = np.empty_like(laid_out)
    result[1:] = laid_out[:-1]
    result[0, 1:] = laid_out[-1, :-1]
    result[0, 0] = 0.0
    return result


def accumulated(decay: np.ndarray | float, added: np.ndarray) -> np.ndarray:
    """The recurrence from x(-1) = 0.

    Parameters
    ----------
    decay : float, (H,) array, or (BLOCK, blocks, 1 or H) array
        One for all steps and histories, one for every history, or one for every step.
    added : (BLOCK, blocks, H) array
        Laid out in blocks.

    Returns
    -------
    (BLOCK, blocks, H) array
        Of the dtype of `added`.
    """
    constant = np.ndim(decay) < 3
    own = np.reshape(decay, (1, 1, -1)) if constant else decay
    decays = np.repeat(np.asarray(own, added.dtype), BLOCK, 0) if constant else np.asarray(own)
    result = np.empty_like(added)
    result[0] = added[0]
    for before, now, decaying, more in zip(
        result[:-1], result[1:], decays[1:], added[1:], strict=True
    ):
        np.multiply(before, decaying, now)
        np.add(now, more, now)
    blocks = added.shape[1]
    if blocks == 1:
        return result
    left = np.multiply.accumulate(decays)
    at_ends = left[-1, 0] if constant else in_blocks(left[-1])
    handed_on = in_a_row(accumulated(at_ends, in_blocks(result[-1])), blocks)
    # The first block is handed nothing.
    result[:, 1:] += (left if constant else left[:, 1:]) * handed_on[:-1]
    return result
