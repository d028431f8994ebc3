"""Tan from Own Colour, rendered: painted places tan as skin of their own colour does."""

import bpy
import numpy as np
import pytest
from artist_skins import KINDS, add, empty_material, mixed, output_of, wear
from artist_skins import textured as with_texture
from scenes import add_camera, apply, of_role, pixels, tan_group, tan_object, white_world
from state import state
from synthetic import MED, MMD, UNTANNED_COLOUR, colour_of
from test_recolour import base_colours
from test_regions import add_region, told

from blender_addon import live
from blender_addon.model.own_colour import offsets
from blender_addon.model.tan import look_of
from blender_addon.scene import own_colour, recolour
from blender_addon.scene.exr import rounded
from hylios.errors import InputError
from hylios.tanning import PIGMENTATIONS, Exposures, simulate

DOSE, DAY = 7.0, 8
PAINTED = [(1.0, 1.0), (1.5, 1.0), (0.6, 1.0), (1.2, 3.0), (1.0, 6.0), (0.3, 2.0)]
"""Melanin and blood of the painted squares over those of the skin."""


def painted_material(name: str = "skin"):
    """It emits the attribute Paint, so that a render shows its numbers."""
    material = empty_material(name)
    tree = material.node_tree
    colours = add(tree, "ShaderNodeVertexColor", layer_name="Paint")
    light = add(tree, "ShaderNodeEmission")
    tree.links.new(colours.outputs["Color"], light.inputs["Color"])
    output_of(tree, light.outputs[0])
    return material


def painted_row(table_path, colours):
    """A square in the sun for each of some colours."""
    obj = tan_object(table_path, [1.0] * len(colours), dose=DOSE)
    obj.data.materials.append(painted_material())
    paint = obj.data.color_attributes.new("Paint", "FLOAT_COLOR", "POINT")
    values = np.concatenate([colours, np.ones((len(colours), 1))], axis=1)
    paint.data.foreach_set("color", np.repeat(values, 4, axis=0).ravel().astype(np.float32))
    settings = obj.skin_tan
    settings.own_colour, settings.usual_colour = True, UNTANNED_COLOUR
    settings.first_frame, settings.last_frame = 0, 30
    add_camera((len(colours) / 2, 0.5, 5.0), len(colours))
    white_world()
    return obj


def own_skin(tan: bool) -> np.ndarray:
    """Colours of the painted squares' skin by the table, before the sun or on the day."""
    steady = PIGMENTATIONS["intermediate"].steady_state()
    lit = np.append(steady / steady.sum(), 1.0)
    if tan:
        exposures = Exposures(hours=np.array([0]), doses=np.array([[DOSE]]))
        history = simulate(
            exposures, PIGMENTATIONS["intermediate"], mmd=MMD, med=MED, hours=24 * 30
        )
        lit = history.states[0, 24 * DAY]
    states = [[own * lit[:3].sum(), 0.0, 0.0, lit[3], blood] for own, blood in PAINTED]
    return colour_of(np.array(states))


@pytest.fixture
def row(table_path):
    return painted_row(table_path, own_skin(tan=False))


def shown(folder, day: int, count: int = len(PAINTED)) -> np.ndarray:
    bpy.context.scene.frame_set(day)
    return base_colours(folder, count)


def test_painted_places_tan_as_skin_of_their_own_colour(tmp_path, row):
    """By the synthetic table's own numbers; without the sun they are as painted."""
    assert apply(row) == {"FINISHED"}
    before, after = own_skin(tan=False), own_skin(tan=True)
    assert shown(tmp_path, 0) == pytest.approx(before, abs=1e-5)
    assert shown(tmp_path, DAY) == pytest.approx(after, abs=0.004)
    row.skin_tan.own_colour = False
    apply(row)
    alike = shown(tmp_path, DAY)
    assert alike / before == pytest.approx(np.tile(alike[0] / before[0], (len(before), 1)))
    unlike = [melanin != 1.0 for melanin, _ in PAINTED]
    assert np.abs(alike - after)[unlike].max(axis=1).min() > 0.01


