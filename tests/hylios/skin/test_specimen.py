"""Specimens, their tissue and the published spectra against the thesis's printed numbers."""

import csv
import io
from importlib.resources import files

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.skin.phototypes import named_specimen
from hylios.skin.specimen import SPECIMENS, overfull, parameters, with_values
from hylios.spectra import estimates_within, published_spectra, with_own_spectrum
from hylios.tissue import Model, Stack
from hylios.tissue.absorbers import blood_absorbers
from hylios.tissue.layers import rayleigh_coefficient, refractive_index
from hylios.tissue.melanosomes import encounter_coefficient, scattering_angle

TABLE_6_1 = """
surface_fold_aspect_ratio    0.1     0.25    0.1     0.45
corneum_thickness            0.001   0.001   0.0004  0.0004
granulosum_thickness         0.0017  0.0033  0.0033  0.0007
spinosum_thickness           0.0017  0.0033  0.0033  0.0007
basale_thickness             0.0017  0.0033  0.0033  0.0007
papillary_thickness          0.02    0.01    0.02    0.023
reticular_thickness          0.1     0.1     0.125   0.2
granulosum_melanosomes       1.0     0.0     0.0     10.0
spinosum_melanosomes         1.0     0.0     0.0     10.0
basale_melanosomes           1.0     3.75    3.0     10.0
granulosum_colloidal_melanin 0.8     1.25    1.35    15.0
spinosum_colloidal_melanin   0.8     1.25    1.35    15.0
basale_colloidal_melanin     0.8     1.25    1.35    15.0
eumelanin_concentration      90.0    50.0    32.0    50.0
pheomelanin_concentration    4.0     2.0     2.0     4.0
melanosome_major_axis        0.41    0.41    0.41    0.69
melanosome_minor_axis        0.17    0.17    0.17    0.28
papillary_blood              0.2     0.7     0.3     2.5
reticular_blood              0.2     0.7     0.3     2.5
oxygenated_blood             75.0    95.0    75.0    75.0
"""

TABLE_6_2 = {
    "corneum_refractive_index": 1.55,
    "epidermis_refractive_index": 1.4,
    "papillary_refractive_index": 1.39,
    "reticular_refractive_index": 1.41,
    "melanin_refractive_index": 1.7,
    "hemoglobin": 147.0,
    "methemoglobin": 1.5,
    "carboxyhemoglobin": 1.5,
    "sulfhemoglobin": 0.0,
    "blood_bilirubin": 0.003,
    "corneum_beta_carotene": 2.1e-4,
    "epidermis_beta_carotene": 2.1e-4,
    "blood_beta_carotene": 7.0e-5,
    "corneum_water": 35.0,
    "epidermis_water": 60.0,
    "papillary_water": 75.0,
    "reticular_water": 75.0,
    "corneum_lipids": 35.0,
    "epidermis_lipids": 20.0,
    "papillary_lipids": 15.1,
    "reticular_lipids": 17.33,
    "corneum_keratin": 65.0,
    "corneum_urocanic_acid": 0.01,
    "skin_dna": 0.185,
}


OWN = {"hypodermis_reflectance"}
"""Of this project: 100 % in section 4.3."""


@pytest.mark.parametrize("line", TABLE_6_1.split("\n")[1:-1])
def test_table_6_1(line):
    name, *printed = line.split()
    held = [getattr(SPECIMENS[each], name) for each in ("S1", "S2", "S3", "S4")]
    assert held == [float(text) for text in printed]


@pytest.mark.parametrize("name", list(SPECIMENS))
def test_table_6_2(name):
    assert {each: getattr(SPECIMENS[name], each) for each in TABLE_6_2} == TABLE_6_2
    printed = {line.split()[0] for line in TABLE_6_1.split("\n")[1:-1]}
    assert {each.name for each in parameters()} - {*TABLE_6_2, *printed} == OWN
    assert SPECIMENS[name].hypodermis_reflectance == 100.0


