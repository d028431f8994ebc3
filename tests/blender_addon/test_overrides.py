"""Library overrides: settings stay with the shot, and the shot keys its own days."""

import bpy
import pytest
from scenes import apply, tan_object


@pytest.fixture
def shot(table_path, tmp_path):
    """The file of a shot, with an override of a tanned character from another file."""
    body = tan_object(table_path)
    apply(body)
    library = str(tmp_path / "character.blend")
    bpy.ops.wm.save_as_mainfile(filepath=library)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(library, link=True) as (_, linked):
        linked.objects = ["Body"]
    linked = bpy.data.objects["Body"]
    bpy.context.collection.objects.link(linked)
    override = linked.override_hierarchy_create(bpy.context.scene, bpy.context.view_layer)
    bpy.context.view_layer.objects.active = override
    return str(tmp_path / "shot.blend")


def body():
    return next(obj for obj in bpy.context.scene.objects if obj.override_library)


def reopened(path):
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    return body()


def test_settings_survive_a_reload(shot):
    settings = body().skin_tan
    settings.last_day = 21.0
    settings.exposures[0].dose = 5.0
    settings.mask.invert = True
    added = settings.exposures.add()
    added.name, added.day = "Boat", 4.0
    settings = reopened(shot).skin_tan
    assert (settings.last_day, settings.exposures[0].dose) == (21.0, 5.0)
    assert settings.mask.invert
    assert [exposure.name for exposure in settings.exposures] == ["", "Boat"]
    assert settings.exposures[1].day == 4.0


def test_the_shot_keys_its_own_days(shot):
    obj = body()
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 101, 111
    assert bpy.ops.skin_tan.reset_timing() == {"FINISHED"}
    obj = reopened(shot)
    for frame, day in ((101, 0.0), (106, 15.0), (111, 30.0)):
        bpy.context.scene.frame_set(frame)
        assert obj["tan_day"] == pytest.approx(day)
    assert obj.animation_data.action.library is None


def test_apply_says_that_an_override_keeps_its_look(shot):
    with pytest.raises(RuntimeError, match="is a library override"):
        bpy.ops.skin_tan.apply()
