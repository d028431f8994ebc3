"""Renders after figures 6.24 to 6.29: skin that tans, in Blender, by tables and the add-on.

Blender runs in a process of its own (`scenes`); `shots` says what it renders.
"""

import subprocess
import sys
import tempfile
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from examples.figures import report, shots
from examples.figures.light import Effort, Task, Tick
from examples.figures.shots import UV, Shot, Window
from examples.figures.tans import Schedule, history
from hylios.adding import colours
from hylios.burley import burley_width
from hylios.errors import InputError
from hylios.lab.colour import TINTS, difference, lab, linear_of_srgb, srgb
from hylios.lab.pictures import write_figure
from hylios.quadrature import MOST
from hylios.skin import Skin
from hylios.table import SkinTable
from hylios.transport.simulate import DISTANCE_EDGES
from hylios.transport.simulate import spectrum as walked
from lut_builder.assemble import build
from lut_builder.exr_writer import write_table
from lut_builder.settings import Settings

FIGURES = ("6.24", "6.25", "6.26", "6.27", "6.28", "6.29")

SETTINGS = Settings(knots=(9, 3, 2), profile_error=0.02, bands=())
"""Of the tables: coarser than the standard preset."""

TABLE_AS_LONG = 4000
"""Wavelengths without noise that take as long as a table; it only serves the time left."""

NEAR = 2.0
"""How near in L* a render is to come to its table; what the shader's surface keeps out is 1."""

UV_NM, UV_RAYS = 365.0, 100_000
UV_EXPOSURE = 1.7
"""How much brighter than the visible pictures those at 365 nm are shown."""


def uv_table(table: SkinTable, skin: Skin, effort: Effort) -> SkinTable:
    """The table with reflectance and profile width at 365 nm in place of colour, as a grey."""
    planes = {name: table.planes[name].copy() for name in ("subsurface_colour", "profile_width")}
    for knot in np.ndindex(*table.axes.shape):
        state = table.axes.knot_states()[knot]
        found = walked(
            skin.at(state),
            np.array([UV_NM]),
            angle=8.0,
            rays=UV_RAYS,
            seed=effort.seed,
            threads=effort.threads,
        )
        width = burley_width(DISTANCE_EDGES, found.exit_counts[0])
        planes["subsurface_colour"][knot] = found.subsurface[0]
        planes["profile_width"][knot] = width
    return replace(table, planes={**table.planes, **planes})


@dataclass(frozen=True)
class Result:
    """A shot, and what was read from it; colours are linear Rec.709.

    Attributes
    ----------
    picture : (rows, columns, 3) array
        sRGB, 0 to 1.
    readings : (parts + 1, 3) array
        Light out of the skin as a share of a white diffuser's: of each part in the sun, then of
        covered skin.
    predicted : (parts + 1, 3) array
        The same by the table at the tanning state of the day.
    exact : (parts + 1, 3) array or None
        The same by the light model without noise; None at 365 nm.
    shine : (2,) array
        Light reflected by the surface, mean of the brightest hundredth, in the sun and covered.
    sun_distance : (rows, columns) array
        Metres to the edge of what the sun reached, negative beyond it; not a number elsewhere.
    subject : str
        Who is in the picture.
    """

    shot: Shot
    picture: np.ndarray
    readings: np.ndarray
    predicted: np.ndarray
    exact: np.ndarray | None
    shine: np.ndarray
    sun_distance: np.ndarray
    subject: str

    @property
    def lightness(self) -> np.ndarray:
        """L* (parts + 1,) as read."""
        return lab(self.readings)[:, 0]

    @property
    def contrast(self) -> np.ndarray:
        """CIEDE2000 (parts,) between the parts in the sun and covered skin, as read."""
        return difference(self.readings[:-1], self.readings[-1])


PICTURE_AS_LONG = 2000
"""Wavelengths without noise that take as long as a picture; it only serves the time left."""


def tasks(effort: Effort) -> dict[str, Task]:
    """One task: tables, then renders in a process of their own.

    Raises
    ------
    InputError
        If there is no Blender.
    """
    if find_spec("bpy") is None:
        raise InputError("figures 6.24 to 6.29 need Blender's Python module bpy.")
    wanted = shots.shots()

    def work(tick: Tick) -> list[Result]:
        with tempfile.TemporaryDirectory() as folder:
            return rendered(wanted, Path(folder), effort, tick)

    skins = len(shots.skins())
    return {"renders": Task(work, skins * TABLE_AS_LONG + PICTURE_AS_LONG * len(wanted))}


