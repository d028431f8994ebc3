"""Measures what section 6.2 says of tans in words alone: no figure of the thesis."""

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from examples.figures.drawing import COLOURS, reflectance_axes, sheet
from examples.figures.light import Curve, Effort, Task, Tick
from examples.figures.report import Row, claim
from examples.figures.tans import (
    COLOUR_WAVELENGTHS,
    MILLER_SKIN,
    SKINS,
    colour,
    history,
    single_doses,
)
from hylios.adding import spectrum
from hylios.lab.colour import difference, lab
from hylios.lab.pictures import write_figure
from hylios.skin import Skin
from hylios.tanning import TanningHistory

FIGURES = ("tanning",)

KINETIC_DOSE, KINETIC_DAYS = 30.0, 60
"""SED of figure 6.29 and days that are looked at. ASSUMED: at once, MMD 2.89 SED."""

PEAK_DAYS = 20
"""Days within which every single dose here has its peak."""

MULTIPLES = (0.99, 1.0, 1.25, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)
"""Doses in MMD at which skins are compared."""

COMPARED = 4.0
"""MMD at which the report compares skins."""

EQUAL_DOSES = (6.0, 12.0, 20.0)
"""SED at which the report compares skins."""

JUST_SEEN = 0.8
"""Fall of L* that is just seen as pigmentation: .8 +- .1 by the abstract of a study of people's
responses to UVA (PubMed 31206816)."""

TRIED = np.arange(0.5, 30.0, 0.25)
"""Doses in SED among which the first with a visible change is looked for."""

WAVELENGTHS = np.arange(300.0, 701.0, 10.0)
UV, GREEN_TO_RED = (300.0, 380.0), (550.0, 650.0)
"""nm between which reflectance is averaged."""


@dataclass(frozen=True)
class Kinetics:
    """How a response rises and fades.

    Attributes
    ----------
    rise : float
        Melanin gained at the peak, relative to the start.
    peak, to_half, top, from_half : float
        Day of the peak; days to half of the rise, above 90 % of it, and from the peak to half.
    """

    rise: float
    peak: float
    to_half: float
    top: float
    from_half: float


def kinetics(states: TanningHistory) -> Kinetics:
    """How fast all melanin rises and fades."""
    gained = states.total - 1.0
    peak = int(np.argmax(gained))
    largest = gained[peak]
    faded = np.flatnonzero(gained[peak:] < 0.5 * largest)
    return Kinetics(
        rise=float(largest),
        peak=peak / 24,
        to_half=int(np.argmax(gained >= 0.5 * largest)) / 24,
        top=int(np.count_nonzero(gained >= 0.9 * largest)) / 24,
        from_half=faded[0] / 24 if faded.size else np.inf,
    )


@dataclass(frozen=True)
class Gain:
    """What single doses give at the peak of melanin.

    Attributes
    ----------
    doses : (D,) array, SED
    relative : (D,) array
        Increase of all melanin relative to the start.
    content, per_area : (D,) arrays; 1, um
        The same as share of the untanned epidermis, and as thickness of pure melanin.
    darker, difference : (D,) arrays
        Fall of L* and CIEDE2000 from the untanned state.
    """

    doses: np.ndarray
    relative: np.ndarray
    content: np.ndarray
    per_area: np.ndarray
    darker: np.ndarray
    difference: np.ndarray


def gain(skin: Skin, doses: Sequence[float], tick: Tick) -> Gain:
    """Gain of a skin at the peak of its tan after single doses in SED."""
    states = single_doses(skin, doses, PEAK_DAYS)
    peaks = states.total.argmax(axis=-1)
    before = colour(skin, skin.untanned_state)
    after = np.empty((len(doses), 3))
    for number, hour in enumerate(peaks):
        after[number] = colour(skin, states.states[number, hour])
        tick(COLOUR_WAVELENGTHS)
    relative = states.total.max(axis=-1) - 1.0
    content = relative * skin.specimen.pigmentation
    return Gain(
        doses=np.array(doses, dtype=float),
        relative=relative,
        content=content,
        per_area=content * 1e4 * skin.specimen.epidermal_thickness.sum(),
        darker=lab(before)[0] - lab(after)[:, 0],
        difference=difference(np.broadcast_to(before, after.shape), after),
    )


