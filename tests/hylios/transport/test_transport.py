"""The walk through skin: conservation, limits, repeatability.

Statistical comparisons allow 4 standard errors: a correct model fails one of them in about 16,000
seeds, and the seeds are fixed.
"""

import pickle
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import trapezoid
from scipy.special import expn

from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS
from hylios.spectra import published_spectra
from hylios.tissue import ABSORBERS, PARTS, Layer, Model, Stack, absorbers
from hylios.transport import interfaces
from hylios.transport.events import (
    SUBSURFACE,
    SURFACE,
)
from hylios.transport.melanosome_paths import path_lengths, survival
from hylios.transport.simulate import spectrum, trace

VISIBLE = np.array([400.0, 460.0, 520.0, 580.0, 640.0, 700.0])


def without_absorbers(layers: Stack) -> Stack:
    return replace(
        layers,
        layers=tuple(
            replace(layer, absorption=0.0, melanin_absorption=0.0) for layer in layers.layers
        ),
    )


@pytest.mark.parametrize("name", list(SPECIMENS))
@pytest.mark.parametrize("angle", [0.0, 75.0])
def test_without_absorbers_all_light_comes_back(name, angle):
    traced = trace(without_absorbers(Stack.of(SPECIMENS[name], 500.0)), rays=10_000, angle=angle)
    reflected = np.isin(traced.outcome, (SURFACE, SUBSURFACE)).sum()
    assert abs(reflected / traced.outcome.size - 1.0) < 1e-9


@pytest.mark.parametrize("angle", [0.0, 60.0])
def test_absorbers_only_over_a_diffuse_floor(angle):
    """Down at the angle by Beer and Lambert, back diffusely: exp(-t / cos) 2 E3(t)."""
    optical_thickness = 0.7
    layers = Stack(
        tuple(Layer(thickness=0.1, refractive_index=1.0, absorption=mu) for mu in (3.0, 4.0)),
        lambertian_floor=True,
    )
    rays = 200_000
    traced = trace(layers, rays=rays, angle=angle)
    down = np.exp(-optical_thickness / np.cos(np.radians(angle)))
    expected = down * 2.0 * expn(3, optical_thickness)
    error = np.sqrt(expected * (1.0 - expected) / rays)
    assert abs((traced.outcome == SUBSURFACE).mean() - expected) < 4.0 * error
    assert not np.any(traced.outcome == SURFACE)


def test_diffuse_floor_spreads_light_as_geometry_says():
    """A ray straight down, back diffusely from depth h: within r comes r^2 / (r^2 + h^2)."""
    depth, rays = 0.2, 200_000
    clear = Layer(thickness=depth, refractive_index=1.0, absorption=0.0)
    distance = 0.1 * trace(Stack((clear,), lambertian_floor=True), rays=rays).distance
    for radius in (0.1, 0.2, 1.0):
        expected = radius**2 / (radius**2 + depth**2)
        error = np.sqrt(expected * (1.0 - expected) / rays)
        assert abs((distance < radius).mean() - expected) < 4.0 * error


def test_survival_without_index_step_is_that_of_straight_chords():
    """Mean of exp(-mu chord) over orientations (4.5) and evenly spread points, by quadrature."""
    aspect, thickness = 0.17 / 0.41, 0.4
    cosine = np.linspace(-1.0, 1.0, 2001)
    weight = (1.0 - np.abs(cosine)) + aspect * np.abs(cosine)
    longest = 2.0 / np.sqrt((1.0 - cosine**2) + (cosine * aspect) ** 2)
    height = (np.arange(2000) + 0.5) / 2000  # sqrt(1 - spread) of the unit disc, density 2 h
    chords = longest[:, None] * height
    inner = (np.exp(-thickness * chords) * 2.0 * height).mean(axis=1)
    expected = trapezoid(weight * inner, cosine) / trapezoid(weight, cosine)
    assert 1.0 - survival(thickness, aspect, 1.0)[0] == pytest.approx(1.0 - expected, rel=1e-4)


