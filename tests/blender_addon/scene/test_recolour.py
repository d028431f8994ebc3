"""The tan in an artist's material: its colour times the tan's ratio, and all else as it was."""

import bpy
import numpy as np
import OpenImageIO
import pytest
from artist_skins import (
    KINDS,
    PAINTED,
    add,
    empty_material,
    grouped,
    layered,
    output_of,
    plain,
    principled,
    shader_group,
    show,
    textured,
    wear,
)
from scenes import add_camera, apply, render, tan_group, tan_groups, tan_object, white_world
from synthetic import UNTANNED_COLOUR

from blender_addon.model.fitting import type_colours
from hylios.tanning import PIGMENTATIONS, Exposures, simulate


def body_in(table_path, materials, shares=None):
    obj = tan_object(table_path, [1.0] * len(materials) if shares is None else shares)
    wear(obj, materials)
    return obj


def base_colours(folder, count: int) -> np.ndarray:
    """Colours (count, 3) of the squares' surfaces, without light or gloss."""
    layer = bpy.context.view_layer
    layer.use_pass_diffuse_color = layer.use_pass_emit = True
    path = folder / "row.exr"
    format_of = bpy.context.scene.render.image_settings
    if hasattr(format_of, "media_type"):
        format_of.media_type = "MULTI_LAYER_IMAGE"
    render(path, width=3 * count, height=3, kind="OPEN_EXR_MULTILAYER")
    colours = np.zeros((count, 3))
    for part in range(OpenImageIO.ImageBuf(str(path)).nsubimages):
        picture = OpenImageIO.ImageBuf(str(path), part, 0)
        pixels = np.asarray(picture.get_pixels(OpenImageIO.FLOAT))[1, 1::3]
        for name, channel in zip(picture.spec().channelnames, pixels.T, strict=True):
            _, what, colour = name.split(".")
            if what in PASSES:
                colours[:, "RGB".index(colour)] += channel
    return colours


PASSES = ("Diffuse Color", "Emission", "DiffCol", "Emit")
"""Names in newer and older versions of Blender."""


def ratio(table, day: float) -> np.ndarray:
    """The table's colour after 30 SED over that before."""
    history = simulate(
        Exposures(hours=np.array([0]), doses=np.array([[30.0]])),
        PIGMENTATIONS["intermediate"],
        mmd=table.provenance["mmd_sed"],
        med=table.provenance["med_sed"],
        hours=24 * 30,
    )
    states = history.states[:, int(24 * day)]
    return table.plane("subsurface_colour", states)[0] / UNTANNED_COLOUR


def test_base_colours_are_multiplied_by_the_table_s_ratio(tmp_path, table, table_path):
    """Of every kind of material at once; before the tan they are as they were."""
    kinds = [make(f"skin {make.__name__}") for make in KINDS]
    obj = body_in(table_path, kinds)
    paint = obj.data.color_attributes.new("Paint", "FLOAT_COLOR", "POINT")
    paint.data.foreach_set("color", np.tile((*PAINTED, 1.0), len(paint.data)))
    white_world()
    add_camera((len(kinds) / 2, 0.5, 5.0), len(kinds))
    before = base_colours(tmp_path, len(kinds))
    assert before.min() > 0.05
    assert apply() == {"FINISHED"}
    obj.skin_tan.last_frame = 31
    assert apply() == {"FINISHED"}
    bpy.context.scene.frame_set(1)
    assert base_colours(tmp_path, len(kinds)) == pytest.approx(before, abs=1e-5)
    bpy.context.scene.frame_set(11)
    tanned = base_colours(tmp_path, len(kinds))
    assert tanned == pytest.approx(before * ratio(table, 10.0), abs=1e-3)


def test_black_overbright_and_negative_colours_stay_finite(tmp_path, table, table_path):
    colours = [(0.0, 0.0, 0.0), (30.0, 2.0, 0.5), (0.5, 0.0, 1.0)]
    materials = []
    for colour in colours:
        material = empty_material("skin")
        light = add(material.node_tree, "ShaderNodeEmission")
        light.inputs["Color"].default_value = (*colour, 1.0)
        output_of(material.node_tree, light.outputs[0])
        materials.append(material)
    body_in(table_path, materials).skin_tan.last_frame = 31
    add_camera((1.5, 0.5, 5.0), 3)
    assert apply() == {"FINISHED"}
    bpy.context.scene.frame_set(11)
    assert base_colours(tmp_path, 3) == pytest.approx(colours * ratio(table, 10.0), rel=2e-3)


@pytest.mark.parametrize("make", [plain, textured])
def test_all_else_stays_as_it_was(table_path, make):
    """The former nodes and links are there, but for the one to Base Color."""
    material = make("skin")
    tree = material.node_tree
    nodes = [(node.name, tuple(node.location)) for node in tree.nodes]
    links = {(link.from_socket, link.to_socket) for link in tree.links}
    body_in(table_path, [material])
    assert apply() == {"FINISHED"}
    assert [(node.name, tuple(node.location)) for node in tree.nodes][: len(nodes)] == nodes
    assert len(tree.nodes) == len(nodes) + 2
    now = {(link.from_socket, link.to_socket) for link in tree.links}
    assert {end.identifier for _, end in links - now} <= {"Base Color"}


