"""Renders shots of `spectral_shots` into NAME.npz, in a process of its own.

`python -m examples.figures.spectral_scenes FOLDER [--scale S] [--samples N] [--stand-in] NAME...`;
FOLDER has looks.json. Blender 4.5 hangs in an ordinary exit after a render, so this one ends
otherwise.
"""

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import bpy
import numpy as np

from examples.demo import render
from examples.demo.tan_lines import silence_blender
from examples.figures import scenes, shots
from examples.figures.pixel_readings import Taken, sun_distance
from examples.figures.spectral_looks import SPOTS
from examples.figures.spectral_material import skin_material
from examples.figures.spectral_shots import SpectralShot
from examples.figures.spectral_shots import shots as spectral_shots
from examples.figures.stages import Stage, built, spectral_stages
from hylios.commands.shell import run
from hylios.lab.colour import srgb

PERCENT = 52
"""Size of the pictures, of the stage's."""


def shoot(
    wanted: Sequence[SpectralShot],
    by_name: Mapping[str, Stage],
    looks: Mapping[str, dict],
    folder: Path,
    quality: render.Quality,
) -> Iterator[str]:
    """Render shots into FOLDER/NAME.npz; yields a shot's name once its file is there."""
    scratch = folder / "scratch.exr"
    for shot in wanted:
        stage = by_name[shot.stage]
        obj = built(stage)
        look = {name: np.array(value) for name, value in looks[shot.name].items()}
        material = skin_material(look, SPOTS, shot)
        for slot in obj.material_slots:
            slot.material = material
        render.passes(bpy.context.scene, 1, quality, scratch, render.WHOLE, denoised=True)
        combined = render.one_pass(render.read_channels(scratch), ("Combined",))[..., :3]
        taken = Taken(combined, render.read_light(scratch))
        camera = np.array(bpy.context.scene.camera.location)
        distance = sun_distance(taken.light, stage, camera)
        np.savez(
            folder / f"{shot.name}.npz",
            picture=srgb(shot.brightness * combined).astype(np.float32),
            combined=combined,
            scattered=taken.light.scattered,
            albedo=taken.light.albedo,
            seen=np.isfinite(distance),
            uncovered=np.nan_to_num(distance, nan=0.0) > 0.0,
            position=taken.light.position,
            subject=stage.subject.name,
        )
        yield shot.name
    scratch.unlink(missing_ok=True)


def main(arguments) -> None:
    """Render the shots named, and print a shot's name when it is done."""
    wheel = None if arguments.stand_in else scenes.body_wheel()
    wanted = [shot for shot in spectral_shots() if shot.name in arguments.names]
    looks = json.loads((arguments.folder / "looks.json").read_text())
    quality = render.Quality(arguments.samples, max(1, round(arguments.scale * PERCENT)), "HIGH")
    for name in shoot(wanted, spectral_stages(wheel), looks, arguments.folder, quality):
        print(f"{shots.DONE}{name}")


if __name__ == "__main__":
    silence_blender()
    os._exit(run(main, scenes.arguments().parse_args()))
