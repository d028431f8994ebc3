"""A film of liquid on the skin against conservation, limits, an added layer and drawn rays.

Statistical comparisons say what a correct solver's chance of failing is; their seeds are fixed.
"""

from dataclasses import replace

import numpy as np
import pytest

from hylios.adding import solve, spectra, spectrum
from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS
from hylios.tissue import Layer, Stack
from hylios.transport.generator import stream
from hylios.transport.interfaces import meet_interface, meet_surface
from hylios.transport.sampling import lambertian_cosine, turned

ANGLES = (0.0, 8.0, 45.0, 70.0)
STACKS = [Stack.of(SPECIMENS[name], nm) for name in ("S1", "S4") for nm in (450.0, 650.0)]
FLAT = [replace(stack, roughness=0.0) for stack in STACKS]


def test_a_film_of_air_is_none():
    without = solve(STACKS, ANGLES)
    of_air = solve(STACKS, ANGLES, film=1.0)
    assert np.allclose(of_air.total, without.total, rtol=0.0, atol=1e-12)
    thinnest = solve(STACKS, ANGLES, film=1.0 + 1e-9)
    assert np.allclose(thinnest.total, without.total, rtol=0.0, atol=5e-4)
    assert np.allclose(thinnest.surface, without.surface, rtol=0.0, atol=5e-4)


@pytest.mark.parametrize("film", [1.05, 1.33, 1.47, 1.7])
@pytest.mark.parametrize("nodes", [6, 22])
def test_without_absorbers_all_light_comes_back(film, nodes):
    clear = [
        replace(
            stack,
            layers=tuple(
                replace(layer, absorption=0.0, melanin_absorption=0.0) for layer in stack.layers
            ),
        )
        for stack in (*STACKS[:1], *FLAT[:1])
    ]
    assert np.abs(solve(clear, (*ANGLES, 89.99), nodes, film=film).total - 1.0).max() < 1e-9


def test_under_a_film_of_the_corneums_own_index_the_rough_surface_is_gone():
    for stack, flat in zip(STACKS[::2], FLAT[::2], strict=True):
        oiled = solve([stack], ANGLES, 48, film=stack.layers[0].refractive_index)
        smooth = solve([flat], ANGLES, 48)
        assert np.allclose(oiled.total, smooth.total, rtol=0.0, atol=1e-5)
        assert np.allclose(oiled.surface, smooth.surface, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("film", [1.33, 1.47])
def test_on_a_flat_surface_a_film_is_one_more_clear_layer(film):
    layered = [replace(stack, layers=(Layer(0.001, film, 0.0), *stack.layers)) for stack in FLAT]
    filmed = solve(FLAT, ANGLES, 48, film=film)
    assert np.allclose(filmed.total, solve(layered, ANGLES, 48).total, rtol=0.0, atol=5e-5)


def ray_ends_outside(state, film, stack, angle):
    """Whether a ray comes back from a clear layer over a diffuse floor, and if from inside it."""
    index, roughness = stack.layers[0].refractive_index, stack.roughness
    crossed, ray = meet_interface(
        state, (np.sin(np.radians(angle)), 0.0, np.cos(np.radians(angle))), 1.0, film
    )
    if not crossed:
        return True, False
    in_film, been_inside = True, False
    while True:
        if in_film and ray[2] < 0.0:
            crossed, ray = meet_interface(state, ray, film, 1.0)
            if crossed:
                return True, been_inside
        elif in_film:
            crossed, ray = meet_surface(state, ray, film, index, roughness)
            in_film, been_inside = not crossed, been_inside or crossed
        elif ray[2] > 0.0:
            if lambertian_cosine(state) ** 2 > stack.floor_reflectance:
                return False, True
            ray = turned(state, (0.0, 0.0, -1.0), lambertian_cosine(state))
        else:
            crossed, ray = meet_surface(state, ray, index, film, roughness)
            in_film = crossed


@pytest.mark.parametrize(("film", "angle"), [(1.33, 8.0), (1.45, 60.0)])
def test_rays_between_film_rough_surface_and_floor(film, angle):
    """Two shares within 4.5 standard errors: false alarms 1e-5 each."""
    layers = (Layer(0.01, 1.55, 0.0),)
    stack = Stack(layers, roughness=0.3, lambertian_floor=True, floor_reflectance=0.8)
    state, rays = stream(7), 12_000
    ends = np.array([ray_ends_outside(state, film, stack, angle) for _ in range(rays)])
    solved = solve([stack], angle, film=film)
    for walked, share in (
        (ends[:, 0] & ~ends[:, 1], solved.surface[0]),
        (ends[:, 0] & ends[:, 1], solved.subsurface[0]),
    ):
        assert abs(walked.mean() - share) < 4.5 * np.sqrt(share * (1.0 - share) / rays)


def test_water_reflects_less_and_lets_out_more():
    """The corneum reflects half as much: its surface under water, and the water's own."""
    dry, wet = (spectrum(SPECIMENS["S3"], [550.0], film=film) for film in (None, 1.33))
    assert 0.5 < wet.surface[0] / dry.surface[0] < 0.6
    assert 1.02 < wet.subsurface[0] / dry.subsurface[0] < 1.06


def test_nodes_beyond_the_default_change_little():
    usual, finer = (solve(STACKS, ANGLES, nodes, film=1.4) for nodes in (22, 40))
    assert np.abs(usual.total - finer.total).max() < 1e-3


def test_films_together_are_as_alone():
    """The nodes that a film adds serve the skin without one too: so that is nearer to many."""
    together = solve(STACKS, ANGLES, film=(None, 1.33, 1.45))
    assert together.total.shape == (3, len(ANGLES), len(STACKS))
    for row, film in enumerate((1.33, 1.45), start=1):
        assert np.allclose(together.total[row], solve(STACKS, ANGLES, film=film).total, atol=1e-12)
    finer = solve(STACKS, ANGLES, 48)
    assert np.abs(together.total[0] - finer.total).max() < 1e-4
    assert np.allclose(solve(STACKS, film=[1.33]).surface[0], together.surface[1, 1], atol=1e-12)


def test_spectra_take_films_and_several_angles():
    specimens = [SPECIMENS["S1"], SPECIMENS["S3"]]
    many = spectra(specimens, [450.0, 650.0], angle=(8.0, 60.0), film=1.33)
    assert many.total.shape == (2, 2, 2)
    alone = spectrum(specimens[1], [450.0, 650.0], angle=60.0, film=1.33)
    assert np.allclose(many.total[1, 1], alone.total, rtol=0.0, atol=1e-12)
    films = spectra(specimens, [450.0, 650.0], angle=60.0, film=(None, 1.33))
    assert np.allclose(films.total[1], many.total[1], rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("film", [0.9, 2.1, float("nan"), (None, 0.9)])
def test_bad_films_are_named(film):
    sentence = "refractive index of the film is .*; allowed is 1 to 2"
    with pytest.raises(InputError, match=sentence):
        spectrum(SPECIMENS["S3"], [550.0], film=film)


def test_no_film_is_none_and_not_an_empty_list():
    with pytest.raises(InputError, match="films are an empty list"):
        spectrum(SPECIMENS["S3"], [550.0], film=())
