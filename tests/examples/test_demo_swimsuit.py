"""The demo's swimsuit on a trunk: what it covers, and that both its sides are alike."""

import numpy as np
import pytest

from examples.demo import swimsuit


@pytest.fixture(scope="module")
def trunk():
    """Points on an upright elliptic cylinder of a trunk's size, and its normals."""
    angle, height = np.meshgrid(np.linspace(-np.pi, np.pi, 200), np.linspace(0.8, 1.3, 200))
    x, y = 0.12 * np.sin(angle), 0.09 * np.cos(angle)
    normals = np.stack([x / 0.12**2, y / 0.09**2, 0.0 * x], axis=-1).reshape(-1, 3)
    points = np.stack([x, y - 0.05, height], axis=-1).reshape(-1, 3)
    return points, normals / np.linalg.norm(normals, axis=1, keepdims=True)


def test_share_runs_from_shade_to_sun_and_is_mostly_one_or_the_other(trunk):
    share = swimsuit.share_of_dose(swimsuit.distance_to_edge(swimsuit.one_piece, *trunk))
    assert share.min() == 0.0
    assert share.max() == 1.0
    for side in (0.0, 1.0):
        assert 0.2 < np.mean(share == side) < 0.8


def test_the_two_sides_are_alike(trunk):
    points, _ = trunk
    mirrored = points * [-1.0, 1.0, 1.0]
    assert swimsuit.one_piece(mirrored) == pytest.approx(swimsuit.one_piece(points))


def test_the_straps_cross_on_the_back():
    spine = np.array([[0.0, 0.05, z] for z in np.linspace(1.10, 1.30, 401)])
    covered = spine[swimsuit.one_piece(spine) < 0.0, 2]
    assert swimsuit.STRAP_WIDTH < np.ptp(covered) < 3.0 * swimsuit.STRAP_WIDTH
    beside = spine + [0.04, 0.0, 0.0]
    strips = np.diff((swimsuit.one_piece(beside) < 0.0).astype(int))
    assert np.sum(strips == 1) == 2
