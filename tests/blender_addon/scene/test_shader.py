"""What the shader shows, rendered: the table's numbers at every share and day."""

from dataclasses import replace
from functools import partial

import bpy
import numpy as np
import pytest
from scenes import add_camera, of_role, render, tan_group, tan_object, white_world
from synthetic import ROUGHNESS, UNTANNED_COLOUR

from blender_addon.model.catalogue import shipped_path
from blender_addon.scene import layout_2
from blender_addon.scene.changes import Changes
from hylios.adding import spectrum
from hylios.lab.colour import difference
from hylios.quadrature import MOST, skin_quadrature
from hylios.skin.phototypes import phototype
from hylios.table import melanin_dynamics, minimal_doses, read_table
from hylios.tanning import PIGMENTATIONS, Exposures, simulate, states_at

FIRST_DAY, LAST_DAY, FIRST_FRAME, LAST_FRAME = 2.0, 20.0, 10, 190
DAYS_PER_FRAME = (LAST_DAY - FIRST_DAY) / (LAST_FRAME - FIRST_FRAME)
SHARES = np.array([-0.5, 0.0, 0.05, 0.11, 0.3, 0.5, 0.613, 0.8, 0.997, 1.0, 1.7])


def skin_material():
    return bpy.data.materials["Skin Tan Body"]


def skin_node():
    (node,) = (n for n in skin_material().node_tree.nodes if "Surface" in n.outputs)
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
    """A plane of the table at shares of 30 SED on day 0."""
    return table.plane(plane, simulated(table, shares, day))


def simulated(table, shares: np.ndarray, day: float) -> np.ndarray:
    """States (N, 4) at shares of 30 SED on day 0, simulated for each of them."""
    history = simulate(
        Exposures(hours=np.array([0]), doses=shares[:, None] * 30.0),
        PIGMENTATIONS["intermediate"],
        mmd=table.provenance["mmd_sed"],
        med=table.provenance["med_sed"],
        hours=24 * 30,
    )
    low = int(24.0 * day)
    fraction = 24.0 * day - low
    return history.states[:, low] * (1.0 - fraction) + history.states[:, low + 1] * fraction


@pytest.mark.parametrize(
    ("frame", "subframe"),
    [(1, 0.0), (10, 0.0), (47, 0.0), (82, 0.35), (190, 0.0), (250, 0.0)],
)
def test_emission_equals_the_table(tmp_path, table, table_path, frame, subframe):
    """At a share and a day, the table's numbers of the state that a simulation leads to."""
    obj = tan_object(table_path, SHARES)
    apply_timed(obj)
    add_camera((len(SHARES) / 2, 0.5, 5.0), len(SHARES))
    bpy.context.scene.frame_set(frame, subframe=subframe)
    day = np.clip(
        FIRST_DAY + (frame + subframe - FIRST_FRAME) * DAYS_PER_FRAME, FIRST_DAY, LAST_DAY
    )
    expected = partial(direct, table, shares=SHARES.clip(0.0, 1.0), day=day)
    show_emission_of("Colour")
    error = difference(rendered_squares(tmp_path, len(SHARES)), expected("subsurface_colour"))
    assert error.mean() < 0.05
    assert error.max() < 0.2
    show_emission_of("Ratio")
    ratio = expected("subsurface_colour") / UNTANNED_COLOUR
    assert rendered_squares(tmp_path, len(SHARES)) == pytest.approx(ratio, rel=0.005)
    for output, plane, close in (
        ("Far Width", "far_width", 0.09),
        ("Near Share", "near_share", 1e-3),
    ):
        show_emission_of(output)
        assert rendered_squares(tmp_path, len(SHARES)) == pytest.approx(expected(plane), rel=close)
    show_emission_of("Share")
    assert rendered_squares(tmp_path, len(SHARES))[:, 0] == pytest.approx(SHARES.clip(0.0, 1.0))


