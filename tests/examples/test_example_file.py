"""The example .blend, made small."""

from dataclasses import replace

import bpy
import numpy as np

import blender_addon
from examples.demo import scene
from examples.example_file.make import make


def test_the_file_has_clothes_masks_and_keyed_days(tmp_path):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    blender_addon.register()
    try:
        make(replace(scene.suzanne(), levels=0), tmp_path / "made" / "example.blend")
        assert bpy.data.objects["Suzanne"].skin_tan.kinetics == "MEASURED"
    finally:
        blender_addon.unregister()
    assert [file.name for file in (tmp_path / "made").iterdir()] == ["example.blend"]
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "made" / "example.blend"), use_scripts=False)
    assert sorted(cloth.name for cloth in bpy.data.collections["Clothes"].objects) == [
        "Band",
        "Scarf",
    ]
    assert all(len(cloth.data.polygons) for cloth in bpy.data.collections["Clothes"].objects)
    body, shot = bpy.data.objects["Suzanne"], bpy.context.scene
    assert (shot.cycles.samples, shot.cycles.use_denoising) == (128, True)
    for name in ("Band Mask", "Scarf Mask"):
        shares = np.empty(4 * len(body.data.vertices), np.float32)
        body.data.attributes[name].data.foreach_get("color", shares)
        assert shares.min() == 0.0 and shares.max() == 1.0
    for frame, day in ((shot.frame_start, 0.0), (shot.frame_end, 40.0)):
        shot.frame_set(frame)
        assert body["tan_day"] == day
