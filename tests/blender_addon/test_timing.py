"""Days on the timeline: by the scene, at a speed, between frames, or by the artist's own keys."""

import bpy
import pytest
from bpy_extras.anim_utils import action_get_channelbag_for_slot
from scenes import apply, tan_object

from blender_addon import applied, live


@pytest.fixture
def body(table_path):
    return tan_object(table_path)


def curve(obj):
    animation = obj.animation_data
    bag = action_get_channelbag_for_slot(animation.action, animation.action_slot)
    return bag.fcurves.find('["tan_day"]')


def keys(obj):
    return [tuple(point.co) for point in curve(obj).keyframe_points]


def day_at(obj, frame, subframe=0.0):
    bpy.context.scene.frame_set(frame, subframe=subframe)
    return obj["tan_day"]


def test_days_lie_over_the_scene_s_own_frames(body):
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1001, 1100
    apply(body)
    assert keys(body) == [(1001, 0), (1100, 30)]
    scene.frame_end = 1061
    apply(body)
    assert keys(body) == [(1001, 0), (1061, 30)]
    assert day_at(body, 1031, 0.5) == pytest.approx(15.25)


def test_a_scene_of_one_frame_shows_the_first_day(body):
    scene = bpy.context.scene
    scene.frame_start = scene.frame_end = 7
    body.skin_tan.first_day = 9.0
    apply(body)
    assert day_at(body, 7) == 9.0


def test_start_and_speed(body):
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = 30, 1.0
    settings = body.skin_tan
    settings.timing, settings.first_frame, settings.days_per_second = "SPEED", 11, 3.0
    apply(body)
    assert keys(body) == [(11, 0), (311, 30)]


def test_frames_that_a_script_sets_count(body):
    body.skin_tan.first_frame, body.skin_tan.last_frame = 40, 60
    apply(body)
    assert keys(body) == [(40, 0), (60, 30)]


@pytest.mark.parametrize("edit", ["third key", "moved key", "noise", "bezier", "deleted"])
def test_own_keys_stay_until_reset(body, edit):
    apply(body)
    made = curve(body)
    if edit == "third key":
        made.keyframe_points.insert(100, 4.0)
    elif edit == "moved key":
        made.keyframe_points[1].co.x = 99
    elif edit == "noise":
        made.modifiers.new("NOISE")
    elif edit == "bezier":
        made.keyframe_points[0].interpolation = "BEZIER"
    else:
        while made.keyframe_points:
            made.keyframe_points.remove(made.keyframe_points[0])
    before = keys(body)
    body.skin_tan.last_day = 20.0
    apply(body)
    assert keys(body) == before and len(curve(body).modifiers) == (edit == "noise")
    assert bpy.ops.skin_tan.reset_timing() == {"FINISHED"}
    assert keys(body) == [(1, 0), (250, 20)]
    body.skin_tan.last_day = 10.0
    apply(body)
    assert keys(body) == [(1, 0), (250, 10)]


def test_own_keys_asked_for_are_never_touched(body):
    body.skin_tan.timing = "OWN"
    body["tan_day"] = 12.5
    apply(body)
    assert body.animation_data is None and body["tan_day"] == 12.5
    del body["tan_day"]
    body.skin_tan.first_day = 3.0
    apply(body)
    assert body.animation_data is None and body["tan_day"] == 3.0


def test_a_retimed_strip_stays(body):
    apply(body)
    animation = body.animation_data
    strip = animation.nla_tracks.new().strips.new("days", 1, animation.action)
    strip.scale = 2.0
    animation.action = None
    apply(body)
    assert animation.action is None and day_at(body, 250) == pytest.approx(15.0, abs=0.1)


def test_keys_of_a_file_from_before_there_was_a_choice(body):
    """Such a file has Apply's keys and no note of them; its frames count, not the scene's."""
    apply(body)
    for name in ("keyed", "timing"):
        body.skin_tan.property_unset(name)
    bpy.context.scene.frame_end = 99
    apply(body)
    assert keys(body) == [(1, 0), (250, 30)]


def test_the_darkest_day_is_shown(body):
    apply(body)
    days = {}
    assert bpy.ops.skin_tan.go_to_darkest_day() == {"FINISHED"}
    darkest = bpy.context.scene.frame_current
    for frame in (darkest - 30, darkest, darkest + 30):
        days[frame] = day_at(body, frame)
    # The strongest tan of one exposure comes after 5 to 12 days (thesis, figure 6.21).
    assert 5.0 < days[darkest] < 12.0


def test_the_darkest_day_needs_keys(body):
    with pytest.raises(RuntimeError, match="has no keys"):
        bpy.ops.skin_tan.go_to_darkest_day()


