"""From a clothed character to tan lines in two buttons, as the artist's guide tells it."""

import bpy
import numpy as np
import pytest
from artist_skins import PAINTED, plain

from blender_addon.scene.mask_values import mask_values


@pytest.fixture
def character():
    """A body and a garment that an artist has selected, the body last."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5, radius=0.5)
    body = bpy.context.view_layer.objects.active
    body.data.materials.append(plain("body skin"))
    bpy.ops.mesh.primitive_cylinder_add(radius=0.505, depth=0.3, vertices=96)
    garment = bpy.context.view_layer.objects.active
    body.select_set(True)
    bpy.context.view_layer.objects.active = body
    return body, garment


def test_two_buttons_lead_from_a_clothed_character_to_tan_lines(character):
    body, garment = character
    bpy.ops.skin_tan.mask_from_clothes(target="OBJECT")
    bpy.ops.skin_tan.apply(show=True)
    settings = body.skin_tan
    shares = mask_values(body, settings.shown_mask()).shares
    assert 0.1 < np.mean(shares == 0.0) and 0.3 < np.mean(shares == 1.0)
    assert bpy.context.scene.frame_current > 30 and 4.0 < body["tan_day"] < 8.0
    material = body.active_material
    colour = material.node_tree.nodes["Principled BSDF"].inputs["Base Color"]
    assert material.name == "body skin" and colour.links[0].from_node.label == "Tan"
    assert colour.default_value[:3] == pytest.approx(PAINTED)
    assert not garment.skin_tan.exposures and garment.skin_tan.group is None
