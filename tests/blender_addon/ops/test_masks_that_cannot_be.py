"""Masks that cannot be made or painted: names, clothes and textures that are none."""

import bpy
import numpy as np
import pytest
from artist_skins import add, plain, textured
from scenes import apply

from blender_addon.scene import masks
from blender_addon.scene.mask_values import mask_values

ONLY_MESHES = "Only meshes count as clothes, so 'Dress', 'Strap' did not: convert curves"


@pytest.fixture
def body():
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4, radius=0.1)
    obj = bpy.context.object
    obj.name = "Body"
    return obj


@pytest.fixture
def band(body):
    bpy.ops.mesh.primitive_cylinder_add(
        vertices=128, radius=0.105, depth=0.06, end_fill_type="NOTHING"
    )
    garment = bpy.context.object
    select(body, garment)
    return garment


def select(body, *others) -> None:
    bpy.ops.object.select_all(action="DESELECT")
    for obj in (*others, body):
        obj.select_set(True)
    bpy.context.view_layer.objects.active = body


def shares(obj) -> np.ndarray:
    return mask_values(obj, obj.skin_tan.shown_mask()).shares


def test_clothes_that_are_no_meshes_are_told(body, band, capfd):
    strap = bpy.data.objects.new("Strap", bpy.data.curves.new("Strap", "CURVE"))
    dress, rig = bpy.data.objects.new("Dress", None), bpy.data.objects.new("Rig", None)
    dress.instance_type = "COLLECTION"
    for obj in (strap, dress, rig):
        bpy.context.collection.objects.link(obj)
    select(body, strap, dress, rig)
    with pytest.raises(RuntimeError, match=ONLY_MESHES):
        bpy.ops.skin_tan.mask_from_clothes()
    select(body, strap, dress, rig, band)
    bpy.ops.skin_tan.mask_from_clothes()
    assert ONLY_MESHES in capfd.readouterr().out and shares(body).min() == 0.0


def test_faces_of_a_garment_without_a_place_cover_nothing(body, band):
    """A point that is no number counted as the origin, and its faces cut through the body."""
    for obj in (body, band):
        obj.location = (0.0, 0.2, 0.5)
    bpy.ops.skin_tan.mask_from_clothes()
    expected = shares(body)
    torn = bpy.data.meshes.new("Torn")
    nowhere = (float("nan"),) * 3
    torn.from_pydata([nowhere, (-0.2, 0.3, 0.9), (0.2, 0.3, 0.9)], [], [(0, 1, 2)])
    seam = bpy.data.objects.new("Seam", torn)
    bpy.context.collection.objects.link(seam)
    select(body, band, seam)
    bpy.ops.skin_tan.mask_from_clothes()
    assert (shares(body) == expected).all()


@pytest.mark.parametrize("name", ["density", "material_index", ".hidden", "é" * 32, "a" * 200])
def test_names_that_no_mask_can_have_are_refused(body, band, name):
    listed, exposure = set(body.data.attributes.keys()), body.skin_tan.exposures.add()
    for make in (bpy.ops.skin_tan.mask_from_clothes, bpy.ops.skin_tan.paint_mask):
        with pytest.raises(RuntimeError, match="The name of the mask"):
            make(name=name, target="EXPOSURE")
    assert set(body.data.attributes.keys()) == listed
    assert not (exposure.own_mask or exposure.mask.source)


def test_the_longest_name_of_a_mask_tans_twice(body):
    for target in ("OBJECT", "EXPOSURE"):
        body.skin_tan.exposures.add()
        assert bpy.ops.skin_tan.paint_mask(name="a" * 63, target=target) == {"FINISHED"}
    assert body.skin_tan.mask.source != body.skin_tan.exposures[0].mask.source
    assert apply(body) == {"FINISHED"}


def test_the_skin_s_own_texture_is_not_painted_as_a_mask(body):
    material = textured("Skin")
    body.data.materials.append(material)
    colour = material.node_tree.nodes["Principled BSDF"].inputs["Base Color"]
    scar = bpy.data.images.new("Scar", 4, 4)
    body.skin_tan.mask.image = colour.links[0].from_node.image
    with pytest.raises(RuntimeError, match="'Painted.*' is the colour of the skin"):
        bpy.ops.skin_tan.paint_mask()
    assert bpy.context.tool_settings.image_paint.canvas is None
    body.skin_tan.mask.image = scar
    assert bpy.ops.skin_tan.paint_mask() == {"FINISHED"}
    assert bpy.context.tool_settings.image_paint.canvas == scar


def shows_colours(name: str, layer: str):
    """A material in the colours of an attribute; without a name, of the mesh's usual one."""
    material = plain(name)
    tree = material.node_tree
    colours = add(tree, "ShaderNodeVertexColor", layer_name=layer)
    tree.links.new(colours.outputs["Color"], tree.nodes["Principled BSDF"].inputs["Base Color"])
    return material


@pytest.mark.parametrize("layer", ["Scar", ""])
def test_colours_of_the_skin_are_not_painted_as_a_mask(body, layer):
    body.data.materials.append(shows_colours("Skin", layer))
    for name in ("Scar", "Dust"):
        body.data.color_attributes.new(name, "BYTE_COLOR", "CORNER")
    body.skin_tan.mask.source = "Scar"
    with pytest.raises(RuntimeError, match="'Scar' is the colour of the skin"):
        bpy.ops.skin_tan.paint_mask()
    body.skin_tan.mask.source = "Dust"
    assert bpy.ops.skin_tan.paint_mask() == {"FINISHED"}
    assert body.data.attributes.default_color_name == "Scar"


def test_a_mask_is_not_what_materials_show_by_default(body):
    """The first colours of a mesh would be, in place of none."""
    body.data.materials.append(shows_colours("Skin", ""))
    assert bpy.ops.skin_tan.paint_mask() == {"FINISHED"}
    attributes = body.data.attributes
    assert attributes.default_color_name == "" and attributes.active_color_name == "Sun Mask"


def test_masks_are_offered_before_textures_of_the_skin(body):
    body.data.materials.append(textured("Skin"))
    bpy.data.images["Painted.001"].colorspace_settings.name = "Non-Color"
    bpy.data.images.new("Scar", 4, 4)
    body.vertex_groups.new(name="Cloth")
    offered = [item.name for item in masks.usable_sources(body, None)]
    assert offered == ["Cloth", "Scar", "Painted", "Painted.001"]
    body.skin_tan.mask.source = "Gone"
    with pytest.raises(RuntimeError, match="no 'Gone', .*; allowed are: Cloth, Scar\\."):
        apply(body)


def test_the_sentence_on_a_missing_mask_names_a_dozen_that_are_there(body):
    body.skin_tan.mask.source = "Gone"
    with pytest.raises(RuntimeError, match="allowed are: vertex groups .* none of\\."):
        apply(body)
    for number in range(15):
        body.vertex_groups.new(name=f"Part {number:02d}")
    with pytest.raises(RuntimeError, match="Part 00, .*, Part 11 and 3 more\\."):
        apply(body)
