"""BioSpec and DJ06 against closed forms, limits and this project's own random walk.

Statistical comparisons allow 4 standard errors (a chance of 6e-5) with fixed seeds.
"""

import numpy as np
import pytest
from scipy.special import expn

from hylios.errors import InputError
from hylios.lab.predecessors import biospec, donner_jensen
from hylios.lab.predecessors.donner_jensen import Medium
from hylios.spectra import published_spectra
from hylios.tissue import Layer, Stack
from hylios.transport.events import SUBSURFACE, SURFACE
from hylios.transport.generator import stream
from hylios.transport.simulate import trace

VISIBLE = np.arange(400.0, 701.0, 25.0)


def medium(absorption, extinction=10.0):
    return Medium(np.atleast_1d(absorption), np.atleast_1d(extinction - absorption))


@pytest.mark.parametrize("absorption", [0.01, 0.1, 1.0])
def test_half_space_is_the_dipole_of_jensen_2001(absorption):
    """Its equation 15, R_d = alpha'/2 (1 + exp(-4/3 A k)) exp(-k), k = sqrt(3 (1 - alpha'))."""
    albedo = 1.0 - absorption / 10.0
    reflected = donner_jensen.diffuse_fresnel(1.4)
    factor = (1.0 + reflected) / (1.0 - reflected)
    root = np.sqrt(3.0 * (1.0 - albedo))
    expected = 0.5 * albedo * (1.0 + np.exp(-4.0 / 3.0 * factor * root)) * np.exp(-root)
    assert donner_jensen.half_space(medium(absorption), 1.4) == pytest.approx(expected, rel=1e-12)


def test_diffuse_fresnel_is_the_integral_over_the_hemisphere():
    """The polynomial of Egan and Hilgeman against Fresnel's equations, within its .01."""
    cosine = (np.arange(20_000) + 0.5) / 20_000
    beyond = np.sqrt(np.maximum(0.0, 1.0 - 1.4**2 * (1.0 - cosine**2)))
    across = (1.4 * cosine - beyond) / (1.4 * cosine + beyond)
    along = (1.4 * beyond - cosine) / (1.4 * beyond + cosine)
    share = np.mean((across**2 + along**2) * cosine)
    assert donner_jensen.diffuse_fresnel(1.4) == pytest.approx(share, abs=0.01)


@pytest.mark.parametrize(("above", "below"), [(1.0, 1.0), (1.4, 1.0), (1.4, 1.4)])
def test_a_slab_that_absorbs_nothing_loses_nothing(above, below):
    for thickness in (0.15, 1.0, 30.0):
        reflected, through = donner_jensen.slab(medium(0.0), thickness, above, below)
        assert reflected + through == pytest.approx(1.0, abs=1e-12)


def test_slab_is_the_sum_over_its_poles():
    """The multipole's printed sum, 400 dipoles to either side, at three radial frequencies."""
    layer, thickness = medium(0.2), 0.5
    frequency = np.array([0.0, 1.0, 10.0])
    source, decay = layer.mean_free_path, layer.decay(frequency)
    top, bottom = (donner_jensen.extrapolation(layer, index) for index in (1.4, 1.0))
    number = np.arange(-400, 401)[:, None]
    real = 2.0 * number * (thickness + top + bottom) + source
    image = real - 2.0 * source - 2.0 * top

    def poles(depth):
        return np.sign(depth) * np.exp(-decay * np.abs(depth))

    expected = (
        0.5 * layer.albedo * (poles(real) - poles(image)).sum(axis=0),
        0.5 * layer.albedo * (poles(thickness - real) - poles(thickness - image)).sum(axis=0),
    )
    result = donner_jensen.slab(layer, thickness, 1.4, 1.0, frequency)
    np.testing.assert_allclose(result, expected, rtol=1e-12)


def test_a_thick_slab_is_a_half_space():
    frequency = np.array([0.0, 0.5, 5.0])
    reflected, through = donner_jensen.slab(medium(0.1), 50.0, 1.4, 1.4, frequency)
    expected = donner_jensen.half_space(medium(0.1), 1.4, frequency)
    np.testing.assert_allclose(reflected, expected, rtol=1e-12)
    assert np.all(through < 1e-12)


