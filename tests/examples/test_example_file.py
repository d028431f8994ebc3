"""The example .blend, made small."""

from dataclasses import replace

import bpy
import numpy as np

import blender_addon
from blender_addon.model.curve import curve_of
from blender_addon.model.summary import of_blisters
from examples.demo import scene
from examples.example_file.make import make
from hylios.colour_difference import ciede2000, lab


def require_plain_lines(values) -> None:
    """On the darkest day bare skin is far from covered skin, and no day blisters."""
    curve = curve_of(values)
    bare, covered = lab(curve.colours[[curve.darkest, 0]])
    assert ciede2000(bare, covered) > 9.0
    assert not of_blisters(values)


def test_the_file_has_clothes_masks_and_keyed_days(tmp_path):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    blender_addon.register()
    try:
        make(replace(scene.suzanne(), levels=0), tmp_path / "made" / "example.blend")
        settings = bpy.data.objects["Suzanne"].skin_tan
        assert settings.kinetics == "MEASURED" and settings.exposures[-1].own_mask
        assert not any(time.own_mask for time in settings.exposures[:-1])
        require_plain_lines(settings.values())
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
