"""Figures 6.13 to 6.18 and table 6.3: what the removal of a material does to S3."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from examples.figures import dna
from examples.figures.drawing import (
    DOMAINS,
    bars,
    plot,
    points,
    reflectance_axes,
    sheet,
    swatch,
)
from examples.figures.light import (
    RANGE,
    THESIS_RAYS,
    Curve,
    Effort,
    Task,
    noise_free,
    noisy,
    walked,
)
from examples.figures.report import Row, agreement, claim, relative
from hylios.lab.pictures import write_figure
from hylios.skin.specimen import SPECIMENS, Specimen, with_values

FIGURES = (*(f"6.{number}" for number in range(13, 19)), "table 6.3")

ANGLE = 8.0
"""Angle of incidence in degrees, as in figure 6.6's curve of S3."""

CHECKED = np.arange(250.0, 2501.0, 50.0)
"""Wavelengths in nm at which rays walk too."""

HYPER = (RANGE[0], RANGE[-1])
DRAWS = 50
"""How often noise is drawn for the index that noise alone would give."""

WITHIN = 0.15


@dataclass(frozen=True)
class Material:
    """What is removed: parameters by the end of their names, and what table 6.3 prints."""

    endings: tuple[str, ...]
    domain: str
    printed: float
    printed_hyper: float


MATERIALS = {
    "melanin": Material(("_melanosomes", "_colloidal_melanin"), "visible", 0.415, 0.123),
    "blood": Material(("_blood",), "visible", 0.229, 0.049),
    "DNA": Material(("_dna",), "UV", 0.135, 0.018),
    "keratin": Material(("_keratin",), "UV", 0.068, 0.012),
    "water": Material(("_water",), "IR", 0.611, 0.491),
    "lipids": Material(("_lipids",), "IR", 0.026, 0.022),
}

PAIRS = (
    ("6.13", "6.14", ("melanin", "blood")),
    ("6.15", "6.16", ("DNA", "keratin")),
    ("6.17", "6.18", ("water", "lipids")),
)
"""Figure of the curves, figure of the swatches, and the materials they remove."""


def without(skin: Specimen, material: str) -> Specimen:
    """The specimen with a material's parameters at 0."""
    endings = MATERIALS[material].endings
    names = [field.name for field in fields(Specimen) if field.name.endswith(endings)]
    names = [name for name in names if name != "oxygenated_blood"]
    return with_values(skin, dict.fromkeys(names, 0.0), allow_unphysical=True)


def tasks(effort: Effort) -> dict[str, Task]:
    """S3 and what is left of it, without noise, and some wavelengths by random walk."""
    start = SPECIMENS["S3"]
    skins = {"all": start, **{name: without(start, name) for name in MATERIALS}}
    work = {}
    for name, skin in skins.items():
        work[name] = noise_free(skin, RANGE, ANGLE)
        work[f"{name} walked"] = walked(skin, CHECKED, ANGLE, effort)
    work["readings"] = dna.task()
    return work


def index(base: np.ndarray, changed: np.ndarray) -> float:
    """Mean sensitivity index of two curves (6.1)."""
    return float(np.mean(np.abs(base - changed) / np.maximum(base, changed)))


def indices(base: Curve, changed: Curve) -> dict[str, float]:
    """Mean sensitivity index by domain, and over all of the range."""
    return {
        name: index(base.within(*domain), changed.within(*domain))
        for name, domain in {**DOMAINS, "Hyper": HYPER}.items()
    }


def noisy_index(base: np.ndarray, changed: np.ndarray, rays: int) -> float:
    """What index (6.1) would come out on average with so many rays per wavelength.

    Noise adds to it, because it counts differences of either sign as positive.
    """
    drawn = [
        index(noisy(base, rays, 2 * seed), noisy(changed, rays, 2 * seed + 1))
        for seed in range(DRAWS)
    ]
    return float(np.mean(drawn))


def draw(results: Mapping[str, Curve], folder: Path) -> list[Row]:
    """Draw all figures and compare with table 6.3."""
    for number, swatches, materials in PAIRS:
        draw_pair(results, number, materials, folder)
        draw_swatches(results, swatches, materials, folder)
    draw_table(results, folder / "table 6.3.png")
    checks = [
        agreement("table 6.3", f"S3, removed {name}", results[name], results[f"{name} walked"])
        for name in MATERIALS
    ]
    base = agreement("table 6.3", "S3", results["all"], results["all walked"])
    return [
        *table_rows(results),
        *results["readings"],
        *swatch_rows(results),
        omega_row(results),
        base,
        *checks,
    ]


