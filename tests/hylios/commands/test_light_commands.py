"""`hylios brdf` and `hylios profile`, as a shell sees them."""

import csv
import io

import numpy as np
import pytest

from hylios.burley import burley_share_within
from hylios.commands.cli import main
from hylios.skin.phototypes import named_specimen
from hylios.skin.regions import region
from hylios.skin.specimen import SPECIMENS
from hylios.transport.angular import brdf
from hylios.transport.radial import Rings, profile
from hylios.transport.simulate import spectrum

S3 = SPECIMENS["S3"]


def table(text):
    rows = list(csv.reader(io.StringIO(text)))
    return dict(zip(rows[0], np.array(rows[1:], dtype=float).T, strict=True))


def test_brdf_is_csv_that_sums_to_the_reflectance(capsys):
    command = "brdf --specimen S3 --wavelength 550 --angle 30 --polar-bins 6 --azimuth-bins 4"
    assert main([*command.split(), "--rays", "4000", "--seed", "3"]) == 0
    printed = capsys.readouterr()
    header = (
        "polar_degrees,azimuth_degrees,projected_solid_angle_sr,"
        "surface_per_sr,subsurface_per_sr,total_per_sr,standard_error"
    )
    assert printed.out.splitlines()[0] == header
    assert "ESTIMATE" in printed.err
    columns = table(printed.out)
    result = brdf(S3, 550.0, angle=30.0, polar_bins=6, azimuth_bins=4, rays=4000, seed=3)
    reflectance = (result.surface_counts + result.subsurface_counts).sum() / 4000
    solid_angle = columns["projected_solid_angle_sr"]
    assert np.sum(columns["total_per_sr"] * solid_angle) == pytest.approx(reflectance, rel=1e-6)
    parts = columns["surface_per_sr"] + columns["subsurface_per_sr"]
    assert parts == pytest.approx(columns["total_per_sr"], abs=1e-7)
    brightest = np.argmax(columns["surface_per_sr"])
    assert columns["polar_degrees"][brightest] in (22.5, 37.5)  # 30 is the edge between the two
    assert columns["azimuth_degrees"][brightest] == 22.5


def test_profile_is_csv_that_sums_to_the_subsurface_reflectance(capsys):
    command = "profile --specimen S3 --wavelength 633 --rays 4000 --seed 3 --rings 30 --largest 20"
    assert main(command.split()) == 0
    printed = capsys.readouterr()
    header = "inner_mm,outer_mm,exitance_per_mm2,standard_error,burley_per_mm2"
    assert printed.out.splitlines()[0] == header
    result = profile(S3, 633.0, rings=Rings(largest=20.0, count=30), rays=4000, seed=3)
    assert f"Burley's width d is {result.burley_width:.4g} mm" in printed.err
    assert f"{result.beyond:.3g} of the light leaves beyond 20 mm" in printed.err
    columns = table(printed.out)
    area = np.pi * (columns["outer_mm"] ** 2 - columns["inner_mm"] ** 2)
    inside = result.subsurface - result.beyond
    assert np.sum(columns["exitance_per_mm2"] * area) == pytest.approx(inside, rel=1e-6)
    fitted = result.subsurface * burley_share_within(20.0, result.burley_width)
    assert np.sum(columns["burley_per_mm2"] * area) == pytest.approx(fitted, rel=1e-6)


def test_the_fitted_width_alone_is_one_row(capsys):
    assert main("profile --wavelength 633 --rays 4000 --seed 3 --fit".split()) == 0
    columns = table(capsys.readouterr().out)
    result = profile(S3, 633.0, rays=4000, seed=3)
    assert list(columns) == ["wavelength_nm", "subsurface", "burley_width_mm", "standard_error_mm"]
    assert columns["burley_width_mm"] == pytest.approx([result.burley_width], rel=1e-6)
    assert columns["subsurface"] == pytest.approx([result.subsurface])
    assert 0.0 < columns["standard_error_mm"][0] < 0.2 * result.burley_width


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("brdf --wavelength 200", "allowed is 250 to 2500 nm"),
        ("brdf --wavelength nan", "wavelength nan nm is outside"),
        ("brdf --angle 90", "allowed is 0 to 89.99 degrees"),
        ("brdf --polar-bins 0", "number of polar bins is 0"),
        ("brdf --rays 0", "number of rays is 0"),
        ("brdf --specimen S9", "there is no specimen 'S9'"),
        ("profile --wavelength 3000", "allowed is 250 to 2500 nm"),
        ("profile --largest 0.001", "largest radius is 0.001 mm"),
        ("profile --rings 1", "number of rings is 1"),
        ("profile --wavelength 2500 --rays 1", "none of 1 rays came back from inside"),
        ("profile --seed -1", "seed is -1"),
    ],
)
def test_bad_input_is_one_sentence_and_status_2(capsys, arguments, sentence):
    assert main(arguments.split()) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err
    assert printed.err.count("\n") == 1
    assert printed.out == ""


def test_a_region_has_the_reflectance_of_its_specimen(capsys):
    assert (
        main("reflectance --specimen II --region palms --wavelengths 600 --rays 500".split()) == 0
    )
    printed = capsys.readouterr()
    start = named_specimen("II")
    palm = region("palms", start.pigmentation).of(start)
    right = spectrum(palm, [600.0], rays=500, seed=1).total
    assert table(printed.out)["total"] == pytest.approx(right, rel=1e-6)
    assert "note: of palms it is an ESTIMATE: tan." in printed.err
