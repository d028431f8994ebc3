"""The demo from table to video: the tan lines of a swimsuit over 30 days, into out/."""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import bpy
import numpy as np
from tqdm import tqdm

import blender_addon
from examples.demo import colours, interrupt, montage, render, scene
from examples.demo.body import BodyUnavailableError, fetch_wheel
from hylios.errors import InputError
from hylios.table import read_table, skin_of

OUT = Path("out")
TABLE = "table.exr"
DOSE = 30.0  # SED, on day 0
DAYS = (0, 1, 4, 10, 20, 30)
FRAMES_PER_DAY = 2


def demo(_: argparse.Namespace) -> None:
    """Build a table, render everything from it, and print where it is."""
    started = time.monotonic()
    OUT.mkdir(exist_ok=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with tempfile.TemporaryDirectory(dir=OUT, prefix=".unfinished-") as folder:
        unfinished = Path(folder)
        person = subject()
        skin_table(unfinished / TABLE)
        obj = scene.build(person)
        tan(obj, unfinished / TABLE)
        render.prepare(bpy.context.scene)
        with interrupt.removing(unfinished):
            stills(unfinished)
            video(unfinished)
            readings = measured(person, obj, unfinished)
        files = sorted(path for path in unfinished.iterdir() if path.is_file())
        for path in files:
            os.replace(path, OUT / path.name)
    print(f"\nMade in {time.monotonic() - started:.0f} s, in {OUT.resolve()}:")
    print("  " + "  ".join(path.name for path in files))
    print(f"\n{colours.report(readings)}")


def subject() -> scene.Subject:
    """The swimmer, or Suzanne where there is no body to be had."""
    try:
        return scene.swimmer(fetch_wheel(OUT / ".cache"))
    except BodyUnavailableError as error:
        print(f"{error} Blender's Suzanne stands in for the body.", file=sys.stderr)
        return scene.suzanne()


def skin_table(path: Path) -> None:
    """Build a table of the skin of the thesis's figure 6.29 with the shell command.

    Raises
    ------
    InputError
        If that fails; the command itself has said why.
    """
    command = [sys.executable, "-m", "lut_builder.cli", "build"]
    skin = ["--specimen", "S3", "--pigmentation", "intermediate", "--mmd", "2.89", "--med", "1.7"]
    try:
        built = subprocess.run([*command, *skin, "-o", str(path)], stdout=subprocess.DEVNULL)
    except KeyboardInterrupt:
        sys.exit(130)  # Ctrl-C reached the command too, and it has said so.
    if built.returncode:
        raise InputError("the skin table could not be built.")


def tan(obj: bpy.types.Object, table: Path) -> None:
    """Give an object its tan, as an artist does in the add-on's panel."""
    blender_addon.register()
    settings = obj.skin_tan
    settings.skin = "FILE"
    settings.table_path = str(table.resolve())
    settings.mask_attribute = scene.MASK
    settings.kinetics, settings.redness = "THESIS", False
    bpy.ops.skin_tan.add_exposure()
    settings.exposures[0].day, settings.exposures[0].dose = 0.0, DOSE
    settings.first_day, settings.last_day = 0.0, DAYS[-1]
    settings.first_frame, settings.last_frame = frame_of(0), frame_of(DAYS[-1])
    bpy.ops.skin_tan.apply()


def frame_of(day: float) -> int:
    """Frame of the timeline that shows a day."""
    return 1 + round(FRAMES_PER_DAY * day)


def stills(folder: Path) -> None:
    """Render the days and their contact sheet."""
    paths = [folder / f"day_{day:02d}.png" for day in DAYS]
    for day, path in zip(tqdm(DAYS, "frames", unit="frame"), paths, strict=True):
        render.picture(bpy.context.scene, frame_of(day), render.STILL, path)
    montage.contact_sheet(paths, [f"Day {day}" for day in DAYS], folder / "contact_sheet.png")


def measured(person: scene.Subject, obj: bpy.types.Object, folder: Path) -> list[colours.Reading]:
    """Read the colours of the skin back from renders of the days, as with a white standard.

    The skin is made even for it, as the light model has it.
    """
    scene.make_even(obj)
    shot = bpy.context.scene
    readings = []
    with tempfile.TemporaryDirectory(dir=folder) as scratch:
        file = Path(scratch) / "light.exr"
        with render.white(obj):
            overview = render.light(shot, frame_of(0), render.OVERVIEW, file)
            patches = colours.patches(overview, person.cloth, np.array(shot.camera.location))
            whites = [
                render.light(shot, frame_of(0), render.READING, file, patch.window)
                for patch in patches
            ]
        skin = skin_of(read_table(folder / TABLE).provenance)
        angles = [patch.angle for patch in patches]
        predicted = colours.predictions(skin, DOSE, DAYS, angles)
        for day, both in zip(tqdm(DAYS, "colours", unit="frame"), predicted, strict=True):
            for patch, white, prediction in zip(patches, whites, both, strict=True):
                light = render.light(shot, frame_of(day), render.READING, file, patch.window)
                readings.append(colours.reading(day, patch, light, white, prediction))
    colours.write_csv(readings, folder / "colours.csv")
    return readings


def video(folder: Path) -> None:
    """Render every frame of the timeline, smaller, into a video."""
    frames = range(frame_of(0), frame_of(DAYS[-1]) + 1)
    with tempfile.TemporaryDirectory(dir=folder) as scratch:
        paths = [Path(scratch) / f"{frame:03d}.png" for frame in frames]
        for frame, path in zip(tqdm(frames, "video", unit="frame"), paths, strict=True):
            render.picture(bpy.context.scene, frame, render.VIDEO, path)
        captions = [f"Day {(frame - frame_of(0)) // FRAMES_PER_DAY}" for frame in frames]
        montage.video(paths, captions, folder / "tan_lines.mp4")


def silence_blender() -> None:
    """Keep standard output for this program's own lines: Blender writes one for every picture."""
    sys.stdout = os.fdopen(os.dup(1), "w", buffering=1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)
