"""Live: changes of settings show without Apply, and outlast undo, saving and loading.

Timers need a window; here what they call is called instead.
"""

import bpy
import numpy as np
import pytest
from scenes import apply, look, of_role, pixels, tan_object

from blender_addon import applied, live, timers
from blender_addon.model import catalogue
from blender_addon.model.tan import history_of
from blender_addon.scene import exr


@pytest.fixture
def body(table_path):
    obj = tan_object(table_path)
    apply(obj)
    return obj


def stale() -> bool:
    scene = bpy.context.scene
    return any(applied.is_changed(obj, scene) for obj in scene.objects)


def states(obj) -> np.ndarray:
    return pixels(of_role(obj, "states").image)[..., :3]


def test_a_new_schedule_shows_and_becomes_exact(body):
    assert not stale()
    body.skin_tan.exposures[0].dose = 8.0
    assert stale()
    before = look(body)
    live.show_changes()
    roughly = look(body)
    assert roughly != before and stale()
    expected = history_of(body.skin_tan.values())
    live.make_exact()
    assert not stale()
    np.testing.assert_array_equal(states(body), exr.rounded(expected.coordinates))


def test_a_drag_that_ends_where_it_began(body):
    before = look(body)
    for dose in (8.0, 30.0):
        body.skin_tan.exposures[0].dose = dose
        live.show_changes()
    live.make_exact()
    assert look(body) == before


def test_what_shows_while_dragging_is_near_what_stays(body, tmp_path):
    from scenes import add_camera, render, white_world

    add_camera((0.5, 0.5, 1.0), 1.0)
    white_world()
    bpy.context.scene.frame_set(80)
    body.skin_tan.exposures[0].dose = 12.0
    live.show_changes()
    roughly = render(tmp_path / "roughly.exr", width=4, height=4, samples=16)
    live.make_exact()
    exactly = render(tmp_path / "exactly.exr", width=4, height=4, samples=16)
    np.testing.assert_allclose(roughly, exactly, atol=0.01)


@pytest.mark.parametrize(
    ("name", "value"), [("last_day", 12.0), ("own_minimal_doses", True), ("timing", "SPEED")]
)
def test_other_settings_show_too(body, name, value):
    setattr(body.skin_tan, name, value)
    assert stale()
    live.show_changes()
    live.make_exact()
    assert not stale()


def test_another_sensitivity_leads_to_what_apply_shows(body):
    """The look lies along the states that skin of these doses reaches."""
    body.skin_tan.own_minimal_doses, body.skin_tan.med = True, 9.0
    body.skin_tan.mmd = 15.0
    live.show_changes()
    live.make_exact()
    shown = look(body)
    apply(body)
    assert look(body) == shown


def test_undo_of_another_sensitivity_leads_to_the_look_that_was(body, monkeypatch, capfd):
    """States of doses by hand lie elsewhere than the look of before tells."""
    monkeypatch.setattr(timers, "are_called", lambda: True)
    bpy.ops.ed.undo_push(message="applied")
    before = look(body)
    body.skin_tan.own_minimal_doses, body.skin_tan.mmd = True, 15.0
    bpy.ops.ed.undo_push(message="sensitivity")
    live.show_changes()
    live.make_exact()
    after = look(body)
    for go, expected in (("undo", before), ("undo", before), ("redo", before), ("redo", after)):
        getattr(bpy.ops.ed, go)()
        live.make_exact()
        body = bpy.data.objects["Body"]
        is_between = look(body) == before and body.skin_tan.own_minimal_doses
        assert look(body) == expected
        assert stale() == is_between
    assert "ERROR" not in capfd.readouterr().out  # Blender looks for no file of a packed image


def test_no_tan_is_made_where_there_was_none(table_path):
    obj = tan_object(table_path)
    obj.skin_tan.exposures[0].dose = 3.0
    live.show_changes()
    live.make_exact()
    assert obj.skin_tan.group is None


def test_off_by_a_checkbox(body):
    body.skin_tan.live = False
    body.skin_tan.exposures[0].dose = 3.0
    before = look(body)
    live.show_changes()
    live.make_exact()
    assert look(body) == before and stale()
    apply(body)
    assert not stale()


def test_a_setting_that_cannot_be_used_changes_nothing(body):
    before = look(body)
    body.skin_tan.table_path = "/nowhere.exr"
    live.show_changes()
    live.make_exact()
    assert look(body) == before and stale()


def test_another_object_with_the_group_keeps_its_look(body):
    other = body.copy()
    bpy.context.collection.objects.link(other)
    before = look(other)
    body.skin_tan.exposures[0].dose = 3.0
    live.show_changes()
    assert look(other) == before != look(body)


def test_images_of_the_artist_s_own_are_left(body):
    image = bpy.data.images.new("Own", 4, 4, float_buffer=True)
    of_role(body, "states").image = image
    body.skin_tan.exposures[0].dose = 3.0
    before = pixels(image).copy()
    live.show_changes()
    np.testing.assert_array_equal(pixels(image), before)


def test_what_is_saved_is_exact_and_lasts(body, tmp_path):
    body.skin_tan.exposures[0].dose = 8.0
    live.show_changes()
    live.make_exact()
    path = str(tmp_path / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    shown = states(body)
    bpy.ops.wm.open_mainfile(filepath=path)
    body = bpy.data.objects["Body"]
    np.testing.assert_array_equal(states(body), shown)
    assert not stale()


def test_a_file_of_an_earlier_version_waits_for_apply(body):
    body.skin_tan.property_unset("applied")
    before = look(body)
    body.skin_tan.exposures[0].dose = 3.0
    live.show_changes()
    assert look(body) == before and not stale()


@pytest.mark.parametrize("name", ["dose", pytest.param("blood", marks=pytest.mark.slow)])
def test_without_a_window_undo_leads_back_to_the_picture_that_was(name):
    apply(tan_object(catalogue.shipped_path("III")))
    bpy.ops.ed.undo_push(message="applied")
    pictures = [look(bpy.data.objects["Body"])]

    def change() -> None:
        settings = bpy.data.objects["Body"].skin_tan
        if name == "dose":
            settings.exposures[0].dose = 9.0
        else:
            settings.biology.blood = 1.5

    for message, act in (("changed", change), ("applied again", apply)):
        act()
        bpy.ops.ed.undo_push(message=message)
        pictures.append(look(bpy.data.objects["Body"]))
    assert pictures[0] == pictures[1] != pictures[2]
    for act, picture in zip(
        (bpy.ops.ed.undo, bpy.ops.ed.undo, bpy.ops.ed.redo, bpy.ops.ed.redo),
        (1, 0, 1, 2),
        strict=True,
    ):
        act()
        assert look(bpy.data.objects["Body"]) == pictures[picture]
        assert stale() == (picture == 1)
