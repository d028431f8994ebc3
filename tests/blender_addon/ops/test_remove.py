"""Remove Tan gives back what was there before Apply, node by node, and keeps edits."""

import bpy
import pytest
from artist_skins import (
    KINDS,
    add,
    empty_material,
    layered,
    output_of,
    plain,
    shader_group,
    show,
    textured,
    wear,
)
from scenes import add_mask, apply, tan_object
from state import of_tree, state

from blender_addon.apply import apply_tan

MAKERS = [
    lambda: [make(f"skin {make.__name__}") for make in KINDS],
    lambda: [plain("skin"), None, plain("eyes")],
    lambda: [],
    lambda: [None],
]


def body_in(table_path, materials):
    obj = tan_object(table_path, [1.0] * max(len(materials), 1))
    wear(obj, materials)
    return obj


def remove(obj=None) -> None:
    if obj is not None:
        bpy.context.view_layer.objects.active = obj
    assert bpy.ops.skin_tan.remove() == {"FINISHED"}


def unedited(obj, before: dict) -> None:
    """Apply twice and Remove: all is as it was."""
    apply(obj)
    assert state() != before
    apply(obj)
    remove(obj)
    assert state() == before


@pytest.mark.parametrize("make", MAKERS)
@pytest.mark.parametrize("replacing", [False, True])
def test_all_is_as_it_was(table_path, make, replacing):
    obj = body_in(table_path, make())
    obj.skin_tan.new_material = replacing
    obj.keyframe_insert("location", frame=3)
    if not obj.data.materials:
        obj.data.polygons[0].material_index = 3
    unedited(obj, state())


def test_copies_of_a_vertex_group_go(table_path):
    obj = body_in(table_path, [plain("skin")])
    obj.vertex_groups.new(name="cloth").add([0, 1], 1.0, "REPLACE")
    obj.skin_tan.mask.source = "cloth"
    before = state()
    apply(obj)
    assert any(attribute.name.startswith("skin_tan") for attribute in obj.data.attributes)
    remove(obj)
    assert state() == before


def test_without_animation_none_is_left(table_path):
    obj = body_in(table_path, [textured("skin")])
    unedited(obj, state())
    assert obj.animation_data is None and not bpy.data.actions


def with_twin(obj):
    twin = bpy.data.objects.new("Twin", obj.data)
    bpy.context.collection.objects.link(twin)


def with_hands(obj):
    hands = bpy.data.objects.new("Hands", bpy.data.meshes.new("Hands"))
    for material in obj.data.materials:
        hands.data.materials.append(material)
    bpy.context.collection.objects.link(hands)


def with_the_group_elsewhere(obj):
    material = empty_material("World")
    group = bpy.data.node_groups["skin nails"]
    output_of(material.node_tree, show(material.node_tree, group).outputs[0])
    material.use_fake_user = True


def with_the_action(obj):
    obj.keyframe_insert("location", frame=3)
    camera = bpy.data.objects.new("Camera", None)
    camera.animation_data_create().action = obj.animation_data.action
    camera.animation_data.action_slot = obj.animation_data.action_slot


@pytest.mark.parametrize(
    "share", [with_twin, with_hands, with_the_group_elsewhere, with_the_action]
)
def test_copies_make_room_for_what_is_shared(table_path, share):
    """A mesh, materials, a node group, an action."""
    obj = body_in(table_path, [layered("skin"), plain("ears")])
    share(obj)
    unedited(obj, state())


