"""Times the add-on on this machine: the rows of `make bench` about Blender.

A process of its own, as Blender brings its own libraries; processor time, for other work on the
machine does not count.
"""

import argparse
import os
import tempfile
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import bpy
import numpy as np

import blender_addon
from blender_addon import live
from blender_addon.applied import text_of
from blender_addon.apply import apply_tan
from blender_addon.model.history import DRAG, FULL
from examples.bench_lines import milliseconds, report_at_most
from examples.demo.tan_lines import silence_blender
from hylios.skin.phototypes import PHOTOTYPES

SKIN = "III"
REPEATS = 15
SEED = 1

SCHEDULES = ((30.0, 1), (60.0, 10), (365.0, 20))
"""Days of a scene, and exposures in it."""

LIVE_LIMITS = {60.0: 16.0, 365.0: 40.0}
"""Milliseconds at most, from a changed exposure to the pixels, by the days of the scene."""

SIZE_LIMITS = {30.0: 0.4, 365.0: 1.0}
"""Megabytes at most that a tan adds to a file."""

BIOLOGY, BIOLOGY_COLD, MASK = 60.0, 300.0, 500.0
"""Milliseconds at most of a move of a biology slider, of the first one, and of a new mask."""

SIDE = 317
"""Vertices along a grid of 100,000 and some."""

CHARACTERS, FRAMES, FRAME_LIMIT = 200, 50, 1.0
"""Milliseconds at most that the tans of so many objects that move add to a change of the frame."""


