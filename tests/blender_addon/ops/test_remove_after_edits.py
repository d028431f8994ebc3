"""Remove Tan gives back what was there, also after duplicates, swapped materials, deleted nodes."""

import bpy
import pytest
from artist_skins import layered, plain, textured, wear
from scenes import add_mask, apply, tan_group, tan_object
from state import of_tree, state

from blender_addon.model import catalogue


def body(table_path):
    obj = tan_object(table_path, [1.0] * 3)
    wear(obj, [textured("skin"), layered("face"), plain("ears")])
    return obj


def duplicate(obj, *, linked: bool):
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    bpy.ops.object.duplicate(linked=linked)
    copy = bpy.context.object
    copy.select_set(False)
    return copy


def remove(obj) -> None:
    bpy.context.view_layer.objects.active = obj
    assert bpy.ops.skin_tan.remove() == {"FINISHED"}


@pytest.mark.parametrize("linked", [False, True])
@pytest.mark.parametrize("copy_first", [False, True])
@pytest.mark.parametrize("own_colour", [False, True])
def test_a_duplicate_and_its_original_both_go_back(
    table_path, linked, copy_first, own_colour, capfd
):
    obj = body(table_path)
    duplicate(obj, linked=linked)
    before = state()
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    obj = body(table_path)
    obj.skin_tan.own_colour = own_colour
    apply(obj)
    copy = duplicate(obj, linked=linked)
    copy.skin_tan.exposures[0].dose = 8.0
    apply(copy)
    shown = look_of(obj if copy_first else copy)
    for one in (copy, obj) if copy_first else (obj, copy):
        remove(one)
        assert not any("inserted" in key for slot in one.material_slots for key in told(slot))
        if one is (copy if copy_first else obj):
            assert look_of(obj if copy_first else copy) == shown
    assert state() == before
    assert "Edited" not in capfd.readouterr().out


def look_of(obj) -> list:
    return [of_tree(slot.material.node_tree) for slot in obj.material_slots]


def told(slot) -> list:
    return [key for node in slot.material.node_tree.nodes for key in node.keys()]


def test_three_that_shared_a_tan_all_go_back(table_path):
    """Whatever the order, and if one had its tan anew meanwhile."""
    for order in ((0, 1, 2), (2, 0, 1), (1, 2, 0)):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        obj = body(table_path)
        before = look_of(obj), [material.name for material in bpy.data.materials]
        apply(obj)
        bodies = [obj, duplicate(obj, linked=False)]
        apply(bodies[1])
        bodies.append(duplicate(bodies[1], linked=False))
        for number in order:
            remove(bodies[number])
        apply(bodies[order[1]])
        remove(bodies[order[1]])
        for one in bodies:
            assert (look_of(one), [m.name for m in bpy.data.materials]) == before
        assert not any("skin_tan" in key for m in bpy.data.materials for key in m.keys())


def test_the_copy_of_a_body_that_was_deleted_gets_its_materials(table_path):
    obj = body(table_path)
    before = state()
    apply(obj)
    copy = duplicate(obj, linked=False)
    apply(copy)
    bpy.data.objects.remove(obj)
    remove(copy)
    after = state()
    assert [after[key] for key in ("materials", "groups")] == [
        before["materials"],
        before["groups"],
    ]
    assert after["blocks"]["images"] == before["blocks"]["images"]
    assert [slot.material.name for slot in copy.material_slots] == ["skin", "face", "ears"]


def test_a_waiting_copy_that_is_edited_or_renamed_is_the_artists(table_path):
    obj = body(table_path)
    apply(obj)
    copy = duplicate(obj, linked=False)
    apply(copy)
    remove(copy)
    edited, renamed, plain_one = (slot.material for slot in copy.material_slots)
    edited.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.1
    renamed.name = "face of the twin"
    remove(obj)
    assert [slot.material for slot in copy.material_slots[:2]] == [edited, renamed]
    assert copy.material_slots[2].material == bpy.data.materials["ears"]
    assert not any("skin_tan" in key for block in (edited, renamed) for key in block.keys())


@pytest.mark.parametrize("replacing", [False, True])
def test_a_material_that_was_swapped_out_loses_its_tan_too(table_path, replacing):
    obj = body(table_path)
    obj.skin_tan.new_material = replacing
    swapped = plain("other skin")
    swapped.use_fake_user = True
    before = state()
    apply(obj)
    material, obj.material_slots[0].material = obj.material_slots[0].material, swapped
    material.use_fake_user = not replacing
    apply(obj)
    remove(obj)
    bpy.data.materials["skin"].use_fake_user = False
    obj.material_slots[0].material = bpy.data.materials["skin"]
    assert state() == before


