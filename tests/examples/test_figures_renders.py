"""Renders after figures 6.24 to 6.29: skins and doses, where the sun gets, readings, the path."""

import subprocess
import sys
from dataclasses import replace

import bpy
import numpy as np
import pytest
from matplotlib.image import imread

import blender_addon
from blender_addon.model.views import VISIBLE
from blender_addon.scene import film
from examples.demo import render, scene
from examples.figures import (
    pixel_readings,
    render_claims,
    render_results,
    render_sheet,
    renders,
    scenes,
    shots,
    stages,
    sun_fields,
)
from examples.figures.light import Effort
from examples.figures.render_results import Result
from examples.figures.render_sheet import Panel
from hylios.errors import InputError
from hylios.lab.colour import lab
from hylios.skin.specimen import SPECIMENS
from hylios.tanning import PIGMENTATIONS
from lut_builder.exr_writer import write_table
from lut_builder.settings import Settings

STAND_IN = ("--stand-in", "--scale", "0.12", "--samples", "32")
COARSE = Settings(
    knots=(3,), bands=(365.0,), profile_error=0.1, profile_wavelengths=4, profile_states=8
)
"""Enough for the path; nobody looks at the colours."""


def grey(lightness):
    """Linear Rec.709 (..., 3) of greys with the given L*, from 8 on."""
    luminance = ((np.asarray(lightness) + 16.0) / 116.0) ** 3
    return np.repeat(luminance[..., None], 3, axis=-1)


def seen(name, lightness, shine=(0.3, 0.3)):
    """The result of a shot by name with the given L* of its parts and beside them."""
    (shot,) = shots.named([name])
    colour = grey(lightness)
    return Result(
        shot, np.zeros((4, 3, 3)), colour, colour, colour, np.array(shine), np.ones((4, 3)), "Back"
    )


@pytest.mark.slow
def test_the_figures_are_listed_without_blender():
    code = "import sys, examples.figures.__main__; sys.exit('bpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_schedules_have_the_totals_of_the_abstract_and_two_doses_a_week():
    totals = [sum(dose for _, dose in schedule) for schedule in shots.SCHEDULES]
    assert totals == pytest.approx([19.0, 29.0, 42.0])
    assert [day for day, _ in shots.SCHEDULES[0]] == [0, 3, 7, 10, 14, 17, 21, 24]
    assert shots.scaled(((1.0, 2.0), (3.0, 4.0)), 2.5) == ((1.0, 5.0), (3.0, 10.0))


def test_the_skins_are_those_of_the_captions():
    skins = shots.skins()
    assert (skins["low"].mmd, skins["low"].med) == (2.89, 1.7)
    assert skins["intermediate"].mmd == pytest.approx(1.4 * 2.89)
    assert skins["high"].med == pytest.approx(2.4 * 1.7)
    assert skins["high"].specimen == SPECIMENS["S4"]
    assert skins["strong"].dynamics.extra_production == (0.0858, 0.0, 0.0)
    assert skins["strong"].dynamics.transfer == PIGMENTATIONS["low"].transfer
    assert skins["beach"].dynamics == PIGMENTATIONS["intermediate"]


def test_the_skin_between_is_darker_than_the_light_and_lighter_than_the_dark():
    untanned = np.array([*PIGMENTATIONS["low"].steady_state(), 1.0])
    skins = [shots.skins()[name] for name in ("low", "intermediate", "high")]
    low, between, high = (lab(render_results.model_colour(skin, untanned))[0] for skin in skins)
    assert high + 10.0 < between < low - 5.0


def test_every_shot_has_its_table_and_day():
    every = shots.shots()
    assert len({shot.name for shot in every}) == len(every)
    assert {shot.table for shot in every} == set(shots.skins())
    assert {shot.view for shot in every} == {VISIBLE, shots.UV}
    assert all(0 <= shot.day <= shots.LAST_DAY for shot in every)
    assert {shot.name.split()[0] for shot in every} == set(renders.FIGURES)


