"""Colour from few wavelengths: the shipped quadratures and how they are chosen."""

from dataclasses import replace

import numpy as np
import pytest

from examples.simplifications.light import GRID, metrics, reflectances
from examples.simplifications.quadrature import gauss, skin_colours
from examples.simplifications.variants import whole
from hylios.errors import InputError
from hylios.lab import colour
from hylios.lab.quadrature_choice import choose
from hylios.quadrature import FEWEST, MOST, skin_quadrature
from hylios.skin.specimen import EPIDERMIS, SPECIMENS

COUNTS = range(FEWEST, MOST + 1)


@pytest.fixture(scope="module")
def held_out():
    """Spectra (4, N) of S1 to S4, which no quadrature was chosen by, and their colours."""
    spectra = reflectances(list(SPECIMENS.values()), GRID, whole)
    return spectra, colour.linear_rec709(GRID, spectra)


def at(wavelengths, spectra):
    return spectra[:, np.searchsorted(GRID, wavelengths)]


@pytest.mark.parametrize("count", COUNTS)
def test_grey_stays_that_grey(count):
    quadrature = skin_quadrature(count)
    assert quadrature.wavelengths.shape == (count,) and quadrature.weights.shape == (3, count)
    assert np.all(np.diff(quadrature.wavelengths) > 0)
    assert 400.0 <= quadrature.wavelengths[0] and quadrature.wavelengths[-1] <= 700.0
    for grey in (0.0, 0.18, 1.0):
        assert quadrature.weights @ np.full(count, grey) == pytest.approx([grey] * 3, abs=1e-14)


@pytest.mark.parametrize("count", COUNTS)
def test_noise_is_no_more_than_with_61_wavelengths(count, held_out):
    """At the same number of rays in all: variance of the colour, as a squared CIEDE2000."""
    spectra, colours = held_out

    def variance(wavelengths, weights):
        reflectance = at(wavelengths, spectra)
        rays = 1.0 / wavelengths.size
        covariance = np.einsum(
            "ik,sk,jk->sij", weights, reflectance * (1.0 - reflectance) / rays, weights
        )
        return np.einsum("sij,sij->s", metrics(colours), covariance)

    quadrature = skin_quadrature(count)
    even = np.arange(400.0, 701.0, 5.0)
    dense = variance(even, colour.rec709_weights(even))
    assert np.all(variance(quadrature.wavelengths, quadrature.weights) < dense)


@pytest.mark.parametrize(
    ("count", "most"), [(4, 0.3), (6, 0.15), (8, 0.05), (16, 0.03), (18, 0.008)]
)
def test_colours_of_skins_held_out(count, most, held_out):
    spectra, colours = held_out
    quadrature = skin_quadrature(count)
    missed = colour.difference(at(quadrature.wavelengths, spectra) @ quadrature.weights.T, colours)
    assert missed.max() < most
    even = np.linspace(400.0, 700.0, count)
    between = np.array([np.interp(even, GRID, spectrum) for spectrum in spectra])
    assert missed.max() < colour.difference(colour.linear_rec709(even, between), colours).min()


def test_more_wavelengths_than_a_walk_s_are_right_for_flushed_skin_too():
    """Seven times as right as the most of a walk."""
    flushed = [
        replace(one, papillary_blood=20.0, reticular_blood=20.0) for one in SPECIMENS.values()
    ]
    spectra = reflectances(flushed, GRID, whole)
    colours = colour.linear_rec709(GRID, spectra)
    missed = [
        colour.difference(at(own.wavelengths, spectra) @ own.weights.T, colours).mean()
        for own in map(skin_quadrature, (16, 18))
    ]
    assert missed[1] < 0.004 and missed[1] < missed[0] / 4.0


def test_skins_far_outside_those_chosen_by():
    """No melanin, no blood, much blood, other haemoglobins: none is off by what an eye can see."""
    usual = SPECIMENS["S3"]
    forms = ("melanosomes", "colloidal_melanin")
    skins = [
        replace(usual, **{f"{layer}_{form}": 0.0 for layer in EPIDERMIS for form in forms}),
        replace(usual, papillary_blood=0.0, reticular_blood=0.0),
        replace(usual, papillary_blood=20.0, reticular_blood=20.0),
        replace(usual, oxygenated_blood=0.0),
        replace(usual, methemoglobin=30.0),
        replace(usual, sulfhemoglobin=10.0),
        replace(SPECIMENS["S4"], eumelanin_concentration=150.0),
    ]
    spectra = reflectances(skins, GRID, whole)
    quadrature = skin_quadrature(8)
    colours = colour.linear_rec709(GRID, spectra)
    missed = colour.difference(at(quadrature.wavelengths, spectra) @ quadrature.weights.T, colours)
    assert missed.max() < 0.7


@pytest.mark.parametrize("count", [2, 5, 9])
def test_gauss_is_exact_for_polynomials(count):
    """Each channel to the degree count - 1, their sum X + Y + Z to twice that and one more."""
    quadrature = gauss(count)
    full = colour.rec709_weights(GRID)
    centred = (GRID - 560.0) / 200.0
    for degree in range(count):
        expected = full @ centred**degree
        nodes = ((quadrature.wavelengths - 560.0) / 200.0) ** degree
        assert quadrature.weights @ nodes == pytest.approx(expected, abs=1e-9)
    weight = colour.xyz_weights(GRID).sum(axis=0)
    to_xyz = np.linalg.lstsq(full.T, weight, rcond=None)[0]
    degree = 2 * count - 1
    total = to_xyz @ quadrature.weights @ ((quadrature.wavelengths - 560.0) / 200.0) ** degree
    # White is made white in the fourth digit, which their sum does not share.
    assert total == pytest.approx(weight @ centred**degree, rel=2e-3)


def test_a_metric_is_the_difference_squared(held_out):
    _, colours = held_out
    error = 1e-4 * np.random.default_rng(4).normal(size=colours.shape)
    squared = np.einsum("si,sij,sj->s", error, metrics(colours), error)
    assert np.sqrt(squared) == pytest.approx(colour.difference(colours, colours + error), rel=0.02)


@pytest.mark.slow
def test_the_shipped_table_is_as_good_as_a_new_choice():
    """On skins that neither was chosen by; a choice by fewer skins should do no better."""
    judges = skin_colours(40, seed=3)
    goal = judges.reflectances @ judges.weights.T

    def error(quadrature):
        missed = at(quadrature.wavelengths, judges.reflectances) @ quadrature.weights.T - goal
        return np.mean(np.einsum("si,sij,sj->s", missed, judges.metrics, missed))

    allowed = (GRID >= 400.0) & (GRID <= 700.0)
    for made in choose(skin_colours(40, seed=2), 8, allowed=allowed)[FEWEST - 1 :]:
        assert error(skin_quadrature(made.wavelengths.size)) < 1.2 * error(made)


@pytest.mark.parametrize(
    ("count", "sentence"),
    [
        (3, "number of wavelengths is 3; allowed is 4 to 20."),
        (21, "number of wavelengths is 21; allowed is 4 to 20."),
        (8.5, "number of wavelengths is 8.5; allowed are whole numbers, 4 to 20."),
    ],
)
def test_other_numbers_of_wavelengths_are_refused(count, sentence):
    with pytest.raises(InputError) as error:
        skin_quadrature(count)
    assert str(error.value) == sentence
