"""Optical layers of specimens against the thesis's printed numbers."""

import csv
import io
from dataclasses import replace
from importlib.resources import files

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS
from hylios.spectra import published_spectra
from hylios.tissue import Model, Stack
from hylios.tissue.absorbers import blood_absorbers
from hylios.tissue.layers import rayleigh_coefficient, refractive_index
from hylios.tissue.melanosomes import encounter_coefficient, scattering_angle


def test_refractive_indices_are_those_of_table_6_2_at_1300_nm_and_follow_water():
    model, s3 = Model(), SPECIMENS["S3"]
    assert refractive_index(s3, "corneum", 1300.0, model) == pytest.approx(1.55)
    # Gladstone and Dale: 0.6 of water, whose index falls from 1.3355 to 1.3159 on the way
    rise = refractive_index(s3, "epidermis", 550.0, model) - 1.4
    water = model.spectra["water_refractive_index"]
    assert rise == pytest.approx(0.6 * (water.at(550.0) - water.at(1300.0)))
    assert 0.005 < rise < 0.02


def test_rayleigh_coefficient_is_32_pi_4_r_3_v_over_lambda_4():
    contrast = ((1.127**2 - 1) / (1.127**2 + 1)) ** 2
    expected = 32 * np.pi**4 * (100e-7) ** 3 * 0.22 / (500e-7) ** 4 * contrast
    assert rayleigh_coefficient(500.0) == pytest.approx(expected)
    ratio = rayleigh_coefficient(500.0, "plus_two") / rayleigh_coefficient(500.0)
    assert ratio == pytest.approx(((1.127**2 + 1) / (1.127**2 + 2)) ** 2)


def test_encounter_coefficients():
    """4.3 for a sphere of radius r is 3 v / 4 r, by either way of describing it."""
    assert encounter_coefficient(0.03, 1e-5, 1e-5, 0.0) == pytest.approx(0.75 * 0.03 / 1e-5)
    assert encounter_coefficient(0.03, 0.1, 0.2, 0.41e-4) == pytest.approx(0.75 * 0.03 / 0.41e-4)
    # a prolate spheroid of half axes 1 and 2: surface 21.48, volume 8 pi / 3
    assert encounter_coefficient(1.0, 1.0, 2.0, 0.0) == pytest.approx(
        21.4784 / 8.37758 / 4, rel=1e-4
    )


def test_blood_by_hand():
    """A.2 at 500 nm: 75 % of 147 g/L as oxyhemoglobin, 66500 g/mol, and the rest."""
    molar = {name: float(spectrum.at(500.0)) for name, spectrum in published_spectra().items()}
    blood = 147.0 * (0.75 * molar["oxyhemoglobin"] + 0.25 * molar["deoxyhemoglobin"])
    blood += 1.5 * (molar["carboxyhemoglobin"] + molar["methemoglobin"])
    expected = np.log(10) * blood / 66500.0
    expected += np.log(10) * (molar["beta_carotene"] * 7e-5 / 537 + molar["bilirubin"] * 3e-3 / 585)
    absorbers = blood_absorbers(SPECIMENS["S3"], 500.0, Model())
    assert sum(absorbers.values()) == pytest.approx(expected)


def test_scattering_angle_fades_from_780_to_1300_nm():
    degrees = [
        np.degrees(scattering_angle(wavelength))
        for wavelength in (400.0, 780.0, 1040.0, 1300.0, 2500)
    ]
    assert degrees == pytest.approx([5.0, 5.0, 2.5, 0.0, 0.0])


def test_melanosomes_shrink_upwards_and_complexes_are_twice_the_major_axis():
    layers = Stack.of(SPECIMENS["S1"], 500.0).layers[1:4]
    assert [layer.complex_radius for layer in layers] == pytest.approx(
        [0.25 * 0.41e-4, 0.5 * 0.41e-4, 0.41e-4]
    )
    single = Stack.of(SPECIMENS["S4"], 500.0).layers[3]
    assert (single.semi_minor, single.semi_major) == pytest.approx((0.14e-4, 0.345e-4))
    assert single.complex_radius == 0.0


def absorption_by_hand(specimen, row):
    """Absorption coefficients of the six layers and of melanin, from a row of spectra.csv.

    Written from section 4.1, table 6.2 and appendix A: everything that is not melanin or blood is
    the same for all specimens.
    """
    f = {name: float(text) for name, text in row.items()}
    decadic = np.log(10.0)
    melanin = decadic * (
        f["eumelanin"] * specimen.eumelanin_concentration
        + f["pheomelanin"] * specimen.pheomelanin_concentration
    )
    oxygenated = specimen.oxygenated_blood / 100
    hemoglobin = 147.0 * (
        oxygenated * f["oxyhemoglobin"] + (1 - oxygenated) * f["deoxyhemoglobin"]
    ) + 1.5 * (f["carboxyhemoglobin"] + f["methemoglobin"])
    blood = decadic * (
        hemoglobin / 66500 + f["beta_carotene"] * 7.0e-5 / 537 + f["bilirubin"] * 0.003 / 585
    )
    carotene = decadic * f["beta_carotene"] * 2.1e-4 / 537
    corneum = 0.35 * f["water"] + 0.35 * f["lipids"] + 0.65 * f["keratin"] + carotene
    corneum += decadic * f["urocanic_acid"] * 0.01
    epidermis = 0.60 * f["water"] + 0.20 * f["lipids"] + 0.185 * f["dna"] + carotene
    colloidal = [
        specimen.granulosum_colloidal_melanin,
        specimen.spinosum_colloidal_melanin,
        specimen.basale_colloidal_melanin,
    ]
    dermis = [
        0.75 * f["water"] + 0.151 * f["lipids"] + specimen.papillary_blood / 100 * blood,
        0.75 * f["water"] + 0.1733 * f["lipids"] + specimen.reticular_blood / 100 * blood,
    ]
    layers = [corneum, *(epidermis + percent / 100 * melanin for percent in colloidal), *dermis]
    return layers, melanin


@pytest.mark.parametrize("name", list(SPECIMENS))
@pytest.mark.parametrize("wavelength", [270, 366, 450, 550, 700, 1100, 1650, 2400])
def test_absorption_of_every_layer_by_hand(name, wavelength):
    text = (files("hylios.spectra") / "spectra.csv").read_text()
    rows = {int(row["wavelength_nm"]): row for row in csv.DictReader(io.StringIO(text))}
    expected, melanin = absorption_by_hand(SPECIMENS[name], rows[wavelength])
    layers = Stack.of(SPECIMENS[name], float(wavelength)).layers
    assert [layer.absorption for layer in layers] == pytest.approx(expected, rel=1e-9)
    assert [layer.melanin_absorption for layer in layers[1:4]] == pytest.approx([melanin] * 3)


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("water", "absorption coefficient of corneum is .* 1/cm; allowed is 0 to 1e\\+20 1/cm"),
        (
            "eumelanin",
            "absorption coefficient of granulosum is .* 1/cm; allowed is 0 to 1e\\+20 1/cm",
        ),
        ("water_refractive_index", "refractive index of corneum is .*; allowed is 0.1 to 10"),
    ],
)
def test_absurd_spectra_of_one_s_own_are_refused_where_layers_are_made(name, sentence):
    """At 1e300 the walk gave a reflectance of 1, and the solver's eigenvalues did not converge."""
    published = published_spectra()[name]
    values = np.geomspace(1.0, 1e300, published.values.size)
    absurd = replace(published, values=values)
    with pytest.raises(InputError, match=sentence):
        Stack.of(SPECIMENS["S3"], 2500.0, Model(spectra={name: absurd}))