def test_after_a_save_and_a_reload(table_path, tmp_path):
    obj = body_in(table_path, [make(f"skin {make.__name__}") for make in KINDS])
    with_hands(obj)
    path = str(tmp_path / "scene.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    before = state()
    apply(bpy.data.objects["Body"])
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    remove(bpy.data.objects["Body"])
    assert state() == before


def test_edits_since_apply_are_kept(table_path):
    """New nodes, another colour in place of the former, a source linked where none was."""
    painted, mixed = plain("skin"), plain("ears")
    body_in(table_path, [painted, mixed])
    apply()
    (factor,) = (n for n in painted.node_tree.nodes if n.get("skin_tan_inserted") == "factor")
    factor.inputs[0].default_value = (0.25, 0.5, 0.125)
    (factor,) = (n for n in mixed.node_tree.nodes if n.get("skin_tan_inserted") == "factor")
    source = add(mixed.node_tree, "ShaderNodeRGB")
    mixed.node_tree.links.new(source.outputs[0], factor.inputs[0])
    remove()
    (skin,) = (n for n in painted.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfPrincipled")
    assert tuple(skin.inputs["Base Color"].default_value) == (0.25, 0.5, 0.125, 1.0)
    (skin,) = (n for n in mixed.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfPrincipled")
    assert skin.inputs["Base Color"].links[0].from_node == source
    assert not any("skin_tan_inserted" in n for m in (painted, mixed) for n in m.node_tree.nodes)


def test_an_edited_copy_stays(table_path, capfd):
    material = plain("skin")
    obj = body_in(table_path, [material])
    with_hands(obj)
    apply(obj)
    copy = obj.material_slots[0].material
    copy.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.1
    remove(obj)
    assert obj.material_slots[0].material == copy != material
    assert "a copy stays: 'skin.001'" in capfd.readouterr().out
    assert len(copy.node_tree.nodes) == len(material.node_tree.nodes)
    assert not list(copy.keys()) and material.users == 1


def test_masks_and_other_keys_stay(table_path):
    obj = body_in(table_path, [plain("skin")])
    add_mask(obj, [1.0] * 4, "painted")
    apply()
    obj.keyframe_insert("location", frame=9)
    remove()
    assert "painted" in obj.data.attributes and obj.skin_tan.mask_attribute == "painted"
    (curves,) = (state()["actions"][action.name][2] for action in bpy.data.actions)
    assert {path for _, path, _, _ in curves} == {"location"}
    assert "tan_day" not in obj and len(obj.skin_tan.exposures) == 1


@pytest.mark.parametrize("linked", [True, False])
@pytest.mark.parametrize("applied", [True, False])
def test_a_duplicate_keeps_its_tan(table_path, linked, applied):
    obj = body_in(table_path, [layered("skin"), plain("ears")])
    apply(obj)
    obj.select_set(True)
    bpy.ops.object.duplicate(linked=linked)
    copy = bpy.context.object
    if applied:
        copy.skin_tan.exposures[0].dose = 8.0
        apply(copy)
    before = [of_tree(slot.material.node_tree) for slot in copy.material_slots]
    group = copy.skin_tan.group
    remove(obj)
    assert [of_tree(slot.material.node_tree) for slot in copy.material_slots] == before
    assert copy.skin_tan.group == group and "tan_day" in copy and "tan_day" not in obj
    bpy.context.scene.frame_set(20)
    assert copy["tan_day"] > 1.0
    remove(copy)
    assert not any("skin_tan" in key for m in bpy.data.materials for key in m.keys())
    assert not [g for g in bpy.data.node_groups if "skin_tan_layout" in g] and not bpy.data.images


def test_an_unticked_material_loses_its_tan_on_apply(table_path):
    obj = body_in(table_path, [plain("skin"), textured("face")])
    before = of_tree(bpy.data.materials["face"].node_tree)
    apply()
    entries = {entry.material.name: entry for entry in obj.skin_tan.materials}
    entries["face"].tans = False
    apply()
    assert of_tree(bpy.data.materials["face"].node_tree) == before
    assert any("skin_tan_inserted" in n for n in bpy.data.materials["skin"].node_tree.nodes)


def test_without_a_tan_it_cannot_be_pressed(table_path):
    body_in(table_path, [plain("skin")])
    assert not bpy.ops.skin_tan.remove.poll()


def test_without_a_window_and_by_an_override(table_path):
    obj, other = body_in(table_path, [plain("skin")]), body_in(table_path, [plain("skin")])
    apply(obj)
    bpy.context.view_layer.objects.active = other
    with bpy.context.temp_override(window=None, object=obj):
        assert bpy.ops.skin_tan.remove(keep_timing=True) == {"FINISHED"}
    assert obj.skin_tan.group is None and "tan_day" in obj


def test_apply_after_remove_gives_the_tan_again(table_path):
    obj = body_in(table_path, [shader_material()])
    apply()
    first = of_tree(bpy.data.node_groups["Shared"])
    remove()
    apply()
    assert of_tree(bpy.data.node_groups["Shared"]) == first
    assert obj.skin_tan.group is not None


def shader_material():
    material = empty_material("skin")
    group = shader_group("Shared", colour_input=False)
    output_of(material.node_tree, show(material.node_tree, group).outputs[0])
    return material


@pytest.mark.parametrize("own_colour", [False, True])
@pytest.mark.parametrize("view", ["VISIBLE", "NM365"])
def test_the_copy_of_a_material_without_its_tick_goes(table_path, own_colour, view):
    """And whatever Apply had to do in its tree at the end with it."""
    obj, skin = tan_object(table_path, [1.0, 1.0]), plain("skin")
    wear(obj, [skin, plain("lips")])
    other = bpy.data.objects.new("Other", obj.data.copy())  # shows them too, so they are copied
    bpy.context.collection.objects.link(other)
    obj.skin_tan.own_colour = own_colour
    apply(obj)
    bpy.ops.skin_tan.switch_view(view=view)
    for entry in obj.skin_tan.materials:
        entry.tans = "lips" in entry.material.name
    obj.skin_tan.own_colour = False
    bpy.context.view_layer.objects.active = obj
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    assert obj.material_slots[0].material == skin
    assert obj.material_slots[1].material != bpy.data.materials["lips"]
    assert {block.name for block in bpy.data.materials} == {"skin", "lips", "lips.001"}


def test_an_artists_own_property_of_that_name_stays(table_path):
    obj = tan_object(table_path)
    obj["tan_day"] = "a note"
    assert not bpy.ops.skin_tan.remove.poll()
    obj["tan_day"] = 7.0
    obj.id_properties_ui("tan_day").update(description="Mine", max=9.0)
    assert not bpy.ops.skin_tan.remove.poll()
    obj.skin_tan.property_unset("kinetics_kept")
    assert obj.skin_tan.kinetics == "MEASURED"
    assert "'tan_day', which you had," in apply_tan(obj, bpy.context.scene)
    bpy.ops.skin_tan.apply()
    bpy.context.scene.frame_set(bpy.context.scene.frame_end)
    assert obj["tan_day"] == 30.0  # Blender cuts what keys say to the range of the property
    bpy.ops.skin_tan.remove()
    shown = obj.id_properties_ui("tan_day").as_dict()
    assert (obj["tan_day"], shown["description"], shown["max"]) == (7.0, "Mine", 9.0)
    assert not obj.animation_data and not bpy.ops.skin_tan.remove.poll()
    obj["tan_day"] = 3
    items = [("0", "None", ""), ("1", "One", "")]
    obj.id_properties_ui("tan_day").update(items=items)
    before = obj.id_properties_ui("tan_day").as_dict()
    bpy.ops.skin_tan.reset_timing()
    apply(obj)
    bpy.ops.skin_tan.remove()
    assert (obj["tan_day"], obj.id_properties_ui("tan_day").as_dict()) == (3, before)


def test_tweak_mode_is_refused_and_leaves_all_as_it_was(table_path):
    obj = tan_object(table_path)
    apply(obj)
    animation = obj.animation_data
    track = animation.nla_tracks.new()
    track.strips.new("days", 1, animation.action).select = True
    animation.action, animation.nla_tracks.active = None, track
    animation.use_tweak_mode = True
    group = obj.skin_tan.group
    with pytest.raises(RuntimeError, match="The animation of 'Body' is in tweak mode; leave"):
        bpy.ops.skin_tan.remove()
    assert obj.skin_tan.group == group and obj.skin_tan.applied
    assert bpy.ops.skin_tan.remove(keep_timing=True) == {"FINISHED"}


def test_a_strip_that_stays_is_said(table_path, capfd):
    obj = tan_object(table_path)
    apply(obj)
    animation = obj.animation_data
    animation.nla_tracks.new().strips.new("days", 1, animation.action)
    animation.action = None
    bpy.ops.skin_tan.remove()
    assert "The strip 'days' of the NLA, which held the day, stays" in capfd.readouterr().out
    assert [strip.name for track in animation.nla_tracks for strip in track.strips] == ["days"]
