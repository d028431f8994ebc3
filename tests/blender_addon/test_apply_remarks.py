"""What Apply says where a tan will not look as an artist meant it."""

import bpy
import numpy as np
import pytest
from artist_skins import plain, wear
from scenes import add_mask, apply, tan_object

from blender_addon.scene import materials


@pytest.fixture
def body(table_path):
    return tan_object(table_path, [0.0, 0.5, 0.75, 1.0])


def said_by_apply(obj, capfd, **options) -> str:
    capfd.readouterr()
    bpy.context.view_layer.objects.active = obj
    assert bpy.ops.skin_tan.apply(**options) == {"FINISHED"}
    return capfd.readouterr().out


NOTHING = "No tan can be seen: this skin hardly tans, or gets too little sun."


def test_a_usual_tan_needs_no_words(body, capfd):
    said = said_by_apply(body, capfd)
    assert not any(word in said for word in (NOTHING, "so nothing", "Own Mask", "no faces"))


def test_an_emptied_list_is_told(body, capfd):
    apply(body)
    bpy.ops.skin_tan.remove_exposure()
    assert "'Body' has no time in the sun, so nothing tans; add one with +." in said_by_apply(
        body, capfd
    )
    assert not body.skin_tan.exposures


def test_exposures_that_are_all_off_are_told(body, capfd):
    body.skin_tan.exposures[0].enabled = False
    said = said_by_apply(body, capfd, show=True)
    assert "All times in the sun of 'Body' are switched off, so nothing tans." in said
    assert NOTHING not in said


@pytest.mark.parametrize("values", [{"dose": 0.0}, {"dose": 0.5}, {"day": 40.0}])
def test_too_little_sun_is_told_once(body, capfd, values):
    for name, value in values.items():
        setattr(body.skin_tan.exposures[0], name, value)
    assert said_by_apply(body, capfd, show=True).count(NOTHING) == 1


def test_a_mesh_without_faces_is_told(body, capfd):
    body.data.clear_geometry()
    body.skin_tan.mask_attribute = ""
    assert "'Body' has no faces, so no skin can be seen." in said_by_apply(body, capfd)


def test_odd_numbers_in_one_of_several_masks_are_told(body, capfd):
    add_mask(body, np.repeat([np.nan, 0.0, 1.0, 0.5], 4), "odd")
    exposure = body.skin_tan.exposures[0]
    exposure.own_mask, exposure.mask.source, exposure.name = True, "sun", "Beach"
    own = body.skin_tan.exposures.add()
    own.own_mask, own.mask.source, own.day = True, "odd", 2.0
    said = said_by_apply(body, capfd)
    assert "4 of 16 points of the mask 'odd' have no valid value; they count as 0." in said
    assert "Own Mask" not in said


def test_regions_that_lie_nowhere_are_told(body, capfd):
    for kind in ("LIPS", "PALMS", "FRECKLES", "FLUSH"):
        body.skin_tan.regions.add().kind = kind
    body.skin_tan.regions[1].mask.source = "sun"
    body.skin_tan.regions[3].enabled = False
    told = "No mask says where these regions lie, so they do not show: "
    assert f"{told}Lips." in said_by_apply(body, capfd)
    body.skin_tan.regions[2].painted = True
    assert f"{told}Lips, Freckles." in said_by_apply(body, capfd)


@pytest.mark.parametrize(("name", "called"), [("Beach", "'Beach'"), ("", "time in the sun 1")])
@pytest.mark.parametrize("several", [False, True])
def test_an_empty_own_mask_is_told(body, capfd, several, name, called):
    exposure = body.skin_tan.exposures[0]
    exposure.own_mask, exposure.name = True, name
    if several:
        body.skin_tan.exposures.add().dose = 20.0
    sentence = f"Own Mask is empty in {called}, so the whole body is bare then."
    assert sentence in said_by_apply(body, capfd)
    exposure.enabled = False
    assert "Own Mask" not in said_by_apply(body, capfd)


def test_a_switch_of_new_material_after_the_first_apply_is_told(table_path, capfd):
    obj = tan_object(table_path)
    wear(obj, [plain("skin")])
    for is_new in (True, False):
        obj.skin_tan.new_material = is_new
        assert "New Material" not in said_by_apply(obj, capfd)
        material = obj.material_slots[0].material
        obj.skin_tan.new_material = not is_new
        said = said_by_apply(obj, capfd)
        assert f"New Material is {'off' if is_new else 'on'}, but {material.name!r}" in said
        assert obj.material_slots[0].material == material
        bpy.ops.skin_tan.remove()


def test_materials_that_geometry_nodes_set_are_told(body, capfd):
    tree = bpy.data.node_groups.new("Skin", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Mesh", in_out=way, socket_type="NodeSocketGeometry")
    kinds = "NodeGroupInput", "GeometryNodeSetMaterial", "NodeGroupOutput"
    start, setting, end = (tree.nodes.new(kind) for kind in kinds)
    setting.inputs["Material"].default_value = plain("skin")
    tree.links.new(start.outputs[0], setting.inputs[0])
    tree.links.new(setting.outputs[0], end.inputs[0])
    body.modifiers.new("Skin", "NODES").node_group = tree
    told = f"geometry nodes set other materials on 'Body'; set '{materials.PREFIX}Body' there."
    assert told in said_by_apply(body, capfd)
    setting.inputs["Material"].default_value = body.material_slots[0].material
    assert "geometry nodes" not in said_by_apply(body, capfd)
    assert "Updated" in said_by_apply(body, capfd) and len(bpy.data.materials) == 2


def test_doses_that_blister_are_told(body, capfd):
    body.skin_tan.exposures[0].dose = 100.0
    said = said_by_apply(body, capfd)
    assert "Above 4 burn doses on day 0: blisters in life; not shown." in said
