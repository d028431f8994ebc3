"""A skin type by picture, from a colour, and from the colour that a character is painted in."""

import artist_skins
import bpy
import numpy as np
import pytest
from scenes import apply, tan_object

from blender_addon.model import catalogue
from blender_addon.model.fitting import type_colours
from blender_addon.own_colour import painted_skin
from blender_addon.scene.painted import weighted_median
from blender_addon.ui import swatches

III = catalogue.shipped_path("III")


@pytest.fixture
def body():
    obj = tan_object(III)
    obj.skin_tan.skin = "III"
    return obj


def test_a_type_by_picture(body):
    body.skin_tan.biology.blood = 2.0
    assert bpy.ops.skin_tan.choose_type(type="V") == {"FINISHED"}
    assert body.skin_tan.skin == "V" and body.skin_tan.biology.blood == 1.0


def test_pictures_have_the_types_colours():
    pictures = swatches.swatches()
    assert list(pictures) == list(catalogue.TYPES)
    for name, colour in type_colours().items():
        drawn = np.array(pictures[name].icon_pixels_float).reshape(-1, 4)
        np.testing.assert_allclose(drawn[0, :3], swatches.shown(colour), atol=0.003)
    swatches.forget_swatches()


def test_from_a_colour(body, capfd):
    assert bpy.ops.skin_tan.match_colour(colour=type_colours()["II"] * 0.97) == {"FINISHED"}
    assert body.skin_tan.skin == "II"
    said = capfd.readouterr().out
    assert "Type II is nearest: colour distance 0." in said
    assert " after adjusting melanin and blood (1 is just seen)." in said
    assert bpy.ops.skin_tan.match_colour(colour=type_colours()["V"], adjust=False) == {"FINISHED"}
    assert body.skin_tan.skin == "V" and not body.skin_tan.biology.is_changed()


def test_from_the_scenes_sample(body):
    bpy.context.scene.skin_tan.sample = type_colours()["IV"]
    bpy.ops.skin_tan.match_colour()
    assert body.skin_tan.skin == "IV"


def test_from_the_own_texture(body):
    colours = np.tile(type_colours()["VI"], (4, 4, 1))
    colours[0, :2] = (0.0, 0.0, 1.0)  # a few texels of something else
    material = artist_skins.empty_material("Skin")
    shader = artist_skins.principled(material.node_tree)
    texture = artist_skins.texture(material.node_tree, colours)
    material.node_tree.links.new(texture.outputs[0], shader.inputs["Base Color"])
    artist_skins.output_of(material.node_tree, shader.outputs[0])
    body.data.materials.append(material)
    assert bpy.ops.skin_tan.match_texture() == {"FINISHED"}
    assert body.skin_tan.skin == "VI"
    apply(body)
    body.skin_tan.skin = "I"
    assert bpy.ops.skin_tan.match_texture() == {"FINISHED"}
    assert body.skin_tan.skin == "VI"


def test_without_a_painted_colour_all_stays(body):
    apply(body)
    with pytest.raises(RuntimeError, match="No painted colour"):
        bpy.ops.skin_tan.match_texture()
    assert body.skin_tan.skin == "III" and not body.skin_tan.biology.is_changed()


def test_sensitivity_by_hand_starts_at_the_skins(body):
    settings = body.skin_tan
    settings.own_minimal_doses = True
    told = catalogue.provenance(III)
    assert settings.mmd == pytest.approx(told["mmd_sed"])
    assert settings.med == pytest.approx(told["med_sed"])
    settings.own_minimal_doses, settings.skin = False, "VI"
    settings.own_minimal_doses = True
    of_six = catalogue.provenance(catalogue.shipped_path("VI"))
    assert settings.med == pytest.approx(of_six["med_sed"])


def test_sensitivity_that_was_set_stays(body):
    settings = body.skin_tan
    settings.mmd, settings.own_minimal_doses = 9.0, True
    assert settings.mmd == 9.0
    settings.own_minimal_doses = False
    settings.own_minimal_doses = True
    assert settings.mmd == 9.0
    assert settings.med == pytest.approx(catalogue.provenance(III)["med_sed"])


def test_sensitivity_without_a_table_stays_at_its_default(body):
    settings = body.skin_tan
    settings.skin, settings.table_path = "FILE", "/nowhere.exr"
    settings.own_minimal_doses = True
    assert settings.mmd == 7.0


def test_a_plain_colour_is_the_painted_one_after_apply_too(body, capfd):
    material = artist_skins.empty_material("Skin")
    shader = artist_skins.principled(material.node_tree)
    shader.inputs["Base Color"].default_value = (*type_colours()["V"], 1.0)
    artist_skins.output_of(material.node_tree, shader.outputs[0])
    body.data.materials.append(material)
    said = []
    for _ in range(2):
        capfd.readouterr()
        bpy.ops.skin_tan.match_texture()
        said.append(capfd.readouterr().out)
        apply(body)
    assert body.skin_tan.skin == "V" and said[0] == said[1]


def test_in_edit_mode_nothing_is_thrown(body):
    colours = np.tile(type_colours()["IV"], (4, 4, 1))
    material = artist_skins.empty_material("Skin")
    shader = artist_skins.principled(material.node_tree)
    texture = artist_skins.texture(material.node_tree, colours)
    material.node_tree.links.new(texture.outputs[0], shader.inputs["Base Color"])
    artist_skins.output_of(material.node_tree, shader.outputs[0])
    body.data.materials.append(material)
    body.data.uv_layers.new(name="UVMap")
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.skin_tan.match_texture() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert body.skin_tan.skin == "IV"


