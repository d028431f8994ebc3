"""Makes an example .blend: a tanned body, its clothes, two times in the sun, days on the timeline.

`python -m examples.example_file` writes out/example.blend. The body is downloaded once; with
--suzanne Blender's monkey stands in for it, and nothing is.
"""

import argparse
import os
import sys
from dataclasses import replace
from pathlib import Path

from hylios.commands.shell import Parser, run


def parser() -> Parser:
    """The command's parser."""
    parser = Parser("python -m examples.example_file", description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/example.blend"), help="the file")
    parser.add_argument("--suzanne", action="store_true", help="the monkey in place of the body")
    return parser


def example(arguments: argparse.Namespace) -> None:
    """Make the file, and print where it is."""
    import bpy  # takes a second, too long for a command's help

    import blender_addon
    from examples.demo import scene, tan_lines
    from examples.example_file.make import make

    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    blender_addon.register()
    subject = scene.suzanne() if arguments.suzanne else tan_lines.subject()
    make(replace(subject, levels=subject.levels - 1), arguments.out)  # a file for the road
    print(f"{arguments.out} ({arguments.out.stat().st_size / 1e6:.1f} MB)")


def main() -> int:
    """Run, and return the status for the shell."""
    return run(example, parser().parse_args())


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    os._exit(status)  # Blender 4.5 hangs in an ordinary exit.
