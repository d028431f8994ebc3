"""What Apply leaves in the scene, and what it says where it cannot."""

import shutil

import bpy
import numpy as np
import pytest
from bpy_extras.anim_utils import action_get_channelbag_for_slot
from scenes import LOOK_IMAGES, OWN_IMAGES, apply, of_role, pixels, tan_groups, tan_object

from blender_addon import applied
from blender_addon.model import catalogue
from hylios.table import read_table
from hylios.table.provenance import minimal_doses

MATERIAL = "Skin Tan Body"


@pytest.fixture
def body(table_path):
    return tan_object(table_path, [0.0, 0.5, 1.0])


def day_curve(obj):
    animation = obj.animation_data
    bag = action_get_channelbag_for_slot(animation.action, animation.action_slot)
    (curve,) = (curve for curve in bag.fcurves if curve.data_path == '["tan_day"]')
    return curve


def day_keys(obj) -> list[tuple]:
    return [(*key.co, key.interpolation) for key in day_curve(obj).keyframe_points]


def refused(sentence: str) -> None:
    """Apply refuses with a sentence that matches, and leaves nothing behind."""
    with pytest.raises(RuntimeError, match=sentence) as caught:
        apply()
    assert len(str(caught.value).strip().splitlines()) == 1
    assert not [*bpy.data.images, *bpy.data.materials, *bpy.data.node_groups, *bpy.data.actions]


def test_shipped_tables_can_be_loaded():
    for shipped in catalogue.SHIPPED:
        table = read_table(shipped.path)
        assert table.provenance["specimen"] == shipped.name
        assert minimal_doses(table.provenance).mmd > 0


def test_shipped_skins_can_be_chosen_and_applied(body):
    for shipped in catalogue.SHIPPED:
        body.skin_tan.skin = shipped.name
        assert apply() == {"FINISHED"}


def test_images_are_packed_floats(body):
    apply()
    spaces = {image.name: image.colorspace_settings.name for image in bpy.data.images}
    assert spaces == {
        "Skin Tan States Body": "Non-Color",
        "Skin Tan Places Body": "Non-Color",
        "Skin Tan Look Colours": "Linear Rec.709",
        "Skin Tan Look Light": "Non-Color",
    }
    for image in bpy.data.images:
        assert image.is_float and image.packed_file is not None


def test_the_day_is_keyed_linearly(body):
    settings = body.skin_tan
    settings.first_day, settings.last_day = 1.0, 21.0
    settings.first_frame, settings.last_frame = 10, 50
    bpy.context.scene.frame_set(20)
    apply()
    assert day_keys(body) == [(10, 1, "LINEAR"), (50, 21, "LINEAR")]
    assert day_curve(body).extrapolation == "CONSTANT"
    assert body["tan_day"] == pytest.approx(6.0)
    for frame, day in ((0, 1.0), (30, 11.0), (99, 21.0)):
        bpy.context.scene.frame_set(frame)
        assert body["tan_day"] == pytest.approx(day)


def test_keys_are_replaced_and_other_animation_is_kept(body):
    body.keyframe_insert("location", frame=3)
    apply()
    body.skin_tan.first_frame, body.skin_tan.last_frame = 40, 60
    apply()
    assert [key[0] for key in day_keys(body)] == [40, 60]
    animation = body.animation_data
    bag = action_get_channelbag_for_slot(animation.action, animation.action_slot)
    assert sorted(curve.data_path for curve in bag.fcurves) == ['["tan_day"]', *["location"] * 3]


def test_applying_twice_replaces(body):
    apply()
    names = {image.name for image in bpy.data.images}
    rows = of_role(body, "states").image.size[1]
    node = next(n for n in bpy.data.materials[MATERIAL].node_tree.nodes if n.type == "GROUP")
    node.inputs["Roughness"].default_value = 0.3
    body.skin_tan.last_day = 10.0
    apply()
    assert {image.name for image in bpy.data.images} == names
    assert of_role(body, "states").image.size[1] < rows
    assert [material.name for material in bpy.data.materials] == [MATERIAL]
    assert [group.name for group in tan_groups()] == [MATERIAL]
    assert [slot.material.name for slot in body.material_slots] == [MATERIAL]
    # What the artist has set on the material is kept.
    assert node.inputs["Roughness"].default_value == pytest.approx(0.3)
    assert len(bpy.data.node_groups[MATERIAL].interface.items_tree) == 12


