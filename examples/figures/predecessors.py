"""Figures 6.2 to 6.4: DJ06, BioSpec and HyLIoS in the visible, and the colours they give.

The measured curves 117 and 113 of figure 6.2 (M. J. Vrhel, R. Gershon and L. S. Iwan 1994,
"Measurement and Analysis of Object Reflectance Spectra", Color Research and Application 19, 4 to 9)
could not be had: no copy of the university's database was found. In their place stand S1 and S2
themselves, and people's measured curves where the user gives them.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import cast

import numpy as np

from examples.figures.drawing import plot, points, reflectance_axes, sheet
from examples.figures.light import RAYS_AS_LONG, Curve, Effort, Task, Tick, noise_free, walked
from examples.figures.measured_people import People
from examples.figures.report import Row, agreement
from hylios.lab.colour import difference, srgb
from hylios.lab.colour import swatch as colour_of_band
from hylios.lab.pictures import write_figure
from hylios.lab.predecessors import biospec, donner_jensen
from hylios.skin.specimen import SPECIMENS
from hylios.transport.events import SUBSURFACE, SURFACE
from hylios.transport.simulate import share_error
from hylios.transport.tallies import tallied

FIGURES = ("6.2", "6.3", "6.4")

SHOWN = ("S1", "S2")
ANGLE = 45.0
"""Angle of incidence in degrees."""

VISIBLE = (400.0, 700.0)
WAVELENGTHS = np.arange(400.0, 701.0, 5.0)
CHECKED = np.arange(400.0, 701.0, 50.0)
"""Wavelengths in nm at which S1 and S2 walk too."""

THIRDS = {"blue": (400.0, 500.0), "green": (500.0, 600.0), "red": (600.0, 700.0)}

SIDES = {
    "6.3": ("S1", ("DJ06 multipole", "DJ06 walked", "S1"), "117"),
    "6.4": ("S2", ("BioSpec", "S2"), "113"),
}
"""For each figure of swatches: the specimen, the models, and the measured curve that is missing."""


def tasks(effort: Effort) -> dict[str, Task]:
    """The models' curves, and S1 and S2 by random walk at some wavelengths."""
    multipole = donner_jensen.reflectance(donner_jensen.NCSU_117, WAVELENGTHS, ANGLE)
    without_noise = Curve(WAVELENGTHS, multipole, np.zeros(WAVELENGTHS.size), 0)
    work = {
        "DJ06 multipole": Task(lambda tick: without_noise, 0),
        "DJ06 walked": Task(lambda tick: walked_dj06(effort, tick), work_size(effort)),
        "BioSpec": Task(lambda tick: walked_biospec(effort, tick), work_size(effort)),
        "people": Task(lambda tick: effort.people, 0),
    }
    for name in SHOWN:
        work[name] = noise_free(SPECIMENS[name], WAVELENGTHS, ANGLE)
        work[f"{name} walked"] = walked(SPECIMENS[name], CHECKED, ANGLE, effort)
    return work


def work_size(effort: Effort) -> float:
    """Size of the work of all wavelengths at so many rays per wavelength."""
    return WAVELENGTHS.size * effort.rays / RAYS_AS_LONG


def walked_dj06(effort: Effort, tick: Tick) -> Curve:
    """DJ06's optical properties through this project's random walk."""

    def tally(traced):
        return np.bincount(traced.outcome, minlength=SUBSURFACE + 1)[[SURFACE, SUBSURFACE]]

    returned = np.empty(WAVELENGTHS.size)
    for place, wavelength in enumerate(WAVELENGTHS):
        layers = donner_jensen.stack(donner_jensen.NCSU_117, wavelength)
        key = (effort.seed, round(wavelength * 1000))
        counts = tallied(
            tally, layers, rays=effort.rays, angle=ANGLE, key=key, threads=effort.threads
        )
        returned[place] = counts.sum()
        tick(effort.rays / RAYS_AS_LONG)
    error = share_error(returned, effort.rays)
    return Curve(WAVELENGTHS, returned / effort.rays, error, effort.rays)


def walked_biospec(effort: Effort, tick: Tick) -> Curve:
    """BioSpec's reflectance, by its own random walk."""
    reflectance = np.empty(WAVELENGTHS.size)
    for place, wavelength in enumerate(WAVELENGTHS):
        reflectance[place] = biospec.reflectance(
            biospec.NCSU_113, wavelength, ANGLE, effort.rays, effort.seed
        )[0]
        tick(effort.rays / RAYS_AS_LONG)
    error = share_error(reflectance * effort.rays, effort.rays)
    return Curve(WAVELENGTHS, reflectance, error, effort.rays)


def draw(results: Mapping[str, object], folder: Path) -> list[Row]:
    """Draw all figures and compare the models."""
    people = cast(People | None, results["people"])
    curves = {name: curve for name, curve in results.items() if isinstance(curve, Curve)}
    draw_curves(curves, people, folder / "6.2.png")
    for number in SIDES:
        draw_swatches(curves, people, number, folder / f"{number}.png")
    checks = [agreement("6.2", name, curves[name], curves[f"{name} walked"]) for name in SHOWN]
    return [
        *curve_rows(curves),
        *people_rows(curves, people),
        *colour_rows(curves, people),
        *checks,
    ]


