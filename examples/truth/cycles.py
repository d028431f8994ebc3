"""Renders shots with Cycles (or EEVEE), each into FOLDER/NAME.npz, in a process of its own.

`python -m examples.truth.cycles SHOTS.json FOLDER`. Blender 4.5 hangs in an ordinary exit after a
render, so this one ends otherwise.
"""

import argparse
import json
import os
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import bpy
import numpy as np

import blender_addon
from examples.demo import render
from examples.demo.scene import make_even
from examples.demo.tan_lines import silence_blender
from examples.simplifications.light import seconds as processor_time
from examples.truth.shots import DONE, FRAMES_PER_DAY, LAST_DAY, SUNNED, Shot
from examples.truth.stages import STAGES, plain_material
from hylios.commands.shell import run
from hylios.errors import InputError
from hylios.skin.phototypes import skin_type

PASSES = {
    "diffuse": (("Diffuse Direct", "DiffDir"), ("Diffuse Indirect", "DiffInd")),
    "glossy": (("Glossy Direct", "GlossDir"), ("Glossy Indirect", "GlossInd")),
}
"""Names of passes in a file of Blender 5 and of Blender 4.5; each is to be times its colour."""

COLOURS = {
    "diffuse": ("Diffuse Color", "DiffCol"),
    "glossy": ("Glossy Color", "GlossCol"),
}


def shot_all(shots: Sequence[Shot], folder: Path) -> Iterator[str]:
    """Render shots; yields a shot's name once its file is there."""
    standing, scratch = None, folder / "scratch.exr"
    skin = None
    for shot in shots:
        sun = replace(SUNNED[shot.tan], day=0.0)
        stage = (shot.stage, shot.skin, sun, shot.angle, shot.thickness)
        stage += (shot.table, shot.plain, shot.engine, shot.space, shot.unit, shot.scale)
        stage += (shot.film, shot.model_scale, shot.applied_unit)
        if standing != stage or skin is None:
            skin, standing = built(shot), stage
        set_inputs(skin, shot)
        light = rendered(shot, scratch)
        np.savez(folder / f"{shot.name}.npz", **light)
        yield shot.name
    scratch.unlink(missing_ok=True)


def built(shot: Shot) -> bpy.types.Object:
    """Fill an empty scene with a shot's stage; returns the skin with its tan."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if shot.space:
        bpy.ops.wm.set_working_color_space(working_space=shot.space, convert_colors=True)
    scene = bpy.context.scene
    scene.unit_settings.scale_length = shot.applied_unit or shot.unit
    skin = STAGES[shot.stage](replace(shot, unit=shot.unit / shot.model_scale))
    settings = skin.skin_tan
    settings.skin = "FILE" if shot.table else shot.skin
    settings.table_path, settings.film = shot.table, shot.film
    _set_sun(settings, shot)
    settings.first_day, settings.last_day = 0.0, LAST_DAY
    settings.first_frame, settings.last_frame = frame_of(0.0), frame_of(LAST_DAY)
    bpy.context.view_layer.objects.active = skin
    if bpy.ops.skin_tan.apply() != {"FINISHED"}:
        raise InputError(f"Apply failed for the shot {shot.name!r}.")
    if shot.applied_unit or shot.model_scale != 1.0:
        scene.unit_settings.scale_length = shot.unit
        bpy.context.view_layer.update()
        bpy.ops.skin_tan.fit_size()
    make_even(skin)
    if shot.plain:
        skin.material_slots[0].material = plain_material()
    _set_up(scene, shot.engine)
    return skin


def _set_sun(settings: Any, shot: Shot) -> None:
    sun, exposure = SUNNED[shot.tan], settings.exposures.add()
    exposure.day, exposure.unit, exposure.multiple = 0.0, "MMD", sun.multiple
    settings.kinetics, settings.redness = "THESIS", False
    if sun.burns:
        exposure.unit, exposure.dose = "SED", sun.multiple * skin_type(shot.skin).med
        settings.kinetics, settings.redness = "MEASURED", True


def frame_of(day: float) -> int:
    """Frame of the timeline that shows a day."""
    return 1 + round(FRAMES_PER_DAY * day)


def _set_up(scene: bpy.types.Scene, engine: str) -> None:
    scene.render.engine = engine
    # That of Mesa, EEVEE without a graphics card, blurs tables even where nothing changes.
    bpy.context.preferences.system.anisotropic_filter = "FILTER_0"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.sample_clamp_indirect = 0.0
    scene.render.resolution_percentage = 100
    render.set_file_format(scene, "MULTI_LAYER_IMAGE", "OPEN_EXR_MULTILAYER")
    layer = scene.view_layers[0]
    layer.use_pass_position = True
    for kind in PASSES:
        for part in ("direct", "indirect", "color"):
            setattr(layer, f"use_pass_{kind}_{part}", True)


def set_inputs(skin: bpy.types.Object, shot: Shot) -> None:
    """Set the day and what the shot asks of the skin's node group.

    Raises
    ------
    InputError
        If the group has no such input.
    """
    bpy.context.scene.frame_set(frame_of(SUNNED[shot.tan].day))
    if shot.plain:
        return
    tree = skin.material_slots[0].material.node_tree
    (group,) = (node for node in tree.nodes if node.type == "GROUP")
    blood = group.inputs.get("Blood")
    if blood is None and shot.blood != 1.0:
        raise InputError("the add-on's node group has no input Blood.")
    if blood is not None:
        blood.default_value = shot.blood
    if not shot.gloss:
        group.inputs["Specular"].default_value = 0.0


def rendered(shot: Shot, scratch: Path) -> dict[str, np.ndarray]:
    """Light in the scene's picture (rows, columns, 3), linear in Blender's working space.

    Also positions in m, and the processor's time in seconds. EEVEE gives no parts of the light.
    """
    scene = bpy.context.scene
    scene.eevee.taa_render_samples = shot.samples
    scene.cycles.samples, scene.cycles.seed = shot.samples, shot.seed
    scene.render.resolution_x, scene.render.resolution_y = shot.size
    scene.render.filepath = str(scratch)
    seconds = processor_time(lambda: bpy.ops.render.render(write_still=True))
    channels = render.read_channels(scratch)
    light = {"combined": render.one_pass(channels, ("Combined",))[..., :3]}
    for kind, names in PASSES.items() if shot.engine == "CYCLES" else ():
        both = sum(render.one_pass(channels, name) for name in names)
        light[kind] = both * render.one_pass(channels, COLOURS[kind])
    light["seconds"] = np.array(seconds)
    light["position"] = shot.unit * render.one_pass(channels, ("Position",))
    return light


def main(arguments: argparse.Namespace) -> None:
    """Render the shots of a file, and print a shot's name when it is done."""
    blender_addon.register()
    shots = [Shot.of(described) for described in json.loads(arguments.shots.read_text())]
    for name in shot_all(shots, arguments.folder):
        print(f"{DONE}{name}")


def arguments() -> argparse.ArgumentParser:
    """The command's parser."""
    parser = argparse.ArgumentParser(prog="python -m examples.truth.cycles", description=__doc__)
    parser.add_argument("shots", type=Path)
    parser.add_argument("folder", type=Path)
    return parser


if __name__ == "__main__":
    silence_blender()
    os._exit(run(main, arguments().parse_args()))