def first_visible_dose(skin: Skin) -> float:
    """The least dose of `TRIED` whose tan is seen at its peak, in SED; response grows with dose."""
    states = single_doses(skin, TRIED, PEAK_DAYS)
    peaks = states.total.argmax(axis=-1)
    before = lab(colour(skin, skin.untanned_state))[0]

    def darker(number: int) -> float:
        return float(before - lab(colour(skin, states.states[number, peaks[number]]))[0])

    first = bisect_left(range(TRIED.size), JUST_SEEN, key=darker)
    return float(TRIED[first]) if first < TRIED.size else np.inf


def spectra(skin: Skin, tick: Tick) -> dict[str, Curve]:
    """Reflectance of a skin untanned and at the peak of a tan of `COMPARED` MMD."""
    states = single_doses(skin, [COMPARED * skin.mmd], PEAK_DAYS)
    curves = {}
    for name, hour in (("untanned", 0), ("tanned", int(states.total[0].argmax()))):
        total = spectrum(skin.at(states.states[0, hour]), WAVELENGTHS).total
        curves[name] = Curve(WAVELENGTHS, total, np.zeros(WAVELENGTHS.size), 0)
        tick(WAVELENGTHS.size)
    return curves


def spread(curves: Sequence[Curve], band: tuple[float, float]) -> float:
    """Difference of the brightest and the darkest of some skins in mean reflectance of a band."""
    return float(np.ptp([curve.within(*band).mean() for curve in curves]))


def tasks(effort: Effort) -> dict[str, Task]:
    """Gains, first visible doses and spectra of the three skins."""
    work = {}
    for name, skin in SKINS.items():
        multiples = [skin.mmd * multiple for multiple in MULTIPLES]
        work[f"{name} multiples"] = _gain_task(skin, multiples)
        work[f"{name} equal"] = _gain_task(skin, EQUAL_DOSES)
        work[f"{name} first"] = Task(lambda tick, skin=skin: first_visible_dose(skin), 0.0)
        size = 2 * WAVELENGTHS.size
        work[f"{name} spectra"] = Task(lambda tick, skin=skin: spectra(skin, tick), size)
    return work


def _gain_task(skin: Skin, doses: Sequence[float]) -> Task:
    return Task(lambda tick: gain(skin, doses, tick), COLOUR_WAVELENGTHS * len(doses))


def kinetic_history() -> TanningHistory:
    """The intermediate set after the dose of figure 6.29."""
    skin = replace(SKINS["intermediate"], mmd=MILLER_SKIN.mmd, med=MILLER_SKIN.med)
    return history(skin, [(0.0, KINETIC_DOSE)], KINETIC_DAYS)


def draw(results: Mapping[str, Any], folder: Path) -> list[Row]:
    """Draw what was measured and compare it with the text."""
    states = kinetic_history()
    draw_claims(results, states, folder / "tanning.png")
    gains = {name: results[f"{name} multiples"] for name in SKINS}
    return [
        kinetic_row(kinetics(states)),
        first_row({name: results[f"{name} first"] for name in SKINS}),
        *gain_rows(gains),
        *equal_rows({name: results[f"{name} equal"] for name in SKINS}),
        *convergence_rows({name: results[f"{name} spectra"] for name in SKINS}),
    ]


def draw_claims(results: Mapping[str, Any], states: TanningHistory, path: Path) -> None:
    """Kinetics, first visible change, gain and the ultraviolet."""
    figure, axes = sheet(13.0, 8.4, columns=2, rows=2)
    rising, by_dose, by_multiple, light = axes.flat
    rising_and_fading = kinetics(states)
    rising.plot(states.hours / 24, 1.0 + 0.0 * states.total, color="grey", lw=0.8)
    rising.plot(states.hours / 24, states.total, color="black")
    for share in (0.5, 0.9):
        rising.axhline(1.0 + share * rising_and_fading.rise, color="grey", ls=":", lw=0.8)
    rising.set(xlabel="day", ylabel="melanin relative to the start", xlim=(0.0, KINETIC_DAYS))
    rising.set_title("30 SED at once, intermediate set; dotted: half and 90 % of the rise")
    for hue, (name, skin) in zip(COLOURS[1:], SKINS.items(), strict=False):
        gained = results[f"{name} multiples"]
        label = f"{name}: {skin.specimen.name}, MMD {skin.mmd:.1f} SED"
        by_dose.plot(gained.doses, gained.difference, ".-", color=hue, label=label)
        by_multiple.plot(gained.doses / skin.mmd, gained.difference, ".-", color=hue, label=label)
        for line, curve in zip(("--", "-"), results[f"{name} spectra"].values(), strict=True):
            light.plot(curve.wavelengths, curve.reflectance, color=hue, ls=line)
    by_dose.set(xlabel="dose (SED)", ylabel="CIEDE2000 of the peak", xscale="log")
    by_multiple.set(xlabel="dose (MMD)", ylabel="CIEDE2000 of the peak")
    by_dose.legend(fontsize=8)
    reflectance_axes(light, 300.0, 700.0, f"untanned (dashed), tanned by {COMPARED:g} MMD")
    for band in (UV, GREEN_TO_RED):
        light.axvspan(*band, color="grey", alpha=0.12)
    for panel in axes.flat:
        panel.grid(alpha=0.25)
        panel.title.set_fontsize(10)
    figure.suptitle(
        "What section 6.2 says of tans. Minimal doses by 3.1 and 3.2; the skin between S3 and S4 "
        "is ASSUMED",
        fontsize=10,
    )
    write_figure(figure, path)


