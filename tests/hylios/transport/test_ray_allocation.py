"""How many rays are spent in which stack."""

import numpy as np
import pytest

from hylios.transport.ray_allocation import allocate_rays, rays_missing, worthwhile


def test_rays_allocated_to_states_with_nothing_in_common():
    """Each needs its own limit over its share of light."""
    share = np.array([0.5, 0.2, 0.05])
    densities = np.repeat(np.diag(share) / 1000, 1000, axis=0)
    rays = allocate_rays(densities, densities, np.full(densities.shape[1], 100.0))
    assert rays == pytest.approx([200, 500, 2000], rel=0.02)


def test_rays_allocated_to_states_that_are_alike():
    """Ten states of the same density need no more than one, 100 / .4 rays."""
    densities = np.full((1000, 10), 0.4 / 1000)
    assert (
        250 <= allocate_rays(densities, densities, np.full(densities.shape[1], 100.0)).sum() <= 260
    )


def test_what_is_missing_is_a_share_of_what_was_spent():
    """Half of what is needed was reached: as much again, and 5 % of all to spare."""
    missing = rays_missing(np.array([50.0, 100.0, 200.0]), np.full(3, 100.0))
    assert missing == pytest.approx([1.1, 0.0, 0.0])


def test_rays_are_shared_only_while_that_costs_less():
    """10 times the rays for one state, or its own share alone."""
    assert worthwhile(np.array([0.1, 10.0]), np.array([5.0, 0.5])) == 0.1
    assert worthwhile(np.array([0.1, 0.2]), np.array([5.0, 0.5])) == 0.2