def test_a_frame_that_only_comes_near_is_said_so(body, capfd):
    scene = bpy.context.scene
    scene.frame_start = scene.frame_end = 1
    apply(body)
    capfd.readouterr()
    bpy.ops.skin_tan.go_to_darkest_day()
    assert "Frame 1 shows day 0, the nearest to the darkest day" in capfd.readouterr().out


def test_a_tan_that_nobody_sees_is_said(body, capfd):
    body.skin_tan.exposures[0].dose = 0.0
    apply(body)
    bpy.context.scene.frame_set(33)
    bpy.ops.skin_tan.go_to_darkest_day()
    assert "No tan can be seen" in capfd.readouterr().out
    assert bpy.context.scene.frame_current == 33


def test_a_strip_that_governs_the_day_is_said(body, capfd):
    apply(body)
    animation = body.animation_data
    animation.nla_tracks.new().strips.new("days", 50, animation.action)
    animation.action = None
    bpy.ops.skin_tan.go_to_darkest_day()
    assert "A driver or a strip of the NLA governs" in capfd.readouterr().out


def test_remove_leaves_keys_of_one_s_own(body):
    body.skin_tan.timing = "OWN"
    body["tan_day"] = 4.0
    body.keyframe_insert('["tan_day"]', frame=7)
    before = keys(body)
    apply(body)
    bpy.ops.skin_tan.remove()
    assert keys(body) == before and body["tan_day"] == 4.0


def test_own_keys_that_are_not_there_yet_are_said(body, capfd):
    body.skin_tan.timing = "OWN"
    assert bpy.ops.skin_tan.apply(show=True) == {"FINISHED"}
    assert body.skin_tan.group is not None
    assert "has no keys, so all frames show day 0: key the property" in capfd.readouterr().out


def test_a_curve_without_keys_or_muted_is_said(body, capfd):
    apply(body)
    curve(body).mute = True
    apply(body)
    assert "The curve of the day is muted" in capfd.readouterr().out
    curve(body).mute = False
    curve(body).keyframe_points.clear()
    apply(body)
    said = capfd.readouterr().out
    assert "has no keys" in said and "your own" not in said


def test_reset_says_that_a_driver_governs_the_day(body, capfd):
    apply(body)
    body.driver_add('["tan_day"]').driver.expression = "3.0"
    bpy.ops.skin_tan.reset_timing()
    assert "A driver governs the day of the tan" in capfd.readouterr().out


def test_keys_under_a_driver_go_with_the_tan_and_the_driver_stays(body, capfd):
    apply(body)
    body.driver_add('["tan_day"]').driver.expression = "3.0"
    body.skin_tan.last_day = 20.0
    apply(body)  # so that they are right should the driver go
    assert keys(body) == [(1, 0), (250, 20)]
    capfd.readouterr()
    bpy.ops.skin_tan.remove()
    assert "A driver governs the property 'tan_day', which stays" in capfd.readouterr().out
    assert not bpy.data.actions and body.animation_data.action is None
    assert day_at(body, 50) == 3.0 and len(body.animation_data.drivers) == 1


def live_shows():
    live.show_changes()
    live.make_exact()


def test_live_leaves_the_days_where_apply_met_the_scene(body):
    """Whatever range is set for a test render, and in another scene too."""
    scene = bpy.context.scene
    apply(body)
    made = [(1, 0), (250, 30)]
    scene.frame_start, scene.frame_end = 95, 105
    live_shows()
    assert keys(body) == made and applied.is_left_behind(body, scene)
    assert not applied.is_changed(body, scene)
    body.skin_tan.last_day = 20.0
    live_shows()
    assert keys(body) == [(1, 0), (250, 20)] and not applied.is_changed(body, scene)
    other = bpy.data.scenes.new("Shot")
    other.frame_end = 1000
    other.collection.objects.link(body)
    bpy.context.window.scene = other
    live_shows()
    assert keys(body) == [(1, 0), (250, 20)]
    bpy.context.window.scene = scene
    apply(body)
    assert keys(body) == [(95, 0), (105, 20)] and not applied.is_left_behind(body, scene)


@pytest.mark.parametrize("way", ["SCENE", "SPEED"])
def test_reset_timing_follows_the_scene_and_live_stays_there(body, way):
    scene = bpy.context.scene
    body.skin_tan.timing = way
    apply(body)
    scene.frame_end, scene.render.fps = 99, 60
    assert applied.is_left_behind(body, scene)
    bpy.ops.skin_tan.reset_timing()
    assert not applied.is_left_behind(body, scene) and not live._stale(scene)
    reset = keys(body)
    body.skin_tan.exposures[0].dose = 3.0
    live_shows()
    apply(body)
    assert keys(body) == reset and reset[1][0] == (99 if way == "SCENE" else 601)
