"""Figures 6.21, B.1 and B.2: what single and few doses do to melanin and thickness.

The thesis only plots the doses; those used here are ASSUMED (`tans.py` and the constants here).
The measurements that it plots beside them could not be had.
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from examples.figures.drawing import COLOURS, plot_layers, sheet
from examples.figures.light import Effort, Task
from examples.figures.report import Row, claim
from examples.figures.tans import (
    MILLER_SKIN,
    SKINS,
    Schedule,
    history,
    rise,
)
from hylios.lab.pictures import write_figure
from hylios.skin import Skin
from hylios.tanning import PIGMENTATIONS, Exposures, TanningHistory, simulate

FIGURES = ("6.21", "B.1", "B.2")

SMALL_DOSES, SMALL_DOSE = 4, 3.0
"""Number of doses on successive days and SED of each, for figure 6.21. ASSUMED."""

SERIES_DAYS, MEASURED_SERIES = 21.0, {6: 2.0, 12: 3.0}
"""Days of a series of equal doses, and how many times smaller each may be than the MMD and still
tan at last, by number of doses: measured in 24 people (Ravnbak et al., Acta
Dermato-Venereologica, doi 10.2340/00015555-0431). ASSUMED: evenly over the three weeks."""

ADDING_DAYS, LAYER_DAYS, THICKENING_DAYS = 40, 14, 21
"""Days that figures 6.21, B.1 and B.2 span."""

THICKENING = {"1 MED": 1.0, "2 MED": 2.0, "4 MED": 4.0}
"""Single doses of figure B.2 in MED. ASSUMED: what Lopez et al. gave could not be established."""

DAILY, DAILY_MED = 3, 1.5
MEASURED_THICKNESS = {"not exposed": 94.2, "exposed": 125.7}
"""Number and MED of daily exposures to UVB, and thickness of the epidermis in um a day after the
last by optical coherence tomography, twelve people (abstract of "UVA1 and UVB irradiated skin
investigated by optical coherence tomography in vivo: a preliminary study", which calls it an
increase of 25 %)."""

TINY = 1e-6
"""Relative melanin more than this is a tan; less is rounding."""


def tasks(effort: Effort) -> dict[str, Task]:
    """None: the tanning model takes no time beside the light model."""
    return {}


def draw(results: Mapping[str, object], folder: Path) -> list[Row]:
    """Draw all figures and compare what the thesis and abstracts say of them."""
    adding = photoaddition()
    single = {name: one_minimal_dose(skin) for name, skin in SKINS.items()}
    grown = thickening()
    draw_photoaddition(adding, folder / "6.21.png")
    draw_layers(single, folder / "B.1.png")
    draw_thickening(grown, folder / "B.2.png")
    return [*photoaddition_rows(adding), *layer_rows(single), *thickening_rows(grown)]


def photoaddition() -> dict[str, TanningHistory]:
    """Small doses together, one of them, and all in one; then the same in halves of them."""
    half = 0.5 * SMALL_DOSE
    return {
        "small": history(MILLER_SKIN, _daily(SMALL_DOSES, SMALL_DOSE), ADDING_DAYS),
        "one small": history(MILLER_SKIN, _daily(1, SMALL_DOSE), ADDING_DAYS),
        "large": history(MILLER_SKIN, [(0.0, SMALL_DOSES * SMALL_DOSE)], ADDING_DAYS),
        "halves": history(MILLER_SKIN, _daily(2 * SMALL_DOSES, half, 0.5), ADDING_DAYS),
        "one half": history(MILLER_SKIN, _daily(1, half), ADDING_DAYS),
    }


def _daily(count: int, dose: float, apart: float = 1.0) -> Schedule:
    """So many doses, some days apart."""
    return [(apart * n, dose) for n in range(count)]


def one_minimal_dose(skin: Skin) -> TanningHistory:
    """What 1 MMD on day 0 does (figure B.1)."""
    return history(skin, [(0.0, skin.mmd)], LAYER_DAYS)


def thickening() -> dict[str, TanningHistory]:
    """What single doses do to the thickness, and a daily one (figure B.2)."""
    unit = MILLER_SKIN.med
    thickened = {
        name: history(MILLER_SKIN, [(0.0, dose * unit)], THICKENING_DAYS)
        for name, dose in THICKENING.items()
    }
    daily = _daily(DAILY, DAILY_MED * unit)
    return {**thickened, "daily": history(MILLER_SKIN, daily, THICKENING_DAYS)}


def draw_photoaddition(adding: Mapping[str, TanningHistory], path: Path) -> None:
    """Figure 6.21: two schedules, and the melanin that they give."""
    figure, axes = sheet(11.0, 4.4, columns=2)
    total = SMALL_DOSES * SMALL_DOSE
    days, left = np.arange(SMALL_DOSES), axes[0, 0]
    left.bar(-0.2, total, 0.4, color=COLOURS[2])
    left.bar(days + 0.2, SMALL_DOSE, 0.4, color=COLOURS[1])
    left.axhline(MILLER_SKIN.mmd, color="grey", ls=":", lw=1.0, label="MMD")
    left.set(xlabel="day", ylabel="dose (SED)", xlim=(-0.7, SMALL_DOSES - 0.3), xticks=days)
    left.legend()
    shown = {
        f"one dose of {total:g} SED": ("large", COLOURS[2], "-"),
        f"{SMALL_DOSES} daily doses of {SMALL_DOSE:g} SED": ("small", COLOURS[1], "-"),
        f"one dose of {SMALL_DOSE:g} SED": ("one small", COLOURS[1], "--"),
    }
    for label, (name, hue, line) in shown.items():
        rise = 100.0 * (adding[name].total - 1.0)
        axes[0, 1].plot(adding[name].hours / 24, rise, color=hue, ls=line, label=label)
    axes[0, 1].set(xlabel="day", ylabel="increase of melanin (%)", xlim=(0.0, ADDING_DAYS))
    axes[0, 1].legend()
    for panel in axes.flat:
        panel.grid(alpha=0.25)
    figure.suptitle(
        "6.21  Photoaddition, low set, MMD 2.89 SED. Doses and days are ASSUMED", fontsize=11
    )
    write_figure(figure, path)


def draw_layers(single: Mapping[str, TanningHistory], path: Path) -> None:
    """Figure B.1: layers and total of the three sets after 1 MMD."""
    figure, axes = sheet(12.0, 6.4, columns=3, rows=2, sharex=True, sharey="row")
    for column, (name, states) in zip(axes.T, single.items(), strict=True):
        plot_layers(column[0], states)
        column[0].set_title(f"{name} ({SKINS[name].mmd:.2f} SED)", fontsize=10)
        column[1].plot(states.hours / 24, 100.0 * (states.total - 1.0), color="black")
        column[1].plot(7.0, 10.0, "o", color=COLOURS[1], label="about 10 % on day 7 (printed)")
        column[1].set(xlabel="day", xlim=(0.0, LAYER_DAYS))
        for panel in column:
            panel.grid(alpha=0.25)
    axes[0, 0].set_ylabel("melanin of the layer\n(relative to all at the start)")
    axes[1, 0].set_ylabel("increase of melanin (%)")
    axes[0, 0].legend(fontsize=8)
    axes[1, 0].legend(fontsize=8, loc="lower right")
    figure.suptitle(
        "B.1  1 MMD on day 0, sets low, intermediate and high. The values of Tadokoro et al. that "
        "the thesis plots\ncould not be had; their dose was 1 MED, taken as 1 MMD by the thesis",
        fontsize=10,
    )
    write_figure(figure, path)


def draw_thickening(grown: Mapping[str, TanningHistory], path: Path) -> None:
    """Figure B.2: thickness after one dose, and after a daily one with what was measured."""
    figure, axes = sheet(8.0, 4.8)
    panel = axes[0, 0]
    for hue, (name, states) in zip(COLOURS, grown.items(), strict=False):
        label = f"{DAILY} days of {DAILY_MED:g} MED" if name == "daily" else name
        panel.plot(states.hours / 24, states.thickness, color=hue, label=label)
    panel.plot(
        DAILY,
        measured_growth(),
        "o",
        color=COLOURS[len(THICKENING)],
        label=f"measured after {DAILY} days of {DAILY_MED:g} MED (not by Lopez et al.)",
    )
    panel.set(xlabel="day", ylabel="thickness relative to the start", xlim=(0.0, THICKENING_DAYS))
    panel.grid(alpha=0.25)
    panel.legend(fontsize=8)
    panel.set_title(
        "B.2  Thickness, table 6.6. All doses are ASSUMED: neither the doses\nnor the "
        "measurements of Lopez et al. could be had",
        fontsize=10,
    )
    write_figure(figure, path)


def measured_growth() -> float:
    """Measured thickness of exposed skin relative to skin that was not."""
    return MEASURED_THICKNESS["exposed"] / MEASURED_THICKNESS["not exposed"]


def times_smaller(count: int) -> float:
    """How many times smaller than the MMD each of so many doses may be and still tan at last.

    Among doses in steps of 1 % of the MMD, evenly over the days of a series.
    """
    shares = np.arange(0.01, 1.005, 0.01)
    hours = np.round(24 * SERIES_DAYS / count * np.arange(count)).astype(int)
    exposures = Exposures(hours, np.tile(shares[:, None], count))
    states = simulate(exposures, PIGMENTATIONS["low"], mmd=1.0, med=1.0, hours=hours[-1] + 1)
    return float(1.0 / shares[np.any(states.total > 1.0 + TINY, axis=-1)].min())


def photoaddition_rows(adding: Mapping[str, TanningHistory]) -> list[Row]:
    """How the response to small doses compares with that to a large one."""
    together, alone, large = (rise(adding[name]) for name in ("small", "one small", "large"))
    halves, half = rise(adding["halves"]), rise(adding["one half"])
    total = SMALL_DOSES * SMALL_DOSE
    return [
        claim(
            "6.21",
            f"{SMALL_DOSES} daily doses of {SMALL_DOSE:g} SED against {total:g} SED at once "
            "(ASSUMED), peak of melanin; aim: each below 25 %, together within 10 % of the large",
            "each small, together similar",
            f"each {alone:+.1%}, together {together:+.1%}, at once {large:+.1%}: "
            f"ratio {together / large:.3f}",
            alone < 0.25 * large and abs(together / large - 1.0) < 0.1,
        ),
        Row(
            "6.21",
            f"{2 * SMALL_DOSES} doses of {0.5 * SMALL_DOSE:g} SED every 12 hours, below the MMD",
            "",
            f"each {half:+.1%}, together {halves:+.1%}: ratio {halves / large:.3f}",
        ),
        Row(
            "6.21",
            f"{', '.join(map(str, MEASURED_SERIES))} doses in three weeks: times smaller than the "
            f"MMD; measured about {', '.join(f'{times:g}' for times in MEASURED_SERIES.values())} "
            "(Ravnbak et al.)",
            "",
            ", ".join(f"{times_smaller(count):.2f}" for count in MEASURED_SERIES),
        ),
    ]


def layer_rows(single: Mapping[str, TanningHistory]) -> list[Row]:
    """What 1 MMD has done by day 7."""
    day = 7 * 24
    gains = {name: float(states.total[day] - 1.0) for name, states in single.items()}
    moved = {name: shares_moved(states, day) for name, states in single.items()}
    down = [change[0] for change in moved.values()]
    middle = [change[1] for change in moved.values()]
    return [
        claim(
            "B.1",
            "1 MMD: increase of melanin on day 7, low, intermediate, high; aim: 9 to 11 %",
            "about 10 %",
            ", ".join(f"{gain:.1%}" for gain in gains.values()),
            all(0.09 <= gain <= 0.11 for gain in gains.values()),
        ),
        claim(
            "B.1",
            "1 MMD: change of basale's and of spinosum's share of the melanin by day 7",
            "from the lower to the middle layer, more in darker skin (Tadokoro et al. 2005)",
            ", ".join(f"{change[0]:+.3f} and {change[1]:+.3f}" for change in moved.values()),
            max(down) < 0.0 and 0.0 < middle[0] < middle[1] < middle[2],
        ),
    ]


def shares_moved(states: TanningHistory, hour: int) -> np.ndarray:
    """Change of each layer's share of all melanin between the start and an hour, (3,)."""
    return states.melanin[hour] / states.total[hour] - states.melanin[0] / states.total[0]


def thickening_rows(grown: Mapping[str, TanningHistory]) -> list[Row]:
    """When the skin is thickest after one dose, and what was measured elsewhere."""
    peaks = {name: grown[name].thickness for name in THICKENING}
    thickest = ", ".join(
        f"{thickness.max():.3f} on day {np.argmax(thickness) / 24:.1f}"
        for thickness in peaks.values()
    )
    after = float(grown["daily"].thickness[DAILY * 24])
    return [
        Row("B.2", f"{', '.join(THICKENING)} (ASSUMED): thickest", "plotted", thickest),
        Row(
            "B.2",
            f"{DAILY} daily doses of {DAILY_MED:g} MED, a day after the last; measured by optical "
            f"coherence tomography {measured_growth():.2f} (not by Lopez et al.)",
            "none",
            f"{after:.3f}; table 6.6 allows 1.25 at most",
        ),
    ]
