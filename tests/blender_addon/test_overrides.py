"""Library overrides: settings stay with the shot, and the shot keys its own days."""

from pathlib import Path

import bpy
import pytest
from drawing import drawn
from scenes import apply, tan_object

import blender_addon
from blender_addon.ui import panel


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


def add(name, day, dose):
    added = body().skin_tan.exposures.add()
    added.name, added.day, added.dose = name, day, dose


def listed():
    return [(exposure.name, exposure.day, exposure.dose) for exposure in body().skin_tan.exposures]


def test_times_of_one_name_survive_a_reload(shot):
    for day, name in enumerate(("Boat", "Boat", "", "", "Boat"), start=4):
        add(name, day, 2.0 * day)
    before = listed()
    assert [name for name, _, _ in before[1:]] == ["Boat", "Boat.001", "", "", "Boat.002"]
    reopened(shot)
    assert sorted(listed()) == sorted(before)  # Blender may change their order


def test_times_of_the_characters_own_file_are_turned_off_not_removed(shot, tmp_path):
    obj = body()
    obj.skin_tan.regions.add()
    bpy.ops.skin_tan.add_exposure(name="Boat", day=4.0, dose=5.0)
    for refused in ("remove_exposure", "move_exposure"):
        with pytest.raises(RuntimeError, match=r"^Error: Entry 1 of the list is that of the char"):
            getattr(bpy.ops.skin_tan, refused)(
                index=0, **({"direction": "DOWN"} if refused == "move_exposure" else {})
            )
    file = tmp_path / "days.csv"
    file.write_text("day,SED\n2,3\n")
    assert bpy.ops.skin_tan.import_exposures(filepath=str(file)) == {"FINISHED"}
    exposures = obj.skin_tan.exposures
    assert [(item.day, item.enabled) for item in exposures] == [(0.0, False), (2.0, True)]
    assert bpy.ops.skin_tan.remove_exposure(index=1) == {"FINISHED"}
    assert len(exposures) == 1


def test_a_preset_turns_them_off_too_and_leaves_linked_data_alone(shot):
    preset = str(next(Path(blender_addon.__file__).parent.glob("presets/skin_tan/*/Day_at*.py")))
    bpy.ops.script.execute_preset(filepath=preset, menu_idname="SKIN_TAN_PT_schedule_presets")
    assert [item.enabled for item in body().skin_tan.exposures] == [False, True]
    linked = body().override_library.reference
    bpy.context.view_layer.objects.active = linked
    with pytest.raises(RuntimeError, match="linked from another file"):
        bpy.ops.script.execute_preset(filepath=preset, menu_idname="SKIN_TAN_PT_schedule_presets")
    assert [item.dose for item in linked.skin_tan.exposures] == [30.0]


def test_the_panel_says_where_the_tan_is_changed(shot):
    lines = ("Library override: its tan changes in", "its own file; Reset keys its days here")
    assert set(lines) <= set(drawn(panel.VIEW3D_PT_skin_tan))
    linked = body().override_library.reference
    with bpy.context.temp_override(object=linked):
        assert "Linked from another file: make it" in drawn(panel.VIEW3D_PT_skin_tan)
    local = bpy.data.objects.new("Local", linked.data)
    with bpy.context.temp_override(object=local):
        assert "Its mesh or animation is linked:" in drawn(panel.VIEW3D_PT_skin_tan)
    local.data = local.data.copy()
    with bpy.context.temp_override(object=local):
        assert not drawn(panel.VIEW3D_PT_skin_tan)
