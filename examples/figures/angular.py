"""Figures 6.7 and 6.8: into which directions skin reflects, in the visible, at 365 and 1100 nm."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes

from examples.figures.drawing import COLOURS, sheet
from examples.figures.light import RAYS_AS_LONG, Effort, Task, Tick
from examples.figures.measured_brdf import forehead
from examples.figures.report import Row, claim
from hylios.lab.pictures import write_figure
from hylios.skin.specimen import SPECIMENS
from hylios.transport.angular import AngularReflectance, brdf
from hylios.transport.simulate import share_error

FIGURES = ("6.7", "6.8")

SKIN = replace(SPECIMENS["S1"], surface_fold_aspect_ratio=0.3)
"""S1 as the caption of table 6.1 has it for these figures."""

INCIDENCES = (0.0, 60.0)
"""Degrees, figure 6.7."""

VISIBLE = np.arange(410.0, 691.0, 20.0)
"""nm, the middles of 15 equal parts of the visible; the thesis integrates over it."""

OBLIQUE = 45.0
"""Degrees of incidence, figure 6.8."""

UV, IR = 365.0, 1100.0
"""nm, figure 6.8."""

POLAR_BINS, AZIMUTH_BINS = 18, 12
"""Bins of 5 degrees and of 15 on either side of the plane of incidence."""

FEW, MANY = 2, 20
"""Rays for one ray of a curve: at the wavelengths of `VISIBLE`, and at `UV` and `IR`."""

WITHIN = 0.2
"""Part by which ratios of the BRDF in two directions may differ and still count as met."""

UP_TO = 75.0
"""Degrees up to which the BRDF is compared with the measured one."""


def tasks(effort: Effort) -> dict[str, Task]:
    """A BRDF for each angle of incidence over the visible, and for each wavelength of 6.8."""
    work = {f"visible {angle:g}": over_the_visible(angle, effort) for angle in INCIDENCES}
    for wavelength in (UV, IR):
        work[f"{wavelength:g} nm"] = at_one(wavelength, OBLIQUE, MANY * effort.rays, effort)
    return work


def at_one(wavelength: float, angle: float, rays: int, effort: Effort) -> Task:
    """A task that walks a BRDF at one wavelength."""
    size = rays / RAYS_AS_LONG

    def work(tick: Tick) -> AngularReflectance:
        distribution = brdf(
            SKIN,
            wavelength,
            angle=angle,
            polar_bins=POLAR_BINS,
            azimuth_bins=AZIMUTH_BINS,
            rays=rays,
            seed=effort.seed,
            threads=effort.threads,
        )
        tick(size)
        return distribution

    return Task(work, size)


def over_the_visible(angle: float, effort: Effort) -> Task:
    """A task that walks the mean BRDF over the visible, all wavelengths with one weight."""
    parts = [at_one(wavelength, angle, FEW * effort.rays, effort) for wavelength in VISIBLE]

    def work(tick: Tick) -> AngularReflectance:
        return together([cast(AngularReflectance, part.work(tick)) for part in parts])

    return Task(work, sum(part.size for part in parts))


def together(parts: list[AngularReflectance]) -> AngularReflectance:
    """The mean of BRDFs with the same angle, bins and number of rays."""
    return replace(
        parts[0],
        rays=sum(part.rays for part in parts),
        surface_counts=sum(part.surface_counts for part in parts),
        subsurface_counts=sum(part.subsurface_counts for part in parts),
    )


def draw(results: Mapping[str, object], folder: Path) -> list[Row]:
    """Draw both figures and compare."""
    distributions = cast(Mapping[str, AngularReflectance], results)
    draw_plane(distributions, folder / "6.7.png")
    draw_lobes(distributions, folder / "6.8.png")
    return [*plane_rows(distributions), *lobe_rows(distributions)]


def in_plane(
    lobes: AngularReflectance, counts: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Directions in degrees in the plane of incidence, f_r of some counts, and its error; (2 P,).

    The mirror's side is positive. The bins next to the normal are taken together, and at normal
    incidence all bins of a ring: there the azimuth means little or nothing.
    """
    wide = lobes.projected_solid_angle
    rings = counts.sum(axis=1) / counts.shape[1], wide.sum(axis=1) / wide.shape[1]
    alike = np.arange(len(wide)) < (len(wide) if lobes.angle == 0.0 else 1)
    number = np.where(alike, counts.shape[1], 1)
    sides = []
    for column in (-1, 0):
        rays = number * np.where(alike, rings[0], counts[:, column])
        size = number * np.where(alike, rings[1], wide[:, column])
        sides.append((rays / lobes.rays / size, share_error(rays, lobes.rays) / size))
    polar = 0.5 * (lobes.polar_edges[1:] + lobes.polar_edges[:-1])
    back, front = sides
    return (
        np.concatenate([-polar[::-1], polar]),
        np.concatenate([back[0][::-1], front[0]]),
        np.concatenate([back[1][::-1], front[1]]),
    )