def rendered(
    wanted: Sequence[Shot],
    folder: Path,
    effort: Effort,
    tick: Tick,
    options: Sequence[str] = (),
) -> list[Result]:
    """Build the tables that shots need in a folder, render there, and read what came of it."""
    skins = {**shots.skins(), UV: shots.skins()["low"]}
    tables = {name: table_of(skins[name], effort, tick) for name in _colour_tables(wanted)}
    if any(shot.table == UV for shot in wanted):
        tables[UV] = uv_table(tables["low"], skins[UV], effort)
    for name, table in tables.items():
        write_table(folder / f"{name}.exr", table)
    run_blender(wanted, folder, options, tick)
    return [result(shot, skins[shot.table], tables[shot.table], folder) for shot in wanted]


def _colour_tables(wanted: Sequence[Shot]) -> list[str]:
    return sorted({"low" if shot.table == UV else shot.table for shot in wanted})


def table_of(skin: Skin, effort: Effort, tick: Tick) -> SkinTable:
    """The table of a skin."""
    table = build(skin, SETTINGS, seed=effort.seed, threads=effort.threads)
    tick(TABLE_AS_LONG)
    return table


def run_blender(wanted: Sequence[Shot], folder: Path, options: Sequence[str], tick: Tick) -> None:
    """Render shots into a folder that has their tables.

    Raises
    ------
    InputError
        If that fails; Blender's process has said why.
    """
    command = [sys.executable, "-m", "examples.figures.scenes", str(folder), *options]
    with subprocess.Popen(
        [*command, *(shot.name for shot in wanted)], stdout=subprocess.PIPE, text=True
    ) as blender:
        for line in blender.stdout or ():
            if line.startswith(shots.DONE):
                tick(PICTURE_AS_LONG)
    if blender.returncode:
        raise InputError(f"Blender could not render the figures (status {blender.returncode}).")


def result(shot: Shot, skin: Skin, table: SkinTable, folder: Path) -> Result:
    """What came of a shot, beside what the model says."""
    states = tanning_states(shot, skin)
    with np.load(folder / f"{shot.name}.npz") as found:
        return Result(
            shot=shot,
            picture=found["picture"],
            readings=found["readings"],
            predicted=table.plane("subsurface_colour", states),
            exact=None if shot.table == UV else np.array([colour(skin, s) for s in states]),
            shine=found["shine"],
            sun_distance=found["sun_distance"],
            subject=str(found["subject"]),
        )


def tanning_states(shot: Shot, skin: Skin) -> np.ndarray:
    """States (parts + 1, 4) on the day of a shot: of each schedule, and without sun."""
    every = (*shot.schedules, ())
    return np.array([history(skin, each, shot.day).states[-1] for each in every])


def colour(skin: Skin, state: np.ndarray) -> np.ndarray:
    """Colour (3,) of the light out of skin in a tanning state (4,), without noise."""
    return colours(skin, state[None], count=MOST).subsurface[0]


# ---------------------------------------------------------------- figures


def _totals(schedules: Sequence[Schedule]) -> str:
    totals = [f"{sum(dose for _, dose in schedule):.3g}" for schedule in schedules]
    return f"{', '.join(totals[:-1])} and {totals[-1]}" if len(totals) > 1 else totals[0]


def draw(results: Mapping[str, Sequence[Result]], folder: Path) -> list[report.Row]:
    """Draw the figures; returns what they say."""
    found = {each.shot.name: each for each in results["renders"]}
    by_figure = {
        figure: [each for name, each in found.items() if name.startswith(figure)]
        for figure in FIGURES
    }
    rows = [*readings_rows(by_figure)]
    for figure, drawn in zip(
        FIGURES, (schedules, plain, matched, strong, face, month), strict=True
    ):
        panels, more = drawn(by_figure[figure])
        sheet(HEADINGS[figure], panels, folder / f"{figure}.png")
        rows += more
    rows.append(mild_beside_strong(by_figure["6.27"], by_figure["6.28"]))
    return sorted(rows, key=lambda row: FIGURES.index(row.where))


