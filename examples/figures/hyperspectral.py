"""Figure 6.6: S3 and S4 from 250 to 2500 nm, with measured people where they are given."""

from collections.abc import Mapping
from pathlib import Path
from typing import cast

import numpy as np

from examples.figures.drawing import plot, points, reflectance_axes, sheet
from examples.figures.light import RANGE, Curve, Effort, Task, noise_free, walked
from examples.figures.measured_people import People
from examples.figures.report import Row, agreement
from hylios.lab.pictures import write_figure
from hylios.skin.specimen import SPECIMENS

FIGURES = ("6.6",)

ANGLES = {"S3": 8.0, "S4": 16.75}
"""Angles of incidence in degrees."""

CHECKED = np.arange(250.0, 2501.0, 150.0)
"""Wavelengths in nm at which rays walk too."""

REGIONS = {"UV": (250.0, 400.0), "visible": (400.0, 700.0), "IR": (700.0, 2500.0)}

SIMILAR_FROM = 1300.0
"""nm beyond which the thesis finds lightly and darkly pigmented skin alike."""

VALLEYS = {
    "haemoglobin, 415": (390.0, 450.0),
    "haemoglobin, 545": (530.0, 560.0),
    "haemoglobin, 575": (560.0, 600.0),
    "water, 970": (920.0, 1040.0),
    "water, 1200": (1120.0, 1260.0),
    "water, 1450": (1350.0, 1550.0),
    "water, 1940": (1850.0, 2050.0),
}
"""Where in nm curves of skin dip, and what absorbs there."""


def tasks(effort: Effort) -> dict[str, Task]:
    """Both curves without noise, and some wavelengths of them by random walk."""
    work = {"people": Task(lambda tick: effort.people, 0)}
    for name, angle in ANGLES.items():
        work[name] = noise_free(SPECIMENS[name], RANGE, angle)
        work[f"{name} walked"] = walked(SPECIMENS[name], CHECKED, angle, effort)
    return work


def draw(results: Mapping[str, object], folder: Path) -> list[Row]:
    """Draw the figure and compare."""
    people = cast(People | None, results["people"])
    curves = {name: curve for name, curve in results.items() if isinstance(curve, Curve)}
    domain = (RANGE[0], RANGE[-1])
    figure, axes = sheet(12.0, 4.6, columns=2, sharey=True)
    for panel, (name, angle) in zip(axes[0], ANGLES.items(), strict=True):
        if people is not None and name == "S3":
            low, middle, high = people.band(RANGE)
            label = f"{len(people.names)} people: 10 to 90 %"
            panel.fill_between(RANGE, low, high, color="grey", alpha=0.25, lw=0, label=label)
            panel.plot(RANGE, middle, color="grey", lw=1.0, ls=":", label="their median")
        plot(panel, {f"HyLIoS {name}": curves[name]}, domain)
        points(panel, [curves[f"{name} walked"]], domain)
        reflectance_axes(panel, *domain, f"{name}, incidence {angle:g} degrees")
        panel.set_ylim(bottom=0.0)
        panel.legend(fontsize=8)
    axes[0, 1].set_ylabel("")
    figure.suptitle("6.6  Lightly and darkly pigmented skin; points: by random walk")
    write_figure(figure, folder / "6.6.png")
    checks = [agreement("6.6", name, curves[name], curves[f"{name} walked"]) for name in ANGLES]
    return [
        *similarity_rows(curves),
        *valley_rows(curves, people),
        *people_rows(curves, people),
        *checks,
    ]


def similarity_rows(curves: Mapping[str, Curve]) -> list[Row]:
    """Beyond 1300 nm both specimens look alike."""
    apart = {
        name: float(np.mean(np.abs(curves["S3"].within(*ends) - curves["S4"].within(*ends))))
        for name, ends in {**REGIONS, "similar": (SIMILAR_FROM, RANGE[-1])}.items()
    }
    return [
        Row(
            "6.6",
            "S3 and S4: mean size of their difference, 1300 to 2500 nm beside 400 to 700 nm",
            "similar beyond 1300 nm",
            f"{apart['similar']:.3f} beside {apart['visible']:.3f}",
            aim="less than half",
            met=apart["similar"] < 0.5 * apart["visible"],
        )
    ]


def valley(wavelengths: np.ndarray, reflectance: np.ndarray, ends: tuple[float, float]) -> float:
    """Wavelength in nm of the lowest point between two others, NaN if it is one of them."""
    inside = (wavelengths >= ends[0]) & (wavelengths <= ends[1])
    lowest = int(np.argmin(reflectance[inside]))
    at_an_end = lowest in (0, int(inside.sum()) - 1)
    return float("nan") if at_an_end else float(wavelengths[inside][lowest])


def valley_rows(curves: Mapping[str, Curve], people: People | None) -> list[Row]:
    """Where the curves dip."""
    shown = {name: curves[name].reflectance for name in ANGLES}
    if people is not None:
        shown["median of people"] = people.band(RANGE)[1]
    return [
        Row(
            "6.6",
            f"valley of {what} nm",
            "a curve",
            ", ".join(
                f"{name} {position(valley(RANGE, values, ends))}" for name, values in shown.items()
            ),
            "none",
        )
        for what, ends in VALLEYS.items()
    ]


def position(wavelength: float) -> str:
    """A valley's wavelength, or that there is none."""
    return "none" if np.isnan(wavelength) else f"{wavelength:.0f} nm"


def people_rows(curves: Mapping[str, Curve], people: People | None) -> list[Row]:
    """S3 beside people measured at its angle, where they are given."""
    if people is None:
        return []
    low, middle, high = people.band(RANGE)
    reflectance, rows = curves["S3"].reflectance, []
    for name, ends in {**REGIONS, "whole": (RANGE[0], RANGE[-1])}.items():
        inside = (RANGE >= ends[0]) & (RANGE <= ends[1])
        off = (reflectance - middle)[inside]
        within = np.mean(((reflectance >= low) & (reflectance <= high))[inside])
        rows.append(
            Row(
                "6.6",
                f"S3, {name}: RMSE from the median of {len(people.names)} people; mean difference; "
                "share within 10 to 90 % of them",
                "another person's curve",
                f"{np.sqrt(np.mean(off**2)):.3f}; {off.mean():+.3f}; {within:.0%}",
            )
        )
    return rows