def test_its_share_goes_from_all_skin_s_tan_to_that_of_its_own(tmp_path, row):
    """Halfway it is that of half the difference in logarithms of melanin and blood."""
    apply(row)
    (tan,) = recolour.inserted(row.data.materials[0].node_tree, recolour.TAN)
    tan.inputs["Own Colour"].default_value = 0.5
    halfway = shown(tmp_path, DAY)
    apply(row)
    assert tan.inputs["Own Colour"].default_value == 0.5
    tan.inputs["Own Colour"].default_value = 0.0
    alike = shown(tmp_path, DAY)
    row.skin_tan.own_colour = False
    apply(row)
    assert alike == pytest.approx(shown(tmp_path, DAY), abs=1e-6)
    assert np.abs(halfway - alike)[1].max() > 0.005


def test_colours_of_no_skin_stay_within_the_tan_of_some_skin(tmp_path, table_path):
    odd = "0 0 0  .9 .9 .9  .02 .6 .1  .7 .01 0  .1 .1 .9"
    colours = np.array(odd.split(), float).reshape(-1, 3)
    row = painted_row(table_path, colours)
    apply(row)
    assert shown(tmp_path, 0, len(colours)) == pytest.approx(colours, abs=1e-5)
    tanned = shown(tmp_path, DAY, len(colours))
    assert np.isfinite(tanned).all()
    assert (tanned <= colours + 1e-5).all()
    assert (tanned >= 0.3 * colours - 1e-5).all()


def test_regions_and_own_colour_come_and_go_in_any_order(tmp_path, row):
    """Where both are, the untanned skin is as painted, and what goes leaves nothing."""
    settings = row.skin_tan
    settings.own_colour = False
    apply(row)
    plain = state()
    settings.own_colour = True
    apply(row)
    own = state()
    region = add_region(row, "freckles", np.ones(len(PAINTED)))
    apply(row)
    assert shown(tmp_path, 0) == pytest.approx(own_skin(tan=False), abs=1e-5)
    assert shown(tmp_path, DAY)[0].max() < own_skin(tan=True)[0].max() - 0.01
    region.enabled = False
    apply(row)
    bpy.context.scene.frame_set(0)
    assert nodes_of(state()) == nodes_of(own)
    region.enabled, settings.own_colour = True, False
    apply(row)
    assert not own_colour.is_shown(tan_group(row))
    region.enabled = False
    apply(row)
    assert nodes_of(state()) == nodes_of(plain)


def nodes_of(everything: dict) -> dict:
    groups = told(everything)["groups"]
    return {name: (nodes, links, keys) for name, (nodes, links, _, keys) in groups.items()}


def test_off_leaves_nothing(table_path):
    """In materials of all kinds, and after a second Apply too."""
    obj = tan_object(table_path, [1.0] * len(KINDS))
    wear(obj, [make(f"skin {make.__name__}") for make in KINDS])
    apply(obj)
    before = told(state())
    obj.skin_tan.own_colour = True
    apply(obj)
    apply(obj)
    assert told(state()) != before
    obj.skin_tan.own_colour = False
    apply(obj)
    after = told(state())
    for part in before.keys() - {"groups", "materials"}:
        assert after[part] == before[part], part
    assert nodes_of(after) == nodes_of(before)
    for name, (tree, keys) in before["materials"].items():
        nodes, links, _, tree_keys = tree
        now, now_links, _, now_keys = after["materials"][name][0]
        assert (now, sorted(now_links), now_keys) == (nodes, sorted(links), tree_keys)
        assert after["materials"][name][1] == keys


def test_remove_tan_gives_all_back_exactly(table_path):
    obj = tan_object(table_path, [1.0] * len(KINDS))
    wear(obj, [make(f"skin {make.__name__}") for make in KINDS])
    before = state()
    obj.skin_tan.own_colour = True
    apply(obj)
    apply(obj)
    assert state() != before
    bpy.ops.skin_tan.remove()
    assert state() == before


def test_every_painted_colour_is_told_to_a_node_of_its_own(table_path):
    obj = tan_object(table_path)
    wear(obj, [mixed("skin")])
    apply(obj)
    tree = obj.data.materials[0].node_tree
    assert len(recolour.inserted(tree, recolour.TAN)) == 1
    obj.skin_tan.own_colour = True
    apply(obj)
    factors = recolour.inserted(tree, recolour.FACTOR)
    tans = [factor.inputs[1].links[0].from_node for factor in factors]
    assert len(set(tans)) == len(factors) == 2
    for factor, tan in zip(factors, tans, strict=True):
        told_by, given = tan.inputs["Painted Colour"], factor.inputs[0]
        assert told_by.is_linked == given.is_linked
        if given.is_linked:
            assert told_by.links[0].from_socket == given.links[0].from_socket
        else:
            assert told_by.default_value[:3] == pytest.approx(given.default_value[:])
        assert tan.inputs["Own Colour"].default_value == 1.0
    tans[1].inputs["Own Colour"].default_value = 0.25
    apply(obj)
    assert recolour.inserted(tree, recolour.TAN) == sorted(tans, key=list(tree.nodes).index)
    assert tans[1].inputs["Own Colour"].default_value == 0.25