def test_patches_are_rounded_squares_one_over_the_other():
    side = np.linspace(-0.12, 0.12, 961)
    across, up = (grid.ravel() for grid in np.meshgrid(side, side))
    inside = sun_fields.square_patches(across, up) > 0
    area = inside.sum() * (side[1] - side[0]) ** 2
    rounded = (4.0 - np.pi) * sun_fields.PATCH_CORNER**2
    assert area == pytest.approx(3 * (4.0 * sun_fields.PATCH_HALF**2 - rounded), rel=0.01)
    heights = np.array(sun_fields.PATCH_HEIGHTS)
    assert np.array_equal(sun_fields.nearest_patch(heights), [0, 1, 2])
    assert np.allclose(
        sun_fields.square_patches(np.zeros(3), heights), sun_fields.PATCH_HALF
    )  # a distance: how far the centre is from the edge


def test_the_painted_sun_has_a_disk_and_twelve_rays():
    angle = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    middle = 0.5 * (sun_fields.RAY_FROM + sun_fields.RAY_TO)
    on_rays = sun_fields.sun_sign(middle * np.cos(angle), middle * np.sin(angle))
    assert np.allclose(on_rays, -0.5 * sun_fields.RAY_WIDTH)
    turned = angle + np.pi / 12
    assert np.all(sun_fields.sun_sign(middle * np.cos(turned), middle * np.sin(turned)) > 0)
    assert sun_fields.sun_sign(np.zeros(1), np.zeros(1))[0] == pytest.approx(-sun_fields.SUN_RADIUS)


def test_sun_and_shade_stay_on_their_side_of_the_body():
    placement = sun_fields.Placement((0.0, 0.0, 1.2))
    points = np.array([[0.0, 0.1, 1.2], [0.0, -0.1, 1.2]])
    assert list(sun_fields.patches_at(placement)(points) > 0) == [True, False]
    assert list(sun_fields.sunscreen_at(placement)(points) > 0) == [False, True]


CAMERA = np.array([0.0, 1.0, 0.0])


def flat_light(scattered):
    """Light of a flat piece of skin 20 cm wide that faces y, (40, 40) pixels."""
    side = np.linspace(-0.1, 0.1, 40)
    x, z = np.meshgrid(side, side)
    position = np.stack([x, np.zeros_like(x), z], axis=-1)
    normal = np.broadcast_to([0.0, 1.0, 0.0], position.shape)
    return render.Light(scattered, scattered, position, normal)


def half_stage(centre):
    subject = scene.Subject("Flat", None, 0, sun_fields.half, (0.0, 0.0, 0.0), 0.2, 0.0)
    return stages.Stage(subject, (), sun_fields.whole, 1, centre, 0.1)


def test_a_colour_is_read_as_a_share_of_white_away_from_the_edge():
    white = flat_light(np.full((40, 40, 3), 0.8))
    colours = np.where(white.position[..., :1] > 0, [0.4, 0.2, 0.1], [0.6, 0.5, 0.4])
    edge = np.abs(white.position[..., :1]) < 0.5 * pixel_readings.CLEAR_OF_EDGE
    light = flat_light(0.8 * np.where(edge, 9.0, colours))
    stage = half_stage((0.0, 0.0, 0.0))
    distance = pixel_readings.sun_distance(white, stage, CAMERA)
    assert np.nanmax(np.abs(distance - white.position[..., 0])) < 1e-9
    regions = pixel_readings.regions(white, distance, stage)
    shares = pixel_readings.readings(light, white, regions)
    assert np.allclose(shares, [[0.4, 0.2, 0.1], [0.6, 0.5, 0.4]])
    shone = pixel_readings.shine(pixel_readings.Taken(light.scattered + 0.25, light), regions)
    assert np.allclose(shone, 0.25)


def test_skin_that_turns_away_is_not_read():
    white = flat_light(np.full((40, 40, 3), 0.8))
    beside = np.array([1.0, 0.5, 0.0])  # 63 degrees from the normal
    assert np.all(
        np.isnan(pixel_readings.sun_distance(white, half_stage((0.0, 0.0, 0.0)), beside)[:, 0])
    )