def test_settings_of_a_linked_object_are_not_changed(body, tmp_path):
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, linked):
        linked.objects = ["Body"]
    obj = bpy.data.objects["Body"]
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    for name in ("add_exposure", "match_colour", "match_texture", "choose_type", "add_region"):
        assert not getattr(bpy.ops.skin_tan, name).poll()
    assert bpy.ops.skin_tan.export_exposures.poll()


def with_faces(obj, areas):
    """Squares of given areas in a row, each showing its own column of a texture."""
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
    points = [np.c_[corners * area**0.5, np.full(4, 1.0 * n)] for n, area in enumerate(areas)]
    obj.data.clear_geometry()
    faces = np.arange(4 * len(areas)).reshape(-1, 4).tolist()
    obj.data.from_pydata(np.concatenate(points).tolist(), [], faces)
    columns = np.repeat((np.arange(len(areas)) + 0.5) / len(areas), 4)
    uv = obj.data.uv_layers.new(name="UVMap").uv
    uv.foreach_set("vector", np.c_[columns, np.full(len(columns), 0.5)].ravel())


def textured(colours):
    material = artist_skins.empty_material("Skin")
    shader = artist_skins.principled(material.node_tree)
    texture = artist_skins.texture(material.node_tree, [colours])
    material.node_tree.links.new(texture.outputs[0], shader.inputs["Base Color"])
    artist_skins.output_of(material.node_tree, shader.outputs[0])
    return material


def test_small_faces_count_little(body):
    """Many small faces, as of hands and a face, and one large one."""
    dark, light = type_colours()["VI"], type_colours()["II"]
    body.data.materials.append(textured([dark, light, light, light]))
    with_faces(body, [1.0, 0.3, 0.3, 0.3])
    np.testing.assert_allclose(painted_skin(body), dark, rtol=1e-6)
    with_faces(body, [1.0, 0.4, 0.4, 0.4])
    np.testing.assert_allclose(painted_skin(body), light, rtol=1e-6)


def test_materials_on_small_areas_count_little(body):
    dark, light = type_colours()["VI"], type_colours()["II"]
    with_faces(body, [1.0, 0.3, 0.3])
    for number, colour in enumerate((dark, light, light)):
        body.data.materials.append(textured([colour] * 3))
        body.data.polygons[number].material_index = number
    np.testing.assert_allclose(painted_skin(body), dark, rtol=1e-6)


def test_a_weighted_median_is_that_of_repeated_values():
    random = np.random.default_rng(5)
    for count in (1, 2, 5, 8):
        values, weights = random.random((count, 3)), random.integers(1, 4, count)
        expected = np.median(np.repeat(values, weights, axis=0), axis=0)
        np.testing.assert_allclose(weighted_median(values, weights), expected)
        np.testing.assert_allclose(
            weighted_median(values, np.zeros(count)), np.median(values, axis=0)
        )


@pytest.mark.parametrize("domain", ["POINT", "CORNER"])
@pytest.mark.parametrize("by", ["ShaderNodeVertexColor", "ShaderNodeAttribute"])
def test_from_colours_painted_on_the_mesh(body, by, domain):
    material = artist_skins.plain("Skin")
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    node = material.node_tree.nodes.new(by)
    setattr(node, "layer_name" if by == "ShaderNodeVertexColor" else "attribute_name", "Paint")
    material.node_tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
    body.data.materials.append(material)
    attribute = body.data.color_attributes.new("Paint", "BYTE_COLOR", domain)
    attribute.data.foreach_set("color", np.tile([*type_colours()["V"], 1.0], len(attribute.data)))
    assert bpy.ops.skin_tan.match_texture() == {"FINISHED"}
    assert body.skin_tan.skin == "V"


@pytest.mark.parametrize("is_told", [False, True])
def test_a_texture_is_looked_up_by_its_own_uv_map(body, is_told):
    """Or by the one that renders, not by the one that is selected in the list."""
    colours = np.tile(type_colours()["I"], (4, 4, 1))
    colours[:, :2] = type_colours()["VI"]
    material = artist_skins.empty_material("Skin")
    shader, tree = artist_skins.principled(material.node_tree), material.node_tree
    texture = artist_skins.texture(tree, colours)
    tree.links.new(texture.outputs[0], shader.inputs["Base Color"])
    artist_skins.output_of(tree, shader.outputs[0])
    body.data.materials.append(material)
    layers = body.data.uv_layers
    for name, x in (("light", 0.75), ("dark", 0.25)):
        layer = layers.get(name) or layers.new(name=name)
        layer.uv.foreach_set("vector", np.tile([x, 0.5], len(layer.uv)))
    layers["light" if is_told else "dark"].active_render = True
    layers.active = layers["light"]
    if is_told:
        mapped, mapping = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("UVMap", "Mapping"))
        mapped.uv_map = "dark"
        tree.links.new(mapped.outputs[0], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs[0], texture.inputs["Vector"])
    assert bpy.ops.skin_tan.match_texture() == {"FINISHED"}
    assert body.skin_tan.skin == "VI"