def test_the_ratio_of_untanned_skin_is_1(tmp_path, table_path):
    obj = tan_object(table_path)
    obj.skin_tan.exposures[0].enabled = False
    apply_timed(obj)
    add_camera((0.5, 0.5, 5.0), 1.0)
    show_emission_of("Ratio")
    assert rendered_squares(tmp_path, 1)[0] == pytest.approx(np.ones(3), abs=1e-5)


@pytest.mark.parametrize(("name", "place"), [("Melanin", slice(0, 3)), ("Blood", slice(4, 5))])
@pytest.mark.parametrize("factor", [0.2, 2.5])
def test_more_melanin_or_blood_is_a_state_with_more(
    tmp_path, table, table_path, name, place, factor
):
    """Exactly: a freckle is skin with 2.5 times the melanin. Less blood than the skin has is not
    in the table."""
    obj = tan_object(table_path, SHARES)
    apply_timed(obj)
    add_camera((len(SHARES) / 2, 0.5, 5.0), len(SHARES))
    (detail,) = (node for node in skin_material().node_tree.nodes if "Relief" in node.inputs)
    detail.inputs[name].default_value = factor
    bpy.context.scene.frame_set(100)
    day = FIRST_DAY + (100 - FIRST_FRAME) * DAYS_PER_FRAME
    states = simulated(table, SHARES.clip(0.0, 1.0), day)
    states = np.concatenate([states, np.ones((len(states), 1))], axis=1)
    states[:, place] *= factor
    show_emission_of("Colour")
    expected = table.plane("subsurface_colour", states)
    error = difference(rendered_squares(tmp_path, len(SHARES)), expected)
    assert error.mean() < 0.05
    assert error.max() < 0.2


def test_without_a_mask_the_whole_body_gets_the_full_dose(tmp_path, table, table_path):
    apply_timed(tan_object(table_path))
    add_camera((0.5, 0.5, 5.0), 1.0)
    show_emission_of("Colour")
    bpy.context.scene.frame_set(LAST_FRAME)
    expected = direct(table, "subsurface_colour", np.array([1.0]), LAST_DAY)
    assert rendered_squares(tmp_path, 1) == pytest.approx(expected, abs=1e-3)


def test_without_exposures_the_skin_stays_as_it_was(tmp_path, table_path):
    obj = tan_object(table_path)
    obj.skin_tan.exposures[0].enabled = False
    apply_timed(obj)
    add_camera((0.5, 0.5, 5.0), 1.0)
    show_emission_of("Colour")
    bpy.context.scene.frame_set(LAST_FRAME)
    assert rendered_squares(tmp_path, 1)[0] == pytest.approx(UNTANNED_COLOUR, abs=1e-3)


def gloss(angles: list[float], roughness: float) -> np.ndarray:
    """Colours (A, 3) of what the light model's surface reflects."""
    skin = phototype("III").skin
    of = replace(skin.at(skin.untanned_state), surface_fold_aspect_ratio=roughness**2)
    visible = skin_quadrature(MOST)
    return spectrum(of, visible.wavelengths, angle=angles).surface @ visible.weights.T


def lit(angle: float, folder, samples: int = 256) -> np.ndarray:
    """Mean colour of a large flat square under white light, seen at an angle."""
    turn = np.radians(angle)
    camera = bpy.context.scene.camera
    camera.location = (0.5, 0.5 - 5.0 * np.sin(turn), 5.0 * np.cos(turn))
    camera.rotation_euler = (turn, 0.0, 0.0)
    return render(folder / "lit.exr", width=16, height=16, samples=samples).mean(axis=(0, 1))


@pytest.mark.parametrize("day", [0.0, 9.0])
def test_albedo_under_white_light(tmp_path, table, table_path, day):
    """Whole: the table's subsurface colour at the angle, and over it the gloss of the model, whose
    facets cast no shadow on each other."""
    tan_object(table_path)
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    white_world()
    add_camera((0.5, 0.5, 5.0), 0.2)
    frames_per_day = 249 / 30
    bpy.context.scene.frame_set(1 + int(day * frames_per_day), subframe=day * frames_per_day % 1.0)
    cases = {0.0: ("", 0.12), 45.0: ("_45", 0.25), 70.0: ("_70", 0.4)}
    over = gloss(list(cases), ROUGHNESS)
    for (angle, (plane, most)), reflected in zip(cases.items(), over, strict=True):
        inside = direct(table, f"subsurface_colour{plane}", np.array([1.0]), min(day, 29.99))[0]
        assert difference(lit(angle, tmp_path), inside + reflected) < most


