"""`make truth`: its stages under a white diffuser, its model, and one comparison end to end."""

import subprocess
import sys
from dataclasses import replace

import bpy
import numpy as np
import pytest

import blender_addon
from examples.demo import render
from examples.truth import albedo, alike, cycles, eevee, gloss, illuminants, model, page, shots
from examples.truth.outcome import Reading, Row, markdown, read_rows, write_rows
from examples.truth.shots import Shot
from hylios.errors import InputError


@pytest.fixture
def addon():
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    blender_addon.register()
    yield
    blender_addon.unregister()


def of_white(shot, folder):
    """Light in a shot of a white diffuser."""
    skin = cycles.built(shot)
    with render.white(skin):
        return cycles.rendered(shot, folder / "white.exr")


def test_a_white_diffuser_is_1_where_it_is_lit_and_0_behind_the_screen(addon, tmp_path):
    light = of_white(Shot("edge", "edge", "III", size=(10, 2), samples=4), tmp_path)
    across = light["position"][0, :, 0]
    assert across == pytest.approx(np.linspace(-0.009, 0.009, 10), abs=1e-3)
    assert light["diffuse"][:, across > 0.0] == pytest.approx(1.0, abs=1e-5)
    assert np.all(light["combined"][:, across < 0.0] == 0.0)


def test_eevee_is_compared_by_the_light_from_inside_the_skin(addon, tmp_path):
    """Straight above, the lamp's reflection is five times as bright in light skin."""
    (shot, *_) = eevee.shots()
    small = replace(shot, size=(10, 2), samples=16)
    cycles.set_inputs(cycles.built(small), small)
    light = cycles.rendered(small, tmp_path / "lit.exr")
    lit = light["position"][0, :, 0] > 0.003
    assert light["glossy"].max() < 1e-3 < 0.1 < light["diffuse"][:, lit].min()
    assert light["combined"] == pytest.approx(light["diffuse"], abs=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("unit", "scale"), [(0.01, 1.0), (1.0, 10.0)])
def test_a_stage_is_the_same_in_other_units(addon, tmp_path, unit, scale):
    shot = Shot("edge", "edge", "III", size=(10, 2), samples=4, unit=unit, scale=scale)
    light = of_white(shot, tmp_path)
    assert light["position"][0, :, 0] == pytest.approx(np.linspace(-0.009, 0.009, 10), abs=1e-3)
    assert light["diffuse"][:, 5:] == pytest.approx(1.0, abs=1e-5)


@pytest.mark.slow
def test_even_light_and_a_camera_at_an_angle_see_white_as_1(addon, tmp_path):
    shot = Shot("white", "white", "III", angle=70.0, size=(4, 4), samples=4)
    assert of_white(shot, tmp_path)["combined"] == pytest.approx(1.0, abs=1e-5)


@pytest.mark.slow
def test_a_lobe_s_picture_has_every_direction(addon, tmp_path):
    shot = Shot("lobe", "lobe", "III", angle=45.0, size=(192, 192), samples=1)
    light = of_white(shot, tmp_path)
    light["glossy"] = light["diffuse"]
    assert gloss.in_bins(light, 45.0)[:17] == pytest.approx(1.0 / np.pi, rel=0.01)


def test_bins_of_directions():
    """A gloss that is the azimuth, on the mirror's side 0."""
    x, y = np.meshgrid(np.linspace(-50.0, 50.0, 1001), np.linspace(-50.0, 50.0, 1001))
    position = np.stack([x, y, np.zeros_like(x)], axis=-1)
    azimuth = np.arctan2(np.abs(y), -x)
    light = {"position": position, "glossy": np.repeat(azimuth[..., None], 3, axis=-1)}
    binned = np.pi * gloss.in_bins(light, 0.0)
    middles = np.pi * (np.arange(gloss.BINS[1]) + 0.5) / gloss.BINS[1]
    assert binned[12:17] == pytest.approx(np.tile(middles, (5, 1)), abs=0.02)


def test_thicker_slabs_let_less_through():
    of = model.specimen("II", "untanned")
    through = [model.slab(of, thickness) for thickness in (1.5, 2.5, 4.0)]
    assert np.all(np.diff(through, axis=0) < 0.0)
    assert through[1] == pytest.approx([0.202, 0.104, 0.050], abs=1e-3)  # as when it was written


