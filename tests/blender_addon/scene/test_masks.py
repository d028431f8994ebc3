"""Whatever can be a mask: rendered, the share of the dose is its number."""

from pathlib import Path

import bpy
import numpy as np
import pytest
from scenes import add_camera, apply, of_role, render, tan_group, tan_object

from blender_addon.props.mask import usable_names
from blender_addon.scene import mask_nodes, masks, vertex_groups
from blender_addon.scene.changes import Changes

DATA = Path(__file__).parents[1] / "data"
VALUES = np.array([0.0, 0.25, 0.6, 1.0])


@pytest.fixture
def body(table_path):
    """Four squares in a row, one material, no mask."""
    obj = tan_object(table_path, VALUES)
    obj.data.attributes.remove(obj.data.attributes["sun"])
    obj.skin_tan.mask.source = ""
    return obj


def add_attribute(obj, data_type: str, domain: str, values=VALUES, name: str = "shade") -> None:
    """An attribute with a value for each square; a colour has it in green."""
    obj.data.attributes.new(name, data_type, domain)
    data = obj.data.attributes[name].data
    for index, item in enumerate(data):
        value = float(values[index * len(values) // len(data)])
        if data_type.endswith("COLOR"):
            item.color = (0.1, value, 0.1, 0.5)
        else:
            item.value = type(item.value)(value)


def rendered(obj, tmp_path) -> np.ndarray:
    """Share of the dose in the middle of each square."""
    tree = obj.material_slots[0].material.node_tree
    (skin,) = (node for node in tree.nodes if "Surface" in node.outputs)
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(skin.outputs["Share"], emission.inputs["Color"])
    tree.links.new(emission.outputs["Emission"], tree.nodes["Material Output"].inputs["Surface"])
    if bpy.context.scene.camera is None:
        add_camera((len(VALUES) / 2, 0.5, 5.0), len(VALUES))
    pixels = render(tmp_path / "row.exr", width=3 * len(VALUES), height=3)
    return pixels[1, 1::3, 0]


@pytest.mark.parametrize(
    ("data_type", "domain"),
    [
        ("FLOAT", "POINT"),
        ("FLOAT", "CORNER"),
        ("FLOAT", "FACE"),
        ("BOOLEAN", "FACE"),
        ("INT8", "POINT"),
        ("INT", "CORNER"),
    ],
)
def test_numbers(body, tmp_path, data_type, domain):
    values = VALUES if data_type == "FLOAT" else VALUES.round()
    add_attribute(body, data_type, domain, values)
    body.skin_tan.mask.source = "shade"
    apply(body)
    assert rendered(body, tmp_path) == pytest.approx(values, abs=1e-6)


@pytest.mark.parametrize(
    ("data_type", "domain"), [("FLOAT_COLOR", "CORNER"), ("BYTE_COLOR", "POINT")]
)
def test_channels_of_a_colour(body, tmp_path, data_type, domain):
    add_attribute(body, data_type, domain)
    mask = body.skin_tan.mask
    mask.source = "shade"
    apply(body)
    for channel, expected in (
        ("GREEN", VALUES),
        ("RED", 0.1),
        ("MEAN", (VALUES + 0.2) / 3.0),
        ("ALPHA", 0.5),
    ):
        mask.channel = channel  # shows without Apply
        assert rendered(body, tmp_path) == pytest.approx(expected + 0 * VALUES, abs=0.003)


def add_group(obj, values=VALUES, name: str = "Skirt"):
    group = obj.vertex_groups.new(name=name)
    for point in range(len(obj.data.vertices)):
        if values[point // 4] > 0.0:
            group.add([point], float(values[point // 4]), "REPLACE")
    return group


def test_a_vertex_group_through_an_attribute_of_our_own(body, tmp_path):
    add_group(body)
    body.skin_tan.mask.source = "Skirt"
    apply(body)
    assert of_role(body, "mask").attribute_name == "skin_tan_Skirt"
    assert rendered(body, tmp_path) == pytest.approx(VALUES, abs=1e-6)
    body.vertex_groups["Skirt"].add(range(16), 0.5, "REPLACE")
    apply(body)
    assert rendered(body, tmp_path) == pytest.approx(0.5)
    names = set(body.data.attributes.keys())
    assert sum(name.startswith("skin_tan") for name in names) == 1
    assert bpy.ops.skin_tan.remove() == {"FINISHED"}
    assert set(body.data.attributes.keys()) == names - {"skin_tan_Skirt"}
    assert masks.COPIES_KEY not in body.data


@pytest.mark.parametrize("name", ["density", "x" * 63, "ß" * 31, "Delete.shirt", 'quote " and \\'])
def test_a_vertex_group_of_any_name(body, tmp_path, name):
    name = add_group(body, name=name).name
    body.skin_tan.mask.source = name
    apply(body)
    apply(body)
    assert rendered(body, tmp_path) == pytest.approx(VALUES, abs=1e-6)
    offered = masks.usable_sources(body, None)
    assert [source.name for source in offered] == [name]


def test_an_attribute_of_the_artist_s_under_the_copy_s_name_stays(body, tmp_path):
    add_attribute(body, "FLOAT", "POINT", VALUES[::-1], "skin_tan_Skirt")
    add_group(body)
    body.skin_tan.mask.source = "Skirt"
    apply(body)
    assert rendered(body, tmp_path) == pytest.approx(VALUES, abs=1e-6)
    with Changes() as changes:
        vertex_groups.remove_own(body, changes)
    values = [item.value for item in body.data.attributes["skin_tan_Skirt"].data]
    assert values[::4] == pytest.approx(VALUES[::-1])


def test_copies_that_another_object_s_mask_needs_stay(body):
    add_group(body)
    body.skin_tan.mask.source = "Skirt"
    apply(body)
    twin = body.copy()
    with Changes() as changes:
        vertex_groups.remove_own(body, changes)
    assert "skin_tan_Skirt" in body.data.attributes
    twin.skin_tan.mask.source = ""
    with Changes() as changes:
        vertex_groups.remove_own(body, changes)
    assert "skin_tan_Skirt" not in body.data.attributes


def add_modifier(obj) -> None:
    """Geometry nodes that store 0.3 on the points as `made`."""
    tree = bpy.data.node_groups.new("Store", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    store = tree.nodes.new("GeometryNodeStoreNamedAttribute")
    store.inputs["Name"].default_value, store.inputs["Value"].default_value = "made", 0.3
    tree.links.new(start.outputs[0], store.inputs["Geometry"])
    tree.links.new(store.outputs[0], end.inputs[0])
    obj.modifiers.new("Store", "NODES").node_group = tree


def test_an_attribute_that_geometry_nodes_make(body, tmp_path):
    add_modifier(body)
    body.skin_tan.mask.source = "made"
    apply(body)
    assert rendered(body, tmp_path) == pytest.approx(0.3)


def add_image(obj, *, is_float: bool = True, name: str = "Photo"):
    """An image of four texels, one for each square, and a UV map that is not the active one."""
    image = bpy.data.images.new(name, 4, 1, float_buffer=is_float)
    image.colorspace_settings.name = "Non-Color"
    pixels = np.ones((4, 4), np.float32)
    pixels[:, 0], pixels[:, 1], pixels[:, 2] = VALUES, 1.0 - VALUES, 0.0
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    image.pack()
    obj.data.uv_layers.new(name="Active")
    layer = obj.data.uv_layers.new(name="Masks")
    centres = np.repeat((np.arange(4) + 0.5) / 4, 4)
    layer.data.foreach_set("uv", np.stack([centres, np.full(16, 0.5)], axis=1).ravel())
    return image


def test_an_image_on_its_uv_map(body, tmp_path):
    image = add_image(body)
    mask = body.skin_tan.mask
    mask.source, mask.channel, mask.uv_map = "Photo", "RED", "Masks"
    assert mask.image == image
    apply(body)
    assert rendered(body, tmp_path) == pytest.approx(VALUES, abs=1e-6)
    image.name = "Renamed"
    apply(body)
    assert rendered(body, tmp_path) == pytest.approx(VALUES, abs=1e-6)
    mask.channel = "GREEN"
    assert rendered(body, tmp_path) == pytest.approx(1.0 - VALUES, abs=1e-6)
    add_attribute(body, "FLOAT", "POINT", VALUES[::-1])
    mask.source = "shade"
    assert mask.image is None
    assert rendered(body, tmp_path) == pytest.approx(VALUES[::-1], abs=1e-6)


@pytest.mark.parametrize(
    ("invert", "strength", "expected"),
    [(False, 0.5, 0.5 + 0.5 * VALUES), (True, 1.0, 1 - VALUES), (True, 0.25, 1 - 0.25 * VALUES)],
)
def test_invert_and_strength_show_at_once(body, tmp_path, invert, strength, expected):
    add_attribute(body, "FLOAT", "POINT")
    apply(body)
    mask = body.skin_tan.mask
    mask.source, mask.invert, mask.strength = "shade", invert, strength
    assert rendered(body, tmp_path) == pytest.approx(expected, abs=1e-6)
    mask.source = ""
    assert rendered(body, tmp_path) == pytest.approx(1.0)


@pytest.mark.parametrize("invert", [False, True])
def test_no_number_counts_as_0_and_others_are_cut(body, tmp_path, invert):
    add_attribute(body, "FLOAT", "POINT", [np.nan, -2.0, 1.7, np.inf])
    mask = body.skin_tan.mask
    mask.source, mask.strength, mask.invert = "shade", 0.5, invert
    apply(body)
    expected = np.array([0.5, 0.5, 1.0, 1.0])
    assert rendered(body, tmp_path) == pytest.approx(1.5 - expected if invert else expected)


def test_another_mask_leaves_the_skin_of_others(body, tmp_path):
    """And an artist's own nodes and links."""
    add_attribute(body, "FLOAT", "POINT")
    apply(body)
    twin = body.copy()
    body.skin_tan.mask.source = "shade"
    assert of_role(body, "mask").attribute_name == ""
    bpy.data.objects.remove(twin)
    group = tan_group(body)
    number = group.nodes.new("ShaderNodeValue")
    number.outputs[0].default_value = 0.7
    group.links.new(number.outputs[0], of_role(body, "share").inputs[0])
    body.skin_tan.mask.strength = 0.9
    assert of_role(body, "mask").attribute_name == "shade"
    assert rendered(body, tmp_path) == pytest.approx(0.1 + 0.9 * 0.7)


def test_the_name_of_version_0_1_0_is_the_source(body):
    add_attribute(body, "FLOAT", "POINT")
    settings = body.skin_tan
    settings.mask_attribute = "shade"
    assert settings.mask.source == "shade"
    settings.mask.source = ""
    assert settings.mask_attribute == "" and not settings.object_mask()
    settings.mask.source = "shade"
    assert settings.mask_attribute == "shade"


def test_a_file_of_an_earlier_version_has_its_mask(tmp_path):
    """By its former name alone, until another one is chosen."""
    bpy.ops.wm.open_mainfile(filepath=str(DATA / "layout_1.blend"))
    settings = bpy.data.objects["Body"].skin_tan
    assert settings.mask.source == "" and settings.object_mask().source == "sun"
    settings.mask.source = "Other"
    settings.mask.source = ""
    assert not settings.object_mask()


def test_settings_of_what_is_no_mesh_take_any_mask(capfd):
    """Blender prints what goes wrong where a setting is followed, and raises nothing."""
    light = bpy.data.objects.new("Light", bpy.data.lights.new("Light", "POINT"))
    light.skin_tan.mask.source = "shade"
    light.skin_tan.mask.image = bpy.data.images.new("Photo", 4, 4)
    light.skin_tan.mask.image = None
    light.skin_tan.mask.strength = 0.5
    assert "Traceback" not in "".join(capfd.readouterr())


def test_an_exposure_s_own_mask(body, tmp_path):
    add_attribute(body, "FLOAT", "POINT")
    exposure = body.skin_tan.exposures[0]
    exposure.own_mask, exposure.mask.source = True, "shade"
    apply(body)
    assert rendered(body, tmp_path) == pytest.approx(VALUES, abs=1e-6)
    body.skin_tan.exposures.add()
    apply(body)
    doses = [exposure.dose for exposure in body.skin_tan.exposures]
    share = (doses[0] * VALUES + doses[1]) / sum(doses)
    assert rendered(body, tmp_path) == pytest.approx(share, abs=1e-6)
    body.skin_tan.exposures[1].own_mask = True
    body.skin_tan.exposures[1].mask.source = "absent"
    with pytest.raises(RuntimeError, match="The mesh has no 'absent', which is set as a mask"):
        apply(body)


def test_what_is_on_offer(body):
    for data_type in ("FLOAT", "FLOAT_COLOR", "BOOLEAN", "FLOAT_VECTOR", "FLOAT2"):
        body.data.attributes.new(data_type, data_type, "POINT")
    body.data.attributes.new("edges", "FLOAT", "EDGE")
    body.data.attributes.new("density", "FLOAT", "POINT")
    body.data.attributes.new("material_index", "INT", "FACE")
    add_group(body)
    add_modifier(body)
    bpy.data.images.new("Photo", 4, 4)
    body.skin_tan.mask.source = "Skirt"
    apply(body)
    offered = {
        item.name: item.label for item in masks.usable_sources(body, masks.current_depsgraph())
    }
    expected = {
        "FLOAT": "Number, points",
        "FLOAT_COLOR": "Colour, points",
        "BOOLEAN": "Yes or no, points",
        "Skirt": "Vertex group",
        "made": "Number, points, by a modifier",
    }
    assert offered == expected
    mask = body.skin_tan.mask
    assert dict(usable_names(mask, bpy.context, "")) == expected
    body.data.uv_layers.new()
    offered = masks.usable_sources(body, masks.current_depsgraph())
    assert {item.name for item in offered} == {*expected, "Photo"}


def test_what_is_gone_is_told(body):
    image = add_image(body)
    mask = body.skin_tan.mask
    mask.source, mask.uv_map = "Photo", "Absent"
    with pytest.raises(RuntimeError, match="no UV map 'Absent'; allowed are: Active, M"):
        apply(body)
    bpy.data.images.remove(image)
    with pytest.raises(RuntimeError, match="no 'Photo', which is set as a mask"):
        apply(body)
    group = add_group(body)
    mask.source = "Skirt"
    group.name = "Dress"
    with pytest.raises(RuntimeError, match="no 'Skirt', which is set as a mask; .*: Dress"):
        apply(body)


def test_an_image_needs_a_uv_map_and_pixels(body):
    image = bpy.data.images.new("Photo", 4, 4)
    body.skin_tan.mask.image = image
    assert body.skin_tan.mask.source == "Photo"
    with pytest.raises(RuntimeError, match="the image 'Photo', and 'Body' has no UV map"):
        apply(body)
    body.data.uv_layers.new()
    assert apply(body) == {"FINISHED"}
    image.source, image.filepath = "FILE", "//missing.png"
    image.reload()
    with pytest.raises(RuntimeError, match="'Photo', which is the mask, has no pixels; its file"):
        apply(body)


def test_an_error_leaves_mesh_and_nodes_as_they_were(body):
    apply(body)
    group = tan_group(body)
    add_group(body)
    image = add_image(body)

    def state() -> tuple:
        nodes = {(node.name, getattr(node, "attribute_name", "")) for node in group.nodes}
        links = {(link.from_node.name, link.to_node.name) for link in group.links}
        return nodes, links, set(body.data.attributes.keys()), dict(body.data)

    before = state()
    for mask in (masks.Mask("Skirt"), masks.Mask(image=image)):
        with pytest.raises(ZeroDivisionError), Changes() as changes:
            mask_nodes.show(group, mask_nodes.shown_mask(body, mask, changes), changes)
            assert state() != before
            raise ZeroDivisionError
        assert state() == before
