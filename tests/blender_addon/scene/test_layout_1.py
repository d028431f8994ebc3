"""A file by the add-on's second plan, whose images held colour and width over share and day.

`data/layout_1.blend` was saved in Blender 5.0: Body of type III, masked, and Twin without a mask.
On Body an artist linked a value into Roughness and set Specular, let Colour and Profile Width shine
as a glow mixed with Surface, mixed freckles with the colour inside the group, and gave it a coat.
"""

from pathlib import Path

import bpy
import numpy as np
import pytest
from scenes import add_camera, apply, look, of_role, render, white_world

from blender_addon.scene import plan
from blender_addon.scene.nodes import find_input, role_of
from hylios.lab.colour import difference

FILE = Path(__file__).parents[1] / "data" / "layout_1.blend"


@pytest.fixture
def body():
    bpy.ops.wm.open_mainfile(filepath=str(FILE))
    return bpy.data.objects["Body"]


def tree(obj):
    return obj.material_slots[0].material.node_tree


def group_node(obj):
    return next(node for node in tree(obj).nodes if node.bl_idname == "ShaderNodeGroup")


def labelled(nodes, label: str):
    (node,) = (node for node in nodes if node.label == label)
    return node


def colours(obj, folder) -> np.ndarray:
    emission = tree(obj).nodes.new("ShaderNodeEmission")
    output = tree(obj).nodes["Material Output"].inputs["Surface"]
    former = output.links[0].from_socket
    tree(obj).links.new(group_node(obj).outputs["Colour"], emission.inputs["Color"])
    tree(obj).links.new(emission.outputs["Emission"], output)
    squares = len(obj.data.polygons)
    add_camera((squares / 2, 0.5 + obj.location.y, 5.0), float(squares))
    seen = render(folder / "row.exr", width=3 * squares, height=3)[1, 1::3]
    tree(obj).links.new(former, output)
    tree(obj).nodes.remove(emission)
    return seen


@pytest.mark.parametrize("name", ["Body", "Twin"])
def test_it_shows_what_it_did_after_apply(body, tmp_path, name):
    obj = bpy.data.objects[name]
    for frame in (1, 250):
        bpy.context.scene.frame_set(frame)
        before = colours(obj, tmp_path)
        assert apply(obj) == {"FINISHED"}
        assert difference(colours(obj, tmp_path), before).max() < 0.3
        bpy.ops.wm.open_mainfile(filepath=str(FILE))
        obj = bpy.data.objects[name]


def test_what_the_artist_did_is_kept(body):
    group, skin = body.skin_tan.group, of_role(body, "skin")
    assert apply(body) == {"FINISHED"}
    assert body.skin_tan.group == group and group[plan.LAYOUT_KEY] == plan.LAYOUT
    node, nodes = group_node(body), tree(body).nodes
    assert node.inputs["Roughness"].links[0].from_node == labelled(nodes, "My roughness")
    assert node.inputs["Specular"].default_value == pytest.approx(0.4)
    assert node.outputs["Colour"].links[0].to_node == labelled(nodes, "Glow")
    assert node.outputs["Far Width"].links[0].to_node == labelled(nodes, "Width")
    assert node.outputs["Surface"].links[0].to_node == labelled(nodes, "Mine")
    assert [node.inputs[name].default_value for name in ("Melanin", "Blood")] == [1.0, 1.0]
    freckles = labelled(group.nodes, "Freckles")
    assert find_input(freckles, "A_Color").links[0].from_node == of_role(body, "mixed_colour")
    assert of_role(body, "base").inputs[0].links[0].from_node == freckles
    for shader in (skin, of_role(body, "near_skin")):
        assert find_input(shader, "Coat Weight").default_value == pytest.approx(0.2)
        assert find_input(shader, "IOR").default_value == pytest.approx(1.5526)
    # a coat lies over near light too, which a diffuse shader can't have
    assert of_role(body, "two_lobes").inputs[1].default_value == -1.0
    assert {role_of(node) for node in group.nodes} == {*plan.ROLES, None}


def test_a_shader_as_it_was_made_has_one_gloss_without_oil(body):
    twin = bpy.data.objects["Twin"]
    apply(twin)
    assert of_role(twin, "two_lobes").inputs[1].default_value == 0.0


def test_roughness_becomes_the_skin_s_where_nobody_set_it(body):
    twin = bpy.data.objects["Twin"]
    assert group_node(twin).inputs["Roughness"].default_value == pytest.approx(0.45)
    apply(twin)
    assert group_node(twin).inputs["Roughness"].default_value == pytest.approx(0.1**0.5)
    group_node(twin).inputs["Roughness"].default_value = 0.2
    apply(twin)
    assert group_node(twin).inputs["Roughness"].default_value == pytest.approx(0.2)


def test_former_images_go_and_the_neighbour_s_stay(body):
    twin, count = bpy.data.objects["Twin"], len(bpy.data.images)
    before = look(twin)
    former = {of_role(body, role).image.name for role in ("colour", "width")}
    apply(body)
    assert look(twin) == before
    assert not former & {image.name for image in bpy.data.images}
    apply(twin)
    assert len({image.name for image in bpy.data.images}) < 2 * count + 5
    assert of_role(twin, "colour").image == of_role(body, "colour").image


def test_a_shader_of_the_artist_s_own_is_left_alone(body, capfd):
    twin = bpy.data.objects["Twin"]
    group = twin.skin_tan.group
    own = group.nodes.new("ShaderNodeBsdfDiffuse")
    group.links.new(of_role(twin, "colour").outputs["Color"], own.inputs["Color"])
    group.links.new(own.outputs["BSDF"], of_role(twin, "output").inputs["Surface"])
    group.nodes.remove(of_role(twin, "skin"))
    apply(twin)
    assert own.inputs["Color"].links[0].from_node == of_role(twin, "mixed_colour")
    assert of_role(twin, "output").inputs["Surface"].links[0].from_node == own
    assert not {role_of(node) for node in group.nodes} & plan.SHADERS
    assert "subsurface scattering is left to the shader in its place" in capfd.readouterr().out


def test_it_renders_under_light_before_and_after(body, tmp_path):
    """About as bright: gloss and near light are new."""
    white_world()
    add_camera((1.5, 3.5, 5.0), 1.0)
    twin = bpy.data.objects["Twin"]
    twin.location.x = 1.0
    before = render(tmp_path / "lit.exr", width=8, height=8, samples=16).mean(axis=(0, 1))
    apply(twin)
    after = render(tmp_path / "lit.exr", width=8, height=8, samples=16).mean(axis=(0, 1))
    assert after == pytest.approx(before, abs=0.04)