def test_one_group_serves_all_slots_and_a_second_apply_adds_nothing(table_path):
    obj = body_in(table_path, [plain("skin"), textured("ears"), grouped("face")])
    apply()
    counts = [len(material.node_tree.nodes) for material in bpy.data.materials]
    group = tan_group(obj)
    apply()
    assert [len(material.node_tree.nodes) for material in bpy.data.materials] == counts
    assert tan_groups() == [group] and tan_group(obj) == group
    assert [slot.material.name for slot in obj.material_slots] == ["skin", "ears", "face"]


def tans(material) -> bool:
    """Whether a material has the tan, maybe in a group."""
    return any(
        "skin_tan_inserted" in node or (getattr(node, "node_tree", None) and tans(node))
        for node in material.node_tree.nodes
    )


def test_a_material_of_another_object_is_copied_first(table_path, capfd):
    material = textured("skin")
    hands = bpy.data.objects.new("Hands", bpy.data.meshes.new("Hands"))
    hands.data.materials.append(material)
    obj = body_in(table_path, [material])
    apply()
    assert "The skin on 'Hands' stays as it was." in capfd.readouterr().out
    assert not tans(material) and hands.material_slots[0].material == material
    assert obj.material_slots[0].material != material and tans(obj.material_slots[0].material)
    apply()
    assert len(bpy.data.materials) == 2


@pytest.mark.parametrize("ticked", [True, False])
def test_a_group_that_others_use_is_copied_first(table_path, ticked):
    """Others are another object's materials, and those of this object that are not ticked."""
    group = shader_group("Shared", colour_input=False)
    skin, eyes = empty_material("skin"), empty_material("eyes" if not ticked else "world")
    for material in (skin, eyes):
        output_of(material.node_tree, show(material.node_tree, group).outputs[0])
    obj = body_in(table_path, [skin] if ticked else [skin, eyes])
    apply()
    assert tans(skin) and not tans(eyes)
    assert not any("skin_tan_inserted" in node for node in group.nodes)
    assert obj.material_slots[0].material == skin


def test_groups_of_two_ticked_materials_are_not_copied(table_path):
    group = shader_group("Shared", colour_input=False)
    skin, ears = empty_material("skin"), empty_material("ears")
    for material in (skin, ears):
        output_of(material.node_tree, show(material.node_tree, group).outputs[0])
    body_in(table_path, [skin, ears])
    apply()
    assert [len([n for n in group.nodes if "skin_tan_inserted" in n])] == [2]
    assert len(bpy.data.node_groups) == 2


def test_objects_that_share_a_mesh_each_get_their_own(table_path):
    material = layered("skin")
    obj = body_in(table_path, [material])
    twin = bpy.data.objects.new("Twin", obj.data)
    bpy.context.collection.objects.link(twin)
    apply(obj)
    assert not tans(material) and twin.material_slots[0].material == material
    assert tans(obj.material_slots[0].material)


@pytest.mark.parametrize("linked", [True, False])
def test_duplicates_of_a_recoloured_object(table_path, linked):
    """Each has its own material, groups and tan once both are applied; then nothing is copied."""
    obj = body_in(table_path, [layered("skin"), plain("ears")])
    apply()
    obj.select_set(True)
    bpy.ops.object.duplicate(linked=linked)
    copy = bpy.context.object
    copy.skin_tan.exposures[0].dose = 8.0
    group = tan_group(obj)
    apply(copy)
    assert tan_group(obj) == group != tan_group(copy)
    for one, other in zip(obj.material_slots, copy.material_slots, strict=True):
        assert one.material != other.material
        assert tans(one.material) and tans(other.material)
    counts = len(bpy.data.materials), len(bpy.data.node_groups)
    apply(obj)
    apply(copy)
    assert (len(bpy.data.materials), len(bpy.data.node_groups)) == counts


def test_an_unticked_slot_stays_and_a_ticked_one_tans_however_slots_move(table_path):
    obj = body_in(table_path, [plain("one"), plain("two"), plain("three")])
    entries = obj.skin_tan.materials
    for name in ("one", "two", "three"):
        entry = entries.add()
        entry.material, entry.tans = bpy.data.materials[name], name == "two"
    obj.data.materials[0], obj.data.materials[1] = obj.data.materials[1], obj.data.materials[0]
    bpy.data.materials["two"].name = "renamed"
    apply()
    assert [tans(slot.material) for slot in obj.material_slots] == [True, False, False]


def test_nothing_ticked_is_refused(table_path):
    obj = body_in(table_path, [plain("skin")])
    obj.skin_tan.materials.add().material = bpy.data.materials["skin"]
    with pytest.raises(RuntimeError, match="No material of 'Body' is ticked to tan"):
        apply()
    assert not tans(bpy.data.materials["skin"]) and "tan_day" not in obj


