"""What the shader shows, rendered: the table's numbers at every share and day."""

import bpy
import numpy as np
import pytest
from scenes import add_camera, of_role, render, tan_object, white_world
from synthetic import UNTANNED_COLOUR

from blender_addon.model.tan import tan
from hylios.sun.doses import joined, of_sed
from hylios.tanning import PIGMENTATIONS, Exposures, simulate

FIRST_DAY, LAST_DAY, FIRST_FRAME, LAST_FRAME = 2.0, 20.0, 10, 190
DAYS_PER_FRAME = (LAST_DAY - FIRST_DAY) / (LAST_FRAME - FIRST_FRAME)
SHARES = np.array([-0.5, 0.0, 0.05, 0.11, 0.3, 0.5, 0.613, 0.8, 0.997, 1.0, 1.7])


def skin_material():
    return bpy.data.materials["Skin Tan Body"]


def skin_node():
    (node,) = (n for n in skin_material().node_tree.nodes if n.bl_idname == "ShaderNodeGroup")
    return node


def show_emission_of(output: str) -> None:
    """Rewire the material to emit one of the group's outputs."""
    tree = skin_material().node_tree
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(skin_node().outputs[output], emission.inputs["Color"])
    tree.links.new(emission.outputs["Emission"], tree.nodes["Material Output"].inputs["Surface"])


def apply_timed(obj) -> None:
    settings = obj.skin_tan
    settings.first_day, settings.last_day = FIRST_DAY, LAST_DAY
    settings.first_frame, settings.last_frame = FIRST_FRAME, LAST_FRAME
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}


def rendered_squares(tmp_path, count: int) -> np.ndarray:
    """The colour in the middle of each square of a row, shape (count, 3)."""
    pixels = render(tmp_path / "row.exr", width=count * 3, height=3)
    return pixels[1, 1::3]


def direct(table, plane: str, shares: np.ndarray, day: float) -> np.ndarray:
    """A plane of the table at shares of 30 SED on day 0, simulated for each of them."""
    history = simulate(
        Exposures(hours=np.array([0]), doses=shares[:, None] * 30.0),
        PIGMENTATIONS["intermediate"],
        mmd=table.provenance["mmd_sed"],
        med=table.provenance["med_sed"],
        hours=24 * 30,
    )
    low = int(24.0 * day)
    fraction = 24.0 * day - low
    states = history.states[:, low] * (1.0 - fraction) + history.states[:, low + 1] * fraction
    return table.plane(plane, states)


@pytest.mark.parametrize(
    ("output", "plane"), [("Colour", "subsurface_colour"), ("Profile Width", "profile_width")]
)
def test_emission_equals_the_table(tmp_path, table, table_path, output, plane):
    obj = tan_object(table_path, SHARES)
    apply_timed(obj)
    add_camera((len(SHARES) / 2, 0.5, 5.0), len(SHARES))
    show_emission_of(output)
    for frame, subframe in ((1, 0.0), (10, 0.0), (47, 0.0), (82, 0.35), (190, 0.0), (250, 0.0)):
        bpy.context.scene.frame_set(frame, subframe=subframe)
        day = FIRST_DAY + (frame + subframe - FIRST_FRAME) * DAYS_PER_FRAME
        expected = direct(table, plane, SHARES.clip(0.0, 1.0), np.clip(day, FIRST_DAY, LAST_DAY))
        assert rendered_squares(tmp_path, len(SHARES)) == pytest.approx(expected, abs=1e-3)


def test_without_a_mask_the_whole_body_gets_the_full_dose(tmp_path, table, table_path):
    apply_timed(tan_object(table_path))
    add_camera((0.5, 0.5, 5.0), 1.0)
    show_emission_of("Colour")
    bpy.context.scene.frame_set(LAST_FRAME)
    expected = direct(table, "subsurface_colour", np.array([1.0]), LAST_DAY)
    assert rendered_squares(tmp_path, 1) == pytest.approx(expected, abs=1e-3)