def test_long_names_are_found_again(body):
    body.name = "ä" * 31
    apply()
    apply()
    assert len(bpy.data.images) == OWN_IMAGES + LOOK_IMAGES and len(bpy.data.materials) == 1


def test_undo_takes_it_all_back(body):
    bpy.ops.ed.undo_push(message="before")
    apply()
    bpy.ops.ed.undo_push(message="after")
    assert len(bpy.data.images) == OWN_IMAGES + LOOK_IMAGES
    bpy.ops.ed.undo()
    body = bpy.data.objects["Body"]
    assert not [*bpy.data.images, *bpy.data.materials, *bpy.data.node_groups, *bpy.data.actions]
    assert "tan_day" not in body and not body.material_slots


def test_objects_that_share_a_mesh_keep_their_own_skin(body, table_path):
    other = bpy.data.objects.new("Twin", body.data)
    bpy.context.collection.objects.link(other)
    apply()
    bpy.context.view_layer.objects.active = other
    other.skin_tan.skin, other.skin_tan.table_path = "FILE", str(table_path)
    apply()
    assert body.material_slots[0].material.name == MATERIAL
    assert other.material_slots[0].material.name == "Skin Tan Twin"


def test_exposures_after_the_last_day_are_reported(body, capfd):
    body.skin_tan.exposures.add().day = 40.0
    assert apply() == {"FINISHED"}
    assert "Times in the sun after day 30 have no effect: 1." in capfd.readouterr().out


def last_row():
    """Apply; the melanin of the last day where all of the dose arrived."""
    apply()
    return pixels(bpy.data.images["Skin Tan States Body"])[-1, -1, 0]


def test_own_minimal_doses_replace_the_table_s(body):
    """The MMD for melanin alone; and for multiples of it."""
    tanned = last_row()
    body.skin_tan.own_minimal_doses = True
    body.skin_tan.mmd, body.skin_tan.med = 50.0, 2.9
    assert last_row() < tanned - 0.01
    body.skin_tan.exposures[0].unit, body.skin_tan.exposures[0].multiple = "MMD", 3.0
    of_multiple = last_row()
    body.skin_tan.exposures[0].unit, body.skin_tan.exposures[0].dose = "SED", 150.0
    assert last_row() == of_multiple


def test_exposures_are_added_and_removed(body):
    settings = body.skin_tan
    bpy.ops.skin_tan.add_exposure()
    assert (len(settings.exposures), settings.exposure_index) == (2, 1)
    settings.exposures[1].dose = 5.0
    settings.exposure_index = 0
    bpy.ops.skin_tan.remove_exposure()
    assert (settings.exposures[0].dose, settings.exposure_index) == (5.0, 0)
    bpy.ops.skin_tan.remove_exposure()
    assert not bpy.ops.skin_tan.remove_exposure.poll()


def test_no_object():
    refused("No object is active; select a mesh object")


def test_not_a_mesh():
    bpy.ops.object.empty_add()
    refused("'Empty' is of type Empty; select a mesh object")


def linked_body(tmp_path):
    """The body, linked into an empty scene from the file that it was saved in."""
    path = tmp_path / "library.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(str(path), link=True) as (_, wanted):
        wanted.objects = ["Body"]
    linked = bpy.data.objects["Body"]
    bpy.context.collection.objects.link(linked)
    return linked


def test_linked_objects_are_refused(body, tmp_path):
    linked = linked_body(tmp_path)
    bpy.context.view_layer.objects.active = linked
    refused("The object 'Body' is linked from another file")


