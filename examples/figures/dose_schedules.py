"""Figure 6.23: what weeks of doses of ultraviolet light do to melanin, thickness and colour.

The thesis only plots the schedules; those used here are ASSUMED (`tans.py`). The measurements that
it plots beside them could not be had.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from examples.figures.drawing import COLOURS, plot_layers, sheet
from examples.figures.light import Effort, Task, Tick
from examples.figures.report import Row, claim
from examples.figures.tans import (
    COLOUR_WAVELENGTHS,
    MILLER_DOSES,
    MILLER_SKIN,
    SCHEDULES,
    Schedule,
    colour,
    history,
    rise,
    rising,
)
from hylios.lab.colour import lab
from hylios.lab.pictures import write_figure
from hylios.skin import Skin
from hylios.tanning import TanningHistory

FIGURES = ("6.23",)

MILLER_DAYS = 60
"""Days that the figure spans."""

SEEN_EVERY = 1
"""Days between two colours of the figure."""


@dataclass(frozen=True)
class Tan:
    """A skin's tan over a schedule.

    Attributes
    ----------
    schedule : Schedule
    history : TanningHistory
        Every hour.
    days, lightness : (D,) arrays
        Days of the colours, and L* under D65.
    """

    schedule: Schedule
    history: TanningHistory
    days: np.ndarray
    lightness: np.ndarray


def tan(skin: Skin, schedule: Schedule, days: np.ndarray, tick: Tick) -> Tan:
    """A schedule's tan to the last of the days, with the skin's lightness on those days."""
    states = history(skin, schedule, days[-1])
    lightness = np.empty(days.size)
    for number, hour in enumerate(np.round(24 * days).astype(int)):
        lightness[number] = lab(colour(skin, states.states[hour]))[0]
        tick(COLOUR_WAVELENGTHS)
    return Tan(schedule, states, days, lightness)


def tasks(effort: Effort) -> dict[str, Task]:
    """The three schedules of figure 6.23, and the same sums in doses that rise from 1 MED."""
    often = np.arange(0.0, MILLER_DAYS + 1.0, SEEN_EVERY)
    seldom = np.array([0.0, 31.0])  # the experiment looked on day 31
    work = {}
    for name, schedule in SCHEDULES.items():
        ramp = rising(*MILLER_DOSES[name], MILLER_SKIN.med)
        work[name] = _task(schedule, often)
        work[f"{name} rising"] = _task(ramp, seldom)
    return work


def _task(schedule: Schedule, days: np.ndarray) -> Task:
    return Task(lambda tick: tan(MILLER_SKIN, schedule, days, tick), COLOUR_WAVELENGTHS * days.size)


def draw(results: Mapping[str, Tan], folder: Path) -> list[Row]:
    """Draw the figure and compare what an abstract says of it."""
    draw_schedules({name: results[name] for name in SCHEDULES}, folder / "6.23.png")
    return schedule_rows(results)


def _doses(axes: Axes, schedule: Schedule, hue: str) -> None:
    axes.bar([day for day, _ in schedule], [dose for _, dose in schedule], 0.6, color=hue)


def draw_schedules(tans: Mapping[str, Tan], path: Path) -> None:
    """Figure 6.23: doses, layers, total melanin, thickness and L* of each schedule."""
    figure, axes = sheet(17.0, 8.6, columns=5, rows=len(tans), sharex=True, sharey="col")
    for panels, (name, tan) in zip(axes, tans.items(), strict=True):
        days = tan.history.hours / 24
        _doses(panels[0], tan.schedule, "grey")
        panels[0].axhline(MILLER_SKIN.mmd, color=COLOURS[1], ls=":", label="MMD")
        panels[0].axhline(MILLER_SKIN.med, color=COLOURS[4], ls=":", label="MED")
        panels[0].set_ylabel(f"{name} in {len(tan.schedule)} doses\ndose (SED)")
        plot_layers(panels[1], tan.history)
        panels[2].plot(days, tan.history.total, color="black")
        panels[3].plot(days, tan.history.thickness, color="black")
        panels[4].plot(tan.days, tan.lightness, color="black", marker=".", markersize=4)
        for panel in panels:
            panel.grid(alpha=0.25)
    titles = (
        "doses (ASSUMED)",
        "melanin of the layers",
        "melanin in all",
        "thickness",
        "L*, D65 (measured: not to be had)",
    )
    for panel, title in zip(axes[0], titles, strict=True):
        panel.set_title(title, fontsize=10)
    for panel in axes[-1]:
        panel.set(xlabel="day", xlim=(-1.0, MILLER_DAYS))
    axes[0, 0].legend(fontsize=8, loc="upper right")
    axes[0, 1].legend(fontsize=8)
    figure.suptitle(
        "6.23  Three schedules on S3 with the low set, MMD 2.89 and MED 1.7 SED; melanin relative "
        "to all melanin at the start.\nSums of 42, 29 and 19 SED are those of Miller et al. 2008; "
        "equal doses on two days a week, and eight of them for 19 SED, are ASSUMED",
        fontsize=10,
    )
    write_figure(figure, path)


def schedule_rows(results: Mapping[str, Tan]) -> list[Row]:
    """What the schedules give, with equal doses and with doses that rise."""
    rows = []
    for kind, label in (("", "equal doses"), (" rising", "doses rising from 1 MED")):
        tans = [results[f"{name}{kind}"] for name in SCHEDULES]
        peaks = [rise(tan.history) for tan in tans]
        darker = [tan.lightness[0] - tan.lightness.min() for tan in tans]
        comparable = abs(peaks[0] - peaks[1]) < 0.5 * abs(peaks[1] - peaks[2])
        when = "at its darkest" if not kind else "on day 31"
        rows.append(
            claim(
                "6.23",
                f"{', '.join(SCHEDULES)}, {label} (ASSUMED): peak of melanin, fall of L* {when}; "
                "aim: 42 and 29 SED less than half as far apart as 29 and 19",
                "42 and 29 SED comparable, 19 SED moderate (Miller et al. 2008)",
                ", ".join(f"{value:+.0%}" for value in peaks)
                + "; "
                + ", ".join(f"{value:.1f}" for value in darker),
                comparable,
            )
        )
    thickest = [float(results[name].history.thickness.max()) for name in SCHEDULES]
    rows.append(
        Row(
            "6.23",
            "L* beside the measured one; thickest",
            "good agreement; plotted",
            "measurements not to be had; " + ", ".join(f"{value:.3f}" for value in thickest),
        )
    )
    return rows
