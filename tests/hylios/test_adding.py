"""The deterministic solver against conservation, closed forms, published slabs and the walk.

Statistical comparisons say what a correct solver's chance of failing is; their seeds are fixed.
"""

from dataclasses import replace

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.special import expn

from hylios.adding import solve
from hylios.errors import InputError
from hylios.specimen import SPECIMENS
from hylios.tissue import Layer, Stack, stack
from hylios.transport.interfaces import fresnel
from hylios.transport.simulate import spectrum
from hylios.transport.survival import with_survival

WAVELENGTHS = np.array([250.0, 300.0, 400.0, 460.0, 550.0, 650.0, 800.0, 1050.0, 1450.0, 2200.0])
OWN_ERROR = 0.0005
"""What the solver may be off by itself, rms, where it is compared with the walk."""


def stacks(specimen, wavelengths=WAVELENGTHS, **arguments):
    return [with_survival(stack(specimen, each, **arguments)) for each in wavelengths]


def without_absorbers(layers: Stack) -> Stack:
    clear = {"absorption": 0.0, "melanin_absorption": 0.0, "survival": 1.0}
    return replace(layers, layers=tuple(replace(each, **clear) for each in layers.layers))


@pytest.mark.parametrize("nodes", [6, 8, 13, 20, 32, 48, 64])
@pytest.mark.parametrize("name", list(SPECIMENS))
def test_without_absorbers_all_light_comes_back(name, nodes):
    clear = [without_absorbers(each) for each in stacks(SPECIMENS[name])]
    total = solve(clear, (0.0, 8.0, 45.0, 80.0), nodes).total
    assert np.abs(total - 1.0).max() < 1e-9


def slab_over_floor(angle, index, optical_thickness, roots=400):
    """Fresnel in, once down, then between a diffuse floor and the face, by direct integration."""
    outside = np.cos(np.radians(angle))
    face, inside = fresnel(outside, 1.0, index)
    half, weight = leggauss(roots)
    # up to the critical angle, and beyond it, where all comes back
    critical = np.sqrt(1.0 - 1.0 / index**2)
    widths = np.array([critical, 1.0 - critical])[:, None]
    cosine = np.array([[0.0], [critical]]) + 0.5 * widths * (1.0 + half)
    cosine, weight = cosine.ravel(), (0.5 * widths * weight).ravel()
    passed = np.exp(-optical_thickness / cosine)
    mirrored = np.array([fresnel(each, index, 1.0)[0] for each in cosine])
    spread = 2.0 * cosine * weight
    back = (spread * passed**2 * mirrored).sum()
    out = (spread * passed * (1.0 - mirrored)).sum()
    return face, (1.0 - face) * np.exp(-optical_thickness / inside) * out / (1.0 - back)


@pytest.mark.parametrize("angle", [0.0, 8.0, 45.0, 80.0])
@pytest.mark.parametrize("optical_thickness", [0.01, 0.7])
def test_absorber_between_fresnel_faces_over_a_diffuse_floor(angle, optical_thickness):
    layer = Layer(thickness=0.1, refractive_index=1.4, absorption=10.0 * optical_thickness)
    found = solve([Stack((layer,), lambertian_floor=True)], angle)
    surface, subsurface = slab_over_floor(angle, 1.4, optical_thickness)
    assert found.surface[0] == pytest.approx(surface, abs=1e-12)
    assert found.subsurface[0] == pytest.approx(subsurface, abs=1e-5)


def test_absorber_without_index_step_over_a_diffuse_floor():
    layers = tuple(Layer(thickness=0.1, refractive_index=1.0, absorption=mu) for mu in (3.0, 4.0))
    found = solve([Stack(layers, lambertian_floor=True)], 60.0)
    assert found.total[0] == pytest.approx(np.exp(-1.4) * 2.0 * expn(3, 0.7), abs=1e-6)


def scattering(thickness, index, absorption, coefficient, anisotropy):
    return Layer(
        thickness=thickness,
        refractive_index=index,
        absorption=absorption,
        scattering=coefficient,
        anisotropy=anisotropy,
    )


def test_published_slabs():
    """H. C. van de Hulst, Multiple Light Scattering (1980), table 35: printed to five places."""
    found = solve([Stack((scattering(0.02, 1.0, 10.0, 90.0, 0.75),))], 0.0, 40)
    assert found.subsurface[0] == pytest.approx(0.09739, abs=1e-5)
    assert found.transmittance[0] == pytest.approx(0.66096, abs=1e-5)


def deviations(name, angle, rays):
    """Sums over ten wavelengths of squared deviations of surface and total, in units of the
    variance: the walk's and the solver's own."""
    walked = spectrum(SPECIMENS[name], WAVELENGTHS, angle=angle, rays=rays)
    found = solve(stacks(SPECIMENS[name]), angle)
    assert np.allclose(found.total + found.absorptance, 1.0, atol=1e-12)
    for share in ("surface", "total"):
        value = getattr(walked, share)
        variance = value * (1.0 - value) / rays + OWN_ERROR**2
        yield ((getattr(found, share) - value) ** 2 / variance).sum()


@pytest.mark.parametrize(("name", "angle"), [("S1", 0.0), ("S2", 45.0), ("S3", 8.0), ("S4", 80.0)])
def test_agrees_with_the_walk(name, angle):
    """A correct solver fails with less than 1 seed in 10,000 (chi squared, 10 degrees)."""
    assert max(deviations(name, angle, 20_000)) < 35.6


@pytest.mark.slow
@pytest.mark.parametrize("angle", [8.0, 80.0])
@pytest.mark.parametrize("name", list(SPECIMENS))
def test_agrees_with_the_walk_of_many_rays(name, angle):
    """The same with 200,000 rays, whose noise is .001 too."""
    assert max(deviations(name, angle, 200_000)) < 35.6


def test_survival_is_needed():
    with pytest.raises(InputError, match="survival of a layer with melanosomes is -1; allowed"):
        solve([stack(SPECIMENS["S3"], 500.0)])