def test_linked_animation_is_refused(body, tmp_path):
    body.keyframe_insert("location", frame=3)
    name = body.animation_data.action.name
    path = tmp_path / "library.blend"
    bpy.data.libraries.write(str(path), {body.animation_data.action})
    bpy.data.actions.remove(body.animation_data.action)
    with bpy.data.libraries.load(str(path), link=True) as (_, wanted):
        wanted.actions = [name]
    body.animation_data.action = bpy.data.actions[name]
    with pytest.raises(RuntimeError, match="The animation of 'Body' is linked"):
        apply()
    assert not bpy.data.images and "tan_day" not in body


def test_an_override_is_called_so(body, tmp_path):
    linked = linked_body(tmp_path)
    override = linked.override_create(remap_local_usages=True)
    bpy.context.view_layer.objects.active = override
    refused("The object 'Body' is a library override")


def test_the_nla_s_tweak_mode_is_refused(body):
    body.keyframe_insert("location", frame=1)
    animation = body.animation_data
    track, action = animation.nla_tracks.new(), animation.action
    strip = track.strips.new("walk", 1, action)
    animation.action = None
    strip.select, animation.nla_tracks.active = True, track
    animation.use_tweak_mode = True
    with pytest.raises(RuntimeError, match="The animation of 'Body' is in tweak mode; leave"):
        apply()
    assert list(bpy.data.actions) == [action] and "tan_day" not in body
    assert not [*bpy.data.images, *bpy.data.materials, *bpy.data.node_groups]


@pytest.mark.parametrize("value", ["Tuesday", [1.0, 2.0], {"a": 1}])
def test_a_property_of_the_artist_s_own_with_the_day_s_name(body, value):
    body["tan_day"] = value
    refused("The custom property 'tan_day' of 'Body' holds no number")


def test_a_driver_of_the_day_is_told(body, capfd):
    body["tan_day"] = 0.0
    body.driver_add('["tan_day"]').driver.expression = "5.0"
    assert apply() == {"FINISHED"}
    assert "A driver governs the day of the tan" in capfd.readouterr().out
    assert body.animation_data.action is None  # keys would lie under the driver, without effect
    bpy.context.scene.frame_end = 99
    assert not applied.is_left_behind(body, bpy.context.scene)


def test_an_empty_slot_for_others_with_the_mesh_is_told(body, capfd):
    bpy.context.collection.objects.link(bpy.data.objects.new("Twin", body.data))
    apply()
    assert "Slots belong to the mesh, so 'Twin' got an empty one." in capfd.readouterr().out


@pytest.mark.parametrize("name", ["density", "color", "uv", "N", "velocity_x", "pointiness"])
def test_a_mask_under_a_name_of_cycles_own(body, name):
    body.data.attributes["sun"].name = name
    assert body.data.attributes[name].data_type == "FLOAT"
    body.skin_tan.mask_attribute = name
    refused(f"The attribute {name!r} cannot be a mask: Cycles keeps that name for itself; rename")


def test_missing_mask(body):
    body.skin_tan.mask_attribute = "shade"
    refused("The mesh has no 'shade', which is set as a mask; allowed are: sun.")


@pytest.mark.parametrize(
    ("kind", "domain", "words"),
    [
        ("FLOAT_VECTOR", "POINT", "Vector on Point"),
        ("FLOAT", "EDGE", "Float on Edge"),
        ("FLOAT2", "CORNER", "2D Vector on Face Corner"),
    ],
)
def test_mask_of_another_kind(body, kind, domain, words):
    body.data.attributes.new("shade", kind, domain)
    body.skin_tan.mask_attribute = "shade"

    refused(f"The attribute 'shade' cannot be a mask: it is of type {words}; allowed are numbers,")


def test_days_and_frames_out_of_order(body):
    settings = body.skin_tan
    settings.first_day = settings.last_day = 5.0
    refused("last day is 5; allowed is more than the first day, 5, to 366")
    settings.last_day = float("nan")
    refused("last day is nan; allowed is 0 to 366")
    settings.last_day, settings.last_frame = 9.0, 1
    refused("last frame is 1; allowed is more than the first frame, 1, to 1048574")
    settings.last_day, settings.last_frame = 5.0, 2**31 - 1
    assert settings.last_frame == 1048574