def test_arrangement_of_melanosomes():
    arrangements = [each.melanosome_arrangement for each in SPECIMENS.values()]
    assert arrangements == ["complexes", "complexes", "complexes", "individual"]


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
    molar = {name: float(each.at(500.0)) for name, each in published_spectra().items()}
    blood = 147.0 * (0.75 * molar["oxyhemoglobin"] + 0.25 * molar["deoxyhemoglobin"])
    blood += 1.5 * (molar["carboxyhemoglobin"] + molar["methemoglobin"])
    expected = np.log(10) * blood / 66500.0
    expected += np.log(10) * (molar["beta_carotene"] * 7e-5 / 537 + molar["bilirubin"] * 3e-3 / 585)
    absorbers = blood_absorbers(SPECIMENS["S3"], 500.0, Model())
    assert sum(absorbers.values()) == pytest.approx(expected)


def test_scattering_angle_fades_from_780_to_1300_nm():
    degrees = [np.degrees(scattering_angle(each)) for each in (400.0, 780.0, 1040.0, 1300.0, 2500)]
    assert degrees == pytest.approx([5.0, 5.0, 2.5, 0.0, 0.0])


def test_melanosomes_shrink_upwards_and_complexes_are_twice_the_major_axis():
    layers = Stack.of(SPECIMENS["S1"], 500.0).layers[1:4]
    assert [each.complex_radius for each in layers] == pytest.approx(
        [0.25 * 0.41e-4, 0.5 * 0.41e-4, 0.41e-4]
    )
    single = Stack.of(SPECIMENS["S4"], 500.0).layers[3]
    assert (single.semi_minor, single.semi_major) == pytest.approx((0.14e-4, 0.345e-4))
    assert single.complex_radius == 0.0


def test_spectra_cover_the_model_and_name_their_sources():
    assert len(published_spectra()) == 17
    for spectrum in published_spectra().values():
        assert spectrum.source
        assert spectrum.unit
        assert (spectrum.wavelengths[0], spectrum.wavelengths[-1]) == (250.0, 2500.0)
        assert np.all(spectrum.values >= 0)


def test_estimates_stay_marked():
    lines = estimates_within(published_spectra(), published_spectra(), np.array([1700.0]))
    assert any(line.startswith("lipids") and "ESTIMATE" in line for line in lines)
    assert any("PROVISIONAL" in line for line in lines)
    assert not any(line.startswith("water,") for line in lines)


def test_a_spectrum_can_be_the_user_s_own(tmp_path):
    file = tmp_path / "keratin.csv"
    file.write_text("250,10\n2500,20\n")
    own = with_own_spectrum(published_spectra(), "keratin", file)
    assert own["keratin"].at(1375.0) == pytest.approx(15.0)
    usual = Stack.of(SPECIMENS["S3"], 1375.0).layers[0].absorption
    changed = Stack.of(SPECIMENS["S3"], 1375.0, Model(own)).layers[0].absorption
    assert changed == pytest.approx(usual + 0.65 * 15.0)


@pytest.mark.parametrize(
    "text",
    [
        "300,1\n250,2\n260,3\n",
        "250,1\n300,1e308\n",
        "250,-1\n300,2\n",
        "a,b\n",
        "",
        "250,nan\n260,1",
    ],
)
def test_a_bad_spectrum_is_refused(tmp_path, text):
    file = tmp_path / "own.csv"
    file.write_text(text)
    with pytest.raises(InputError):
        with_own_spectrum(published_spectra(), "keratin", file)


def test_bad_parameters_are_named():
    with pytest.raises(InputError, match="papillary_blood is 101 %; allowed is 0 to 100 %"):
        with_values(SPECIMENS["S3"], {"papillary_blood": 101.0}, allow_unphysical=True)
    with pytest.raises(InputError, match="there is no parameter 'blood'"):
        with_values(SPECIMENS["S3"], {"blood": 1.0})
    with pytest.raises(InputError, match="there is no specimen 'S9'; there are S1, S2, S3, S4"):
        named_specimen("S9")
    with pytest.raises(InputError, match="corneum_thickness is nan cm"):
        with_values(SPECIMENS["S3"], {"corneum_thickness": float("nan")})


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


def test_more_melanin_than_a_layer_holds_is_refused():
    with pytest.raises(InputError, match="basale_colloidal_melanin together are 101.35 %"):
        with_values(SPECIMENS["S3"], {"basale_melanosomes": 100.0}, allow_unphysical=True)


def test_a_tan_that_overfills_a_layer_is_told():
    assert overfull(SPECIMENS["S4"], np.array([0.1, 4.5, 0.1]), 1.0)
    assert not overfull(SPECIMENS["S4"], np.array([0.1, 1.2, 0.1]), 1.0)