HEADINGS = {
    "6.24": f"Patches of skin of low pigmentation (MMD {shots.MMD} SED). From the upper: "
    f"{_totals(shots.SCHEDULES)} SED in equal doses twice a week from day 0 on (assumed)",
    "6.25": "The same doses on three skins, day 20; upper to lower patch as under the pictures",
    "6.26": "Doses scaled by 1, 1.4 and 2.4, day 20; upper to lower patch as under the pictures",
    "6.27": "30 SED on day 0 beside sunscreen; low pigmentation, high tanning ability",
    "6.28": "30 SED on day 0 on one half of a face; low pigmentation, mild tanning ability",
    "6.29": "30 SED on day 0 beside a swimsuit; intermediate tanning set, day by day",
}
Rows = list[report.Row]
Panels = list[list["Panel"]]


@dataclass(frozen=True)
class Panel:
    """A picture (rows, columns, 3), sRGB, with lines under it.

    Drawn into it: a frame, and a line where `outlined` (rows, columns) is 0.
    """

    picture: np.ndarray
    caption: str
    marked: Window | None = None
    outlined: np.ndarray | None = None


def readings_rows(by_figure: Mapping[str, Sequence[Result]]) -> Rows:
    """How near the renders come to the tables, and those to the light model."""
    rows = []
    for figure, results in by_figure.items():
        visible = [each for each in results if each.exact is not None]
        off = np.concatenate([lab(each.readings) - lab(each.predicted) for each in visible])[:, 0]
        apart = np.concatenate([difference(each.predicted, each.exact) for each in visible])
        rows.append(
            report.Row(
                figure,
                f"L* read from {len(visible)} renders, less the table's",
                "",
                f"{np.nanmin(off):+.2f} to {np.nanmax(off):+.2f}; table from the light model "
                f"without noise: CIEDE2000 up to {apart.max():.2f}",
                "none but in profile widths",
                f"within {NEAR:g}",
                bool(np.nanmax(np.abs(off)) <= NEAR),
            )
        )
        others = sorted({each.subject for each in results if each.subject == "Suzanne"})
        if others:
            rows.append(report.Row(figure, "subject", "a woman", "Suzanne stands in for her"))
    return rows