def test_dose_that_is_no_number(body):
    body.skin_tan.exposures[0].dose = float("nan")
    refused("dose of a time in the sun is nan SED; allowed is 0 to 1000 SED")


def test_tables_that_cannot_be_used(body, table_path, tmp_path):
    settings = body.skin_tan
    settings.table_path = ""
    refused("No table is set")
    settings.table_path = str(tmp_path / "absent.exr")
    refused("absent.exr cannot be read: No such file")
    settings.table_path = "//absent.exr"
    refused("absent.exr cannot be read: No such file")
    settings.table_path = str(tmp_path)
    refused("cannot be read: it is no regular file")
    text = tmp_path / "text.exr"
    text.write_text("no image")
    settings.table_path = str(text)
    refused("text.exr cannot be used: it is not an OpenEXR file")
    cut = tmp_path / "cut.exr"
    settings.table_path = str(cut)
    whole = table_path.read_bytes()
    for removed in (1, 20, 500, 1000, 2000, len(whole) - 100):
        cut.write_bytes(whole[:-removed])
        refused("cut.exr cannot be used: it is cut short or damaged")


def test_a_table_beside_the_blend_file(body, table_path, tmp_path):
    shutil.copy(table_path, tmp_path / "skin.exr")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    body = bpy.data.objects["Body"]
    body.skin_tan.table_path = "//skin.exr"
    assert apply() == {"FINISHED"}


@pytest.mark.parametrize(("from_hour", "late"), [(0.0, False), (12.0, False), (13.0, True)])
def test_sun_is_late_by_its_hours(table_path, capfd, from_hour, late):
    """Day 30.9 stands for day 30; what begins by the last day, noon of it, has an effect."""
    obj = tan_object(table_path)
    exposure, obj.skin_tan.last_day = obj.skin_tan.exposures[0], 30.5
    exposure.unit, exposure.day = "SUN", 30.9
    exposure.from_hour, exposure.to_hour = from_hour, 16.0
    assert apply() == {"FINISHED"}
    assert ("after day 30.5 have no effect: 1." in capfd.readouterr().out) == late
    assert (np.ptp(melanin()[-1]) > 0.0) != late


def test_apply_takes_every_unit(table_path):
    """The picture of each differs from that under sunscreen, and from the others."""
    exposure = tan_object(table_path).skin_tan.exposures[0]
    exposure.to_hour = 12.5
    bare = {}
    for unit in ("SED", "MMD", "UV_INDEX", "SUN"):
        exposure.unit = unit
        exposure.sunscreen = False
        assert apply() == {"FINISHED"}
        bare[unit] = melanin()
        exposure.sunscreen, exposure.spf = True, 50.0
        assert apply() == {"FINISHED"}
        assert abs(melanin().max() - bare[unit].max()) > 0.02
    assert len({picture.tobytes() for picture in bare.values()}) == 4


def melanin() -> np.ndarray:
    return pixels(bpy.data.images["Skin Tan States Body"])[..., 0]


def test_a_unit_scale_that_is_no_length(body):
    bpy.context.scene.unit_settings.scale_length = float("nan")
    refused("unit scale of the scene is nan; allowed is 1e-09 to 1e\\+09")


def test_minimal_doses_that_are_no_numbers(body):
    body.skin_tan.own_minimal_doses, body.skin_tan.mmd = True, float("nan")
    refused("minimal tanning dose is nan SED; allowed is 0.1 to 1000 SED")


def test_without_a_window(body):
    with bpy.context.temp_override(window=None):
        assert not hasattr(bpy.context, "object")
        assert bpy.ops.skin_tan.add_exposure() == {"FINISHED"}
        assert bpy.ops.skin_tan.remove_exposure() == {"FINISHED"}
        assert apply() == {"FINISHED"}
    assert "tan_day" in body


@pytest.mark.parametrize("name", ["object", "active_object"])
def test_the_object_of_an_override_gets_the_tan(body, table_path, name):
    other = tan_object(table_path)
    bpy.context.view_layer.objects.active = body
    with bpy.context.temp_override(**{name: other}):
        assert apply() == {"FINISHED"}
    assert "tan_day" in other and "tan_day" not in body