def everything(lobes: AngularReflectance) -> np.ndarray:
    """Counts (P, A) of all reflected rays."""
    return lobes.surface_counts + lobes.subsurface_counts


def measured(angle: float, directions: np.ndarray) -> np.ndarray:
    """The fitted measurement in 1/sr at directions in the plane of incidence in degrees, (N,).

    As mean over the same azimuths as our bins.
    """
    width = 180.0 / AZIMUTH_BINS
    turns = width * (np.arange(5) + 0.5) / 5
    polar, behind = np.abs(directions), directions < 0.0
    return np.mean(
        [forehead(angle, polar, np.where(behind, 180.0 - turn, turn)) for turn in turns], axis=0
    )


def draw_plane(distributions: Mapping[str, AngularReflectance], path: Path) -> None:
    """Figure 6.7."""
    figure, axes = sheet(12.0, 5.0, columns=2)
    fine = np.linspace(-88.0, 88.0, 353)
    for panel, angle in zip(axes[0], INCIDENCES, strict=True):
        ours = distributions[f"visible {angle:g}"]
        parts = {
            "HyLIoS S1, aspect ratio 0.3": (everything(ours), COLOURS[1]),
            "its surface part": (ours.surface_counts, COLOURS[2]),
            "its subsurface part": (ours.subsurface_counts, COLOURS[4]),
        }
        panel.plot(fine, measured(angle, fine), "k--", lw=1.2, label="lobes fitted to a forehead")
        for name, (counts, colour) in parts.items():
            directions, curve, error = in_plane(ours, counts)
            panel.plot(directions, curve, color=colour, lw=1.4, label=name)
            panel.fill_between(directions, curve - error, curve + error, color=colour, alpha=0.25)
        mark_mirror(panel, angle)
        directions, curve, _ = in_plane(ours, everything(ours))
        panel.set(
            xlabel="direction of reflection in the plane of incidence (degrees)",
            title=f"incidence {angle:g} degrees",
            xlim=(-90.0, 90.0),
            ylim=(0.0, 1.3 * curve[np.abs(directions) < UP_TO].max()),
        )
        panel.grid(alpha=0.25)
    axes[0, 0].set_ylabel("BRDF (1/sr), mean over 400 to 700 nm")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, fontsize=9)
    figure.suptitle("6.7  BRDF beside the measurement of Marschner et al. 1999")
    write_figure(figure, path)


def mark_mirror(panel: Axes, angle: float) -> None:
    """Show where a mirror would send the light."""
    panel.axvline(angle, color="grey", lw=0.8, ls=":")
    across = panel.get_xaxis_transform()
    panel.text(
        angle - 1.0,
        0.98,
        "mirror",
        rotation=90,
        color="grey",
        ha="right",
        va="top",
        fontsize=8,
        transform=across,
    )


def draw_lobes(distributions: Mapping[str, AngularReflectance], path: Path) -> None:
    """Figure 6.8: f_r times the cosine in the plane of incidence, the largest total being 1."""
    figure = Figure(figsize=(12.0, 4.2), dpi=120)
    for left, wavelength in ((0.04, UV), (0.54, IR)):
        box = (left, -0.13, 0.42, 1.2)  # the half circle fills its middle half
        panel = cast(PolarAxes, figure.add_axes(box, projection="polar"))
        most = draw_lobe(panel, distributions[f"{wavelength:g} nm"])
        heading = f"{wavelength:g} nm; 1 stands for {most:.3f}/sr"
        figure.text(left + 0.21, 0.87, heading, ha="center")
        handles, labels = panel.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=3, fontsize=9)
    figure.suptitle(
        "6.8  BRDF times cosine in the plane of incidence, S1 with aspect ratio 0.3, light from "
        "-45 degrees"
    )
    write_figure(figure, path)


def draw_lobe(panel: PolarAxes, lobes: AngularReflectance) -> float:
    """One wavelength of figure 6.8; returns its largest total in 1/sr."""
    parts = {
        "total, $R_t$": (everything(lobes), COLOURS[0], "-"),
        "surface, $R_s$": (lobes.surface_counts, COLOURS[2], "--"),
        "subsurface, $R_d$": (lobes.subsurface_counts, COLOURS[1], "-"),
    }
    directions, total, _ = in_plane(lobes, everything(lobes))
    cosine = np.cos(np.radians(directions))
    most = float(np.max(total * cosine))
    for name, (counts, colour, style) in parts.items():
        radius = in_plane(lobes, counts)[1] * cosine / most
        panel.plot(np.radians(directions), radius, color=colour, ls=style, label=name)
    arrow = {"arrowstyle": "->", "color": "grey", "lw": 1.2}
    panel.annotate("", (0.0, 0.0), (np.radians(-OBLIQUE), 1.0), arrowprops=arrow)
    panel.set_theta_zero_location("N")
    panel.set_theta_direction(-1)
    panel.set_thetamin(-90.0)
    panel.set_thetamax(90.0)
    panel.set_rlim(0.0, 1.05)
    panel.set_rticks([0.25, 0.5, 0.75, 1.0])
    panel.tick_params(labelsize=8)
    return most


