"""A file by the plan before today's, whose nodes led to places in images, as images do today.

`data/layout_2.blend` was saved in Blender 5.0: Body of type III, masked, with lips, freckles and a
masked film of water. An artist linked a node of his own to the place for thick skin.
"""

from pathlib import Path

import bpy
import pytest
from scenes import add_camera, apply, of_role, render, tan_group, tan_object
from test_layout_1 import labelled
from test_shader import show_emission_of

from blender_addon.model import catalogue
from blender_addon.scene import layout_2, nodes, plan, views
from blender_addon.scene.nodes import role_of
from hylios.lab.colour import difference

FILE = Path(__file__).parents[1] / "data" / "layout_2.blend"


@pytest.fixture
def body():
    bpy.ops.wm.open_mainfile(filepath=str(FILE))
    obj = bpy.data.objects["Body"]
    obj.skin_tan.table_path = str(catalogue.shipped_path("III"))
    return obj


def test_it_shows_what_it_did_after_apply(body, tmp_path):
    """With unevenness and regions; tables that are built anew may change a little."""
    add_camera((2.0, 0.5, 5.0), 4.0)
    show_emission_of("Colour")
    before = render(tmp_path / "row.exr", width=12, height=3)
    assert apply(body) == {"FINISHED"}
    after = render(tmp_path / "row.exr", width=12, height=3)
    assert difference(after, before).mean() < 0.1 and difference(after, before).max() < 0.5


def test_nodes_and_images_are_today_s(body):
    """Besides the one to which the artist's own node is linked."""
    group = body.skin_tan.group
    assert apply(body) == {"FINISHED"}
    assert body.skin_tan.group == group and group[plan.LAYOUT_KEY] == plan.LAYOUT
    former = {*layout_2.PLACES, *layout_2.GLOSS, *layout_2.NORMAL, "through"}
    assert {role_of(node) for node in group.nodes} & former == {"thick_place"}
    (own,) = labelled(group.nodes, "Mine").inputs[0].links
    assert own.from_node == of_role(body, "thick_place")
    assert of_role(body, "mixed_colour").bl_idname == "ShaderNodeVectorMath"
    assert of_role(body, "normal").bl_idname == "ShaderNodeBump"
    assert {image.name for image in nodes.made_images(group)} == {
        image.name for image in bpy.data.images
    }
    count = len(group.nodes)
    assert apply(body) == {"FINISHED"} and len(group.nodes) == count


def test_before_apply_it_shows_no_view(body):
    said = "1100 nm cannot be shown on 'Body': an earlier version made this tan; press Apply Tan"
    with pytest.raises(RuntimeError, match=said):
        bpy.ops.skin_tan.switch_view(view="NM1100")
    assert apply(body) == {"FINISHED"}
    assert bpy.ops.skin_tan.switch_view(view="NM1100") == {"FINISHED"}


def test_without_regions_the_untanned_colour_is_that_of_the_skin(body):
    body.skin_tan.regions.clear()
    assert apply(body) == {"FINISHED"}
    (link,) = of_role(body, "untanned").inputs["Vector"].links
    assert link.from_node == of_role(body, "look_place")
    assert not of_role(body, "untanned").texture_mapping.scale[0]


def as_layout_3(obj) -> None:
    """Have a tan's gloss be as by layout 3, in a view of another band, which a colour tinted."""
    group = tan_group(obj)
    for role in layout_2.SHADERS:
        end = of_role(obj, role).inputs["Specular Tint"]
        group.links.remove(end.links[0])
    former = group.nodes.new("ShaderNodeRGB")
    former.name = f"{plan.ROLE_PREFIX}view_tint"
    group.links.new(former.outputs[0], of_role(obj, "near_skin").inputs["Specular Tint"])
    group[plan.LAYOUT_KEY] = 3


@pytest.mark.parametrize("tint", [(1.0, 1.0, 1.0, 1.0), (1.0, 0.8, 0.6, 1.0)])
def test_gloss_that_was_alike_at_all_angles(table_path, tint):
    """By layout 3, in a view of another band too; an artist's tint stays."""
    obj = tan_object(table_path)
    assert apply(obj) == {"FINISHED"}
    as_layout_3(obj)
    group, end = tan_group(obj), of_role(obj, "skin").inputs["Specular Tint"]
    end.default_value = tint
    assert apply(obj) == {"FINISHED"} and group[plan.LAYOUT_KEY] == plan.LAYOUT
    assert end.is_linked == (tint[1] == 1.0)
    assert not any(node.bl_idname == "ShaderNodeRGB" for node in group.nodes)
    assert tuple(end.default_value) == pytest.approx(tint)


def test_out_of_a_view_by_layout_3_before_apply(table_path):
    obj = tan_object(table_path)
    assert apply(obj) == {"FINISHED"}
    as_layout_3(obj)
    tan_group(obj)[views.VIEW_KEY] = bpy.context.scene[views.VIEW_KEY] = "NM365"
    assert bpy.ops.skin_tan.switch_view(view="VISIBLE") == {"FINISHED"}
    assert views.shown_view(tan_group(obj)) is None and views.view_of_file() is None
    assert not any(node.bl_idname == "ShaderNodeRGB" for node in tan_group(obj).nodes)
    assert not of_role(obj, "near_skin").inputs["Specular Tint"].is_linked