def test_a_material_that_another_object_wears_now_keeps_its_tan_until_asked(table_path, capfd):
    obj = body(table_path)
    before = of_tree(bpy.data.materials["skin"].node_tree)
    apply(obj)
    other = tan_object(table_path)
    other.data.materials.append(bpy.data.materials["skin"])
    obj.material_slots[0].material = None
    tanned = of_tree(bpy.data.materials["skin"].node_tree)
    remove(obj)
    assert (
        "'skin', now on 'Body.001', keeps the tan until Remove Tan there." in capfd.readouterr().out
    )
    assert of_tree(bpy.data.materials["skin"].node_tree) == tanned
    remove(other)
    assert of_tree(bpy.data.materials["skin"].node_tree) == before
    assert not [group for group in bpy.data.node_groups if "skin_tan_layout" in group]


@pytest.mark.parametrize("again", [False, True])
def test_nothing_is_left_where_the_tans_group_was_deleted(table_path, again):
    obj = body(table_path)
    for number in range(2):
        name = f"mask {number}"
        add_mask(obj, [float(number)] * 6 + [0.5] * 6, name)
        exposure = obj.skin_tan.exposures[0] if number else obj.skin_tan.exposures.add()
        exposure.own_mask, exposure.dose, exposure.mask.source = True, 20.0, name
    bpy.ops.skin_tan.add_region(kind="FRECKLES")
    before = state()
    apply(obj)
    bpy.data.node_groups.remove(tan_group(obj))
    if again:
        apply(obj)
    remove(obj)
    assert state() == before


def deleted(tree, *kinds: str) -> None:
    for node in list(tree.nodes):
        if node.get("skin_tan_inserted") in kinds:
            tree.nodes.remove(node)


@pytest.mark.parametrize("kinds", [("factor",), ("tan",), ("factor", "tan")])
@pytest.mark.parametrize("again", [False, True])
@pytest.mark.parametrize("own_colour", [False, True])
def test_deleted_nodes_of_ours_leave_the_texture_linked(table_path, kinds, again, own_colour):
    obj = body(table_path)
    before = state()
    obj.skin_tan.own_colour = own_colour
    apply(obj)
    for material in bpy.data.materials:
        deleted(material.node_tree, *kinds)
    for group in bpy.data.node_groups:
        deleted(group, *kinds)
    if again:
        apply(obj)
    remove(obj)
    assert state() == before


def test_what_was_linked_in_place_of_the_texture_comes_back(table_path):
    obj = body(table_path)
    apply(obj)
    tree = bpy.data.materials["skin"].node_tree
    (factor,) = (node for node in tree.nodes if node.get("skin_tan_inserted") == "factor")
    source = tree.nodes.new("ShaderNodeRGB")
    tree.links.new(source.outputs[0], factor.inputs[0])
    apply(obj)
    tree.nodes.remove(factor)
    remove(obj)
    (link,) = tree.nodes["Principled BSDF"].inputs["Base Color"].links
    assert link.from_node == source


def test_a_source_that_is_linked_past_a_deleted_node_stays(table_path):
    obj = body(table_path)
    apply(obj)
    tree = bpy.data.materials["skin"].node_tree
    deleted(tree, "factor")
    source = tree.nodes.new("ShaderNodeRGB")
    end = tree.nodes["Principled BSDF"].inputs["Base Color"]
    tree.links.new(source.outputs[0], end)
    remove(obj)
    assert end.links[0].from_node == source and not list(tree.keys())


def test_a_deleted_node_in_a_view_leaves_the_texture_linked():
    """A view puts a node of its own between Tan and the shader."""
    obj = body(catalogue.shipped_path("III"))
    before = state()
    bpy.context.scene.skin_tan.view = "NM365"
    apply(obj)
    tree = bpy.data.materials["skin"].node_tree
    assert any(node.get("skin_tan_inserted") == "instead" for node in tree.nodes)
    deleted(tree, "factor", "instead")
    remove(obj)
    assert state() == before


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_a_linked_duplicate_without_an_apply_leaves_no_empty_animation(table_path, order):
    obj = body(table_path)
    apply(obj)
    bodies = obj, duplicate(obj, linked=True)
    for index in order:
        remove(bodies[index])
    assert [one.animation_data for one in bodies] == [None, None]
    assert not bpy.data.actions
