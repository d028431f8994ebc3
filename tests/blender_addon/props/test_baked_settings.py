"""Settings that Apply bakes take no keys, which would do nothing; the day of the tan does."""

import bpy
import pytest
from scenes import apply, tan_object

from blender_addon.props import CLASSES


@pytest.mark.parametrize("group", CLASSES)
def test_no_setting_can_be_keyed_or_driven(group):
    inherited = {"rna_type", "name"}
    settings = [item for item in group.bl_rna.properties if item.identifier not in inherited]
    assert settings
    assert [item.identifier for item in settings if item.is_animatable] == []


def test_melanin_takes_no_key_and_the_day_does(table_path):
    body = tan_object(table_path)
    apply(body)
    with pytest.raises(TypeError, match="not animatable"):
        body.keyframe_insert("skin_tan.biology.melanin", frame=1)
    assert body.keyframe_insert('["tan_day"]', frame=7)
    bpy.context.scene.frame_set(7)
