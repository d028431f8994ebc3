"""Figures 6.2 to 6.8: earlier models, goniometry, the whole range, directions of reflection."""

from dataclasses import replace

import numpy as np
import pytest

from examples.figures import __main__ as program
from examples.figures import angular, goniometry, hyperspectral, predecessors
from examples.figures.light import RANGE, Curve, Effort
from examples.figures.measured_people import People
from hylios.transport.angular import AngularReflectance
from hylios.transport.interfaces import fresnel
from hylios.transport.tallies import tallied

PEOPLE = People(("s1", "s3"), np.array([250.0, 2500.0]), np.array([[0.25, 0.25], [0.5, 0.5]]))


def test_every_figure_from_6_2_to_6_8_has_one_owner():
    named = [name for group in program.GROUPS for name in group.FIGURES]
    assert len(named) == len(set(named))
    assert {f"6.{number}" for number in range(2, 9)} <= set(named)
    assert program.groups_with(["6.3"]) == [predecessors]


def visible(reflectance):
    many = predecessors.WAVELENGTHS
    return Curve(many, np.broadcast_to(reflectance, many.shape), np.zeros(many.size), 0)


MODELS = ("S1", "S2", "DJ06 multipole", "DJ06 walked", "BioSpec")


def test_models_that_agree_have_no_difference_and_one_colour():
    curves = dict.fromkeys(MODELS, visible(0.3))
    for row in predecessors.curve_rows(curves):
        assert row.ours == "0.000; blue 0.000, green 0.000, red 0.000"
    assert {row.ours for row in predecessors.colour_rows(curves, None)} == {"0.0"}


def test_a_difference_is_found_in_the_third_where_it_is():
    short = np.where(predecessors.WAVELENGTHS < 500.0, 0.4, 0.3)
    curves = dict.fromkeys(MODELS, visible(0.3)) | {"BioSpec": visible(short)}
    row = predecessors.curve_rows(curves)[-1]
    # 20 of the 21 wavelengths of the blue third
    assert row.ours == f"{0.1 * np.sqrt(20 / 61):.3f}; blue 0.095, green 0.000, red 0.000"


def test_people_stand_beside_the_models_only_where_they_are_given():
    curves = dict.fromkeys(MODELS, visible(0.375))
    assert predecessors.people_rows(curves, None) == []
    rows = predecessors.people_rows(curves, PEOPLE)
    assert [row.ours for row in rows] == ["100%; 0.000"] * len(MODELS)
    assert "median of people" in predecessors.swatches(curves, PEOPLE, ("S1",))


def test_dj06_walks_as_far_as_its_multipole_says():
    """Diffusion is not exact: .03 is three standard errors of 1000 rays and what it may be off.

    That the walk is right is tested with the transport; this is about what is handed to it.
    """
    walked = predecessors.walked_dj06(Effort(rays=1000), lambda size: None)
    results = predecessors.tasks(Effort(rays=1))
    multipole = results["DJ06 multipole"].work(lambda size: None)
    assert np.abs(np.mean(walked.reflectance - multipole.reflectance)) < 0.03


def test_a_corneum_without_roughness_turns_nothing_and_absorbs_by_beer_and_lambert():
    """Share let through (1 - F) exp(-mu d), five standard errors: false alarm 1 in 1e6."""
    sample = replace(goniometry.SAMPLES["stratum corneum"], flat=True)
    stack = goniometry.prepared(sample)
    rays = 20_000
    counts = tallied(goniometry.by_angle, stack, rays=rays, angle=0.0, key=(3,))
    assert counts[1:].sum() == 0
    only = stack.layers[0]
    reflected, _ = fresnel(1.0, 1.0, only.refractive_index)
    expected = (1.0 - reflected) * np.exp(-only.absorption * only.thickness)
    error = np.sqrt(expected * (1.0 - expected) / rays)
    assert abs(counts[0] / rays - expected) < 5.0 * error


def test_samples_have_their_layers_and_what_lies_behind():
    whole = goniometry.prepared(goniometry.SAMPLES["epidermis"])
    assert len(whole.layers) == 4 and whole.roughness == 0.25 and not whole.lambertian_floor
    assert whole.index_below == whole.layers[-1].refractive_index
    bare = goniometry.prepared(goniometry.SAMPLES["epidermis without stratum corneum"])
    assert bare.layers == whole.layers[1:]
    assert goniometry.prepared(goniometry.SAMPLES["epidermis, into air"]).index_below == 1.0


def test_cumulative_shares_by_hand():
    counts = np.zeros(180, int)
    counts[[0, 19, 99]] = 1, 2, 1  # up to 0.5, 10 and 50 degrees
    assert goniometry.at(counts, np.array([0.0, 0.5, 9.5, 10.0, 60.0])) == pytest.approx(
        [0.0, 25.0, 25.0, 75.0, 100.0]
    )
    assert goniometry.median(*goniometry.cumulative(counts)) == pytest.approx(9.75)