def draw_pair(
    results: Mapping[str, Curve], number: str, materials: tuple[str, str], folder: Path
) -> None:
    """Figures 6.13, 6.15, 6.17: curves in a domain, and the index by domain."""
    domain = MATERIALS[materials[0]].domain
    figure, axes = sheet(12.0, 4.4, columns=2)
    left, right = axes[0]
    curves = {"S3": results["all"], **{f"no {name}": results[name] for name in materials}}
    plot(left, curves, DOMAINS[domain])
    points(left, [results[f"{name} walked"] for name in ("all", *materials)], DOMAINS[domain])
    reflectance_axes(left, *DOMAINS[domain], "lines without noise, points by random walk")
    left.legend()
    index = {name: indices(results["all"], results[name]) for name in materials}
    labels = list(index[materials[0]])
    series = {f"no {name}": list(index[name].values()) for name in materials}
    bars(right, labels, series, "mean sensitivity index")
    for offset, name in zip((-0.2, 0.2), materials, strict=True):
        places = [labels.index(domain) + offset, labels.index("Hyper") + offset]
        printed = [MATERIALS[name].printed, MATERIALS[name].printed_hyper]
        right.plot(places, printed, "kD", markersize=5, mfc="none", label="table 6.3")
    handles, names = right.get_legend_handles_labels()
    right.legend(dict(zip(names, handles, strict=True)).values(), dict.fromkeys(names), fontsize=8)
    figure.suptitle(f"{number}  S3 without {materials[0]} or {materials[1]}, incidence 8 degrees")
    write_figure(figure, folder / f"{number}.png")


def draw_swatches(
    results: Mapping[str, Curve], number: str, materials: tuple[str, str], folder: Path
) -> None:
    """Figures 6.14, 6.16, 6.18: swatches in a domain."""
    domain = MATERIALS[materials[0]].domain
    figure, axes = sheet(6.6, 2.7, columns=3)
    shown = {"S3": "all", **{f"no {name}": name for name in materials}}
    for panel, (title, name) in zip(axes[0], shown.items(), strict=True):
        swatch(panel, results[name], domain, title)
    figure.suptitle(f"{number}  {domain}{'' if domain == 'visible' else ', pseudo colour'}")
    write_figure(figure, folder / f"{number}.png")


def draw_table(results: Mapping[str, Curve], path: Path) -> None:
    """Table 6.3 as a picture."""
    figure, axes = sheet(12.0, 4.4, columns=2)
    for panel, title in zip(axes[0], ("in the domain of the most impact", "Hyper"), strict=True):
        printed, ours, with_noise = [], [], []
        for name, material in MATERIALS.items():
            domain = HYPER if title == "Hyper" else DOMAINS[material.domain]
            both = results["all"].within(*domain), results[name].within(*domain)
            printed.append(material.printed_hyper if title == "Hyper" else material.printed)
            ours.append(index(*both))
            with_noise.append(noisy_index(*both, THESIS_RAYS))
        series = {
            "ours without noise": ours,
            f"ours with the noise of {THESIS_RAYS:,} rays": with_noise,
            "thesis": printed,
        }
        bars(panel, list(MATERIALS), series, "mean sensitivity index")
        panel.set_title(title)
    figure.suptitle("Table 6.3  Removal of a material from S3")
    write_figure(figure, path)


def table_rows(results: Mapping[str, Curve]) -> list[Row]:
    """Table 6.3."""
    rows = []
    for name, material in MATERIALS.items():
        for domain, limits, printed in (
            (material.domain, DOMAINS[material.domain], material.printed),
            ("Hyper", HYPER, material.printed_hyper),
        ):
            both = results["all"].within(*limits), results[name].within(*limits)
            what = f"no {name}, MSI, {domain}"
            rows.append(relative("table 6.3", what, printed, index(*both), WITHIN))
            rows.append(
                relative(
                    "table 6.3",
                    f"{what}, with the noise of {THESIS_RAYS:,} rays",
                    printed,
                    noisy_index(*both, THESIS_RAYS),
                    WITHIN,
                )
            )
    return rows


def swatch_rows(results: Mapping[str, Curve]) -> list[Row]:
    """Figures 6.14, 6.16, 6.18: each removal lightens its domain."""
    rows = []
    for _, number, materials in PAIRS:
        domain = MATERIALS[materials[0]].domain
        means = {
            name: results[name].within(*DOMAINS[domain]).mean() for name in ("all", *materials)
        }
        rows.append(
            claim(
                number,
                f"mean reflectance, {domain}: S3, no {materials[0]}, no {materials[1]}",
                "lighter without either",
                ", ".join(f"{value:.4f}" for value in means.values()),
                all(means[name] > means["all"] for name in materials),
            )
        )
    return rows


def omega_row(results: Mapping[str, Curve]) -> Row:
    """Figure 6.13: the two valleys of oxyhemoglobin go with the blood."""
    valleys = {
        name: int(np.sum(np.diff(np.sign(np.diff(results[name].within(500.0, 600.0)))) > 0))
        for name in ("all", "blood")
    }
    return claim(
        "6.13",
        "valleys from 500 to 600 nm: S3, no blood",
        "an omega, which vanishes",
        f"{valleys['all']}, {valleys['blood']}",
        valleys == {"all": 2, "blood": 0},
    )