def draw_curves(curves: Mapping[str, Curve], people: People | None, path: Path) -> None:
    """Figure 6.2: curves of the earlier models and HyLIoS."""
    figure, axes = sheet(12.0, 4.8, columns=2, sharey=True)
    shown = (
        {
            "HyLIoS S1": curves["S1"],
            "DJ06, multipole as published": curves["DJ06 multipole"],
            "DJ06's properties, random walk": curves["DJ06 walked"],
        },
        {"HyLIoS S2": curves["S2"], "BioSpec": curves["BioSpec"]},
    )
    notes = (
        "DJ06: ASSUMED melanin and blood, fitted to S1",
        "BioSpec: ASSUMED parameters, its program's lightest skin",
    )
    for place, name, lines, note, side in zip(
        axes[0], SHOWN, shown, notes, SIDES.values(), strict=True
    ):
        if people is not None:
            draw_people(place, people)
        plot(place, lines, VISIBLE)
        points(place, [curves[f"{name} walked"]], VISIBLE)
        reflectance_axes(place, *VISIBLE, f"{note}\n(measured NCSU curve {side[2]} not at hand)")
        place.title.set_fontsize(9)
        place.set_ylim(bottom=0.0)
        place.legend(fontsize=8, loc="upper left")
    axes[0, 1].set_ylabel("")
    figure.suptitle(
        "6.2  Models in the visible, incidence 45 degrees; points: S1 and S2 by random walk"
    )
    write_figure(figure, path)


def draw_people(place, people: People) -> None:
    """The band that holds 80 % of the people, and their median."""
    low, middle, high = people.band(WAVELENGTHS)
    label = f"{len(people.names)} people at 8 degrees: 10 to 90 %"
    place.fill_between(WAVELENGTHS, low, high, color="grey", alpha=0.2, lw=0, label=label)
    place.plot(WAVELENGTHS, middle, color="grey", lw=1.0, ls=":", label="their median")


def draw_swatches(
    curves: Mapping[str, Curve], people: People | None, number: str, path: Path
) -> None:
    """Figures 6.3 and 6.4: the colours side by side, with their distances from HyLIoS."""
    reference, models, measured = SIDES[number]
    colours = swatches(curves, people, models)
    figure, axes = sheet(2.3 * len(colours), 3.2, columns=len(colours))
    for place, (name, colour) in zip(axes[0], colours.items(), strict=True):
        place.imshow(srgb(colour)[None, None])
        apart = float(difference(colour, colours[reference]))
        below = "" if name == reference else f"ΔE$_{{00}}$ to {reference}: {apart:.1f}"
        place.set(xticks=[], yticks=[])
        place.set_title(label(name), fontsize=9)
        place.set_xlabel(below, fontsize=9)
    figure.suptitle(
        f"{number}  Skin under D65. {models[0].split()[0]}'s parameters are ASSUMED;\n"
        f"the measured curve {measured} is not at hand",
        fontsize=10,
    )
    write_figure(figure, path)


def label(name: str) -> str:
    """What a swatch is called."""
    return f"HyLIoS {name}" if name in SPECIMENS else name


def swatches(
    curves: Mapping[str, Curve], people: People | None, models: tuple[str, ...]
) -> dict[str, np.ndarray]:
    """Linear Rec.709 (3,) of each model, and of the people's median spectrum where given."""
    colours = {name: colour(curves[name].reflectance) for name in models}
    if people is not None:
        colours["median of people"] = colour(people.band(WAVELENGTHS)[1])
    return colours


def colour(reflectance: np.ndarray) -> np.ndarray:
    """Linear Rec.709 (3,) of reflectance at `WAVELENGTHS` under D65."""
    return colour_of_band(WAVELENGTHS, reflectance, "visible")


def curve_rows(curves: Mapping[str, Curve]) -> list[Row]:
    """How far each earlier model is from HyLIoS, by thirds of the visible."""
    rows = []
    for number, (reference, models, _) in SIDES.items():
        for name in models[:-1]:
            mean = {
                third: np.mean(np.abs(curves[name].within(*ends) - curves[reference].within(*ends)))
                for third, ends in THIRDS.items()
            }
            off = curves[name].reflectance - curves[reference].reflectance
            rows.append(
                Row(
                    "6.2",
                    f"{name} from HyLIoS {reference}: RMSE; mean size of the difference by third",
                    f"a curve (of {SIDES[number][2]}, both)",
                    f"{np.sqrt(np.mean(off**2)):.3f}; "
                    + ", ".join(f"{third} {value:.3f}" for third, value in mean.items()),
                    noise(curves[name]),
                )
            )
    return rows


def noise(curve: Curve) -> str:
    """What a report says of a curve's noise."""
    if not curve.rays:
        return "none"
    return f"{curve.rays:,} rays, standard error up to {curve.standard_error.max():.4f}"


def people_rows(curves: Mapping[str, Curve], people: People | None) -> list[Row]:
    """How the models stand to measured people, where they are given."""
    if people is None:
        return []
    low, middle, high = people.band(WAVELENGTHS)
    rows = []
    for name in ("S1", "S2", "DJ06 multipole", "DJ06 walked", "BioSpec"):
        reflectance = curves[name].reflectance
        inside = np.mean((reflectance >= low) & (reflectance <= high))
        rmse = np.sqrt(np.mean((reflectance - middle) ** 2))
        rows.append(
            Row(
                "6.2",
                f"{label(name)}: share of 400 to 700 nm within 10 to 90 % of "
                f"{len(people.names)} people; RMSE from their median",
                "not compared",
                f"{inside:.0%}; {rmse:.3f}",
                noise(curves[name]),
            )
        )
    return rows


def colour_rows(curves: Mapping[str, Curve], people: People | None) -> list[Row]:
    """CIEDE2000 of each swatch from HyLIoS's."""
    rows = []
    for number, (reference, models, _) in SIDES.items():
        colours = swatches(curves, people, models)
        for name, swatch_colour in colours.items():
            if name != reference:
                apart = float(difference(swatch_colour, colours[reference]))
                what = f"{name} from HyLIoS {reference}, CIEDE2000"
                rows.append(Row(number, what, "swatches, no number", f"{apart:.1f}"))
    return rows