@pytest.mark.slow
@pytest.mark.parametrize("name", ["III", "VI"])
def test_the_model_s_burnt_skin_holds_more_blood_and_its_dermis_is_no_thicker(name):
    bare, burnt, tanned = (model.specimen(name, tan) for tan in ("untanned", *shots.BURNS))
    assert burnt.papillary_blood > 3.0 * bare.papillary_blood > 2.0 * tanned.papillary_blood
    assert tanned.melanin @ tanned.epidermal_thickness > bare.melanin @ bare.epidermal_thickness
    assert burnt.papillary_thickness == bare.papillary_thickness


def test_light_at_two_places_alike_far_from_an_edge_makes_up_all_light():
    places = np.array([-8.0, -0.5, 0.5, 8.0])
    edge = model.lit_edge(model.specimen("III", "untanned"), places, rays=20_000)
    assert edge[0] + edge[3] == pytest.approx(edge[1] + edge[2])
    assert np.all(np.diff(edge[:, 0]) > 0.0)


def test_the_surface_s_lobe_holds_all_that_it_reflects():
    lobe = model.gloss(model.specimen("III", "untanned"), 45.0, 100_000, gloss.BINS)
    of = model.albedo(model.specimen("III", "untanned"), [45.0])
    reflected = (lobe.surface * lobe.projected_solid_angle).sum()
    assert reflected == pytest.approx((of.total - of.subsurface)[0].mean(), abs=0.003)
    assert not lobe.subsurface.any()


def test_white_stays_white_under_any_lamp_and_in_any_space():
    for lamp in illuminants.LAMPS:
        assert illuminants.under(np.ones(3), lamp) == pytest.approx(1.0, abs=2e-3)
    assert illuminants.under(np.array([0.5, 0.3, 0.2]), "A") != pytest.approx([0.5, 0.3, 0.2])
    for space in alike.SPACES.values():
        assert alike.in_rec709(np.full(3, 0.4), space) == pytest.approx(0.4, abs=1e-3)


def reading(*distances):
    grey = np.full((len(distances), 3), 0.2)
    return Reading("edge", "case", grey, grey, np.array(distances), np.arange(len(distances)))


def test_a_row_is_met_where_mean_and_largest_are_within_what_is_allowed(tmp_path):
    readings = [reading(1.0, 3.0), reading(4.0)]
    rows = [
        Row.of(readings, what, allowed)
        for what, allowed in (("a", (3.0, 4.0)), ("b", (3.0, 3.9)), ("c", (None, None)))
    ]
    assert [(row.mean, row.largest, row.met) for row in rows] == [
        (3.0, 4.0, True),
        (3.0, 4.0, False),
        (3.0, 4.0, None),
    ]
    described = {"blender": "5.0.1", "machine": "x", "date": "y", "seconds": "1"}
    write_rows(tmp_path / "rows.csv", rows, described)
    assert read_rows(tmp_path / "rows.csv") == (described, rows)
    assert "| b | CIEDE2000 | 3 / 3.9 | 3.000 / 4.000 | **no** |" in markdown({"5.0.1": rows})
    page.write(tmp_path / "page.md", [tmp_path])
    assert "Blender 5.0.1 on x, y, 1 s" in (tmp_path / "page.md").read_text()
    with pytest.raises(InputError, match="has no rows.csv"):
        page.write(tmp_path / "page.md", [tmp_path / "other"])


def test_one_comparison_from_exposures_to_row_and_picture(addon, tmp_path):
    name = "III light blood 1 at 0"
    shot = Shot(name, "white", "III", "light", size=(8, 8), samples=64)
    assert list(cycles.shot_all([shot], tmp_path)) == [name]
    with np.load(tmp_path / f"{name}.npz") as light:
        outcome = albedo.read([shot], {name: dict(light)})
    whole, inside = outcome.rows
    assert whole.what == "albedo, whole, at 0°" and inside.what.startswith("albedo, subsurface")
    assert max(whole.mean, inside.mean) < 1.0  # at so few samples
    page.draw({"albedo": outcome}, tmp_path)
    assert (tmp_path / "truth_albedo.png").exists()


@pytest.mark.slow
def test_the_command_prints_a_table_and_writes_files(tmp_path):
    command = [sys.executable, "-m", "examples.truth", "--only", "slab", "--out", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert "slab lit from behind" in done.stdout
    assert {path.name for path in tmp_path.iterdir()} == {
        "rows.csv",
        "readings.csv",
        "truth_slab.png",
    }
