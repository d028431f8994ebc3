"""Tans the characters of a folder of .blend files: `python -m examples.tan_folder FOLDER`.

An example for a farm's preparation: it needs no window and no installed extension, and the files
that it writes render on machines that have neither the add-on nor scripts.
"""

import argparse
import os
import sys
from collections.abc import Iterator
from fnmatch import fnmatchcase
from pathlib import Path

from hylios.commands.shell import run
from hylios.errors import InputError


def parser() -> argparse.ArgumentParser:
    """The command's parser."""
    parser = argparse.ArgumentParser("python -m examples.tan_folder", description=__doc__)
    parser.add_argument("folder", type=Path, help="with .blend files, which stay as they are")
    parser.add_argument(
        "--out", type=Path, default=Path("out/tanned"), help="folder for the copies"
    )
    parser.add_argument("--objects", default="Body*", help="names of the characters' meshes")
    parser.add_argument("--skin", default="III", help="a skin of the add-on (default: III)")
    parser.add_argument("--schedule", type=Path, help="CSV with columns day and SED")
    parser.add_argument("--days", type=float, default=30.0, help="last day (default: 30)")
    parser.add_argument("--force", action="store_true", help="make copies anew that are there")
    return parser


def tan_folder(arguments: argparse.Namespace) -> None:
    """Write a tanned copy of every file; one that is there is not made again."""
    import bpy
    from tqdm import tqdm

    import blender_addon
    from blender_addon.model.catalogue import shipped_path
    from blender_addon.model.exposures_csv import read_exposures
    from blender_addon.model.settings import check_days

    files = sorted(arguments.folder.glob("*.blend"))
    if not files:
        raise InputError(f"{arguments.folder} holds no .blend file.")
    if arguments.out.resolve() == arguments.folder.resolve():
        raise InputError(f"--out is {arguments.out}, the folder of the originals; give another.")
    shipped_path(arguments.skin)
    check_days(0.0, arguments.days)
    exposures = read_exposures(arguments.schedule).exposures if arguments.schedule else ()
    arguments.out.mkdir(parents=True, exist_ok=True)
    blender_addon.register()
    failed: list[str] = []
    for file in tqdm(files, "tan", unit="file"):
        target = arguments.out / file.name
        if target.exists() and target.samefile(file):
            raise InputError(f"{target} is the original itself; give --out another folder.")
        if target.exists() and not arguments.force:
            continue
        try:
            bpy.ops.wm.open_mainfile(filepath=str(file), load_ui=False)
        except RuntimeError as error:
            failed.append(file.name)
            tqdm.write(f"{file.name} cannot be read: {' '.join(str(error).split())}")
            continue
        try:
            lines = list(tanned(arguments, exposures))
        except InputError as error:
            failed.append(file.name)
            tqdm.write(f"{file.name}: {error}")
            continue
        if not lines:
            tqdm.write(f"{file.name}: no mesh is called {arguments.objects}; no copy is made.")
            continue
        for line in lines:
            tqdm.write(f"{file.name}: {line}")
        unfinished = target.with_suffix(".unfinished.blend")
        bpy.ops.wm.save_as_mainfile(filepath=str(unfinished.resolve()), copy=True)
        os.replace(unfinished, target)
    if failed:
        raise InputError(f"Files without a copy: {', '.join(failed)}; all others are done.")


def tanned(arguments: argparse.Namespace, exposures: tuple[dict, ...]) -> Iterator[str]:
    """Tan the meshes of the open file; a line on each.

    Raises
    ------
    InputError
        If one of them cannot be tanned.
    """
    import bpy

    from blender_addon.apply import apply_tan

    scene = bpy.context.scene
    meshes = [obj for obj in scene.objects if obj.type == "MESH"]
    bodies = [obj for obj in meshes if fnmatchcase(obj.name, arguments.objects)]
    for body in bodies:
        settings = body.skin_tan
        settings.skin, settings.last_day = arguments.skin, arguments.days
        if exposures:
            settings.exposures.clear()
        for values in exposures:
            exposure = settings.exposures.add()
            for name, value in values.items():
                setattr(exposure, name, value)
        try:
            yield apply_tan(body, scene)
        except InputError as error:
            raise InputError(
                f"{body.name} cannot be tanned, so no copy is made: {error}"
            ) from error


def main() -> int:
    """Run, and return the status for the shell."""
    return run(tan_folder, parser().parse_args())


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    os._exit(status)  # Blender 4.5 hangs in an ordinary exit.
