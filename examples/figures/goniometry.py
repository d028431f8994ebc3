"""Figure 6.5: how far an epidermis turns the light that it lets through, at 302 nm.

Measured by W. A. G. Bruls and J. C. van der Leun 1984
(hylios/lab/predecessors/bruls_goniometry.csv). Their paper was not at hand. So it is not
established how thick the isolated sample was, nor in which medium behind it the angles were
measured. The angles inside the tissue are compared first, as BioSpec uses them; the angles after
refraction into air stand beside them.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from examples.figures.drawing import COLOURS
from examples.figures.light import RAYS_AS_LONG, Effort, Task, Tick
from examples.figures.report import Row
from hylios.lab.pictures import write_figure
from hylios.lab.predecessors.biospec import goniometry
from hylios.skin.specimen import SPECIMENS
from hylios.tissue import Model, Stack
from hylios.transport.events import TRANSMITTED
from hylios.transport.melanosome_paths import with_survival
from hylios.transport.simulate import Rays
from hylios.transport.tallies import tallied

FIGURES = ("6.5",)

WAVELENGTH = 302.0
SUSPECT = 27.5
"""Degrees where the measured share of the epidermis is doubtful (see the file)."""

MANY = 10
"""Rays here for one ray of a curve."""

STEP = 0.5
"""Degrees between the angles at which rays are counted."""

DOTS = 2500
"""Dots in a projection."""


@dataclass(frozen=True)
class Sample:
    """Which layers of S2 (corneum first), their surface, what lies behind, and how they scatter.

    `index_behind` of None is the last layer's own, so that the angles inside it are seen; `times`
    is a factor on how many melanosome complexes are met.
    """

    layers: slice
    index_behind: float | None = None
    flat: bool = False
    scattering: str = "algorithm_1"
    times: float = 1.0


SAMPLES = {
    "epidermis": Sample(slice(0, 4)),
    "epidermis, into air": Sample(slice(0, 4), index_behind=1.0),
    "epidermis without stratum corneum": Sample(slice(1, 4)),
    "epidermis, flat surface": Sample(slice(0, 4), flat=True),
    "epidermis, exponential of mean 5°": Sample(slice(0, 4), scattering="exponential"),
    "epidermis, four times the complexes": Sample(slice(0, 4), times=4.0),
    "stratum corneum": Sample(slice(0, 1)),
}
"""The epidermis is stratum corneum, granulosum, spinosum and basale unless said.

Four times the complexes is what the measured spread would need. It is no reading of the thesis: it
would move the index of table 6.3 for melanin from .417, where .415 is printed, to .58.
"""

SHOWN = tuple(
    name for name in SAMPLES if name not in ("epidermis, flat surface", "stratum corneum")
)


def prepared(sample: Sample) -> Stack:
    """The sample as layers in air, with whatever lies behind."""
    model = Model(readings={"melanosome_scattering": sample.scattering})
    whole = with_survival(Stack.of(SPECIMENS["S2"], WAVELENGTH, model))
    layers = tuple(
        replace(layer, encounter=sample.times * layer.encounter)
        for layer in whole.layers[sample.layers]
    )
    behind = sample.index_behind
    return replace(
        whole,
        layers=layers,
        roughness=0.0 if sample.flat else whole.roughness,
        lambertian_floor=False,
        index_below=layers[-1].refractive_index if behind is None else behind,
    )


def tasks(effort: Effort) -> dict[str, Task]:
    """Counts of transmitted rays by angle, for each sample."""
    size = MANY * effort.rays / RAYS_AS_LONG

    def work(sample: Sample):
        def count(tick: Tick) -> np.ndarray:
            rays, key = MANY * effort.rays, (effort.seed, round(WAVELENGTH * 1000))
            counts = tallied(
                by_angle, prepared(sample), rays=rays, angle=0.0, key=key, threads=effort.threads
            )
            tick(size)
            return counts

        return Task(count, size)

    return {name: work(sample) for name, sample in SAMPLES.items()}


def by_angle(traced: Rays) -> np.ndarray:
    """Transmitted rays whose angle lies in each step from 0 to 90 degrees, integers."""
    cosine = traced.direction[traced.outcome == TRANSMITTED, 2]
    angle = np.degrees(np.arccos(np.clip(cosine, 0.0, 1.0)))
    return np.histogram(angle, bins=round(90.0 / STEP), range=(0.0, 90.0))[0]


def cumulative(counts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angles (N,) in degrees, and which share in % of the transmitted light lies within, (N,)."""
    edges = STEP * np.arange(counts.size + 1)
    return edges, 100.0 * np.concatenate([[0.0], np.cumsum(counts)]) / counts.sum()


