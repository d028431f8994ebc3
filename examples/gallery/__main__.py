"""Renders faces, shoulders and hands of new materials: `python -m examples.gallery`."""

import argparse
import os
import sys
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from examples.gallery import shots

if TYPE_CHECKING:
    import numpy as np

    from examples.demo.scene import Subject

WEEK = "week"

Tan = Callable[[str, tuple[str, float]], object]
"""Puts the body with a skin, after some sun, into an empty scene."""


def parser() -> argparse.ArgumentParser:
    """The command's parser."""
    parser = argparse.ArgumentParser("python -m examples.gallery", description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/gallery"), help="folder to write to")
    parser.add_argument("--size", type=int, default=320, help="height of a picture in pixels")
    parser.add_argument("--samples", type=int, default=64, help="samples of a pixel")
    parser.add_argument("--skins", nargs="+", default=list(shots.SKINS), help="skins of the add-on")
    parser.add_argument(
        "--only-week",
        action="store_true",
        help="the sheet on which skin burns, tans and fades, without those of places",
    )
    return parser


def gallery(arguments: argparse.Namespace) -> None:
    """Render all pictures, and write a sheet for every place of the body and one of a week."""
    import tempfile

    from tqdm import tqdm

    import blender_addon
    from examples.gallery import stage

    tan = partial(stage.tanned, *_body())
    blender_addon.register()
    arguments.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=arguments.out) as scratch, tqdm(unit="picture") as bar:
        file = Path(scratch) / "picture.png"
        _week(arguments, tan, file, bar.update)
        if not arguments.only_week:
            _places(arguments, tan, file, bar.update)
    print(f"The sheets are in {arguments.out.resolve()}")


def _body() -> "tuple[Subject, Mapping[str, np.ndarray]]":
    """The body after a swimsuit, and how far its vertices lie in regions of the face."""
    from examples.demo.body import EYES_CLOSED, BodyUnavailableError, fetch_wheel, read_body
    from examples.demo.scene import Subject
    from examples.demo.swimsuit import one_piece
    from examples.demo.tan_lines import OUT
    from examples.gallery import face
    from hylios.errors import InputError

    try:
        wheel = fetch_wheel(OUT / ".cache")
        body = read_body(wheel, EYES_CLOSED)
        regions = face.shares(wheel, len(body.vertices))
    except BodyUnavailableError as error:
        raise InputError(f"{error} The gallery needs its body.") from error
    return Subject("Body", body, 2, one_piece, (0.0, 0.0, 1.27), 0.76, 25.0), regions


def _week(
    arguments: argparse.Namespace, tan: Tan, scratch: Path, rendered: Callable[[], object]
) -> None:
    from examples.figures.render_sheet import Panel, sheet
    from examples.gallery import stage

    rows = []
    for skin in shots.WEEK_SKINS:
        tan(skin, shots.SAME_SUN)
        row = []
        for day, picture in stage.portraits(arguments.samples, arguments.size, scratch):
            row.append(Panel(picture, f"{skin}, day {day}"))
            rendered()
        rows.append(row)
    amount, days = shots.SAME_SUN[1], shots.SUNNY_DAYS
    sheet(f"{days} days of {amount:g} SED from day 0 on", rows, arguments.out / f"{WEEK}.png")


def _places(
    arguments: argparse.Namespace, tan: Tan, scratch: Path, rendered: Callable[[], object]
) -> None:
    from examples.figures.render_sheet import Panel, sheet
    from examples.gallery import stage

    rows: dict[str, dict[str, list[Panel]]] = {place.name: {} for place in shots.PLACES}
    for skin in arguments.skins:
        tan(skin, shots.ALIKE)
        for place, far, light, picture in stage.pictures(
            arguments.samples, arguments.size, scratch
        ):
            panel = Panel(picture, f"{skin}, {far}, {light} light")
            rows[place].setdefault(skin, []).append(panel)
            rendered()
    for place, by_skin in rows.items():
        heading = f"{place.capitalize()}, after a week in the sun"
        sheet(heading, list(by_skin.values()), arguments.out / f"{place}.png")


def main() -> int:
    """Make the gallery, and return the status for the shell."""
    arguments = parser().parse_args()

    from examples.demo.tan_lines import silence_blender
    from hylios.commands.shell import run

    silence_blender()
    return run(gallery, arguments)


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    os._exit(status)  # Blender 4.5 hangs in an ordinary exit after a render.