def kinetic_row(times: Kinetics) -> Row:
    """Whether the response rises faster than its top lasts and than it fades."""
    return claim(
        "tanning",
        "30 SED, intermediate: days to half of the rise, above 90 % of it, from the peak to half; "
        "aim: the first is the shortest",
        "rises fast, broad maximum, fades gradually; peak on day 10 (6.29)",
        f"{times.to_half:.1f}, {times.top:.1f}, {times.from_half:.1f}; peak {times.rise:+.0%} on "
        f"day {times.peak:.1f}",
        times.to_half < min(times.top, times.from_half),
    )


def first_row(doses_by_skin: Mapping[str, float]) -> Row:
    """Which dose is the first that shows."""
    doses = list(doses_by_skin.values())
    return claim(
        "tanning",
        f"first dose whose tan is seen (L* lower by {JUST_SEEN:g}), in SED; MMD by 3.2",
        "higher in darker skin",
        "; ".join(
            f"{name} {dose:g} ({SKINS[name].mmd:.2f})" for name, dose in doses_by_skin.items()
        ),
        doses[0] < doses[1] < doses[2],
    )


def gain_rows(gains: Mapping[str, Gain]) -> list[Row]:
    """By which measures the dark skin gains more than the light one at equal multiples of MMD."""
    place = MULTIPLES.index(COMPARED)
    measures = {
        "melanin relative to the start": ("relative", "{:.1%}"),
        "melanin as share of the epidermis": ("content", "{:.2%}"),
        "melanin per area (um)": ("per_area", "{:.2f}"),
        "fall of L*": ("darker", "{:.2f}"),
        "CIEDE2000": ("difference", "{:.2f}"),
    }
    rows = []
    for what, (field, form) in measures.items():
        gained = [float(getattr(gain, field)[place]) for gain in gains.values()]
        rows.append(
            claim(
                "tanning",
                f"{COMPARED:g} MMD, gain in {what}: low, intermediate, high; aim: high above low",
                "more in darker skin",
                ", ".join(form.format(value) for value in gained),
                gained[2] > gained[0],
            )
        )
    return rows


def equal_rows(gains: Mapping[str, Gain]) -> list[Row]:
    """Whether the darker skin tans less after the same dose."""
    rows = []
    for what, field, form in (
        ("melanin relative to the start", "relative", "{:.0%}"),
        ("CIEDE2000", "difference", "{:.1f}"),
    ):
        gained = np.array([getattr(gain, field) for gain in gains.values()])
        rows.append(
            claim(
                "tanning",
                f"{', '.join(f'{dose:g}' for dose in EQUAL_DOSES)} SED, gain in {what}: low, "
                "intermediate, high",
                "less in darker skin",
                "; ".join(", ".join(form.format(value) for value in dose) for dose in gained.T),
                bool(np.all(np.diff(gained, axis=0) <= 0.0)),
            )
        )
    return rows


def convergence_rows(curves: Mapping[str, Mapping[str, Curve]]) -> list[Row]:
    """How far apart the three skins are in the ultraviolet and the visible, before and after."""
    told, share_left = [], []
    for band in (UV, GREEN_TO_RED):
        before, after = (
            spread([spectra[state] for spectra in curves.values()], band)
            for state in ("untanned", "tanned")
        )
        share_left.append(after / before)
        told.append(f"{before:.3f} to {after:.3f} ({after / before:.0%} left)")
    return [
        claim(
            "tanning",
            f"reflectance between the lightest and the darkest skin, 300 to 380 and 550 to 650 nm, "
            f"untanned and tanned by {COMPARED:g} MMD; aim: less of it left in the ultraviolet",
            "converges in the ultraviolet when melanin grows",
            "; ".join(told),
            share_left[0] < share_left[1],
        )
    ]
