"""Presets of skins and schedules, by Blender's own system."""

from pathlib import Path

import bpy
import pytest
from scenes import tan_object

import blender_addon
from blender_addon.model import catalogue
from blender_addon.model.summary import of_blisters

SHIPPED = sorted(Path(blender_addon.__file__).parent.glob("presets/skin_tan/schedule/*.py"))


@pytest.fixture
def user_presets(tmp_path, monkeypatch):
    """A folder in place of the user's own."""

    def user_resource(kind, *, path="", create=False):
        folder = tmp_path / path
        folder.mkdir(parents=True, exist_ok=True)
        return str(folder)

    monkeypatch.setattr(bpy.utils, "user_resource", user_resource)
    return tmp_path / "presets" / "skin_tan"


def execute(path: Path, menu: str) -> None:
    bpy.ops.script.execute_preset(filepath=str(path), menu_idname=menu)


def test_a_schedule_is_kept_and_given_to_another_body(table_path, user_presets):
    first, second = tan_object(table_path), tan_object(table_path)
    bpy.context.view_layer.objects.active = first
    exposure = first.skin_tan.exposures[0]
    exposure.name, exposure.unit, exposure.multiple, exposure.enabled = "Boat", "MMD", 2.5, False
    bpy.ops.skin_tan.add_exposure(day=3.0, dose=7.0)
    first.skin_tan.last_day = 60.0
    assert bpy.ops.skin_tan.schedule_preset_add(name="My trip") == {"FINISHED"}
    (file,) = (user_presets / "schedule").iterdir()
    bpy.context.view_layer.objects.active = second
    execute(file, "SKIN_TAN_PT_schedule_presets")
    boat, other = second.skin_tan.exposures
    assert (boat.name, boat.unit, boat.multiple, boat.enabled) == ("Boat", "MMD", 2.5, False)
    assert (other.day, other.unit, other.dose) == (3.0, "SED", 7.0)
    assert second.skin_tan.last_day == 60.0


def test_a_skin_is_kept(table_path, user_presets):
    first, second = tan_object(table_path), tan_object(table_path)
    bpy.context.view_layer.objects.active = first
    first.skin_tan.own_minimal_doses, first.skin_tan.mmd = True, 9.5
    first.skin_tan.kinetics = "MEASURED"
    first.skin_tan.redness = first.skin_tan.peeling = first.skin_tan.darkening = True
    bpy.ops.skin_tan.skin_preset_add(name="Nora")
    (file,) = (user_presets / "skin").iterdir()
    bpy.context.view_layer.objects.active = second
    execute(file, "SKIN_TAN_PT_skin_presets")
    assert second.skin_tan.own_minimal_doses and second.skin_tan.mmd == 9.5
    assert second.skin_tan.kinetics == "MEASURED"
    assert second.skin_tan.redness and second.skin_tan.peeling and second.skin_tan.darkening
    assert second.skin_tan.table_path == str(table_path)
    assert second.skin_tan.exposures[0].dose == 30.0


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_every_preset_that_comes_with_the_add_on_tans(table_path, path):
    obj = tan_object(table_path)
    execute(path, "SKIN_TAN_PT_schedule_presets")
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    assert all(exposure.name for exposure in obj.skin_tan.exposures)


@pytest.mark.parametrize("skin", catalogue.TYPES)
@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_no_preset_blisters_any_type_of_skin(table_path, path, skin):
    settings = tan_object(table_path).skin_tan
    execute(path, "SKIN_TAN_PT_schedule_presets")
    settings.skin = skin
    assert of_blisters(settings.values()) == ()


def test_blender_lists_them():
    folders = bpy.utils.preset_paths("skin_tan/schedule")
    assert any(Path(folder).samefile(SHIPPED[0].parent) for folder in folders)
    assert len(SHIPPED) >= 4


def test_without_an_active_mesh_a_preset_says_what_it_needs(table_path, user_presets):
    tan_object(table_path)
    bpy.ops.skin_tan.schedule_preset_add(name="Mine")
    own = next((user_presets / "schedule").iterdir())
    bpy.context.view_layer.objects.active = None
    for file in (own, *SHIPPED):
        with pytest.raises(RuntimeError, match="No mesh object is active"):
            execute(file, "SKIN_TAN_PT_schedule_presets")
