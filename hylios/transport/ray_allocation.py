"""How many rays to spend in which stack, for paths that states share."""

import numpy as np

STEPS = 50
"""Steps of the iteration that allocates rays."""

SPARE = 1.05
"""Factor on what is missing where more rays are added, for noise not to leave it missing."""

FEWEST = 0.003
"""Share of all rays below which none are spent in a state."""

MOST_PER_PATH = 400
"""Rays per effective path after which a state that lets out hardly any light is left as it is."""

LEAST = 1e-300
"""Stands for 0 in a divisor."""


def allocate_rays(proposed: np.ndarray, wanted: np.ndarray, limit: np.ndarray) -> np.ndarray:
    """How many rays to spend in each of A walked stacks, (A,) int.

    With n_a rays in stack a, state s has, for each path of density p_s, the weight
    p_s / sum(n_a q_a), and an effective sample size that follows from the mean of its square. Its
    inverse is convex in n. The result is the fewest rays for which no state has less than its
    limit: by the multiplicative iteration of optimal design for n, and one of the same kind for how
    much each state has to say.

    Parameters
    ----------
    proposed, wanted : (N, A) and (N, S) arrays
        Densities of N tried paths in the walked stacks and in the states, each over the density
        of that path's being tried: their sums are shares of light.
    limit : (S,) array
        Effective sample sizes.
    """
    light = wanted.sum(axis=0)
    seen = light > 0.0
    if not seen.any():
        return np.zeros(proposed.shape[1], int)
    scaled = limit[seen] * (wanted[:, seen] / light[seen]) ** 2
    rays = np.full(proposed.shape[1], 1.0)
    say = np.full(scaled.shape[1], 1.0 / scaled.shape[1])
    for _ in range(STEPS):
        pooled = proposed @ rays
        needed = (1.0 / pooled) @ scaled
        say *= needed / needed.max()
        say /= say.sum()
        rays *= np.sqrt((scaled @ say / pooled**2) @ proposed)
        rays /= rays.sum()
    rays[rays < FEWEST] = 0.0
    needed = ((1.0 / np.maximum(proposed @ rays, LEAST)) @ scaled).max()
    return np.ceil(rays * min(needed, MOST_PER_PATH * rays.size * limit.max())).astype(int)


def rays_missing(reached: np.ndarray, limit: np.ndarray) -> np.ndarray:
    """How many times the rays spent every state needs besides, (S,); 0 where none.

    Parameters
    ----------
    reached, limit : (S,) arrays
        Effective sample sizes that there are, and that there should be.
    """
    needed = SPARE * limit / np.maximum(reached, 1e-6 * limit)
    return np.where(reached < limit, needed - 1.0, 0.0)


def worthwhile(missing: np.ndarray, alone: np.ndarray) -> float:
    """How many times the rays spent to share besides; states that need more are left to themselves.

    The fewest rays in all, where `missing` (S,) is from `rays_missing` and `alone` (S,) what each
    state would need by itself.
    """
    choices = np.append(0.0, missing)
    costs = [choice + alone[missing > choice].sum() for choice in choices]
    return float(choices[np.argmin(costs)])