def test_the_usual_colour_is_that_of_the_painted_skin_until_it_is_set(table_path, capfd):
    paint = np.array([[[0.42, 0.23, 0.16]] * 3 + [[0.2, 0.08, 0.04]]], np.float32)
    obj = tan_object(table_path)
    wear(obj, [with_texture("skin", colours=paint)])
    settings = obj.skin_tan
    settings.own_colour = True
    apply(obj)
    assert settings.usual_colour[:] == pytest.approx((0.42, 0.23, 0.16), abs=1e-3)
    settings.usual_colour = (0.5, 0.3, 0.2)
    apply(obj)
    assert settings.usual_colour[:] == pytest.approx((0.5, 0.3, 0.2))
    assert of_role(obj, "own_red").inputs[1].default_value[:] == pytest.approx(
        (2.0, 0, 0), abs=1e-5
    )
    assert "No painted colour" not in capfd.readouterr().out
    obj.data.materials[0] = painted_material("green")
    settings.usual_colour = (0.0, 0.0, 0.0)
    apply(obj)
    assert "No painted colour of skin was found" in capfd.readouterr().out
    assert settings.usual_colour[:] == pytest.approx(UNTANNED_COLOUR, abs=1e-3)


def test_a_new_material_and_one_of_ours_have_no_nodes_for_it(table_path):
    for materials, replacing in (([], False), ([with_texture("skin")], True)):
        obj = tan_object(table_path)
        wear(obj, materials)
        obj.skin_tan.own_colour, obj.skin_tan.new_material = True, replacing
        apply(obj)
        assert not own_colour.is_shown(tan_group(obj))
        assert "Painted Colour" not in {item.name for item in tan_group(obj).interface.items_tree}


def test_objects_of_one_skin_share_the_image_and_a_copy_keeps_it(table_path):
    objects = [tan_object(table_path) for _ in range(2)]
    for obj in objects:
        wear(obj, [with_texture("skin")])
        obj.skin_tan.own_colour = True
        apply(obj)
    copy = objects[0].copy()
    bpy.context.collection.objects.link(copy)
    apply(copy)
    images = {of_role(obj, "own_image").image for obj in (*objects, copy)}
    assert len(images) == 1
    copy.skin_tan.own_colour = False
    apply(copy)
    assert of_role(objects[0], "own_image").image in images
    for obj in objects:
        apply(obj)
        bpy.ops.skin_tan.remove()
    assert not [image for image in bpy.data.images if "Own Colour" in image.name]


def test_a_dragged_biology_shows_in_it(table_path):
    obj = tan_object(table_path)
    wear(obj, [with_texture("skin")])
    obj.skin_tan.skin, obj.skin_tan.own_colour = "III", True
    apply(obj)
    image = of_role(obj, "own_image").image
    obj.skin_tan.biology.melanin = 1.5
    live.show_changes()
    assert of_role(obj, "own_image").image == image
    wanted = rounded(offsets(look_of(obj.skin_tan.values(), rough=True)))
    assert np.array_equal(pixels(image)[..., :3], wanted)
    live.make_exact()
    wanted = rounded(offsets(look_of(obj.skin_tan.values())))
    assert np.array_equal(pixels(of_role(obj, "own_image").image)[..., :3], wanted)


def test_an_error_leaves_all_as_it_was(row, monkeypatch):
    from blender_addon.scene import images

    row.skin_tan.own_colour = False
    apply(row)
    row.skin_tan.own_colour, row.skin_tan.usual_colour = True, (0.0, 0.0, 0.0)
    before = told(state())

    def fail(*_):
        raise InputError("no.")

    with monkeypatch.context() as patched:
        patched.setattr(images, "replace", fail)
        with pytest.raises(RuntimeError):
            apply(row)
    assert told(state()) == before
    assert row.skin_tan.usual_colour[:] == (0.0, 0.0, 0.0)
    apply(row)
    before = told(state())
    row.skin_tan.own_colour = False
    monkeypatch.setattr(images, "replace", fail)
    with pytest.raises(RuntimeError):
        apply(row)
    assert told(state()) == before