def test_nothing_is_read_where_nothing_is_seen():
    white = flat_light(np.full((40, 40, 3), 0.8))
    stage = half_stage((0.0, 5.0, 0.0))
    regions = pixel_readings.regions(
        white, pixel_readings.sun_distance(white, stage, CAMERA), stage
    )
    assert not np.any(regions)
    assert np.all(np.isnan(pixel_readings.readings(white, white, regions)))


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    path = tmp_path_factory.mktemp("tables") / "low.exr"
    low = shots.skins()["low"]
    write_table(path, renders.build(low, COARSE))
    return path


def test_three_schedules_on_one_object_are_three_materials(table):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    blender_addon.register()
    try:
        obj = stages.built(stages.stages(None)["patches"])
        scenes.tan(obj, table, shots.SCHEDULES)
        names = [material.name for material in obj.data.materials]
        assert names == ["Skin Tan Suzanne", "Skin Tan Suzanne 1", "Skin Tan Suzanne 2"]
        assert [obj.name for obj in bpy.data.objects if obj.type == "MESH"] == ["Suzanne"]
        melanin = [
            np.array(bpy.data.images[f"Skin Tan States {name[9:]}"].pixels[:])[::4].max()
            for name in names
        ]
        assert melanin[0] < melanin[1] < melanin[2]  # stronger schedules are darker
        assert {face.material_index for face in obj.data.polygons} == {0, 1, 2}
        assert not any(film.is_shown(group) for group in groups_of(obj))
    finally:
        blender_addon.unregister()


def groups_of(obj):
    """The tan's groups of an object."""
    nodes = [node for slot in obj.material_slots for node in slot.material.node_tree.nodes]
    return [node.node_tree for node in nodes if "Oil" in node.inputs]


def test_sunscreen_is_the_film_of_the_add_on_on_skin_without_oil(table):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    blender_addon.register()
    try:
        obj = stages.built(stages.stages(None)["face"])
        scenes.tan(obj, table, (shots.BEACH,), sunscreen=True)
        (group,) = groups_of(obj)
        assert film.is_shown(group)
        assert obj.skin_tan.worn_film_mask().invert  # it lies where the sun does not reach
        nodes = obj.material_slots[0].material.node_tree.nodes
        assert [node.inputs["Oil"].default_value for node in nodes if "Oil" in node.inputs] == [0.0]
    finally:
        blender_addon.unregister()


def test_what_is_said_of_patches_follows_the_readings():
    days = (0, *shots.CLOSE_DAYS, 45)
    tanned = [seen(f"6.24 day {day}", [61.0, 58.0, 55.0, 65.0]) for day in days]
    assert render_claims.schedules(tanned)[1][0].met
    crossed = [*tanned[:-1], seen("6.24 day 45", [61.0, 58.0, 59.0, 65.0])]
    assert not render_claims.schedules(crossed)[1][0].met


def test_what_is_said_of_three_skins_follows_the_readings():
    names = tuple(shots.SENSITIVITY)
    falling = [
        seen(f"6.25 {name}", [60.0 - step, 55.0 - step, 50.0 - step, 60.2])
        for name, step in zip(names, (9.0, 5.0, 0.0), strict=True)
    ]
    assert [row.met for row in render_claims.plain(falling)[1]] == [True, True, True]
    assert [row.met for row in render_claims.plain(falling[::-1])[1]][
        0
    ] is True  # by name, not place
    rising = [
        seen(f"6.26 {name}", [60.0 - step, 55.0 - step, 50.0 - step, 60.2])
        for name, step in zip(names, (0.0, 5.0, 9.0), strict=True)
    ]
    assert render_claims.matched(rising)[1][0].met


def test_what_is_said_of_sunscreen_and_face_follows_the_readings():
    days = [
        seen(f"6.27 day {day}", [dark, 65.0])
        for day, dark in zip(shots.AIRPORT_DAYS, (65.0, 50.0, 40.0), strict=True)
    ]
    assert render_claims.strong(days)[1][0].met
    assert not render_claims.strong([*days[:2], seen("6.27 day 15", [55.0, 65.0])])[1][0].met
    faces = [
        seen(f"6.28 {light} day {day}", [60.0, 65.0], shine=(0.2, 0.5))
        for light in ("visible", "UV")
        for day in shots.FACE_DAYS
    ]
    assert render_claims.face(faces)[1][0].met
    assert render_claims.mild_beside_strong(days, faces).met
    assert not render_claims.mild_beside_strong(faces, days).met


