"""The page of docs that shows rendered figures beside what the thesis says of them."""

from collections.abc import Sequence
from pathlib import Path

from PIL import Image

from examples.figures.report import Row
from hylios.files import written_beside

SAID = {
    "6.9": "Distinct looks in the UV, visible and IR: glossier in the UV, soft and diffuse in the "
    "IR, where pigment is hardly seen; a BRDF does for the UV only.",
    "6.10": "More melanin (1.5, 7, 30 %) takes the reflectance at 365 nm fast to a low value.",
    "6.11": "Loss of water (0, 20, 40 %) makes skin brighter at 1650 nm.",
    "6.12": "Beyond 1100 nm irregularities of pigment disappear; at 1400 nm, where water absorbs, "
    "skin is darker and glossier than at 1200 nm.",
    "6.19": "From 1.5 to 7 % melanin, with light from behind to make translucency prominent.",
    "6.20": "A back with sunscreen and water under a high sun: sunscreen is dark in the UV, water "
    "in the IR.",
    "6.27": "30 SED beside sunscreen, high tanning ability: noticeably darker after 4 days, "
    "significantly after 15.",
    "6.28": "30 SED on one half of a face, mild tanning ability; visible and UV, before and after "
    "15 days.",
    "6.29": "A month after 30 SED: a rapid rise to a broad maximum, then gradual fading.",
}
"""What each picture of the thesis is to show, in short."""

HEAD = """\
# The thesis's pictures

Each is made by one command, as `make figures FIGURES=6.9`, and stands here beside what the thesis
says should be seen. That takes 22 to 98 seconds of processor time (6.29 longest, of 34 renders),
and took two minutes at most on two cores that others used too. With `PAGE=docs/thesis_pictures.md`
and all their names that command writes this page.
[What came back of the thesis](thesis_figures.md) has the other figures, and what was assumed.

In 6.9 to 6.12, 6.19 and 6.20 each skin is solved at its own wavelength; the material has a near
share, Burley's profile for the rest, and the surface's gloss (`examples/figures/spectral_*.py`).
Freckles and moles (four times the melanin at most), films and lights are ASSUMED. The faces and
bodies are MakeHuman's, for the thesis's meshes were not to be had.

6.27 to 6.29 are made with tables and the add-on's Apply, with the relief and blotches of a material
that it makes. Sunscreen is its film, and the pictures at 365 nm are its view,
which tints skin alone: the cap and what is behind stay as they are in the visible.
"""

QUALITY = 85


def write(path: Path, rows: Sequence[Row], pictures: Path) -> None:
    """Write the page, and the pictures in a folder beside it as JPEG."""
    parts = [HEAD]
    folder = path.with_suffix("")
    folder.mkdir(exist_ok=True)
    for figure, said in SAID.items():
        drawn = pictures / f"{figure}.png"
        own = [row for row in rows if row.where == figure]
        if not own or not drawn.exists():
            continue
        with written_beside(folder / f"{figure}.jpg") as file:
            Image.open(drawn).convert("RGB").save(file, "JPEG", quality=QUALITY)
        lines = ["| the thesis says | ours | met |", "|---|---|---|"]
        for row in own:
            met = {None: "", True: "yes", False: "**no**"}[row.met]
            lines.append(f"| {row.what} | {row.ours or row.printed} | {met} |")
        image = f"```{{image}} {folder.name}/{figure}.jpg\n:alt: Render after figure {figure}.\n```"
        parts.append("\n\n".join([f"## Figure {figure}", said, image, "\n".join(lines)]) + "\n")
    with written_beside(path) as file:
        file.write_text("\n".join(parts), encoding="utf-8")