@pytest.mark.parametrize("name", ["III", "VI"])
@pytest.mark.parametrize("day", [0.0, 10.0])
def test_shipped_skin_under_white_light(tmp_path, name, day):
    """Gloss and all: the table's total colour at 0 and 45 degrees."""
    table = read_table(shipped_path(name))
    if "total_colour_45" not in table.planes:
        pytest.skip("a table of format 3 has no such colour")
    obj = tan_object(shipped_path(name), dose=45.0)
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    white_world()
    add_camera((0.5, 0.5, 5.0), 0.2)
    frame = 1.0 + day * 249 / 30
    bpy.context.scene.frame_set(int(frame), subframe=frame % 1.0)
    minimal = minimal_doses(table.provenance)
    states = states_at(
        Exposures([0], [45.0]),
        melanin_dynamics(table.provenance),
        times=[24.0 * obj["tan_day"]],
        mmd=minimal.mmd,
        med=minimal.med,
    )
    for angle, plane, most in ((0.0, "total_colour", 0.25), (45.0, "total_colour_45", 0.4)):
        error = difference(lit(angle, tmp_path), table.plane(plane, states)[0])
        assert error < most


def test_profile_width_does_not_depend_on_the_unit_of_the_scene(table_path):
    obj = tan_object(table_path)
    for system, length, scale in (("METRIC", 1.0, 1.0), ("METRIC", 0.01, 100.0), ("NONE", 0.01, 1)):
        units = bpy.context.scene.unit_settings
        units.system, units.scale_length = system, length
        apply_timed(obj)
        value = of_role(obj, "radius")
        assert value.outputs[0].default_value == pytest.approx(0.013069 * scale, rel=1e-4)


def test_one_gloss_and_two_show_the_same_light(tmp_path, table_path):
    """With so little oil that both lobes are as wide as one, which has a diffuse shader beside it:
    from everywhere and from a lamp, straight on and aslant."""
    tan_object(table_path)
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    tree = skin_material().node_tree
    tree.nodes.remove(next(node for node in tree.nodes if "Relief" in node.inputs))
    white_world()
    bpy.ops.object.light_add(type="SUN", rotation=(0.9, 0.0, 0.0))
    add_camera((0.5, 0.5, 5.0), 0.2)
    for angle in (8.0, 45.0, 70.0):
        seen = []
        for oil in (0.0, 1e-6):
            skin_node().inputs["Oil"].default_value = oil
            # With 256 samples noise alone is up to .1 in Blender 5.2.
            seen.append(lit(angle, tmp_path, samples=1024))
        assert difference(*seen) < 0.06


def test_the_share_of_thick_skin_bulges_in_a_group_of_an_earlier_version_too():
    """Which had one node for it. Type VI, whose colour changes most in skin a little thicker."""
    obj = tan_object(shipped_path("VI"))
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    former = of_role(obj, "thickness_slope")
    slope, start = (former.inputs[number].default_value for number in (1, 2))
    tan_group(obj).nodes.remove(former)
    with Changes() as changes:
        layout_2.complete_thickness(tan_group(obj), changes)
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    node, end = of_role(obj, "thickness_slope"), of_role(obj, "thickness")
    assert end.inputs[1].links[0].from_node == node
    assert node.inputs[0].links[0].from_socket == end.inputs[0].links[0].from_socket
    assert [node.inputs[number].default_value for number in (1, 2)] == [slope, start]
    thick = float(read_table(shipped_path("VI")).axes.knots[1][-1])
    share = [v * (v * slope + start) + end.inputs[2].default_value for v in (0.0, thick / 2, thick)]
    assert share == pytest.approx([0.0, 0.7, 1.0], abs=0.01)
