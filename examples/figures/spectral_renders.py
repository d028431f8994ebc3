"""Renders after figures 6.9 to 6.12, 6.19 and 6.20: skin in the ultraviolet, visible and infrared.

`spectral_shots` says what is rendered, `spectral_looks` solves each skin at its wavelength, and
Blender renders it in a process of its own (`spectral_scenes`).
"""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

from examples.figures import report
from examples.figures.light import Effort, Task, Tick
from examples.figures.render_sheet import Panel, sheet
from examples.figures.renders import PICTURE_AS_LONG, rendering, run_blender
from examples.figures.spectral_claims import CLAIMS, Seen, pseudo_colour
from examples.figures.spectral_looks import look
from examples.figures.spectral_shots import LIGHT, SpectralShot, of_figures, said_of

FIGURES = ("6.9", "6.10", "6.11", "6.12", "6.19", "6.20")

HEADINGS = {
    "6.9": f"{LIGHT:.1%} melanin, freckles and moles (assumed). Upper row BSSRDF, lower row BRDF",
    "6.10": "More and more melanin, at 365 nm",
    "6.11": f"Loss of water, at 1650 nm; {LIGHT:.1%} melanin",
    "6.12": f"{LIGHT:.1%} melanin, freckles and moles (assumed). Each picture made brighter",
    "6.19": "Light from behind and from the side. Upper row BSSRDF, lower row BRDF",
    "6.20": f"{LIGHT:.1%} melanin; a sun of sunscreen, and drops of water, under a high light",
}
ROWS_OF = {"6.9": 3, "6.19": 2}
"""Pictures in a row, where there is more than one."""


def tasks(effort: Effort) -> dict[str, Task]:
    """One task: looks, then renders in a process of their own.

    Raises
    ------
    InputError
        If there is no Blender.
    """
    wanted = of_figures(effort.wanted(FIGURES))
    return rendering(
        "figures 6.9 to 6.12, 6.19 and 6.20",
        lambda folder, tick: rendered(wanted, folder, effort, tick),
        PICTURE_AS_LONG * len(wanted),
    )


def rendered(
    wanted: Sequence[SpectralShot],
    folder: Path,
    effort: Effort,
    tick: Tick,
    options: Sequence[str] = (),
) -> list[Seen]:
    """Solve the skins of shots, render them into a folder, and read them."""
    looks = {
        shot.name: look(
            shot.skin, shot.nm, spotted=shot.spots, seed=effort.seed, threads=effort.threads
        ).described
        for shot in wanted
    }
    (folder / "looks.json").write_text(json.dumps(looks), encoding="utf-8")
    run_blender(wanted, folder, options, tick, "examples.figures.spectral_scenes")
    return [Seen.of(shot, folder / f"{shot.name}.npz") for shot in wanted]


def draw(results: Mapping[str, Sequence[Seen]], folder: Path) -> list[report.Row]:
    """Draw the figures; returns what they say."""
    rows = []
    for figure in FIGURES:
        seen = [one for one in results["renders"] if one.shot.name.split()[0] == figure]
        if not seen:
            continue
        panels = [Panel(pseudo_colour(one), _caption(one, figure)) for one in seen]
        count = ROWS_OF.get(figure, len(panels))
        lines = [panels[first : first + count] for first in range(0, len(panels), count)]
        sheet(HEADINGS[figure], lines, folder / f"{figure}.png")
        rows += CLAIMS[figure](seen)
        others = sorted({one.subject for one in seen} - {"Face", "Back"})
        if others:
            rows.append(report.Row(figure, "subject", "a person", "Suzanne stands in"))
    return rows


def _caption(one: Seen, figure: str) -> str:
    named = one.shot.name.removeprefix(figure).strip()
    return named if said_of(one.shot.nm) in named else f"{named}, {said_of(one.shot.nm)}"
