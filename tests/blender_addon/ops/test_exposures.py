"""The buttons beside the list of exposures, without a window."""

import bpy
import pytest
from scenes import apply, look, tan_object


@pytest.fixture
def body(table_path):
    return tan_object(table_path)


def days(obj):
    return [exposure.day for exposure in obj.skin_tan.exposures]


def test_the_next_is_a_day_after_the_last_and_like_it(body):
    first = body.skin_tan.exposures[0]
    first.unit, first.multiple, first.sunscreen, first.name = "MMD", 3.5, True, "Beach"
    bpy.ops.skin_tan.add_exposure()
    added = body.skin_tan.exposures[1]
    assert (added.day, added.unit, added.multiple, added.sunscreen) == (1.0, "MMD", 3.5, True)
    assert added.name == "" and body.skin_tan.exposure_index == 1
    bpy.ops.skin_tan.add_exposure(name="Boat", day=9.0, dose=4.0)
    boat = body.skin_tan.exposures[2]
    assert (boat.name, boat.day, boat.unit, boat.dose) == ("Boat", 9.0, "SED", 4.0)


def test_the_next_has_no_own_mask_so_a_brush_leaves_that_of_the_last(body):
    body.skin_tan.exposures[0].name = "Shirt"
    bpy.ops.skin_tan.paint_mask(target="EXPOSURE", enter=False)
    bpy.ops.skin_tan.add_exposure()
    assert not body.skin_tan.exposures[1].own_mask
    bpy.ops.skin_tan.paint_mask(target="EXPOSURE", enter=False)
    first, second = (exposure.mask.source for exposure in body.skin_tan.exposures)
    assert first and second and first != second


def test_duplicate_move_and_remove(body):
    for day in (3.0, 5.0):
        bpy.ops.skin_tan.add_exposure(day=day)
    bpy.ops.skin_tan.duplicate_exposure(index=1)
    assert days(body) == [0.0, 3.0, 3.0, 5.0] and body.skin_tan.exposure_index == 2
    bpy.ops.skin_tan.move_exposure(index=3, direction="UP")
    assert days(body) == [0.0, 3.0, 5.0, 3.0]
    assert bpy.ops.skin_tan.move_exposure(index=0, direction="UP") == {"CANCELLED"}
    bpy.ops.skin_tan.remove_exposure(index=0)
    assert days(body) == [3.0, 5.0, 3.0]


def test_one_that_is_off_does_not_count(body):
    bpy.ops.skin_tan.add_exposure(day=2.0)
    apply(body)
    both = look(body)
    body.skin_tan.exposures[1].enabled = False
    apply(body)
    one = look(body)
    body.skin_tan.exposures.remove(1)
    apply(body)
    assert look(body) == one != both


@pytest.mark.parametrize("index", [1, 99, -7])
def test_an_index_that_is_not_in_a_list_is_refused(body, index):
    body.skin_tan.regions.add()
    for name in ("remove_exposure", "duplicate_exposure", "move_exposure", "remove_region"):
        with pytest.raises(RuntimeError, match=f"index is {index}; allowed is 0 to 0"):
            getattr(bpy.ops.skin_tan, name)(index=index)
    assert len(body.skin_tan.exposures) == len(body.skin_tan.regions) == 1