def schedules(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Figure 6.24."""
    ordered = sorted(results, key=lambda each: each.shot.day)
    panels = [
        Panel(
            each.picture,
            f"day {each.shot.day:g}",
            shots.PATCHES if each.shot.window == shots.WHOLE else None,
        )
        for each in ordered
    ]
    later = [each for each in ordered if each.shot.day > 0]
    dark = np.array([each.lightness for each in later])
    rows = [
        report.claim(
            "6.24",
            "each stronger schedule leaves a darker patch, and all are darker than beside them",
            "so drawn",
            "; ".join(
                f"day {each.shot.day:g}: " + " ".join(f"{value:.1f}" for value in each.lightness)
                for each in later
            )
            + " (L* of upper, middle, lower, beside)",
            bool(np.all(np.diff(dark[:, [3, 0, 1, 2]], axis=1) < 0.0)),
        )
    ]
    return [panels], rows


def plain(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Figure 6.25."""
    panels, contrasts = _three_skins(results)
    weakest = contrasts["high"][0]
    less = all(
        np.all(np.diff([contrasts[name][part] for name in shots.SENSITIVITY]) < 0.0)
        for part in range(3)
    )
    return panels, [
        report.claim(
            "6.25",
            "the darker the skin, the less it tans of the same doses, in every patch",
            "so it is",
            _contrasts(contrasts),
            less,
        ),
        report.claim(
            "6.25",
            "weakest schedule on the darkest skin: no noticeable change",
            "not noticeable (here: CIEDE2000 below 1)",
            f"{weakest:.2f}",
            bool(weakest < 1.0),
        ),
        report.claim(
            "6.25",
            "the other schedules on the darkest skin (implied)",
            "noticeable",
            " and ".join(f"{value:.2f}" for value in contrasts["high"][1:]),
            bool(np.all(contrasts["high"][1:] >= 1.0)),
        ),
    ]


def matched(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Figure 6.26."""
    panels, contrasts = _three_skins(results)
    more = all(
        np.all(np.diff([contrasts[name][part] for name in shots.SENSITIVITY]) > 0.0)
        for part in range(3)
    )
    return panels, [
        report.claim(
            "6.26",
            "the darker the skin, the more noticeable the change, in every patch",
            "so it is",
            _contrasts(contrasts),
            more,
        )
    ]


def _three_skins(results: Sequence[Result]) -> tuple[Panels, dict[str, np.ndarray]]:
    panels = []
    for each in results:
        name = each.shot.table
        caption = f"{name} pigmentation\n{_totals(each.shot.schedules)} SED in all"
        panels.append(Panel(each.picture, caption))
    return [panels], {each.shot.table: each.contrast for each in results}


def _contrasts(contrasts: Mapping[str, np.ndarray]) -> str:
    listed = "; ".join(
        f"{name} " + " ".join(f"{value:.1f}" for value in values)
        for name, values in contrasts.items()
    )
    return f"CIEDE2000 of upper, middle, lower from beside: {listed}"


def strong(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Figure 6.27."""
    panels = [
        Panel(each.picture, "day 0, sunscreen on (outlined)", outlined=each.sun_distance)
        if each.shot.gloss
        else Panel(each.picture, f"day {each.shot.day:g}")
        for each in results
    ]
    contrasts = {each.shot.day: float(each.contrast[0]) for each in results}
    return [panels], [
        report.claim(
            "6.27",
            "noticeably darker on day 4, significantly on day 15",
            "so it is",
            ", ".join(
                f"day {day:g}: L* {each.lightness[0]:.1f}, CIEDE2000 {contrasts[day]:.1f} "
                "from under the sunscreen"
                for day, each in zip(contrasts, results, strict=True)
            ),
            bool(1.0 < contrasts[4] < contrasts[15]),
        ),
        _filling(),
    ]


def _filling() -> report.Row:
    """What so much melanin does to a layer, over the days of the figure."""
    skin = shots.skins()["strong"]
    over = history(skin, shots.BEACH, shots.LAST_DAY)
    cut = any(skin.overfull(state) for state in over.states)
    return report.Row(
        "6.27",
        "most melanin, as a multiple of the untanned skin's",
        "",
        f"{over.total.max():.2f}; " + ("cut to fill a layer" if cut else "it fits every layer"),
    )


def face(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Figure 6.28."""
    seen = {each.shot.day: each for each in results if each.shot.table != UV}
    uv = {each.shot.day: each for each in results if each.shot.table == UV}
    before, after = shots.FACE_DAYS
    said = {before: "before, sunscreen on one half", after: f"{after} days after"}
    panels = [
        [
            Panel(seen[day].picture, f"visible\n{said[day]}"),
            Panel(pseudo_colour(uv[day].picture), f"365 nm\n{said[day]}"),
        ]
        for day in (before, after)
    ]
    bare, covered = seen[before].shine
    visible, at_365 = (_luminance(found[after].readings) for found in (seen, uv))
    return panels, [
        report.claim(
            "6.28",
            "the side under sunscreen is glossier",
            "so drawn",
            f"the surface reflects up to {covered:.2f} there, {bare:.2f} beside",
            bool(covered > bare),
        ),
        report.Row(
            "6.28",
            f"light out of tanned over covered skin on day {after}",
            "",
            f"{visible[0] / visible[1]:.2f} (visible, luminance), {at_365[0] / at_365[1]:.2f} "
            f"(365 nm); CIEDE2000 {seen[after].contrast[0]:.1f} in the visible",
        ),
    ]


def mild_beside_strong(back: Sequence[Result], faces: Sequence[Result]) -> report.Row:
    """Figures 6.27 and 6.28 on day 15."""
    high, mild = (
        next(each.contrast[0] for each in results if each.shot.day == 15 and each.shot.table != UV)
        for results in (back, faces)
    )
    return report.claim(
        "6.28",
        "tan line on day 15 fainter than with high tanning ability (6.27)",
        "so it is",
        f"CIEDE2000 {mild:.1f} and {high:.1f}",
        bool(mild < high),
    )


def pseudo_colour(picture: np.ndarray) -> np.ndarray:
    """A grey picture in the tint of ultraviolet swatches, sRGB; brighter by `UV_EXPOSURE`."""
    return srgb(UV_EXPOSURE * linear_of_srgb(picture) * np.array(TINTS["uv"]))


def _luminance(linear: np.ndarray) -> np.ndarray:
    return linear @ np.array([0.2126, 0.7152, 0.0722])


def month(results: Sequence[Result]) -> tuple[Panels, Rows]:
    """Figure 6.29."""
    daily = [each for each in results if "small" in each.shot.name]
    main = [each for each in results if "small" not in each.shot.name]
    small = [Panel(each.picture, f"day {each.shot.day:g}") for each in daily]
    weeks = [small[start : start + 10] for start in range(0, len(small), 10)]
    lightness = np.array([each.lightness[0] for each in daily])
    days = np.array([each.shot.day for each in daily])
    darkest, untanned = lightness.min(), daily[0].lightness[1]
    change = (untanned - lightness) / (untanned - darkest)
    peak = days[np.argmin(lightness)]
    broad = days[change > 0.9]
    return [*weeks, [Panel(each.picture, f"day {each.shot.day:g}") for each in main]], [
        report.claim(
            "6.29", "day of the darkest skin", "10", f"{peak:g}", bool(8.0 <= peak <= 12.0)
        ),
        report.claim(
            "6.29",
            "rapid rise, broad maximum, gradual fading",
            "so it is",
            f"half of the largest change in L* ({untanned - darkest:.1f}) by day "
            f"{days[np.argmax(change > 0.5)]:g}; nine tenths from day {broad[0]:g} to "
            f"{broad[-1]:g}; on day {days[-1]:g} {change[-1]:.0%} are left",
            bool(
                broad[0] < broad[-1] - broad[0]
                and broad[0] < days[-1] - broad[-1]
                and change[-1] < 0.75
            ),
        ),
    ]


# ---------------------------------------------------------------- sheets

DOTS_PER_INCH = 100
GAP, LINE, LETTER = 8, 19, 8
"""Pixels between pictures, of a line of a caption, and of a heading's letter."""


def sheet(heading: str, panels: Panels, path: Path) -> None:
    """Write rows of panels under a heading into a PNG file, each picture pixel by pixel."""
    heights = [
        max(panel.picture.shape[0] + GAP + LINE * (panel.caption.count("\n") + 1) for panel in row)
        for row in panels
    ]
    widths = [sum(panel.picture.shape[1] + GAP for panel in row) + GAP for row in panels]
    width, height = max(widths), sum(heights) + GAP * (len(panels) + 1) + 2 * LINE
    figure = Figure(figsize=(width / DOTS_PER_INCH, height / DOTS_PER_INCH), dpi=DOTS_PER_INCH)
    lines = textwrap.fill(heading, width // LETTER)
    figure.text(0.5, 1.0 - GAP / height, lines, ha="center", va="top", fontsize=10)
    top = GAP + LINE * (lines.count("\n") + 2) - LINE // 2
    for row, tall, wide in zip(panels, heights, widths, strict=True):
        left = (width - wide) // 2 + GAP
        for panel in row:
            _put(figure, panel, left, top, width, height)
            left += panel.picture.shape[1] + GAP
        top += tall + GAP
    write_figure(figure, path)


def _put(figure: Figure, panel: Panel, left: int, top: int, width: int, height: int) -> None:
    """Put a picture into a figure of so many pixels, its caption below."""
    rows, columns = panel.picture.shape[:2]
    bottom = height - top - rows
    axes = figure.add_axes((left / width, bottom / height, columns / width, rows / height))
    axes.imshow(panel.picture, interpolation="nearest", aspect="auto", extent=(0, 1, 0, 1))
    axes.axis("off")
    if panel.marked:
        x0, x1, y0, y1 = panel.marked
        axes.add_patch(
            Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, edgecolor="white", linewidth=1.0)
        )
    if panel.outlined is not None:
        axes.contour(
            panel.outlined,
            levels=[0.0],
            colors="white",
            linewidths=0.8,
            extent=(0, 1, 0, 1),
            origin="upper",
        )
    figure.text(
        (left + columns / 2) / width,
        (bottom - GAP / 2) / height,
        panel.caption,
        ha="center",
        va="top",
        fontsize=9,
    )
