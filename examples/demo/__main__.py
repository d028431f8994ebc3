"""Renders the tan lines of a swimsuit over 30 days into out/: `python -m examples.demo`."""

import argparse
import os


def main() -> int:
    """Run the demo, and return the status for the shell."""
    argparse.ArgumentParser("python -m examples.demo", description=__doc__).parse_args()

    # Blender and colour-science take seconds, too long for a command's help.
    from examples.demo.tan_lines import demo, silence_blender
    from hylios.commands.shell import run

    silence_blender()
    return run(demo, argparse.Namespace())


if __name__ == "__main__":
    os._exit(main())  # Blender 4.5 hangs in an ordinary exit after a render.
