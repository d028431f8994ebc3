"""Relief and unevenness of a new skin: what they change, what not, and in which size."""

import resource

import bpy
import numpy as np
import pytest
from scenes import add_camera, apply, render, tan_group, tan_object, white_world

from blender_addon.scene import materials

USUAL = dict(materials.NEW_SKIN)


@pytest.fixture
def usual_skin(empty_scene, monkeypatch):
    monkeypatch.setattr(materials, "NEW_SKIN", USUAL)


def detail_of(obj):
    (node,) = (
        node
        for node in obj.material_slots[0].material.node_tree.nodes
        if node.get("skin_tan_detail")
    )
    return node


def test_a_new_material_brings_relief_and_blotches_and_is_dry(usual_skin, table_path):
    obj = tan_object(table_path)
    apply(obj)
    node = detail_of(obj)
    assert (node.inputs["Relief"].default_value, node.inputs["Variation"].default_value) == (1, 1)
    (skin,) = (link.to_node for link in node.outputs["Normal"].links)
    assert skin.node_tree == tan_group(obj)
    assert skin.inputs["Oil"].default_value == 0.0


@pytest.mark.parametrize(("unit", "scale"), [(1.0, 1.0), (0.01, 1.0), (1.0, 17.0), (0.01, 100.0)])
def test_its_size_is_physical(table_path, unit, scale):
    bpy.context.scene.unit_settings.scale_length = unit
    obj = tan_object(table_path)
    obj.scale = (scale, scale, scale)
    bpy.context.view_layer.update()
    apply(obj)
    node = detail_of(obj)
    assert node.inputs["Size"].default_value[0] == pytest.approx(1000.0 * unit * scale, rel=1e-5)
    assert node.inputs["Millimetre"].default_value == pytest.approx(0.001 / unit, rel=1e-5)
    apply(obj)  # again, with another scale
    obj.scale = (1.0, 1.0, 1.0)
    bpy.context.view_layer.update()
    apply(obj)
    assert node.inputs["Size"].default_value[0] == pytest.approx(1000.0 * unit, rel=1e-5)


def seen(tmp_path, samples=64) -> np.ndarray:
    """The middle of a square under white light, (pixels, 3)."""
    return render(tmp_path / "seen.exr", width=32, height=32, samples=samples).reshape(-1, 3)


@pytest.fixture
def square(usual_skin, table_path):
    """A tanned square of 1 cm, seen whole."""
    obj = tan_object(table_path)
    obj.scale = (0.01, 0.01, 0.01)
    bpy.context.view_layer.update()
    apply(obj)
    add_camera((0.005, 0.005, 1.0), 0.006)
    white_world()
    return obj


def set_sliders(obj, relief: float, variation: float, oil: float) -> None:
    node = detail_of(obj)
    node.inputs["Relief"].default_value = relief
    node.inputs["Variation"].default_value = variation
    (skin,) = (link.to_node for link in node.outputs["Normal"].links)
    skin.inputs["Oil"].default_value = oil


def test_with_all_sliders_at_0_it_is_the_even_skin(square, tmp_path):
    set_sliders(square, 0.0, 0.0, 0.0)
    even = seen(tmp_path)
    tree = square.material_slots[0].material.node_tree
    tree.nodes.remove(detail_of(square))
    np.testing.assert_allclose(seen(tmp_path).mean(axis=0), even.mean(axis=0), atol=1e-4)


def test_relief_shows_under_a_lamp_and_hardly_changes_the_mean(square, tmp_path):
    bpy.context.scene.world = None
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.rotation_euler = (1.2, 0.0, 0.0)
    bpy.context.collection.objects.link(sun)
    set_sliders(square, 0.0, 0.0, 0.0)
    even = seen(tmp_path)
    set_sliders(square, 1.0, 0.0, 0.0)
    rough = seen(tmp_path)
    # Even skin has the noise of light that scatters, most in red.
    assert np.all(rough.std(axis=0) > 1.5 * even.std(axis=0))
    np.testing.assert_allclose(rough.mean(axis=0), even.mean(axis=0), rtol=0.15)


def test_variation_is_melanin_and_blood_about_those_of_the_skin(square, tmp_path):
    """The red channel is the melanin's factor, the green one the blood's."""
    square.scale = (1.0, 1.0, 1.0)
    bpy.context.view_layer.update()
    apply(square)
    bpy.context.scene.camera.data.ortho_scale = 0.6
    bpy.context.scene.camera.location = (0.5, 0.5, 1.0)
    node = detail_of(square)
    tree = square.material_slots[0].material.node_tree
    emission = tree.nodes.new("ShaderNodeEmission")
    both = tree.nodes.new("ShaderNodeCombineXYZ")
    for number, name in enumerate(("Melanin", "Blood")):
        tree.links.new(node.outputs[name], both.inputs[number])
    tree.links.new(both.outputs[0], emission.inputs["Color"])
    tree.links.new(emission.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    factors = seen(tmp_path, samples=1)[:, :2]
    assert np.all(abs(np.log(factors.mean(axis=0))) < 0.1)
    assert np.all(factors.std(axis=0) > 0.02)
    node.inputs["Variation"].default_value = 0.0
    np.testing.assert_allclose(seen(tmp_path, samples=1)[:, :2], 1.0, atol=1e-6)


def test_one_group_serves_all_objects(table_path):
    first, second = tan_object(table_path), tan_object(table_path)
    apply(first)
    apply(second)
    assert detail_of(first).node_tree == detail_of(second).node_tree
    assert first.skin_tan.material != second.skin_tan.material


@pytest.mark.slow
def test_it_takes_at_most_twice_the_time_of_even_skin(square, tmp_path):
    """Medians of five renders in turn, of processor time, as a new material comes."""
    rows = []
    for _ in range(5):
        row = []
        for amount in (0.0, 1.0):
            set_sliders(square, amount, amount, oil=0.0)
            tree = square.material_slots[0].material.node_tree
            if amount == 0.0:
                links = [
                    (end, link.to_socket) for end in detail_of(square).outputs for link in end.links
                ]
                for _, end in links:
                    tree.links.remove(end.links[0])
            start = sum(resource.getrusage(resource.RUSAGE_SELF)[:2])
            render(tmp_path / "timed.exr", width=160, height=160, samples=64)
            row.append(sum(resource.getrusage(resource.RUSAGE_SELF)[:2]) - start)
            if amount == 0.0:
                for link in links:
                    tree.links.new(*link)
        rows.append(row)
    even, detailed = np.median(rows, axis=0)
    assert detailed < 2.0 * even