def at(counts: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Cumulative share in % within angles in degrees."""
    return np.interp(angles, *cumulative(counts))


def median(angles: np.ndarray, within: np.ndarray) -> float:
    """Angle in degrees within which half of the transmitted light lies."""
    return float(np.interp(50.0, within, angles))


def draw(results: Mapping[str, object], folder: Path) -> list[Row]:
    """Draw the figure and compare."""
    counts = cast(Mapping[str, np.ndarray], results)
    angles, measured = sound("epidermis")
    figure = Figure(figsize=(11.0, 6.0), dpi=120, layout="constrained")
    panels = figure.subplot_mosaic(
        [["shares", "measured"], ["shares", "modelled"]], width_ratios=(2.3, 1.0)
    )
    draw_shares(panels["shares"], counts)
    draw_projection(panels["measured"], "measured", angles, measured, COLOURS[0])
    ours = cumulative(counts["epidermis"])
    draw_projection(panels["modelled"], "HyLIoS S2, epidermis", *ours, COLOURS[1])
    figure.suptitle("6.5  Light behind the epidermis at 302 nm, normal incidence")
    write_figure(figure, folder / "6.5.png")
    return rows(counts)


def sound(tissue: str) -> tuple[np.ndarray, np.ndarray]:
    """Angles (N,) in degrees and measured shares (N,) in %, the suspect value left out."""
    kept = goniometry()["angle_deg"] != SUSPECT
    return goniometry()["angle_deg"][kept], goniometry()[f"{tissue}_302"][kept]


def draw_shares(panel: Axes, counts: Mapping[str, np.ndarray]) -> None:
    """Cumulative shares, measured and of each sample."""
    whole = dict(zip(goniometry()["angle_deg"], goniometry()["epidermis_302"], strict=True))
    panel.plot(*sound("epidermis"), "ko-", ms=4, lw=1.0, label="measured, epidermis")
    panel.plot(SUSPECT, whole[SUSPECT], "ko", ms=5, mfc="white", label="measured, suspect value")
    styles = ("-", "--", "-.", ":", (0, (1, 1)))
    for name, colour, style in zip(SHOWN, COLOURS[1:], styles, strict=True):
        panel.plot(*cumulative(counts[name]), color=colour, ls=style, lw=1.5, label=f"S2, {name}")
    panel.set(
        xlabel="angle from the incident direction (degrees)",
        ylabel="share of the transmitted light within the angle (%)",
        xlim=(0.0, 90.0),
        ylim=(0.0, 102.0),
    )
    panel.grid(alpha=0.25)
    panel.legend(fontsize=8, loc="lower right")


def draw_projection(
    panel: Axes, title: str, angles: np.ndarray, within: np.ndarray, colour: str
) -> None:
    """Directions drawn from a cumulative share, seen along the incident direction."""
    random = np.random.default_rng(1)
    polar = np.radians(np.interp(100.0 * random.random(DOTS), within, angles))
    azimuth = 2.0 * np.pi * random.random(DOTS)
    panel.plot(
        np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), ".", ms=1.2, color=colour
    )
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    for ring in (30.0, 60.0, 90.0):
        size = np.sin(np.radians(ring))
        panel.plot(size * np.cos(turn), size * np.sin(turn), color="grey", lw=0.6)
    panel.text(0.0, -1.15, "rings at 30°, 60°, 90°", fontsize=8, ha="center", color="grey")
    panel.set(aspect="equal", xlim=(-1.05, 1.05), ylim=(-1.2, 1.05))
    panel.set_title(title, fontsize=9)
    panel.set_axis_off()


def rows(results: Mapping[str, np.ndarray]) -> list[Row]:
    """RMS difference in percentage points from the measured shares, and medians."""
    result = []
    for name, counts in results.items():
        angles, measured = sound("stratum_corneum" if name == "stratum corneum" else "epidermis")
        off = (at(counts, angles) - measured)[1:]
        middle = median(*cumulative(counts))
        worst = 50.0 / np.sqrt(counts.sum())
        result.append(
            Row(
                "6.5",
                f"S2, {name}: RMS difference over {off.size} angles; median angle",
                f"a curve; measured median {median(angles, measured):.1f}°",
                f"{np.sqrt(np.mean(off**2)):.1f} percentage points; {middle:.1f}°",
                f"{counts.sum():,} transmitted rays, standard error up to {worst:.2f} points",
            )
        )
    return result
