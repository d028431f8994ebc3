"""A file by the first version of the add-on, which found its data-blocks by name.

`data/first_version.blend` was saved by it in Blender 4.5: an object Body of type III, masked, and
an object Twin of type VI with the same mesh. Roughness was set to 0.3 on Body's material, and a
node called Freckles put into its group.
"""

from pathlib import Path

import bpy
import numpy as np
import pytest
from scenes import add_camera, apply, look, of_role, render

from blender_addon.model import catalogue
from hylios.lab.colour import difference

FILE = Path(__file__).parents[1] / "data" / "first_version.blend"
FRAMES = (1, 250)
TYPES = {"Body": "III", "Twin": "VI"}
COLOURS = {
    "Body": (
        [[0.37254, 0.23302, 0.13770]] * 3,
        [[0.37254, 0.23302, 0.13770], [0.35941, 0.21629, 0.12452], [0.35608, 0.21259, 0.12133]],
    ),
    "Twin": ([[0.13141, 0.04884, 0.01473]] * 3, [[0.11891, 0.04407, 0.01329]] * 3),
}
"""What the first version rendered at the shares 0, .5 and 1."""


@pytest.fixture
def body():
    bpy.ops.wm.open_mainfile(filepath=str(FILE))
    return bpy.data.objects["Body"]


def group_node(obj):
    tree = obj.material_slots[0].material.node_tree
    return next(node for node in tree.nodes if node.bl_idname == "ShaderNodeGroup")


def colours(obj, folder) -> list[np.ndarray]:
    """Of the three squares at both frames."""
    tree = obj.material_slots[0].material.node_tree
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(group_node(obj).outputs["Colour"], emission.inputs["Color"])
    output = tree.nodes["Material Output"].inputs["Surface"]
    former = output.links[0].from_socket
    tree.links.new(emission.outputs["Emission"], output)
    add_camera((1.5, 0.5 + obj.location.y, 5.0), 3.0)
    seen = []
    for frame in FRAMES:
        bpy.context.scene.frame_set(frame)
        seen.append(render(folder / "row.exr", width=9, height=3)[1, 1::3])
    tree.links.new(former, output)
    tree.nodes.remove(emission)
    return seen


@pytest.mark.parametrize("name", COLOURS)
def test_it_renders_as_it_did_and_still_does_after_apply(body, tmp_path, name):
    obj = bpy.data.objects[name]
    assert colours(obj, tmp_path) == pytest.approx(np.array(COLOURS[name]), abs=2e-5)
    assert apply(obj) == {"FINISHED"}
    untanned, tanned = colours(obj, tmp_path)
    table = catalogue.table(catalogue.shipped_path(TYPES[name]))
    now = table.plane("subsurface_colour", [*table.axes.sheet.untanned, 1.0])
    assert difference(untanned, np.tile(now, (3, 1))).max() < 0.02
    # The table is another since: ten wavelengths make its colours in place of eight.
    assert difference(untanned, np.array(COLOURS[name][0])).max() < 0.1
    assert difference(tanned, np.array(COLOURS[name][1])).max() < 0.3


def test_apply_takes_the_old_material_over(body):
    """Under another name, with what the artist changed, and no second set of anything."""
    material, twin = body.material_slots[0].material, bpy.data.objects["Twin"]
    before, of_twin = look(body), look(twin)
    material.name, body.name = "Sunny", "Anna"
    body.skin_tan.exposures[0].dose = 5.0
    assert apply(body) == {"FINISHED"}
    assert body.material_slots[0].material == material and body.skin_tan.material == material
    assert look(body) != before and look(twin) == of_twin
    assert group_node(body).inputs["Roughness"].default_value == pytest.approx(0.3)
    assert "Freckles" in body.skin_tan.group.nodes
    assert len(bpy.data.materials) == len(bpy.data.node_groups) == 2 and len(bpy.data.images) == 6
    nodes = len(body.skin_tan.group.nodes)
    apply(body)
    assert len(body.skin_tan.group.nodes) == nodes


def test_a_mask_can_be_set_where_there_was_none(body):
    twin = bpy.data.objects["Twin"]
    twin.skin_tan.mask_attribute = "sun"
    apply(twin)
    assert of_role(twin, "mask").attribute_name == "sun"
    assert [end.default_value for end in of_role(twin, "share").inputs[1:]] == [1.0, 0.0]
    assert of_role(twin, "columns").inputs["Vector"].links[0].from_node == of_role(twin, "share")
    values = [node for node in twin.skin_tan.group.nodes if node.bl_idname == "ShaderNodeValue"]
    assert values == [of_role(twin, "radius")]


def test_objects_that_met_under_one_name_part(body):
    """As the first version left two objects whose names were alike."""
    twin = bpy.data.objects["Twin"]
    twin.material_slots[0].material = body.material_slots[0].material
    before = look(body)
    apply(twin)
    assert look(body) == before != look(twin)
