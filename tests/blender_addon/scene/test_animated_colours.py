"""Painted colours with keys or drivers: they go on under the tan, and Remove Tan gives all back."""

import bpy
import numpy as np
import pytest
from artist_skins import grouped, plain, wear
from bpy_extras.anim_utils import action_get_channelbag_for_slot
from scenes import apply, tan_object
from state import state

from blender_addon.scene import animated, recolour

COLOURS = {1: (0.6, 0.42, 0.33, 1.0), 100: (0.1, 0.1, 0.8, 1.0)}


def body(table_path, materials):
    obj = tan_object(table_path, [1.0] * len(materials))
    wear(obj, materials)
    return obj


def colour_of(material):
    (shader,) = (node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    return shader.inputs["Base Color"]


def keyed(name: str):
    material = plain(name)
    end = colour_of(material)
    for frame, colour in COLOURS.items():
        end.default_value = colour
        end.keyframe_insert("default_value", frame=frame)
    return material


def driven(name: str):
    material = plain(name)
    for channel, curve in enumerate(colour_of(material).driver_add("default_value")):
        curve.driver.expression = f"frame / {200 + channel}"
    return material


def in_strips(name: str):
    """Two strips of one action, the second at half speed, which begins at frame 200."""
    material = keyed(name)
    animation = material.node_tree.animation_data
    strips = animation.nla_tracks.new().strips
    for start in (1, 200):
        strip = strips.new("colours", start, animation.action)
    strip.scale = 2.0
    animation.action = None
    return material


def painted(material) -> tuple:
    """What the tan multiplies."""
    (factor,) = recolour.inserted(material.node_tree, recolour.FACTOR)
    return tuple(factor.inputs[0].default_value)


def all_of_file() -> tuple:
    trees = [material.node_tree for material in bpy.data.materials]
    moved = [
        (
            tree.animation_data and animated.actions(tree.animation_data),
            sorted(curve.data_path for curve in curves_of(tree)),
        )
        for tree in trees
    ]
    return moved, state()


def curves_of(tree) -> list:
    animation = tree.animation_data
    if animation is None:
        return []
    curves = list(animation.drivers)
    strips = [strip for track in animation.nla_tracks for strip in track.strips]
    for source in (animation, *strips):
        if source.action:
            curves += action_get_channelbag_for_slot(source.action, source.action_slot).fcurves
    return curves


@pytest.mark.parametrize("make", [keyed, driven, in_strips])
def test_an_animated_colour_goes_on_and_comes_back(table_path, make, tmp_path, capfd):
    obj = body(table_path, [make("skin")])
    bpy.context.scene.frame_set(1)
    before = all_of_file()
    apply(obj)
    assert "Keys and drivers of a painted colour" in capfd.readouterr().out
    bpy.context.scene.frame_set(100)
    wanted = np.divide(100.0, (200, 201, 202)) if make is driven else COLOURS[100][:3]
    assert painted(bpy.data.materials["skin"]) == pytest.approx(wanted)
    if make is in_strips:
        bpy.context.scene.frame_set(398)
        assert painted(bpy.data.materials["skin"]) == pytest.approx(wanted)
    apply(obj)
    bpy.context.scene.frame_set(1)
    bpy.ops.skin_tan.remove()
    assert all_of_file() == before


@pytest.mark.parametrize("make", [keyed, driven, in_strips, plain])
def test_by_its_own_colour_skin_follows_one_that_is_linked_and_says_where_it_cannot(
    table_path, make, capfd
):
    obj = body(table_path, [make("skin")])
    obj.skin_tan.own_colour = True
    apply(obj)
    said = "A painted colour in 'skin' is animated" in capfd.readouterr().out
    assert said == (make is not plain)
    (tan,) = recolour.inserted(bpy.data.materials["skin"].node_tree, recolour.TAN)
    assert not tan.inputs[recolour.PAINTED_COLOUR].is_linked
    bpy.ops.skin_tan.remove()
    tree = bpy.data.materials["skin"].node_tree
    colour = tree.nodes.new("ShaderNodeRGB").outputs[0]
    tree.links.new(colour, colour_of(bpy.data.materials["skin"]))
    colour.keyframe_insert("default_value", frame=1)
    apply(obj)
    assert "is animated" not in capfd.readouterr().out
    (tan,) = recolour.inserted(tree, recolour.TAN)
    assert tan.inputs[recolour.PAINTED_COLOUR].links[0].from_socket == colour


def test_keys_go_on_in_a_saved_file(table_path, tmp_path):
    apply(body(table_path, [keyed("skin")]))
    path = str(tmp_path / "keyed.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path, use_scripts=False)
    for frame, colour in COLOURS.items():
        bpy.context.scene.frame_set(frame)
        assert painted(bpy.data.materials["skin"]) == pytest.approx(colour[:3])


@pytest.mark.parametrize("make", [keyed, in_strips])
def test_another_tree_with_the_action_keeps_its_own(table_path, make):
    """A material that others show is copied, and its action with it."""
    skin = make("skin")
    prop = body(table_path, [skin])
    prop.name = "Prop"
    obj = body(table_path, [skin])
    bpy.context.scene.frame_set(1)
    before = all_of_file()
    apply(obj)
    bpy.context.scene.frame_set(100)
    assert tuple(colour_of(skin).default_value) == pytest.approx(COLOURS[100])
    assert painted(obj.material_slots[0].material) == pytest.approx(COLOURS[100][:3])
    bpy.context.scene.frame_set(1)
    bpy.ops.skin_tan.remove()
    assert all_of_file() == before


@pytest.mark.parametrize(
    ("make", "order", "applied"),
    [
        (keyed, (0, 1), True),
        (keyed, (1, 0), True),
        (keyed, (1, 0), False),
        (in_strips, (0, 1), False),
        (in_strips, (1, 0), True),
    ],
)
def test_a_duplicate_and_its_original_both_go_back(table_path, make, order, applied):
    skin = make("skin")
    first = body(table_path, [skin])
    bpy.context.scene.frame_set(1)
    before, actions = state()["materials"], animated.actions(skin.node_tree.animation_data)
    paths = [curve.data_path for curve in curves_of(skin.node_tree)]
    apply(first)
    second = first.copy()
    bpy.context.collection.objects.link(second)
    if applied:
        second.skin_tan.exposures[0].dose = 8.0
        apply(second)
    bpy.context.scene.frame_set(100)
    bodies = first, second
    for obj in bodies:
        assert painted(obj.material_slots[0].material) == pytest.approx(COLOURS[100][:3])
    bpy.context.scene.frame_set(1)
    for index in order:
        bpy.context.view_layer.objects.active = bodies[index]
        bpy.ops.skin_tan.remove()
        bpy.context.scene.frame_set(1)
    assert state()["materials"] == before
    assert [obj.material_slots[0].material for obj in bodies] == [skin, skin]
    assert [curve.data_path for curve in curves_of(skin.node_tree)] == paths
    assert animated.actions(skin.node_tree.animation_data) == actions
    assert len(bpy.data.actions) == 1


@pytest.mark.provokes
def test_an_error_leaves_the_keys_where_they_were(table_path, monkeypatch):
    obj = body(table_path, [keyed("skin"), grouped("ears")])
    before = all_of_file()
    monkeypatch.setattr(recolour, "note_links", fail)
    with pytest.raises(RuntimeError):
        apply(obj)
    assert all_of_file() == before


def fail(*_):
    raise RuntimeError("stopped")
