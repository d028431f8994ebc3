"""Specimens, their tissue and the published spectra against the thesis's printed numbers."""

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.skin.phototypes import named_specimen
from hylios.skin.specimen import SPECIMENS, overfull, parameters, with_values

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
    held = [getattr(SPECIMENS[specimen], name) for specimen in ("S1", "S2", "S3", "S4")]
    assert held == [float(text) for text in printed]


@pytest.mark.parametrize("name", list(SPECIMENS))
def test_table_6_2(name):
    assert {field: getattr(SPECIMENS[name], field) for field in TABLE_6_2} == TABLE_6_2
    printed = {line.split()[0] for line in TABLE_6_1.split("\n")[1:-1]}
    assert {field.name for field in parameters()} - {*TABLE_6_2, *printed} == OWN
    assert SPECIMENS[name].hypodermis_reflectance == 100.0


def test_arrangement_of_melanosomes():
    arrangements = [specimen.melanosome_arrangement for specimen in SPECIMENS.values()]
    assert arrangements == ["complexes", "complexes", "complexes", "individual"]


def test_bad_parameters_are_named():
    with pytest.raises(InputError, match="papillary_blood is 101 %; allowed is 0 to 100 %"):
        with_values(SPECIMENS["S3"], {"papillary_blood": 101.0}, allow_unphysical=True)
    with pytest.raises(InputError, match="there is no parameter 'blood'"):
        with_values(SPECIMENS["S3"], {"blood": 1.0})
    with pytest.raises(InputError, match="there is no specimen 'S9'; there are S1, S2, S3, S4"):
        named_specimen("S9")
    with pytest.raises(InputError, match="corneum_thickness is nan cm"):
        with_values(SPECIMENS["S3"], {"corneum_thickness": float("nan")})


def test_more_melanin_than_a_layer_holds_is_refused():
    with pytest.raises(InputError, match="basale_colloidal_melanin together are 101.35 %"):
        with_values(SPECIMENS["S3"], {"basale_melanosomes": 100.0}, allow_unphysical=True)


def test_a_tan_that_overfills_a_layer_is_told():
    assert overfull(SPECIMENS["S4"], np.array([0.1, 4.5, 0.1]), 1.0)
    assert not overfull(SPECIMENS["S4"], np.array([0.1, 1.2, 0.1]), 1.0)