def test_what_is_said_of_a_month_follows_the_readings():
    def month(peak, fade):
        days = np.array(shots.DAILY)
        rise, fall = (days / peak) ** 0.3, np.exp(-(((days - peak) / fade) ** 2))
        change = 10.0 * np.where(days < peak, rise, fall)
        return [
            seen(f"6.29 small, day {day}", [65.0 - value, 65.0])
            for day, value in zip(days, change, strict=True)
        ]

    assert [row.met for row in render_claims.month(month(9, 24.0))[1]] == [True, True]
    assert [row.met for row in render_claims.month(month(25, 24.0))[1]] == [False, False]


def test_a_sheet_holds_every_picture_pixel_by_pixel(tmp_path):
    red, blue = np.zeros((30, 20, 3)), np.zeros((40, 25, 3))
    red[..., 0], blue[..., 2] = 1.0, 1.0
    panels = [[Panel(red, "a"), Panel(blue, "b\nc", (0.2, 0.8, 0.2, 0.8))]]
    render_sheet.sheet("Two", panels, tmp_path / "two.png")
    drawn = imread(tmp_path / "two.png")[..., :3]
    assert np.all(drawn == red[0, 0], axis=-1).sum() == 30 * 20
    assert 0 < np.all(drawn == blue[0, 0], axis=-1).sum() < 40 * 25  # all but the frame


def test_a_tiny_render_goes_the_whole_path(tmp_path, monkeypatch):
    monkeypatch.setattr(renders, "SETTINGS", COARSE)
    wanted = shots.named(["6.28 visible day 0", "6.28 UV day 15"])
    ticks = []
    results = renders.rendered(wanted, tmp_path, Effort(seed=1), ticks.append, STAND_IN)
    assert [result.shot for result in results] == wanted
    assert ticks.count(renders.PICTURE_AS_LONG) == 2
    visible, uv = results
    assert visible.subject == "Suzanne"
    assert visible.picture.shape == uv.picture.shape == (43, 32, 3)
    assert visible.exact is not None and uv.exact is None
    off = lab(visible.readings) - lab(visible.predicted)
    assert np.abs(off[0, 0]) < render_claims.NEAR
    assert np.all(np.isnan(off[1]))  # a film lies there
    assert uv.readings[0, 0] < uv.readings[1, 0]
    assert uv.readings == pytest.approx(uv.predicted, rel=0.1)


@pytest.mark.slow
def test_blender_that_fails_is_told_in_a_sentence(tmp_path):
    wanted = shots.named(["6.27 day 0"])  # whose table is not there
    with pytest.raises(InputError, match="could not render the figures .status 2."):
        renders.run_blender(wanted, tmp_path, STAND_IN, lambda _: None)


@pytest.mark.slow
def test_all_figures_from_small_renders_of_the_stand_in(tmp_path, monkeypatch):
    monkeypatch.setattr(renders, "SETTINGS", replace(renders.SETTINGS, profile_error=0.1))
    options = ("--stand-in", "--scale", "0.4", "--samples", "48")
    results = renders.rendered(shots.shots(), tmp_path, Effort(seed=1), lambda _: None, options)
    rows = renders.draw({"renders": results}, tmp_path)
    assert {f"{name}.png" for name in renders.FIGURES} <= {path.name for path in tmp_path.iterdir()}
    assert {row.where for row in rows} == set(renders.FIGURES)
    # Fewer samples than 48 on so few pixels put noise of 4 L* into a reading; and no body is as
    # smooth as a real one, which comes nearer to the table.
    claims = [row for row in rows if row.aim == "as printed"]
    # Relief is too fine for them to tell how much glossier a film is.
    assert {row.where for row in claims if not row.met} <= {"6.25", "6.26", "6.28"}