@pytest.mark.parametrize("absorption", [0.001, 0.01, 0.1])
def test_a_half_space_cut_in_two_stays_nearly_the_same(absorption):
    """Adding is an approximation here: measured are .0001, .0008 and .0030."""
    whole = donner_jensen.half_space(medium(absorption), 1.4)
    cut = donner_jensen.two_layers(medium(absorption), medium(absorption))
    assert cut == pytest.approx(whole, abs=0.004)


def test_layers_that_absorb_nothing_reflect_everything():
    nothing = donner_jensen.two_layers(medium(0.0), medium(0.0))
    assert nothing == pytest.approx(1.0, abs=1e-12)


def test_inverse_hankel_of_the_dipole_is_the_dipole():
    layer = medium(0.3)
    radii = np.array([0.0, 0.05, 0.3, 1.0, 4.0, 20.0, 50.0])
    source = layer.mean_free_path[0]
    image = source + 2.0 * donner_jensen.extrapolation(layer, 1.4)[0]
    rate = layer.decay(0.0)[0]

    def pole(depth):
        distance = np.hypot(radii, depth)
        decayed = (1.0 + rate * distance) * np.exp(-rate * distance)
        return depth * decayed / (4.0 * np.pi * distance**3)

    expected = layer.albedo * (pole(source) + pole(image))
    result = donner_jensen.inverse_hankel(
        lambda frequency: donner_jensen.half_space(layer, 1.4, frequency), 40.0 / source, radii
    )
    np.testing.assert_allclose(result, expected, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("wavelength", [400.0, 550.0, 700.0])
def test_the_profile_holds_the_diffuse_reflectance(wavelength):
    radii = np.concatenate([[0.0], np.geomspace(1e-3, 50.0, 500)])
    exitance = donner_jensen.profile(donner_jensen.NCSU_117, wavelength, radii)
    rings = 0.5 * np.diff(radii) * (radii[1:] * exitance[1:] + radii[:-1] * exitance[:-1])
    total = donner_jensen.diffuse_reflectance(donner_jensen.NCSU_117, wavelength)
    assert 2.0 * np.pi * rings.sum() == pytest.approx(total[0], rel=1e-3)


def walked(layers, rays, key):
    """Share of the entered rays that leave through the surface, and its standard error."""
    outcome = trace(layers, rays=rays, key=key).outcome
    entered = rays - np.count_nonzero(outcome == SURFACE)
    share = np.count_nonzero(outcome == SUBSURFACE) / entered
    return share, np.sqrt(share * (1.0 - share) / entered)


@pytest.mark.parametrize(
    ("absorption", "anisotropy", "rays"), [(0.1, 0.0, 20_000), (0.01, 0.0, 8_000), (0.1, 0.8, 8000)]
)
def test_diffusion_meets_the_walk_where_little_is_absorbed(absorption, anisotropy, rays):
    """Dipole and walk in a matched half space differ by less than .005 from an albedo of .99 up."""
    layer = Layer(
        thickness=np.inf,
        refractive_index=1.0,
        absorption=10.0 * absorption,
        scattering=10.0 * (10.0 - absorption) / (1.0 - anisotropy),
        anisotropy=anisotropy,
    )
    share, error = walked(Stack((layer,)), rays, (31,))
    expected = donner_jensen.half_space(medium(absorption), 1.0)[0]
    assert abs(share - expected) < 0.005 + 4.0 * error


@pytest.mark.parametrize("wavelength", [450.0, 700.0])
def test_multipole_meets_the_walk_in_skin_without_pigments(wavelength):
    """Two layers, albedo .95 to .99: the multipole is too dark by up to .02."""
    bare = donner_jensen.Parameters(melanin=0.0, eumelanin_share=0.0, haemoglobin=0.0)
    share, error = walked(donner_jensen.stack(bare, wavelength), 15_000, (32,))
    expected = donner_jensen.diffuse_reflectance(bare, wavelength)[0]
    assert abs(share - expected) < 0.02 + 4.0 * error


@pytest.mark.parametrize("name", ["melanin", "eumelanin_share", "haemoglobin"])
def test_dj06_darkens_with_every_pigment(name):
    values = dict(melanin=0.02, eumelanin_share=0.5, haemoglobin=0.01)
    spectra = [
        donner_jensen.diffuse_reflectance(
            donner_jensen.Parameters(**{**values, name: value}), VISIBLE[VISIBLE >= 475.0]
        )
        for value in (0.0, 0.02, 0.05, 0.1)
    ]
    assert np.all(np.diff(spectra, axis=0) < 0.0)


def test_dj06_reflects_at_the_surface_as_fresnel_has_it():
    assert donner_jensen.fresnel(0.0) == pytest.approx((0.4 / 2.4) ** 2, rel=1e-12)
    brewster = np.degrees(np.arctan(1.4))
    half = 0.5 * ((1.4**2 - 1.0) / (1.4**2 + 1.0)) ** 2
    assert donner_jensen.fresnel(brewster) == pytest.approx(half, rel=1e-12)
    dry = donner_jensen.Parameters(0.02, 0.0, 0.01, oiliness=0.0)
    within = donner_jensen.diffuse_reflectance(dry, VISIBLE)
    np.testing.assert_array_equal(donner_jensen.reflectance(dry, VISIBLE, 45.0), within)


def test_dj06_refuses_what_the_paper_does_not_cover():
    with pytest.raises(InputError, match=r"melanin is 0\.6; allowed is 0 to 0\.5"):
        donner_jensen.Parameters(0.6, 0.0, 0.01)
    with pytest.raises(InputError, match="wavelength is 1000 nm; allowed is 380 to 780 nm"):
        donner_jensen.diffuse_reflectance(donner_jensen.NCSU_117, 1000.0)
    with pytest.raises(InputError, match=r"0\.05 mm thick; allowed is more than .* 0\.1 mm"):
        donner_jensen.slab(medium(0.1), 0.05, 1.4, 1.0)


# BioSpec


def biospec_share(layers, rays, turned=False):
    """Reflectance of layers (thickness, index, absorption, Rayleigh) by BioSpec's walk."""
    angles = biospec.scattering_angles(550.0) if turned else np.zeros((2, biospec.TABLE_SIZE))
    ends = np.zeros(4, np.int64)
    biospec.walk(np.array(layers), angles, 0.0, 0.0, 1.0, rays, stream(7), ends)
    assert ends.sum() == rays and ends[biospec.LOST] == 0
    return (ends[biospec.SURFACE] + ends[biospec.SUBSURFACE]) / rays


def test_biospec_without_fibres_is_a_product_of_exponential_integrals():
    """Straight through corneum and epidermis, diffuse across each dermal layer down and up.

    A diffuse crossing of optical depth t lets 2 E3(t) through; on the way out the papillary
    dermis gives the direction for the layers above it too.
    """
    depth = np.array([0.05, 0.2, 0.1, 0.3])
    layers = [(0.01, 1.0, 100.0 * optical_depth, 0.0) for optical_depth in depth]
    crossing = 2.0 * expn(3, [depth[2], depth[3], depth[:3].sum()])
    expected = np.exp(-depth[:2].sum()) * crossing[0] * crossing[1] ** 2 * crossing[2]
    share = biospec_share(layers, 200_000)
    assert abs(share - expected) < 4.0 * np.sqrt(expected * (1.0 - expected) / 200_000)


def test_biospec_rayleigh_scattering_sends_half_back():
    """Half at the papillary dermis, half of the rest at the reticular, the others swallowed."""
    fibres = [(0.01, 1.0, 0.0, 0.0)] * 2 + [(0.01, 1.0, 0.0, 1e9), (0.01, 1.0, 1e9, 1e9)]
    share = biospec_share(fibres, 100_000)
    assert abs(share - 0.75) < 4.0 * np.sqrt(0.75 * 0.25 / 100_000)


def test_biospec_without_absorbers_returns_all_light():
    layers = [(0.01, index, 0.0, 50.0) for index in (1.55, 1.4, 1.36, 1.38)]
    assert biospec_share(layers, 20_000, turned=True) == 1.0


@pytest.mark.parametrize("aspect", [0.25, 1.0, 2.0])
def test_biospec_folds_follow_trowbridge_and_reitz(aspect):
    """The mean of cos^2, its formula integrated over the uniform number, is 1 / (1 + s^2)."""
    state = stream(5)
    squared = np.array([biospec.fold_cosine(state, aspect) ** 2 for _ in range(100_000)])
    error = squared.std() / np.sqrt(squared.size)
    assert abs(squared.mean() - 1.0 / (1.0 + aspect**2)) < 4.0 * error


def test_biospec_scattering_angles_keep_the_measured_shares():
    table = biospec.goniometry()
    for row, tissue in enumerate(("stratum_corneum", "epidermis")):
        for length in (302.0, 436.0, 546.0):
            angles = biospec.scattering_angles(length)[row]
            share = np.linspace(0.0, 100.0, angles.size)
            measured_share = np.interp(table["angle_deg"], angles, share)
            np.testing.assert_allclose(measured_share, table[f"{tissue}_{length:.0f}"], atol=0.1)
    np.testing.assert_array_equal(
        biospec.scattering_angles(700.0), biospec.scattering_angles(546.0)
    )
    between = 0.5 * (biospec.scattering_angles(436.0) + biospec.scattering_angles(546.0))
    np.testing.assert_allclose(biospec.scattering_angles(491.0), between, atol=1e-12)


def test_biospec_absorption_by_hand():
    """550 nm, from spectra.csv and the program's formulas."""
    at_550 = {name: spectrum.at(550.0) for name, spectrum in published_spectra().items()}
    melanin = 0.019 * (80.0 * at_550["eumelanin"] + 12.0 * at_550["pheomelanin"])
    carotene = at_550["beta_carotene"] / 537.0
    blood = 0.75 * at_550["oxyhemoglobin"] + 0.25 * at_550["deoxyhemoglobin"]
    blood = blood * 150.0 / 66500.0 + at_550["bilirubin"] * 0.005 / 585.0
    expected = [
        carotene * 2.1e-4,
        melanin + 0.981 * carotene * 2.1e-4,
        0.012 * blood + carotene * 7e-5,
        0.0091 * blood + carotene * 7e-5,
    ]
    np.testing.assert_allclose(biospec.absorption(biospec.NCSU_113, 550.0), expected, rtol=1e-12)
    natural = biospec.absorption(biospec.Parameters(extinction="natural"), 550.0)
    np.testing.assert_allclose(natural, np.log(10.0) * np.array(expected), rtol=1e-12)


def test_biospec_darkens_with_melanosomes():
    rays = 4_000
    spectra = [
        biospec.reflectance(biospec.Parameters(melanosomes=percent), VISIBLE, 45.0, rays)
        for percent in (0.0, 1.9, 5.2, 12.0, 42.0)
    ]
    assert np.all(np.diff(spectra, axis=0) < 4.0 * np.sqrt(0.5 / rays))
    assert np.all(np.diff(np.mean(spectra, axis=1)) < 0.0)


def test_biospec_repeats_and_depends_on_its_seed():
    first = biospec.reflectance(biospec.NCSU_113, [450.0, 650.0], 45.0, 2_000, seed=3)
    again = biospec.reflectance(biospec.NCSU_113, 650.0, 45.0, 2_000, seed=3)
    other = biospec.reflectance(biospec.NCSU_113, 650.0, 45.0, 2_000, seed=4)
    assert first[1] == again[0] != other[0]


def test_biospec_refuses_what_cannot_be():
    with pytest.raises(InputError, match="melanosomes is 101 %; allowed is 0 to 100 %"):
        biospec.Parameters(melanosomes=101.0)
    with pytest.raises(InputError, match="allowed is decadic, natural"):
        biospec.Parameters(extinction="binary")
    with pytest.raises(InputError, match="wavelength is 300 nm"):
        biospec.reflectance(biospec.NCSU_113, 300.0, 45.0, 10)