def test_without_exposures_the_skin_stays_as_it_was(tmp_path, table_path):
    obj = tan_object(table_path)
    obj.skin_tan.exposures.clear()
    apply_timed(obj)
    add_camera((0.5, 0.5, 5.0), 1.0)
    show_emission_of("Colour")
    bpy.context.scene.frame_set(LAST_FRAME)
    assert rendered_squares(tmp_path, 1)[0] == pytest.approx(UNTANNED_COLOUR, abs=1e-3)


@pytest.mark.parametrize("day", [0.0, 9.0, 30.0])
def test_white_furnace_gives_the_subsurface_albedo(tmp_path, table, table_path, day):
    obj = tan_object(table_path)
    # A ball of a metre: flat over the few millimetres that light travels in skin.
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32)
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    bpy.data.objects.remove(obj)
    ball.name = "Body"
    ball.skin_tan.skin, ball.skin_tan.table_path = "FILE", str(table_path)
    ball.skin_tan.exposures.add().dose = 30.0
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    skin_node().inputs["Specular"].default_value = 0.0
    white_world()
    add_camera((0.0, 0.0, 5.0), 1.0)
    frames_per_day = 249 / 30
    bpy.context.scene.frame_set(1 + int(day * frames_per_day), subframe=day * frames_per_day % 1.0)
    pixels = render(tmp_path / "ball.exr", width=24, height=24, samples=64)
    expected = direct(table, "subsurface_colour", np.array([1.0]), min(day, 29.99))[0]
    assert pixels.mean(axis=(0, 1)) == pytest.approx(expected, abs=0.01)


def test_profile_width_does_not_depend_on_the_unit_of_the_scene(table_path):
    obj = tan_object(table_path)
    for system, length, scale in (("METRIC", 1.0, 1.0), ("METRIC", 0.01, 100.0), ("NONE", 0.01, 1)):
        units = bpy.context.scene.unit_settings
        units.system, units.scale_length = system, length
        apply_timed(obj)
        value = of_role(obj, "radius")
        assert value.outputs[0].default_value == pytest.approx(0.013069 * scale, rel=1e-4)


def test_image_against_direct_simulation(table):
    """Bilinear sampling of the images at random places, for three schedules.

    Away from the steps of the response it is nearly exact; a step is spread over the texel that
    it falls into.
    """
    random = np.random.default_rng(1)
    for hours, doses in (([0], [30.0]), ([0, 24, 48, 72], [8.0] * 4), ([0, 130], [12.0, 20.0])):
        image = tan(
            table,
            joined([of_sed(hour, dose) for hour, dose in zip(hours, doses, strict=True)]),
            mmd=4.9,
            med=2.9,
            first_day=0.0,
            last_day=30.0,
        )
        history = simulate(
            Exposures(hours=np.array(hours), doses=(share := random.random(1000))[:, None] * doses),
            PIGMENTATIONS["intermediate"],
            mmd=4.9,
            med=2.9,
            hours=720,
        )
        hour = random.integers(0, 720, share.size)
        states = history.states[np.arange(share.size), hour]
        for plane, values in (
            ("subsurface_colour", image.colour),
            ("profile_width", image.profile_width),
        ):
            error = np.abs(bilinear(values, share, hour / 720.0) - table.plane(plane, states))
            assert error.mean() < 1e-4
            assert np.quantile(error, 0.95) < 5e-4
            assert error.max() < 0.006


def bilinear(values: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Sample (rows, columns, 3) at positions of 0 to 1 between first and last texel."""
    rows, columns, _ = values.shape
    low_x = np.minimum((x * (columns - 1)).astype(int), columns - 2)
    low_y = np.minimum((y * (rows - 1)).astype(int), rows - 2)
    fx, fy = (x * (columns - 1) - low_x)[:, None], (y * (rows - 1) - low_y)[:, None]
    lower = values[low_y, low_x] * (1 - fx) + values[low_y, low_x + 1] * fx
    upper = values[low_y + 1, low_x] * (1 - fx) + values[low_y + 1, low_x + 1] * fx
    return lower * (1 - fy) + upper * fy
