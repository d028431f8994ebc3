"""The numbers of a mask, on the mesh: those that are rendered, and what Apply says of odd ones."""

import bpy
import numpy as np
import pytest
from scenes import apply
from test_masks import VALUES, add_attribute, add_group, add_image, add_modifier, body, rendered

from blender_addon import painting
from blender_addon.scene.mask_values import mask_values

__all__ = ["body"]


def values(obj, count: int = 4) -> np.ndarray:
    """One value for each square, of four points and four corners."""
    result = mask_values(obj, obj.skin_tan.shown_mask())
    assert result.shares.dtype == np.float32
    squares = result.shares.reshape(count, 4)
    assert (squares == squares[:, :1]).all()
    return squares[:, 0]


@pytest.mark.parametrize(
    ("data_type", "domain", "values_of"),
    [
        ("FLOAT", "POINT", "POINT"),
        ("FLOAT", "FACE", "CORNER"),
        ("BOOLEAN", "CORNER", "CORNER"),
        ("INT8", "FACE", "CORNER"),
        ("INT", "POINT", "POINT"),
        ("FLOAT_COLOR", "CORNER", "CORNER"),
        ("BYTE_COLOR", "POINT", "POINT"),
    ],
)
@pytest.mark.parametrize(("invert", "strength"), [(False, 1.0), (True, 0.75)])
def test_attributes_as_rendered(body, tmp_path, data_type, domain, values_of, invert, strength):
    whole = data_type in ("BOOLEAN", "INT8", "INT")
    add_attribute(body, data_type, domain, VALUES.round() if whole else VALUES)
    mask = body.skin_tan.mask
    mask.source, mask.channel, mask.invert, mask.strength = "shade", "GREEN", invert, strength
    apply(body)
    assert mask_values(body, body.skin_tan.shown_mask()).domain == values_of
    assert values(body) == pytest.approx(rendered(body, tmp_path), abs=2e-6)


@pytest.mark.parametrize(
    ("is_float", "space"), [(True, "Non-Color"), (False, "Non-Color"), (False, "sRGB")]
)
@pytest.mark.parametrize("channel", ["RED", "MEAN", "ALPHA"])
def test_images_as_rendered(body, tmp_path, is_float, space, channel):
    image = add_image(body, is_float=is_float)
    if not is_float:  # a float image loses its pixels by this
        image.colorspace_settings.name = space
    mask = body.skin_tan.mask
    mask.source, mask.channel, mask.uv_map = "Photo", channel, "Masks"
    # Between two texels, and beyond the edges.
    places = np.repeat([-0.3, 0.375, 0.55, 2.0], 4)
    uv = np.stack([places, np.full(16, 0.5)], axis=1)
    body.data.uv_layers["Masks"].uv.foreach_set("vector", uv.astype(np.float32).ravel())
    apply(body)
    assert values(body) == pytest.approx(rendered(body, tmp_path), abs=0.004)


def test_groups_and_attributes_of_modifiers(body):
    add_group(body)
    body.skin_tan.mask.source = "Skirt"
    assert values(body) == pytest.approx(VALUES)
    add_modifier(body)
    body.skin_tan.mask.source = "made"
    assert values(body) == pytest.approx(0.3)
    body.modifiers.new("Finer", "SUBSURF").levels = 1
    with pytest.raises(ValueError, match="modifiers that make 'made' change the points of 'Body'"):
        values(body)


def test_without_a_mask_all_is_bare(body):
    assert values(body) == pytest.approx(1.0)


def test_no_points_and_no_faces(body):
    """A mesh may hold nothing."""
    body.data.clear_geometry()
    body.data.attributes.new("shade", "FLOAT", "POINT")
    body.skin_tan.mask.source = "shade"
    assert mask_values(body, body.skin_tan.shown_mask()).shares.shape == (0,)
    assert apply(body) == {"FINISHED"}


@pytest.mark.parametrize(
    ("numbers", "sentence"),
    [
        ([0, 0, 0, 0], "By the mask 'shade' the whole body is covered, so nothing tans."),
        ([1, 1, 1, 1], "By the mask 'shade' the whole body is bare."),
        ([np.nan, 0, 1, np.inf], "4 of 16 points of the mask 'shade' have no valid value"),
        ([-2, 0, 1, 1.7], "holds numbers from -2 to 1.7; they are cut to 0 to 1."),
        ([0, 0, 1, 1], None),
    ],
)
def test_what_an_artist_will_not_have_meant_is_told(body, capfd, numbers, sentence):
    add_attribute(body, "FLOAT", "POINT", numbers)
    body.skin_tan.mask.source = "shade"
    capfd.readouterr()
    apply(body)
    said = capfd.readouterr().out
    assert (sentence in said) if sentence else ("mask" not in said)
    assert mask_values(body, body.skin_tan.shown_mask()).shares.max() <= 1.0


def test_edit_mode_is_told(body):
    add_attribute(body, "FLOAT", "POINT")
    body.skin_tan.mask.source = "shade"
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(ValueError, match="cannot be read in Edit Mode; leave Edit Mode"):
        values(body)
    assert apply(body) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    add_group(body)
    body.skin_tan.mask.source = "Skirt"
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(RuntimeError, match="its vertex group 'Skirt' cannot be read; leave Edit"):
        apply(body)
    bpy.ops.object.mode_set(mode="OBJECT")


def test_strokes_on_weights_show(body):
    add_group(body)
    body.skin_tan.mask.source = "Skirt"
    apply(body)
    body.vertex_groups["Skirt"].add(range(16), 0.5, "REPLACE")
    painting.show_strokes()
    copy = body.data.attributes["skin_tan_Skirt"].data
    assert copy[0].value == 0.0
    bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
    painting.show_strokes()
    assert {item.value for item in body.data.attributes["skin_tan_Skirt"].data} == {0.5}
    bpy.ops.object.mode_set(mode="OBJECT")