def test_survival_is_certain_without_absorption_and_falls_with_it():
    values = [survival(thickness, 0.4, 1.2)[0] for thickness in (0.0, 0.01, 0.1, 1.0, 100.0)]
    assert values[0] == 1.0
    assert np.all(np.diff(values) < 0)
    lengths, longest = path_lengths(0.4, 1.2, False)
    assert np.all(np.diff(lengths) >= 0)
    assert longest > lengths[-1]


def test_results_do_not_depend_on_threads_or_on_other_wavelengths():
    one = spectrum(SPECIMENS["S3"], VISIBLE, rays=40_000, threads=1)
    two = spectrum(SPECIMENS["S3"], VISIBLE, rays=40_000, threads=2)
    alone = spectrum(SPECIMENS["S3"], VISIBLE[3:4], rays=40_000)
    for measure in ("surface", "subsurface", "absorbed", "absorbed_in_melanosomes", "exit_counts"):
        assert np.array_equal(getattr(one, measure), getattr(two, measure))
        assert np.array_equal(getattr(one, measure)[3], getattr(alone, measure)[0])
    other = spectrum(SPECIMENS["S3"], VISIBLE, rays=40_000, seed=2)
    assert not np.array_equal(one.subsurface, other.subsurface)


@pytest.mark.parametrize("name", list(SPECIMENS))
def test_every_ray_is_accounted_for(name):
    result = spectrum(SPECIMENS[name], [250.0, 365.0, 550.0, 1100.0, 2500.0], rays=5_000)
    assert np.allclose(result.total + result.absorptance, 1.0, rtol=0, atol=1e-12)
    assert np.allclose(result.exit_counts.sum(axis=1) / result.rays, result.subsurface, atol=1e-12)
    assert np.all(result.absorbed_in_melanosomes[:, [0, 4, 5]] == 0)


@pytest.mark.parametrize("name", list(SPECIMENS))
@pytest.mark.parametrize("colloidal", ["as_in_melanosomes", "solid"])
def test_a_layer_absorbs_with_the_sum_of_its_absorbers(name, colloidal):
    wavelengths = np.array([250.0, 365.0, 550.0, 970.0, 2500.0])
    model = Model(readings={"colloidal_melanin": colloidal})
    held = absorbers(SPECIMENS[name], wavelengths, model)
    assert tuple(held) == PARTS
    assert {name for part in held.values() for name in part} == set(ABSORBERS)
    for row, wavelength in enumerate(wavelengths):
        layers = Stack.of(SPECIMENS[name], wavelength, model).layers
        for part, layer in zip(PARTS, layers, strict=True):
            assert layer.absorption == pytest.approx(
                sum(spectrum[row] for spectrum in held[part].values())
            )


def test_light_is_absorbed_by_layer_and_absorber():
    """Who takes it where, at wavelengths where one absorber rules; and all of it adds up."""
    walked = spectrum(SPECIMENS["S3"], [280.0, 420.0, 577.0, 1450.0], rays=4_000)
    by = walked.absorbed_by
    assert by.shape == (4, len(PARTS), len(ABSORBERS))
    assert np.allclose(by.sum(axis=2), walked.absorbed, rtol=1e-12, atol=0.0)
    ended = walked.total + by.sum(axis=(1, 2)) + walked.absorbed_in_melanosomes.sum(axis=1)
    assert np.allclose(ended, 1.0, rtol=0.0, atol=1e-12)

    def ruling(row, part):
        return ABSORBERS[int(np.argmax(by[row, PARTS.index(part)]))]

    assert ruling(1, "spinosum") == "colloidal_melanin"
    assert ruling(2, "reticular") == "oxyhemoglobin"
    assert {ruling(3, part) for part in PARTS} == {"water"}
    for absent in ("keratin", "urocanic_acid"):
        assert not by[:, 1:, ABSORBERS.index(absent)].any()
    assert not by[:, PARTS.index("papillary") :, ABSORBERS.index("dna")].any()
    assert by[0, 1:4, ABSORBERS.index("dna")].all()


