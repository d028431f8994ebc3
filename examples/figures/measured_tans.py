"""People's redness and tans beside the model's, row by row: no figure of the thesis."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import cast

import numpy as np

from examples.figures.drawing import COLOURS, sheet
from examples.figures.light import Effort, Task, Tick
from examples.figures.report import Row
from hylios.adding import colours
from hylios.adding.redness import erythema
from hylios.colour_difference import lab
from hylios.lab import measured_tans
from hylios.lab.colour import srgb
from hylios.lab.kinetics_fit import BURN, HOURS_BETWEEN, tans
from hylios.lab.pictures import write_figure
from hylios.lab.redness_of_people import after
from hylios.lab.tans_of_people import values_of_people
from hylios.skin.phototypes import PHOTOTYPES, skin_type
from hylios.tanning import KINETICS, Exposures

FIGURES = ("people.tans",)

SIZE = 100.0
"""Of a row, in wavelengths solved once."""

HOURS = np.concatenate([np.arange(0.0, 24.0, 2.0), np.arange(24.0, 193.0, 8.0)])
"""Hours of the curves of redness."""

DAYS = (0, 0.5, 1, 2, 3, 5, 7, 10, 14, 21, 30, 45, 60, 90, 120)
"""Days of the swatches."""

SUN = {(0, 0): "2 MED at once", tuple(range(0, 336, 24)): "1 MED daily for 14 days"}
"""Hours of exposures of 1 MED, whose swatches are drawn."""

PICTURES = ("redness", "melanin", "types")


@dataclass(frozen=True)
class Beside:
    """What was measured, and what the model makes of it by either kinetics; None if nothing."""

    row: measured_tans.Row
    values: Mapping[str, float | None]

    def is_met(self, kinetics: str) -> bool | None:
        """Whether the value is within what was measured; None where that is not judged."""
        value = self.values[kinetics]
        if value is None or not self.row.is_judged:
            return None
        return self.row.beyond(value) == 0.0

    def told(self, kinetics: str) -> str:
        """The value, and by how much it is beyond what was measured."""
        value = self.values[kinetics]
        if value is None:
            return "none"
        beyond = self.row.beyond(value) if self.row.is_judged else 0.0
        shown = f"{round(value, 6):.3g}"
        by = f"{beyond:+.0f}" if abs(beyond) >= 10.0 else f"{beyond:+.2g}"
        return f"{shown} ({by})" if beyond else shown


def tasks(effort: Effort) -> dict[str, Task]:
    """All rows by both kinetics, computed on this run."""
    rows = measured_tans.rows()

    def work(tick: Tick) -> list[Beside]:
        functions, result = values_of_people(), []
        for row in rows:
            function = functions[row.subject].get(row.case)
            values = {name: function(name) if function else None for name in KINETICS}
            result.append(Beside(row, values))
            tick(SIZE)
        return result

    return {"rows": Task(work, SIZE * len(rows))}


def draw(results: Mapping[str, object], folder: Path) -> list[Row]:
    """Draw redness, melanin and skins over time, and set the rows beside the model."""
    beside = cast(list[Beside], results["rows"])
    for name, function in zip(PICTURES, (_redness, _melanin, _types), strict=True):
        write_figure(function(beside), folder / f"people.tans_{name}.png")
    return [_reported(own) for own in beside]


def _reported(own: Beside) -> Row:
    row = own.row
    ends = f"{row.low:g} to {row.high:g} {row.unit}" if row.is_judged else ""
    return Row(
        FIGURES[0],
        f"{row.subject}: {row.case}",
        f"people: {'ESTIMATE ' if row.is_estimate else ''}{row.measured}",
        "; ".join(f"{name} {own.told(name)}" for name in KINETICS),
        aim=ends,
        met=own.is_met("measured"),
    )


def _redness(beside: Sequence[Beside]):
    """a* of type II over hours after 1, 2, 4 and 8 MED."""
    figure, axes = sheet(9.0, 4.6)
    for colour, dose in zip(COLOURS[1:], (1.0, 2.0, 4.0, 8.0), strict=False):
        own = after("II", dose, "measured")
        seen = lab(colours(own.skin, own.states(HOURS)).total)[:, 1]
        axes[0, 0].plot(HOURS, seen - seen[0], color=colour, label=f"{dose:g} MED")
    rows = {own.row.case: own.row for own in beside if own.row.subject == "redness"}
    _bar(axes[0, 0], rows["threshold"], 24.0, COLOURS[1], "measured after 1 MED")
    for colour, dose, hour in zip(COLOURS[2:], (2, 4, 8), (22.5, 24.0, 25.5), strict=False):
        label = f"ESTIMATE after {dose} MED, from memory"
        _bar(axes[0, 0], rows[f"a* after {dose} MED"], hour, colour, label, "--")
    axes[0, 0].set(
        xlabel="hours",
        ylabel="change of a*",
        title="Redness of type II after sun at hour 0, the tan included (an estimate)",
        xlim=(-1, 195),
        xticks=range(0, 193, 24),
    )
    axes[0, 0].grid(alpha=0.25)
    axes[0, 0].legend(fontsize=8)
    return figure


def _bar(axes, row: measured_tans.Row, hour: float, colour: str, label: str | None, line="-"):
    axes.plot([hour, hour], [row.low, row.high], line, color=colour, lw=3, alpha=0.5, label=label)


def _melanin(beside: Sequence[Beside]):
    """New melanin over days by both kinetics, as a share of its peak."""
    figure, axes = sheet(11.0, 4.4, columns=2, sharey=True)
    rows = {own.row.case: own.row for own in beside if own.row.subject == "tan"}
    once, often = np.zeros((2, 24 * 190))
    once[0] = BURN
    often[(42 * np.arange(12)).astype(int)] = 1.001
    titles = "after 2 MED at once", "after 12 exposures of 1 MMD in 3 weeks"
    for panel, doses, title in zip(axes[0], (once, often), titles, strict=True):
        for colour, kinetics in zip(COLOURS[1:], KINETICS, strict=False):
            curve = tans(skin_type("III", kinetics=kinetics).melanin_kinetics, doses[None])[0]
            days = HOURS_BETWEEN / 24.0 * np.arange(curve.size)
            label = f"{kinetics} kinetics"
            panel.plot(days, 100.0 * curve / curve.max(), color=colour, label=label)
        panel.axhline(5.0, color="black", lw=0.6, ls=":")
        panel.set(xlabel="days", title=title, xlim=(0, 189), ylim=(0, 108))
        panel.grid(alpha=0.25)
    last = 21.0 / 12.0 * 11.0
    for panel, darkest, gone, begun in (
        (axes[0, 0], "darkest after 2 MED, days", "gone after 2 MED, days", 0.0),
        (
            axes[0, 1],
            "darkest after 12 in 3 weeks, days",
            "gone after the last of 12, days",
            last,
        ),
    ):
        days = rows[darkest].low, rows[darkest].high
        panel.axvspan(*days, color="grey", alpha=0.35, lw=0, label="people: darkest")
        days = rows[gone].low + begun, rows[gone].high + begun
        panel.axvspan(*days, color="grey", alpha=0.18, lw=0, label="people: gone")
        panel.legend(fontsize=8)
    axes[0, 0].set(ylabel="new melanin, % of its peak")
    return figure


def _types(beside: Sequence[Beside]):
    """The skin types over the days, with redness, by both kinetics: a burn, two weeks of sun."""
    figure, axes = sheet(11.0, 6.4, columns=2, rows=2)
    for row, (hours, what) in zip(axes, SUN.items(), strict=True):
        for panel, kinetics in zip(row, KINETICS, strict=True):
            seen = [_over_days(name, kinetics, np.array(hours)) for name in PHOTOTYPES]
            panel.imshow(np.array(seen), aspect="auto", interpolation="nearest")
            panel.set_xticks(range(len(DAYS)), [f"{day:g}" for day in DAYS], fontsize=8)
            panel.set_yticks(range(len(PHOTOTYPES)), PHOTOTYPES)
            panel.set(xlabel="days", title=f"{what}, {kinetics} kinetics")
    return figure


def _over_days(name: str, kinetics: str, hours: np.ndarray) -> np.ndarray:
    """sRGB (T, 3) of a type at `DAYS` after exposures of 1 MED at some hours."""
    skin = replace(skin_type(name, kinetics=kinetics), thickening="epidermis")
    exposures = Exposures(hours, np.full(hours.size, skin.med))
    states = skin.states(exposures, 24.0 * np.array(DAYS), erythema=erythema(skin))
    return srgb(colours(skin, states).total)
