"""Renders the shots of figures 6.24 to 6.29, each into a file NAME.npz, in a process of its own.

`python -m examples.figures.scenes FOLDER [--scale S] [--samples N] [--stand-in] NAME...`; FOLDER
has the tables. Blender 4.5 hangs in an ordinary exit after a render, so this one ends otherwise.
"""

import argparse
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import bpy
import numpy as np

import blender_addon
from blender_addon.apply import apply_tan
from examples.demo import render, scene
from examples.demo import tan_lines as demo
from examples.demo.body import BodyUnavailableError, fetch_wheel
from examples.figures import shots
from examples.figures.pixel_readings import Taken, readings, regions, shine, sun_distance
from examples.figures.shots import LAST_DAY, Schedule, Shot
from examples.figures.stages import Stage, built, stages
from hylios.commands.shell import run
from hylios.lab.colour import srgb

FRAMES_PER_DAY = 4


def tan(
    obj: bpy.types.Object, table: Path, schedules: Sequence[Schedule], *, sunscreen: bool = False
) -> None:
    """Give each part of an object the tan of its schedule, as the add-on's Apply does.

    With sunscreen a film of it lies on what the sun does not reach.

    Apply gives an object one tan. The further ones are applied to objects that share the mesh,
    whose materials the mesh's further slots take.
    """
    for number, schedule in enumerate(schedules):
        tanned = obj if number == 0 else bpy.data.objects.new(f"{obj.name} {number}", obj.data)
        settings = tanned.skin_tan
        settings.skin, settings.table_path = "FILE", str(table.resolve())
        settings.mask.source = scene.MASK
        settings.kinetics, settings.redness = "THESIS", False
        if sunscreen:
            settings.film = "SUNSCREEN"
            settings.film_mask.source, settings.film_mask.invert = scene.MASK, True
        settings.exposures.clear()
        for day, dose in schedule:
            exposure = settings.exposures.add()
            exposure.day, exposure.dose = day, dose
        settings.first_day, settings.last_day = 0.0, LAST_DAY
        settings.first_frame, settings.last_frame = frame_of(0.0), frame_of(LAST_DAY)
        apply_tan(tanned, bpy.context.scene)
        if len(schedules) > 1:  # blotches would pass for tans in small patches
            scene.make_even(tanned)
        if number:
            material = tanned.skin_tan.material
            bpy.data.objects.remove(tanned)
            obj.data.materials[number] = material


def frame_of(day: float) -> int:
    """Frame of the timeline that shows a day."""
    return 1 + round(FRAMES_PER_DAY * day)


def take(shot: Shot, quality: render.Quality, scratch: Path) -> Taken:
    """Render a shot of the stage that is built; `scratch` is a file to use."""
    shown = bpy.context.scene
    render.passes(shown, frame_of(shot.day), quality, scratch, shot.window, denoised=True)
    combined = render.one_pass(render.read_channels(scratch), ("Combined",))
    return Taken(combined[..., :3], render.read_light(scratch))


def shoot(
    wanted: Sequence[Shot], by_name: Mapping[str, Stage], folder: Path, scale: float, samples: int
) -> Iterator[str]:
    """Render shots into FOLDER/NAME.npz; yields a shot's name once its file is there."""
    scratch = folder / "scratch.exr"
    standing, obj = None, None
    whites: dict[tuple, render.Light] = {}
    for shot in wanted:
        stage = by_name[shot.stage]
        quality = render.Quality(samples, max(1, round(scale * shot.percent)), "HIGH")
        wanted_now = (shot.stage, shot.table, shot.schedules, shot.gloss, shot.view)
        if standing != wanted_now:
            # A new scene even for a new tan only: with persistent data Cycles may render a former
            # image in place of the one that has replaced it.
            obj = built(stage)
            tan(obj, folder / f"{shot.table}.exr", shot.schedules, sunscreen=shot.gloss)
            bpy.context.scene.skin_tan.view = shot.view
            standing = wanted_now
        view = (shot.stage, shot.window, shot.percent)
        if view not in whites:
            with render.white(obj):
                frame = frame_of(shot.day)
                whites[view] = render.light(bpy.context.scene, frame, quality, scratch, shot.window)
        taken = take(shot, quality, scratch)
        camera = np.array(bpy.context.scene.camera.location)
        distance = sun_distance(whites[view], stage, camera)
        where = regions(whites[view], distance, stage)
        np.savez(
            folder / f"{shot.name}.npz",
            picture=srgb(taken.picture).astype(np.float32),
            readings=readings(taken.light, whites[view], where),
            shine=shine(taken, where),
            sun_distance=distance,
            subject=stage.subject.name,
        )
        yield shot.name
    scratch.unlink(missing_ok=True)


def main(arguments: argparse.Namespace) -> None:
    """Render the shots named, and print a shot's name when it is done."""
    by_name = stages(None if arguments.stand_in else body_wheel())
    blender_addon.register()
    wanted = shots.named(arguments.names)
    for name in shoot(wanted, by_name, arguments.folder, arguments.scale, arguments.samples):
        print(f"{shots.DONE}{name}")


def body_wheel() -> Path | None:
    """The wheel with the body, or None where it cannot be had."""
    try:
        return fetch_wheel(demo.OUT / ".cache")
    except BodyUnavailableError as error:
        print(f"{error} Blender's Suzanne stands in for the body.", file=sys.stderr)
        return None


def arguments() -> argparse.ArgumentParser:
    """The command's parser."""
    parser = argparse.ArgumentParser(prog="python -m examples.figures.scenes", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="+")
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--samples", type=int, default=20)
    parser.add_argument("--stand-in", action="store_true")
    return parser


if __name__ == "__main__":
    demo.silence_blender()
    os._exit(run(main, arguments().parse_args()))
