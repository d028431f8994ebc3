"""The table of survival in a melanosome, against the walk that it stands for."""

from dataclasses import replace

import numpy as np
import pytest

from hylios.adding import spectrum as spectrum_without_noise
from hylios.errors import InputError
from hylios.skin.physiology import PHYSIOLOGY
from hylios.skin.specimen import SPECIMENS
from hylios.tissue import Layer, Stack
from hylios.tissue.melanosome_survival import (
    LEAST_ASPECT,
    is_tabulated,
    survival_in_melanosome,
)
from hylios.transport.melanosome_paths import survival, with_survival
from hylios.transport.simulate import spectrum
from hylios.transport.survival_table import quadrature

WAVELENGTHS = (250.0, 300.0, 400.0, 460.0, 550.0, 650.0, 800.0, 1050.0, 1450.0, 2200.0)


def melanosome(aspect, depth):
    """A layer whose melanosomes have a shape, and an optical depth along their minor half axis."""
    return Layer(
        thickness=1.0,
        refractive_index=1.0,
        absorption=0.0,
        encounter=1.0,
        semi_minor=aspect,
        semi_major=1.0,
        melanin_absorption=depth / aspect,
    )


@pytest.mark.parametrize("name", list(SPECIMENS))
def test_tabulated_survival_is_the_walked_one(name):
    """Light absorbed in one melanosome within .6 %: 4 standard errors of the walked one."""
    for plain in (Stack.of(SPECIMENS[name], wavelength) for wavelength in WAVELENGTHS):
        for layer, walked in zip(plain.layers, with_survival(plain).layers, strict=True):
            if layer.encounter > 0.0:
                tabulated = survival_in_melanosome(layer, plain.melanin_index)
                assert 1.0 - tabulated == pytest.approx(1.0 - walked.survival, rel=0.006)


@pytest.mark.parametrize("aspect", [0.0834, 0.1375, 0.6])
@pytest.mark.parametrize("depth", [0.001, 0.1, 1.0])
def test_long_and_round_melanosomes_too(aspect, depth):
    """Index 1.214 times the tissue's, as in all specimens; the shapes lie between the table's."""
    tabulated = survival_in_melanosome(melanosome(aspect, depth), 1.214)
    walked, _ = survival(depth, aspect, 1.214)
    assert 1.0 - tabulated == pytest.approx(1.0 - walked, rel=0.002)


def test_every_physiological_shape_is_tabulated():
    minor, major = PHYSIOLOGY["melanosome_minor_axis"], PHYSIOLOGY["melanosome_major_axis"]
    assert minor.low / major.high > LEAST_ASPECT
    assert is_tabulated(melanosome(minor.low / major.high, 1.0), 1.214)


def test_a_needle_is_refused_with_the_range():
    expected = "minor to major axis of melanosomes is 0.07; allowed is 0.08 to 1"
    with pytest.raises(InputError, match=expected):
        survival_in_melanosome(melanosome(0.07, 1.0), 1.2)


def test_a_skin_with_long_melanosomes_is_solved_as_it_is_walked():
    """0.8 by 0.11 um is physiological, and was refused; 4 standard errors."""
    specimen = replace(SPECIMENS["S4"], melanosome_major_axis=0.8, melanosome_minor_axis=0.11)
    walked = spectrum(specimen, [450.0, 650.0], rays=20_000)
    solved = spectrum_without_noise(specimen, [450.0, 650.0])
    assert np.all(np.abs(solved.total - walked.total) < 4.0 * walked.standard_error + 0.0005)


def test_the_table_keeps_the_moments_of_what_it_is_made_from():
    lengths = np.random.default_rng(8).gamma(2.0, size=1000)
    points, weights = quadrature(lengths, 6)
    for power in range(12):
        expected = np.mean(lengths**power)
        assert weights @ points**power == pytest.approx(expected, rel=1e-9)


def test_survival_falls_smoothly_from_1():
    layer = Stack.of(SPECIMENS["S3"], 550.0).layers[3]
    fallen = [
        survival_in_melanosome(replace(layer, melanin_absorption=absorption), 1.7)
        for absorption in (0.0, *np.geomspace(1.0, 1e9, 60))
    ]
    assert fallen[0] == pytest.approx(1.0, abs=1e-7)
    assert np.all(np.diff(fallen) < 1e-12)
    assert fallen[-1] < 1e-12
