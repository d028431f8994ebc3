"""Apply and Copy Tan to Selected on several objects, without a window."""

import bpy
import pytest
from scenes import apply, look, tan_object

from blender_addon.props.copying import values_in


@pytest.fixture
def pair(table_path):
    first, second = tan_object(table_path), tan_object(table_path, dose=12.0)
    first.name, second.name = "First", "Second"
    for obj in (first, second):
        obj.select_set(True)
    bpy.context.view_layer.objects.active = first
    return first, second


def test_an_object_without_exposures_gets_a_day_in_the_sun(table_path):
    body = tan_object(table_path)
    body.skin_tan.exposures.clear()
    apply(body)
    (exposure,) = body.skin_tan.exposures
    assert (exposure.name, exposure.unit) == ("Day in the sun", "MMD") and exposure.multiple > 1.0
    body.skin_tan.exposures.clear()
    apply(body)
    assert not body.skin_tan.exposures  # no sun is what the artist wants now


def test_no_exposure_is_left_where_apply_fails(table_path):
    body = tan_object(table_path)
    body.skin_tan.exposures.clear()
    body.skin_tan.table_path = "/nowhere.exr"
    with pytest.raises(RuntimeError, match="cannot be read"):
        apply(body)
    assert not body.skin_tan.exposures


def test_selected_objects_with_exposures_tan_by_their_own(pair, table_path):
    first, second = pair
    garment = tan_object(table_path)
    garment.skin_tan.exposures.clear()
    garment.select_set(True)
    apply(first)
    assert look(first) != look(second)
    assert garment.skin_tan.group is None  # cloth that was selected with the body
    apply(second)
    alone = look(second)
    apply(first)
    assert look(second) == alone


def test_the_active_one_alone(pair):
    first, second = pair
    bpy.ops.skin_tan.apply(objects="ACTIVE")
    assert first.skin_tan.group is not None and second.skin_tan.group is None


def test_one_that_is_named_is_alone(pair):
    first, second = pair
    with bpy.context.temp_override(active_object=second):
        bpy.ops.skin_tan.apply()
    assert first.skin_tan.group is None and second.skin_tan.group is not None


def test_one_that_cannot_tan_does_not_stop_the_others(pair):
    first, second = pair
    second.skin_tan.table_path = "/nowhere.exr"
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    assert first.skin_tan.group is not None and second.skin_tan.group is None


def test_copy_to_selected(pair):
    first, second = pair
    first.skin_tan.exposures[0].name = "Boat"
    first.skin_tan.last_day = 20.0
    apply(first)
    assert bpy.ops.skin_tan.copy_to_selected() == {"FINISHED"}
    assert second.skin_tan.exposures[0].name == "Boat"
    assert look(first) == look(second)
    assert first.skin_tan.group != second.skin_tan.group
    second.skin_tan.exposures[0].dose = 2.0
    apply(second)
    assert look(first) != look(second)


@pytest.mark.parametrize("tanned", [False, True])
def test_what_cannot_be_copied_leaves_the_other_as_it_was(pair, tanned):
    first, second = pair
    first.data.attributes.new("shirt", "FLOAT", "POINT")
    first.skin_tan.mask.source = "shirt"
    own = second.skin_tan
    own.first_frame, own.timing, own.exposures[0].name = 40, "SCENE", "Boat"
    own.exposures.add().unit = "MMD"
    own.biology.blood = 1.2
    if tanned:
        apply(second)
    apply(first)
    before = values_in(own)
    assert bpy.ops.skin_tan.copy_to_selected() == {"CANCELLED"}
    assert values_in(own) == before
    first.skin_tan.mask.source = ""
    assert bpy.ops.skin_tan.copy_to_selected() == {"FINISHED"}
    assert [exposure.name for exposure in own.exposures] == [""] and own.timing == "SCENE"


def test_what_is_said_of_other_objects_names_them(pair, capfd):
    pair[1].skin_tan.exposures[0].enabled = False
    bpy.ops.skin_tan.apply()
    said = capfd.readouterr().out
    assert "Second: Applied" in said and "All times in the sun of 'Second' are switched off" in said
