"""Skin of the right size: units that change after Apply, giants, and no false alarm."""

import bpy
import pytest
from artist_skins import plain, wear
from scenes import apply, of_role, tan_object
from test_changes import inventory

from blender_addon import size as mending
from blender_addon.apply import apply_tan
from blender_addon.ui.size import size_lines
from hylios.errors import InputError


def fit(**keywords) -> set:
    return bpy.ops.skin_tan.fit_size(**keywords)


def lines(obj) -> tuple:
    return size_lines(obj, bpy.context.scene)


def radius(obj) -> float:
    return of_role(obj, "radius").outputs[0].default_value


def detail(obj):
    tree = obj.material_slots[0].material.node_tree
    (node,) = (node for node in tree.nodes if "skin_tan_detail" in node)
    return node


def body(table_path, length: float):
    obj = tan_object(table_path)
    obj.scale = (length,) * 3
    bpy.context.view_layer.update()
    return obj


@pytest.fixture
def tanned(table_path):
    obj = body(table_path, 1.7)
    apply(obj)
    return obj


def test_a_life_size_body_is_let_alone(tanned):
    assert lines(tanned) == ()
    before = inventory()
    assert fit() == {"FINISHED"}
    assert inventory() == before and tanned.skin_tan.model_scale == 1.0


@pytest.mark.parametrize("unit", [0.01, 0.3048, 0.0254, 0.001, 1000.0])
def test_a_shot_in_other_units_is_right_from_the_start(table_path, tanned, unit):
    settings = bpy.context.scene.unit_settings
    settings.system, settings.scale_length = "IMPERIAL", unit
    obj = body(table_path, 1.7 / unit)
    apply(obj)
    assert lines(obj) == ()
    assert radius(obj) == pytest.approx(radius(tanned) / unit)


def test_units_that_change_after_apply_are_mended(tanned, table_path):
    """The artist scales the body with the scene: all is as if applied then, in all objects."""
    other = body(table_path, 1.2)
    other.name = "Other"
    apply(other)
    former = [radius(tanned), radius(other)]
    bpy.context.scene.unit_settings.scale_length = 0.1
    tanned.scale, other.scale = (17.0,) * 3, (12.0,) * 3
    bpy.context.view_layer.update()
    assert lines(tanned) == (
        "Units or scale changed since Apply:",
        "light goes 10 times too short",
    )
    keys = tanned.animation_data.action
    bpy.context.view_layer.objects.active = tanned
    assert fit() == {"FINISHED"}
    assert [radius(tanned), radius(other)] == pytest.approx([10.0 * value for value in former])
    assert detail(tanned).inputs["Millimetre"].default_value == pytest.approx(0.01)
    assert tuple(detail(tanned).inputs["Size"].default_value)[:2] == pytest.approx((1700.0,) * 2)
    assert lines(tanned) == lines(other) == () and tanned.animation_data.action == keys


def test_units_that_change_without_the_body(tanned):
    """Its skin was right, and is again: the body is a hundredth of life-size now."""
    before = radius(tanned)
    bpy.context.scene.unit_settings.scale_length = 0.01
    assert lines(tanned) == ("17 mm is too small for a person:", "its skin glows like wax")
    fit()
    assert tanned.skin_tan.model_scale == pytest.approx(0.01)
    assert radius(tanned) == pytest.approx(before) and lines(tanned) == ()


def test_a_giant_is_mended_by_one_click(table_path, tanned):
    giant = body(table_path, 17.0)
    said = apply_tan(giant, bpy.context.scene)
    assert lines(giant) == ("17 m is too large for a person:", "its skin hardly scatters light")
    assert "too large for a person: its skin hardly scatters light; press Fit Skin" in said
    assert radius(giant) == pytest.approx(radius(tanned))
    assert fit() == {"FINISHED"}
    assert giant.skin_tan.model_scale == pytest.approx(10.0) and lines(giant) == ()
    assert radius(giant) == pytest.approx(10.0 * radius(tanned))
    size = tuple(detail(giant).inputs["Size"].default_value)
    assert size == pytest.approx(tuple(detail(tanned).inputs["Size"].default_value))
    assert "too large" not in apply_tan(giant, bpy.context.scene)
    assert radius(giant) == pytest.approx(10.0 * radius(tanned))
    assert fit(model_scale=8.0) == {"FINISHED"}
    assert radius(giant) == pytest.approx(8.0 * radius(tanned))


def test_before_apply_the_button_sets_the_scale(table_path):
    giant = body(table_path, 170.0)
    fit()
    assert giant.skin_tan.model_scale == pytest.approx(100.0) and lines(giant) == ()


def test_an_artist_s_own_shader_scatters_as_he_set_it(table_path):
    giant = body(table_path, 17.0)
    wear(giant, [plain("skin")])
    assert "person" not in apply_tan(giant, bpy.context.scene) and lines(giant) == ()


def test_a_scale_that_the_artist_sets_waits_for_the_button(tanned):
    tanned.skin_tan.model_scale = 2.0
    assert lines(tanned)[1] == "light goes 2 times too short"
    fit()
    assert lines(tanned) == () and tanned.skin_tan.model_scale == 2.0


def test_what_is_out_of_range_changes_nothing(tanned):
    before = inventory()
    with pytest.raises(InputError, match="model scale"):
        mending.fit_size(tanned, bpy.context.scene, 1e9)
    bpy.context.scene.unit_settings.scale_length = 0.0
    assert lines(tanned) == ()
    assert inventory() == before and tanned.skin_tan.model_scale == 1.0