def test_surface_reflects_what_fresnel_says():
    flat = replace(Stack.of(SPECIMENS["S3"], 550.0), roughness=0.0)
    rays = 200_000
    for angle in (0.0, 60.0):
        expected, _ = interfaces.fresnel(
            np.cos(np.radians(angle)), 1.0, flat.layers[0].refractive_index
        )
        share = (trace(flat, rays=rays, angle=angle).outcome == SURFACE).mean()
        assert abs(share - expected) < 4.0 * np.sqrt(expected * (1.0 - expected) / rays)


def test_fresnel_limits():
    assert interfaces.fresnel(1.0, 1.0, 1.5)[0] == pytest.approx(0.04)
    assert interfaces.fresnel(1e-9, 1.0, 1.5)[0] == pytest.approx(1.0, abs=1e-6)
    assert interfaces.fresnel(np.cos(np.radians(60.0)), 1.5, 1.0) == (1.0, 0.0)
    brewster = np.arctan(1.5)
    across = np.sin(2 * brewster - np.pi / 2) ** 2
    assert interfaces.fresnel(np.cos(brewster), 1.0, 1.5)[0] == pytest.approx(across / 2)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"angle": 90.0}, "angle of incidence is 90 degrees; allowed is 0 to 89.99 degrees."),
        ({"rays": 0}, "number of rays is 0; allowed is 1 to 10000000000."),
        ({"rays": 1.5}, "number of rays is 1.5; allowed are whole numbers"),
        ({"seed": -1}, "seed is -1"),
        ({"threads": -1}, "number of threads is -1"),
        ({"wavelengths": [[500.0]]}, "wavelengths are no list of numbers"),
        ({"wavelengths": [float("nan")]}, "wavelength nan nm is outside the spectrum"),
        ({"wavelengths": [249.0]}, "wavelength 249 nm is outside the spectrum"),
        ({"wavelengths": []}, "wavelengths are no list of numbers"),
    ],
)
def test_bad_input_is_named(arguments, sentence):
    usual = {"wavelengths": [500.0], "rays": 10}
    with pytest.raises(InputError) as error:
        spectrum(SPECIMENS["S3"], **{**usual, **arguments})
    assert sentence in str(error.value)


def test_a_model_of_what_does_not_exist_is_refused():
    with pytest.raises(InputError, match="reading floor is 'soft'; allowed is normal, mirrored."):
        Model(readings={"floor": "soft"})
    with pytest.raises(InputError, match="there is no reading 'ceiling'; there are colloidal_mel"):
        Model(readings={"ceiling": "off"})
    with pytest.raises(InputError, match="there is no spectrum 'wine'; there are eumelanin, "):
        Model({"wine": published_spectra()["water"]})


def test_a_model_is_equal_by_what_it_holds_and_travels_to_other_processes():
    usual, water = Model(), published_spectra()["water"]
    own = replace(water, values=2.0 * water.values)
    assert usual == Model(published_spectra(), {"floor": "normal"})
    assert hash(usual) == hash(Model(published_spectra()))
    assert usual != Model({"water": own}) != Model({"water": own}, {"floor": "mirrored"})
    assert usual.own_spectra == {} and Model({"water": own}).own_spectra == {"water": own}
    assert pickle.loads(pickle.dumps(usual)) == usual
    copy = pickle.loads(pickle.dumps(Model({"water": own}, {"floor": "mirrored"})))
    assert copy.readings["floor"] == "mirrored" and list(copy.own_spectra) == ["water"]
    assert np.array_equal(copy.spectra["water"].values, own.values)


def test_layers_too_thin_for_their_melanosomes_are_refused():
    with pytest.raises(InputError, match="basale_thickness is 3.3e-05 cm; allowed with melanos"):
        Stack.of(replace(SPECIMENS["S3"], basale_thickness=3.3e-5), 500.0)
    assert Stack.of(replace(SPECIMENS["S3"], granulosum_thickness=3.3e-5), 500.0)


def test_one_ray_is_not_certain():
    assert spectrum(SPECIMENS["S3"], [500.0], rays=1).standard_error[0] > 0.4