def new_file() -> None:
    """An empty file."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)


def grid(side: int = 4) -> bpy.types.Object:
    """A mesh object with side x side vertices, and a mask that rises along x."""
    place = np.linspace(0.0, 1.0, side)
    vertices = np.stack([*np.meshgrid(place, place), np.zeros((side, side))], axis=-1)
    first = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    mesh = bpy.data.meshes.new("Skin")
    faces = np.stack([first, first + 1, first + side + 1, first + side], axis=1)
    mesh.from_pydata(vertices.reshape(-1, 3), [], faces)
    mesh.attributes.new("mask", "FLOAT", "POINT")
    shares = np.ascontiguousarray(vertices[..., 0], np.float32).ravel()
    mesh.attributes["mask"].data.foreach_set("value", shares)
    obj = bpy.data.objects.new("Skin", mesh)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def scheduled(obj: bpy.types.Object, days: float, count: int) -> bpy.types.Object:
    """The object with exposures spread over the days of a scene."""
    settings = obj.skin_tan
    settings.skin = SKIN
    settings.mask.source = "mask"
    settings.exposures.clear()
    settings.first_day, settings.last_day = 0.0, days
    doses = np.random.default_rng(SEED).uniform(2.0, 12.0, count)
    for number, dose in enumerate(doses):
        exposure = settings.exposures.add()
        exposure.day, exposure.dose = number * days / (count + 1), float(dose)
    return obj


def report_biology() -> None:
    """A biology slider while it is dragged, and at first: of the slowest skin type."""
    for kinetics in ("MEASURED", "THESIS"):
        by_type = {}
        for name in PHOTOTYPES:
            new_file()
            obj = scheduled(grid(), *SCHEDULES[0])
            obj.skin_tan.skin, obj.skin_tan.kinetics = name, kinetics
            apply_tan(obj, bpy.context.scene)

            def move(run: int, obj=obj) -> None:
                obj.skin_tan.biology.melanin = 1.1 + 0.02 * run
                live.show_look(obj, text_of(obj, bpy.context.scene), rough=True)

            first, *by_type[name] = milliseconds(move, 1 + REPEATS)
            if len(by_type) == 1 and kinetics == "MEASURED":  # nothing is kept from others yet
                report_at_most("biology slider, the first move", [first], "ms", BIOLOGY_COLD)
        slowest = max(by_type, key=lambda name: float(np.median(by_type[name])))
        what = f"biology slider, further moves, type {slowest}, {kinetics.lower()}"
        report_at_most(what, by_type[slowest], "ms", BIOLOGY)


def report_schedules(folder: Path) -> None:
    """Apply, a changed exposure to the pixels, and what a tan adds to a file."""
    for days, count in SCHEDULES:
        new_file()
        obj, shown = grid(), bpy.context.scene
        before = saved_megabytes(folder)
        scheduled(obj, days, count)
        what = f"{days:g} days, {count} exposure{'s' if count > 1 else ''}"

        def change(run: int, obj=obj) -> None:
            obj.skin_tan.exposures[0].dose = 3.0 + 0.1 * run

        def drag(run: int, obj=obj, shown=shown, change=change) -> None:
            change(run)
            live.show_schedule(obj, text_of(obj, shown), DRAG)

        def release(run: int, obj=obj, shown=shown, change=change) -> None:
            change(run)
            live.show_schedule(obj, text_of(obj, shown), FULL)

        def press(run: int, obj=obj, shown=shown, change=change) -> None:
            change(run)
            apply_tan(obj, shown)

        applied = milliseconds(press, 1 + REPEATS)[1:]
        report_at_most(f"Apply, {what}", applied, "ms", None)
        first = saved_megabytes(folder)
        apply_tan(scheduled(grid(), days, count), shown)
        second = saved_megabytes(folder)
        for how, own, further in zip(
            ("compressed", "uncompressed"), first - before, second - first, strict=True
        ):
            report_at_most(f"  adds to a file, {how}", [own], "MB", SIZE_LIMITS.get(days))
            report_at_most(f"  a second object of that skin, {how}", [further], "MB", None)
        dragged = milliseconds(drag, 1 + REPEATS)[1:]
        report_at_most("  a changed exposure, while dragging", dragged, "ms", LIVE_LIMITS.get(days))
        report_at_most("  the same after release", milliseconds(release, REPEATS), "ms", None)


def saved_megabytes(folder: Path) -> np.ndarray:
    """Size of the file as it is saved, (2,): compressed, as Blender 5 does by itself, and not."""
    path, sizes = folder / "size.blend", []
    for compress in (True, False):
        with redirect_stdout(StringIO()):  # Blender says that it has saved
            bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=compress, copy=True)
        sizes.append(path.stat().st_size / 1e6)
    return np.array(sizes)


def report_masks() -> None:
    """A vertex group of many vertices as the mask; two masks, each of exposures of its own."""
    new_file()
    obj, shown = scheduled(grid(SIDE), 60.0, 10), bpy.context.scene
    for name in ("painted", "other"):
        group = obj.vertex_groups.new(name=name)
        for share in range(10):
            first = share * SIDE * SIDE // 10
            group.add(range(first, first + SIDE * SIDE // 10), share / 9.0, "REPLACE")
    names = ("painted", "other")

    def one(run: int) -> None:
        obj.skin_tan.mask.source = names[run % 2]
        apply_tan(obj, shown)

    what = f"mask of {SIDE * SIDE:,} vertices, a vertex group"
    report_at_most(what, milliseconds(one, 1 + REPEATS)[1:], "ms", MASK)
    second = obj.skin_tan.exposures[1]
    second.own_mask = True

    def two(run: int) -> None:
        second.mask.source = ("mask", "other")[run % 2]
        apply_tan(obj, shown)

    report_at_most(
        "  and one exposure with its own", milliseconds(two, 1 + REPEATS)[1:], "ms", MASK
    )


def characters(scene: bpy.types.Scene, *, moving: bool) -> list[bpy.types.Object]:
    """Objects of a scene, each with a material of its own."""
    objects = [grid() for _ in range(CHARACTERS)]
    for obj in objects:
        for collection in obj.users_collection:
            collection.objects.unlink(obj)
        scene.collection.objects.link(obj)
        obj.data.materials.append(bpy.data.materials.new("Skin"))
        for frame in (1, FRAMES) if moving else ():
            obj.location.x = frame
            obj.keyframe_insert("location", frame=frame)
    return objects


def report_frames(*, moving: bool) -> None:
    """What the tans of many characters, moving or not, add to a change of the frame.

    Three scenes take turns: as they are, with a keyed property on every object, and with tans.
    """
    new_file()
    scenes = [bpy.context.scene, bpy.data.scenes.new("Keyed"), bpy.data.scenes.new("Tanned")]
    _, keyed, tanned = (characters(scene, moving=moving) for scene in scenes)
    for obj in keyed:
        for frame in (1, FRAMES):
            obj["key"] = float(frame)
            obj.keyframe_insert('["key"]', frame=frame)
    for obj in tanned:
        apply_tan(scheduled(obj, *SCHEDULES[0]), scenes[2])

    def frames(run: int) -> None:
        for frame in range(1, FRAMES + 1):
            scenes[run % 3].frame_set(frame)

    spent = np.array(milliseconds(frames, 3 * (1 + REPEATS))[3:]).reshape(-1, 3) / FRAMES
    bare, of_keys, of_tans = spent.T
    how = "move" if moving else "stand still"
    report_at_most(f"change of the frame, {CHARACTERS} objects that {how}", bare, "ms", None)
    report_at_most("  added by a keyed property on every one", of_keys - bare, "ms", None)
    limit = FRAME_LIMIT if moving else None
    report_at_most("  added by their tans", of_tans - bare, "ms", limit)


def main() -> None:
    """Measure and print."""
    print(f"Blender {bpy.app.version_string}; processor time of {REPEATS} runs", flush=True)
    blender_addon.register()
    with tempfile.TemporaryDirectory() as folder:
        report_biology()
        report_schedules(Path(folder))
        report_masks()
        report_frames(moving=True)
        report_frames(moving=False)


if __name__ == "__main__":
    argparse.ArgumentParser("python -m examples.bench_blender", description=__doc__).parse_args()
    silence_blender()
    main()
    os._exit(0)  # Blender 4.5 may hang in an ordinary exit
