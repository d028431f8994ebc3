"""Colour under other light: whites, known spectra, and few wavelengths against whole spectra."""

from dataclasses import replace

import colour as reference
import numpy as np
import pytest

from examples.simplifications.light import GRID, reflectances
from examples.simplifications.variants import whole
from hylios.errors import InputError
from hylios.lab.colour import difference, rec709_weights
from hylios.lab.illuminants import (
    OBSERVERS,
    enough_wavelengths,
    illuminant_weights,
    illuminants,
    rec709_weights_under,
)
from hylios.lab.skin_spectra import components, reconstruction, shipped_components
from hylios.quadrature import skin_quadrature
from hylios.skin.specimen import SPECIMENS

LIGHTS = ("A", "D50", "FL2", "FL11", "LED-B3")


@pytest.fixture(scope="module")
def skins():
    """Spectra (S, N) of skins from light to dark, pale to red, that no weights were fitted to."""
    usual = SPECIMENS["S3"]
    made = [
        replace(
            usual,
            basale_melanosomes=melanin,
            spinosum_melanosomes=0.4 * melanin,
            papillary_blood=blood * usual.papillary_blood,
            reticular_blood=blood * usual.reticular_blood,
        )
        for melanin in (1.0, 4.0, 12.0)
        for blood in (0.5, 1.0, 4.0)
    ]
    return reflectances(made, GRID, whole)


def test_daylights_weights_are_those_of_the_laboratory_and_the_shipped_ones():
    assert rec709_weights_under(GRID) == pytest.approx(rec709_weights(GRID), abs=1e-12)
    shipped = skin_quadrature(8).weights
    assert np.array_equal(illuminant_weights(8, "d65", "cie 1931 2 Degree"), shipped)


@pytest.mark.parametrize("observer", OBSERVERS)
@pytest.mark.parametrize("illuminant", illuminants())
def test_white_is_white(illuminant, observer):
    weights = illuminant_weights(8, illuminant, observer)
    assert weights.sum(axis=1) == pytest.approx(np.ones(3), abs=1e-9)
    assert np.isfinite(weights).all()


def test_a_chart_under_tungsten_is_as_colour_science_adapts_it():
    """Bradford's adaptation of XYZ, by colour-science's own way from spectrum to sRGB."""
    reflectance = np.interp(GRID, [360.0, 500.0, 600.0, 780.0], [0.1, 0.3, 0.7, 0.6])
    shape = reference.SpectralShape(360.0, 780.0, 5.0)
    matching = reference.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape)
    tungsten, daylight = (
        reference.SDS_ILLUMINANTS[name].copy().align(shape) for name in ("A", "D65")
    )
    whites = [
        reference.sd_to_XYZ(reference.sd_ones(shape), matching, light, method="Integration") / 100.0
        for light in (tungsten, daylight)
    ]
    seen = reference.sd_to_XYZ(
        reference.SpectralDistribution(reflectance, GRID),
        matching,
        tungsten,
        method="Integration",
    )
    adapted = reference.adaptation.chromatic_adaptation_VonKries(
        seen / 100.0, *whites, transform="Bradford"
    )
    expected = reference.RGB_COLOURSPACES["ITU-R BT.709"].matrix_XYZ_to_RGB @ adapted
    assert rec709_weights_under(GRID, "A") @ reflectance == pytest.approx(expected, abs=2e-4)


@pytest.mark.parametrize("observer", ["CIE 1931 2 degree", "CIE 1964 10 degree"])
@pytest.mark.parametrize(
    ("illuminant", "mean"), [*((name, 0.08) for name in LIGHTS if name != "FL11"), ("FL11", 0.15)]
)
def test_few_wavelengths_give_the_colours_of_whole_spectra(skins, illuminant, observer, mean):
    full = skins @ rec709_weights_under(GRID, illuminant, observer).T
    for count, most in ((8, mean), (12, 0.05)):
        at = np.searchsorted(GRID, skin_quadrature(count).wavelengths)
        few = skins[:, at] @ illuminant_weights(count, illuminant, observer).T
        assert difference(few, full).mean() < most


def test_lamps_with_lines_need_more_wavelengths(skins):
    """So many that colours are about as right as under daylight."""
    assert [enough_wavelengths(8, lamp) for lamp in ("D65", "D50", "E", "A")] == 4 * [8]
    assert enough_wavelengths(8, "FL11") > 8
    assert enough_wavelengths(8, "LED-RGB1") == 16 and enough_wavelengths(18, "LED-RGB1") == 18
    for count in (4, 8):
        errors = []
        for lamp, some in (("D65", count), ("FL11", enough_wavelengths(count, "FL11"))):
            full = skins @ rec709_weights_under(GRID, lamp).T
            at = np.searchsorted(GRID, skin_quadrature(some).wavelengths)
            errors.append(difference(skins[:, at] @ illuminant_weights(some, lamp).T, full).mean())
        assert errors[1] < 1.2 * errors[0]


def test_a_spectrum_of_ones_own_is_as_the_same_by_name():
    sampled = reference.SDS_ILLUMINANTS["LED-B3"]
    own = sampled.wavelengths, 3.0 * sampled.values
    named = illuminant_weights(8, "LED-B3")
    assert illuminant_weights(8, own) == pytest.approx(named, abs=1e-5)


def test_reconstructed_spectra(skins):
    grid, parts = shipped_components()
    assert np.array_equal(grid, GRID) and parts.shape == (85, 20)
    nodes = skin_quadrature(8).wavelengths
    matrix = reconstruction(nodes)
    assert matrix.sum(axis=1) == pytest.approx(np.ones(85), abs=1e-9)
    again = skins[:, np.searchsorted(GRID, nodes)] @ matrix.T
    visible = (GRID >= 400.0) & (GRID <= 700.0)
    assert np.abs(again - skins)[:, visible].mean() < 2e-3


def test_components_hold_spectra_of_few_degrees_of_freedom():
    random = np.random.default_rng(4)
    spectra = random.uniform(0.1, 1.0, (30, 3)) @ random.uniform(0.1, 1.0, (3, 40))
    relative = spectra / spectra.mean(axis=1, keepdims=True)
    parts = components(spectra, 3)
    assert parts @ parts.T == pytest.approx(relative.T @ relative / 30.0, abs=1e-12)


NM = np.array([400.0, 500.0, 600.0])


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((3,), "number of wavelengths is 3; allowed is 4 to 20"),
        ((8, "moonlight"), "illuminant is 'moonlight'; allowed are A, B, C"),
        ((8, "A", "my eye"), "observer is 'my eye'; allowed are CIE 1931 2 degree"),
        ((8, (NM, NM[:2])), r"shapes \(3,\) and \(2,\)"),
        ((8, (NM[::-1], NM)), "wavelengths must ascend"),
        ((8, (NM, -NM)), "power must be 0 or more"),
        ((8, (NM, 0.0 * NM)), "no light that eyes can see white by"),
        ((8, (NM + 500.0, NM)), "no light that eyes can see white by"),
        ((8, (["red"], [1.0])), "expected an array of numbers"),
    ],
)
def test_bad_input_is_named(arguments, sentence):
    with pytest.raises(InputError, match=sentence):
        illuminant_weights(*arguments)


def test_wavelengths_that_cannot_tell_a_spectrum_are_named():
    with pytest.raises(InputError, match="ascending numbers"):
        reconstruction(np.array([500.0, 450.0]))
    with pytest.raises(
        InputError, match="wavelengths of a colour are 300 to 500 nm; allowed is 360"
    ):
        reconstruction(np.array([300.0, 500.0]))