def test_what_was_measured_differs_by_nothing_from_itself():
    angles, measured = goniometry.sound("epidermis")
    assert 27.5 not in angles and angles.size == 13
    edges = goniometry.STEP * np.arange(181)
    counts = np.round(1e6 * np.diff(np.interp(edges, angles, measured))).astype(int)
    row = goniometry.rows({"epidermis": counts})[0]
    assert row.ours.startswith("0.0 percentage points; 24.6°")


def test_valleys_are_lowest_points_between_others():
    dip = np.abs(RANGE - 970.0) / 1000.0
    assert hyperspectral.valley(RANGE, dip, (920.0, 1040.0)) == 970.0
    assert np.isnan(hyperspectral.valley(RANGE, RANGE, (920.0, 1040.0)))
    assert hyperspectral.position(float("nan")) == "none"


def test_specimens_alike_beyond_1300_nm_are_told_from_others():
    flat = Curve(RANGE, np.full(RANGE.size, 0.375), np.zeros(RANGE.size), 0)
    step = replace(flat, reflectance=np.where(RANGE < 1300.0, 0.1, 0.375))
    assert hyperspectral.similarity_rows({"S3": flat, "S4": step})[0].met
    assert not hyperspectral.similarity_rows(
        {"S3": flat, "S4": replace(flat, reflectance=flat.reflectance / 2)}
    )[0].met
    assert hyperspectral.people_rows({"S3": flat}, None) == []
    assert hyperspectral.people_rows({"S3": flat}, PEOPLE)[-1].ours == "0.000; +0.000; 100%"


def lobes(angle, surface, subsurface):
    return AngularReflectance(
        angle=angle,
        rays=10**9,
        polar_edges=np.linspace(0.0, 90.0, 19),
        azimuth_edges=np.linspace(0.0, 180.0, 13),
        surface_counts=surface,
        subsurface_counts=subsurface,
    )


NOTHING = np.zeros((18, 12), int)
DIFFUSE = np.round(3e8 * lobes(0.0, NOTHING, NOTHING).projected_solid_angle / np.pi).astype(int)


@pytest.mark.parametrize("angle", [0.0, 45.0])
def test_lambertian_light_has_one_brdf_in_the_plane(angle):
    directions, brdf, error = angular.in_plane(lobes(angle, NOTHING, DIFFUSE), DIFFUSE)
    assert directions[[0, 17, 18, 35]].tolist() == [-87.5, -2.5, 2.5, 87.5]
    assert brdf == pytest.approx(np.full(36, 0.3 / np.pi), rel=1e-4)
    assert np.all(error > 0.0) and np.all(error < 0.01 * brdf)


def test_the_mirrors_side_is_positive():
    counts = DIFFUSE.copy()
    counts[9, 0] *= 2
    brdf = angular.in_plane(lobes(45.0, counts, NOTHING), counts)[1]
    assert int(np.argmax(brdf)) == 18 + 9
    assert brdf[17 - 9] == pytest.approx(0.3 / np.pi, rel=1e-4)


def test_distance_from_lambertian_light():
    assert angular.from_lambertian(lobes(45.0, NOTHING, DIFFUSE)) == pytest.approx(0.0, abs=1e-6)
    narrow = NOTHING.copy()
    narrow[9, 0] = 1000
    share = lobes(45.0, narrow, NOTHING).projected_solid_angle[9, 0] / np.pi
    assert angular.from_lambertian(lobes(45.0, narrow, NOTHING)) == pytest.approx(1.0 - share)


def test_subsurface_share_and_the_mean_over_wavelengths():
    half = lobes(45.0, DIFFUSE, DIFFUSE)
    assert angular.subsurface_share(half) == 0.5
    both = angular.together([half, lobes(45.0, NOTHING, DIFFUSE)])
    assert both.rays == 2 * half.rays
    assert both.total == pytest.approx(0.75 * half.total)


@pytest.mark.slow
def test_all_of_chapter_6_with_few_rays_leaves_pictures_and_report(tmp_path):
    effort = Effort(rays=50, people=PEOPLE)
    groups = (predecessors, goniometry, hyperspectral, angular)
    results = program.computed({group: group.tasks(effort) for group in groups})
    rows = [row for group in groups for row in group.draw(results[group], tmp_path)]
    made = {path.name for path in tmp_path.iterdir()}
    assert made == {f"6.{number}.png" for number in range(2, 9)}
    assert all((tmp_path / name).read_bytes().startswith(b"\x89PNG") for name in made)
    assert {row.where for row in rows} == {f"6.{number}" for number in range(2, 9)}