def plane_rows(distributions: Mapping[str, AngularReflectance]) -> list[Row]:
    """Figure 6.7 in numbers, beside the fitted measurement."""
    rows = []
    for angle in INCIDENCES:
        ours = distributions[f"visible {angle:g}"]
        directions, curve, error = in_plane(ours, everything(ours))
        near = np.abs(directions) < UP_TO
        theirs = measured(angle, directions)
        off = (curve / theirs - 1.0)[near]
        rows.append(
            Row(
                "6.7",
                f"incidence {angle:g}°, BRDF from the lobes fitted to the measured one, up to "
                f"{UP_TO:g}° from the normal: RMS, least, largest",
                "curves, no number",
                f"{np.sqrt(np.mean(off**2)):.0%}, {off.min():+.0%}, {off.max():+.0%}",
                f"{ours.rays:,} rays, standard error up to {np.max((error / theirs)[near]):.1%}",
            )
        )
    return [*rows, *shape_rows(distributions), reciprocity_row(distributions)]


def reciprocity_row(distributions: Mapping[str, AngularReflectance]) -> Row:
    """Light in at 0 and out at 60 degrees beside the reverse, out to every side."""
    level, steep = (distributions[f"visible {angle:g}"] for angle in INCIDENCES)
    there = everything(level)[11:13].sum() / level.projected_solid_angle[11:13].sum() / level.rays
    back = everything(steep)[:1].sum() / steep.projected_solid_angle[:1].sum() / steep.rays
    return Row(
        "6.7",
        "reciprocity: BRDF from 0° to 60° over BRDF from 60° to 0°",
        "not compared",
        f"{there:.3f} / {back:.3f} = {there / back:.2f}",
        f"{steep.rays:,} rays",
    )


def shape_rows(distributions: Mapping[str, AngularReflectance]) -> list[Row]:
    """How the BRDF depends on the angle, ours and the fitted measurement's."""
    rows = []
    for angle, what, pair in (
        (0.0, "at the normal over 62.5° from it", (2.5, 62.5)),
        (60.0, "62.5° to the mirror's side over 62.5° to the light's", (62.5, -62.5)),
    ):
        ours = distributions[f"visible {angle:g}"]
        directions, curve, _ = in_plane(ours, everything(ours))
        nearest = [int(np.argmin(np.abs(directions - direction))) for direction in pair]
        mine, theirs = (
            float(values[nearest[0]] / values[nearest[1]])
            for values in (curve, measured(angle, directions))
        )
        rows.append(
            Row(
                "6.7",
                f"incidence {angle:g}°, BRDF {what}, and the fit's",
                "curves, no number",
                f"{mine:.2f}; fit {theirs:.2f} ({mine / theirs - 1.0:+.0%})",
                f"{ours.rays:,} rays",
                f"within {WITHIN:.0%} of the fit",
                abs(mine / theirs - 1.0) < WITHIN,
            )
        )
    return rows


def from_lambertian(lobes: AngularReflectance) -> float:
    """Share of the reflected light that would have to move for it to be Lambertian, 0 to 1."""
    counts = everything(lobes)
    diffuse = lobes.projected_solid_angle / np.pi
    return float(0.5 * np.sum(np.abs(counts / counts.sum() - diffuse)))


def subsurface_share(lobes: AngularReflectance) -> float:
    """Share of the reflected light that has been inside."""
    inside = lobes.subsurface_counts.sum()
    return float(inside / (inside + lobes.surface_counts.sum()))


def lobe_rows(distributions: Mapping[str, AngularReflectance]) -> list[Row]:
    """What the thesis says of figure 6.8."""
    uv, ir = distributions[f"{UV:g} nm"], distributions[f"{IR:g} nm"]
    apart = from_lambertian(uv), from_lambertian(ir)
    share = subsurface_share(uv), subsurface_share(ir)
    noise = f"{uv.rays:,} rays"
    rows = [
        claim(
            "6.8",
            "share of the reflected light that would have to move to be Lambertian; 365, 1100 nm",
            "total more diffuse in the IR",
            f"{apart[0]:.3f}, {apart[1]:.3f}",
            apart[1] < apart[0],
        ),
        claim(
            "6.8",
            "subsurface share of the reflected light; 365, 1100 nm",
            "subsurface more dominant in the IR",
            f"{share[0]:.3f}, {share[1]:.3f}",
            share[1] > share[0],
        ),
    ]
    return [replace(row, noise=noise) for row in rows]