def test_a_material_without_a_colour_is_refused(table_path):
    material = empty_material("skin")
    gloss = add(material.node_tree, "ShaderNodeBsdfAnisotropic")
    output_of(material.node_tree, gloss.outputs[0])
    body_in(table_path, [material])
    with pytest.raises(RuntimeError, match="'skin' cannot be recoloured: no Principled BSDF"):
        apply()
    assert not bpy.data.images and not bpy.data.node_groups


@pytest.mark.skipif(bpy.app.version >= (5, 0, 0), reason="all materials have nodes")
def test_nodes_that_are_off_are_told(table_path):
    material = plain("skin")
    material.use_nodes = False
    body_in(table_path, [material])
    with pytest.raises(RuntimeError, match="'skin' has no nodes; turn on Use Nodes"):
        apply()
    assert not tans(material)


def test_a_factor_that_was_removed_is_told_and_not_put_back(table_path, capfd):
    material = textured("skin")
    body_in(table_path, [material])
    apply()
    (factor,) = (n for n in material.node_tree.nodes if n.get("skin_tan_inserted") == "factor")
    material.node_tree.nodes.remove(factor)
    count = len(material.node_tree.nodes)
    assert apply() == {"FINISHED"}
    assert "In 'skin' the tan does not reach 1 of the shaders" in capfd.readouterr().out
    assert len(material.node_tree.nodes) == count


def test_a_group_that_was_deleted_is_put_in_again(tmp_path, table, table_path):
    """Without it the colour is as painted; the nodes of before are used."""
    material = plain("skin")
    obj = body_in(table_path, [material])
    obj.skin_tan.last_frame = 31
    white_world()
    add_camera((0.5, 0.5, 5.0), 1)
    before = base_colours(tmp_path, 1)
    apply()
    bpy.data.node_groups.remove(tan_group(obj))
    bpy.context.scene.frame_set(11)
    assert base_colours(tmp_path, 1) == pytest.approx(before, abs=1e-5)
    count = len(material.node_tree.nodes)
    apply()
    assert len(material.node_tree.nodes) == count
    assert base_colours(tmp_path, 1) == pytest.approx(before * ratio(table, 10.0), abs=1e-3)


def test_edits_of_the_tree_survive(table_path):
    material = plain("skin")
    tree = material.node_tree
    body_in(table_path, [material])
    apply()
    (skin,) = (node for node in tree.nodes if node.bl_idname == "ShaderNodeBsdfPrincipled")
    source = skin.inputs["Base Color"].links[0].from_socket
    hue = add(tree, "ShaderNodeHueSaturation")
    tree.links.new(source, hue.inputs["Color"])
    tree.links.new(hue.outputs["Color"], skin.inputs["Base Color"])
    count = len(tree.nodes)
    apply()
    assert skin.inputs["Base Color"].links[0].from_node == hue and len(tree.nodes) == count


def test_a_new_material_in_place_of_the_artist_s(table_path, capfd):
    former = plain("skin")
    obj = body_in(table_path, [former, plain("eyes")])
    obj.skin_tan.new_material = True
    for _ in range(2):
        assert apply() == {"FINISHED"}
        names = [slot.material.name for slot in obj.material_slots]
        assert names == ["Skin Tan skin", "eyes"]
    assert "'Skin Tan skin' took the place of 'skin'" in capfd.readouterr().out
    assert former.users == 1 and not tans(former)


def test_principled_beside_eyes_of_another_output_stay(table_path):
    """A shader that leads to no output is left alone."""
    material = plain("skin")
    spare = principled(material.node_tree, (0.1, 0.1, 0.1))
    body_in(table_path, [material])
    apply()
    assert not spare.inputs["Base Color"].is_linked


def painted_body(colour):
    """A body with a texture and all settings at their defaults."""
    obj = body_in("", [textured("skin", colours=[[colour]]), textured("eyes")])
    obj.skin_tan.property_unset("skin")
    obj.data.uv_layers.new()
    return obj


@pytest.mark.parametrize("name", ["I", "III", "VI"])
def test_the_first_apply_takes_the_type_nearest_to_the_painted_colour(name, capfd):
    obj = painted_body(tuple(type_colours()[name]))
    assert apply() == {"FINISHED"}
    assert obj.skin_tan.skin == name
    assert f"Of the skin types, {name} is nearest to the painted colour." in capfd.readouterr().out


def test_a_type_that_was_set_stays():
    obj = painted_body((0.9, 0.7, 0.6))
    obj.skin_tan.skin = "V"
    apply()
    assert obj.skin_tan.skin == "V"


def test_solid_view_shows_the_untanned_colour_of_a_material_of_ours(table_path):
    obj = tan_object(table_path)
    apply()
    material = obj.material_slots[0].material
    assert material.diffuse_color[:] == pytest.approx((*UNTANNED_COLOUR, 1.0), abs=1e-3)
    material.diffuse_color = (0.0, 0.0, 1.0, 1.0)
    apply()
    assert material.diffuse_color[:] == (0.0, 0.0, 1.0, 1.0)
