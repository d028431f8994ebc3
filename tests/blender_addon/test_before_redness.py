"""Kinetics and redness: those of a new tan, and of tans from before there was a choice.

`data/before_redness.blend` was saved in Blender 5.0 by the version before: Body of type II with a
mask and 12 SED on day 0 and a tan, and Untanned, whose settings were never applied.
"""

from pathlib import Path

import bpy
import numpy as np
import pytest
from scenes import apply, of_role, pixels, tan_object

from blender_addon import live
from blender_addon.applied import is_changed
from blender_addon.scene import exr, nodes

FILE = Path(__file__).parent / "data" / "before_redness.blend"


def states(obj) -> np.ndarray:
    """u, v and b of the history that an object's tan shows."""
    return pixels(of_role(obj, "states").image)[..., :3]


ROOTS = np.linspace(0.2, 2.0, 40)
"""Square roots of melanin over the untanned skin's, which the tables of then and of now reach."""


def look(obj) -> np.ndarray:
    """The colours that an object's tan shows at these; how far its image reaches is the table's."""
    node = of_role(obj, "colour")
    values = np.split(pixels(node.image), 2)[0]  # of thin skin
    scale, shift = node.texture_mapping.scale[0], node.texture_mapping.translation[0]
    for column in nodes.of_role(obj.skin_tan.group, "look_column"):
        scale, shift = (column.inputs[number].default_value for number in (1, 2))
    places = (scale * ROOTS + shift) * values.shape[1] - 0.5
    columns = np.arange(values.shape[1])
    return np.array(
        [[np.interp(places, columns, one) for one in row.T] for row in values.astype(float)]
    )


@pytest.fixture
def former():
    bpy.ops.wm.open_mainfile(filepath=str(FILE))
    return bpy.data.objects["Body"]


def choices(obj) -> tuple[str, bool]:
    return obj.skin_tan.kinetics, obj.skin_tan.redness


def test_a_tan_from_before_shows_what_it_did(former, tmp_path):
    before = states(former)
    seen = look(former)
    assert choices(former) == ("THESIS", False)
    live.show_changes()
    live.make_exact()
    np.testing.assert_allclose(states(former), exr.rounded(before), rtol=0.0, atol=1e-6)
    assert apply(former) == {"FINISHED"}
    np.testing.assert_allclose(states(former), exr.rounded(before), rtol=0.0, atol=1e-6)
    assert look(former) == pytest.approx(seen, abs=0.02)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "again.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "again.blend"))
    again = bpy.data.objects["Body"]
    assert choices(again) == ("THESIS", False)
    assert not is_changed(again, bpy.context.scene)
    assert bpy.ops.skin_tan.remove() == {"FINISHED"}
    assert choices(again) == ("THESIS", False)


def test_it_shows_another_once_somebody_chooses_so(former):
    former.skin_tan.redness = True
    live.show_changes()
    live.make_exact()
    red = states(former)
    assert red[..., 2].max() > 0.5
    former.skin_tan.kinetics = "MEASURED"
    live.show_changes()
    live.make_exact()
    assert choices(former) == ("MEASURED", True)
    assert abs(states(former)[..., 0].max() - red[..., 0].max()) > 0.02


def test_what_was_never_applied_tans_as_new_skin_does(former):
    other = bpy.data.objects["Untanned"]
    assert choices(other) == ("MEASURED", True)
    assert apply(other) == {"FINISHED"}
    assert choices(other) == ("MEASURED", True)
    assert states(other)[..., 2].max() > 0.5


def test_a_failed_apply_chooses_nothing(former):
    former.skin_tan.exposures[0].dose = 5.0
    former.skin_tan.mask.source = "not there"
    with pytest.raises(RuntimeError, match="not there"):
        apply(former)
    assert choices(former) == ("THESIS", False)


def test_copied_settings_bring_both_along(former):
    other = bpy.data.objects["Untanned"]
    for obj in (former, other):
        obj.select_set(True)
    bpy.context.view_layer.objects.active = former
    assert bpy.ops.skin_tan.copy_to_selected() == {"FINISHED"}
    assert choices(other) == ("THESIS", False)


def test_a_new_tan_reddens_under_a_mask(table_path):
    """Half the dose reddens less, and no dose not at all."""
    obj = tan_object(table_path, np.array([0.0, 0.5, 1.0]), dose=9.0)
    obj.skin_tan.kinetics, obj.skin_tan.redness = "MEASURED", True
    apply(obj)
    red = states(obj)[..., 2]
    assert not red[:, 0].any()
    assert 0.2 < red[:, red.shape[1] // 2].max() < red[:, -1].max()


def test_a_table_without_blood_or_measured_tans_is_said(former_path, capfd):
    obj = tan_object(former_path)
    obj.skin_tan.kinetics, obj.skin_tan.redness = "THESIS", True
    assert apply(obj) == {"FINISHED"}
    assert not states(obj)[..., 2].any()
    said = capfd.readouterr().out
    assert "no sunburn shows" in said and "as measured in people is rough" not in said
    obj.skin_tan.kinetics = "MEASURED"
    assert apply(obj) == {"FINISHED"}
    assert "as measured in people is rough" in capfd.readouterr().out


def test_skin_that_only_burns_shows_its_reddest_day():
    """Type I does not tan, so a first Apply would show nothing."""
    bpy.ops.mesh.primitive_plane_add()
    settings = bpy.context.object.skin_tan
    settings.skin = "I"
    assert bpy.ops.skin_tan.apply(show=True) == {"FINISHED"}
    assert 0.3 < bpy.context.object["tan_day"] < 2.0
    settings.redness = False
    bpy.context.scene.frame_set(1)
    assert bpy.ops.skin_tan.go_to_darkest_day() == {"FINISHED"}
    assert bpy.context.scene.frame_current == 1
