"""Specimens fitted to measured people, where the user gives some: no figure of the thesis.

Also what keeps S3 from them: the people's median is fitted with one thing about the model changed.
"""

import signal
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field, replace
from multiprocessing import get_context
from pathlib import Path
from types import MappingProxyType
from typing import cast

import numpy as np

from examples.figures.drawing import COLOURS, reflectance_axes, sheet
from examples.figures.light import Effort, Task
from examples.figures.measured_people import People
from examples.figures.report import Row
from hylios.lab.fit import USUAL, Fit, fit_spectrum
from hylios.lab.pictures import write_figure
from hylios.skin.specimen import SPECIMENS
from hylios.spectra import Spectra, published_spectra
from hylios.tissue import Model

FIGURES = ("people",)

ANGLE = 8.0
"""Angle of incidence in degrees."""

REGIONS: Mapping[str, np.ndarray] = MappingProxyType(
    {
        "visible": np.arange(400.0, 701.0, 10.0),
        "whole range": np.concatenate(
            [np.arange(250.0, 1000.0, 20.0), np.arange(1000.0, 2501.0, 50.0)]
        ),
    }
)
"""Wavelengths in nm at which people are fitted."""

AIMS = {"visible": 0.010, "whole range": 0.030}
"""Median root mean square error over people."""

SIZE = 120.0
"""Of a fitted wavelength, in wavelengths solved once."""

LIPIDS_FROM = 1597.0
"""nm beyond which the figure for lipids is an estimate that may be twice too high."""


@dataclass(frozen=True)
class Variant:
    """Something changed about the model in which a spectrum is fitted."""

    free: Sequence[str] = USUAL
    reading: Mapping[str, str] = field(default_factory=dict)
    lipids: float = 1.0


VARIANTS = {
    "as fitted": Variant(),
    "hypodermis that reflects all, as in the thesis": Variant(
        free=[name for name in USUAL if name != "hypodermis"]
    ),
    "lipids free too": Variant(free=[*USUAL, "lipids"]),
    "half the lipids' absorption beyond 1597 nm": Variant(lipids=0.5),
    "Rayleigh's eta^2 + 2 in 4.7": Variant(reading={"rayleigh_denominator": "plus_two"}),
    "Rayleigh at every collision": Variant(reading={"rayleigh": "every_collision"}),
    "floor diffuse about the mirrored ray": Variant(reading={"floor": "mirrored"}),
}


def fitted(reflectance: np.ndarray, region: str, variant: Variant) -> Fit:
    """A specimen fitted to a spectrum (W,) of a region, from S3 on."""
    return fit_spectrum(
        SPECIMENS["S3"],
        REGIONS[region],
        reflectance,
        free=variant.free,
        angle=ANGLE,
        model=Model(with_lipids(variant.lipids), variant.reading),
    )


def with_lipids(factor: float) -> Spectra:
    """The published spectra, with lipids changed where they are an estimate."""
    spectra = published_spectra()
    lipids = spectra["lipids"]
    beyond = lipids.wavelengths > LIPIDS_FROM
    scaled = replace(lipids, values=np.where(beyond, factor, 1.0) * lipids.values)
    return spectra if factor == 1.0 else MappingProxyType({**spectra, "lipids": scaled})


def tasks(effort: Effort) -> dict[str, Task]:
    """Fits of all people, and of their median in variants of the model; none without people."""
    people = effort.people
    if people is None:
        return {}
    jobs = {
        region: [(row, region, VARIANTS["as fitted"]) for row in people.at(wavelengths)]
        for region, wavelengths in REGIONS.items()
    }
    middle = np.median(people.at(REGIONS["whole range"]), axis=0)
    jobs["variants"] = [(middle, "whole range", variant) for variant in VARIANTS.values()]
    return {
        "people": Task(lambda tick: people, 0),
        **{name: _together(group, effort.threads) for name, group in jobs.items()},
    }


def _together(jobs: Sequence[tuple[np.ndarray, str, Variant]], processes: int | None) -> Task:
    """The task of several fits, in processes of their own; it gives a list of `Fit`."""
    sizes = [SIZE * REGIONS[region].size for _, region, _ in jobs]

    def work(tick):
        results = []
        context = get_context("spawn")
        with ProcessPoolExecutor(processes, context, _leave_interrupts) as pool:
            try:
                fits = pool.map(fitted, *zip(*jobs, strict=True))
                for fit, size in zip(fits, sizes, strict=True):
                    results.append(fit)
                    tick(size)
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise
        return results

    return Task(work, sum(sizes))


def _leave_interrupts() -> None:
    """Ctrl-C is the parent's to handle."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def draw(results: Mapping[str, object], folder: Path) -> list[Row]:
    """Draw the fits and say how near they come."""
    if not results:
        return []
    people = cast(People, results["people"])
    fits = {region: cast(list[Fit], results[region]) for region in REGIONS}
    figure, axes = sheet(12.0, 7.5, columns=2, rows=2)
    for row, (region, of_region) in zip(axes, fits.items(), strict=True):
        _draw_examples(row[0], region, of_region, people)
        _draw_residuals(row[1], region, of_region)
    figure.suptitle(f"{len(people.names)} measured people, each fitted by a specimen")
    write_figure(figure, folder / "people.png")
    variants = cast(list[Fit], results["variants"])
    return [
        *(row for region in REGIONS for row in region_rows(region, fits[region])),
        *variant_rows(dict(zip(VARIANTS, variants, strict=True))),
    ]


def errors(fits: Sequence[Fit]) -> np.ndarray:
    """Root mean square error of each fit."""
    return np.array([fit.rmse for fit in fits])


def _draw_examples(axes, region: str, fits: Sequence[Fit], people: People) -> None:
    """The best, the middle and the worst fit with what was measured."""
    order = np.argsort(errors(fits))
    for colour, (word, rank) in zip(
        COLOURS, {"best": 0, "middle": len(order) // 2, "worst": -1}.items(), strict=False
    ):
        fit = fits[order[rank]]
        label = f"{word}: {people.names[order[rank]]}, RMSE {fit.rmse:.4f}"
        wavelengths = REGIONS[region]
        axes.plot(wavelengths, fit.observed, color=colour, lw=1.3, label=label)
        axes.plot(wavelengths, fit.observed - fit.residual, ".", color=colour, markersize=4)
    reflectance_axes(axes, *REGIONS[region][[0, -1]], f"{region}; points: measured")
    axes.set_ylim(bottom=0.0)
    axes.legend(fontsize=8)


def _draw_residuals(axes, region: str, fits: Sequence[Fit]) -> None:
    """What the fits leave."""
    residuals = np.array([fit.residual for fit in fits])
    low, middle, high = np.quantile(residuals, [0.1, 0.5, 0.9], axis=0)
    axes.fill_between(REGIONS[region], low, high, color="grey", alpha=0.3, lw=0, label="10 to 90 %")
    axes.plot(REGIONS[region], middle, color="black", label="median")
    axes.axhline(0.0, color="black", lw=0.6)
    reflectance_axes(axes, *REGIONS[region][[0, -1]], "fit minus measured")
    axes.set_ylabel("difference in reflectance")
    axes.legend(fontsize=8)


def region_rows(region: str, fits: Sequence[Fit]) -> list[Row]:
    """How near the fits come, and what they say of people."""
    off, wavelengths = errors(fits), REGIONS[region]
    ends = f"{wavelengths[0]:.0f} to {wavelengths[-1]:.0f} nm"
    left = {
        parameter.name: float(np.median([fit.free[number].left for fit in fits]))
        for number, parameter in enumerate(fits[0].free)
    }
    return [
        Row(
            "people",
            f"median RMSE of {len(fits)} fits, {ends}, {wavelengths.size} wavelengths",
            "",
            f"{np.median(off):.4f} ({off.min():.4f} to {off.max():.4f})",
            aim=f"below {AIMS[region]:.3f}",
            met=bool(np.median(off) < AIMS[region]),
        ),
        Row(
            "people",
            f"share of what was open that {ends} leave open, median",
            "",
            ", ".join(f"{name} {share:.0%}" for name, share in left.items()),
        ),
    ]


def variant_rows(fits: Mapping[str, Fit]) -> list[Row]:
    """What other models of the same median person would leave."""
    rows = []
    for name, fit in fits.items():
        by_region = {
            "UV": (250.0, 400.0),
            "visible": (400.0, 700.0),
            "700 to 1350": (700.0, 1350.0),
            "beyond": (1350.0, 2500.0),
        }
        wavelengths = REGIONS["whole range"]
        parts = []
        for part, (first, last) in by_region.items():
            inside = (wavelengths >= first) & (wavelengths <= last)
            parts.append(f"{part} {np.sqrt(np.mean(fit.residual[inside] ** 2)):.3f}")
        rows.append(
            Row(
                "people",
                f"RMSE of the median person, fitted whole: {name}",
                "",
                f"{fit.rmse:.4f}; {', '.join(parts)}",
            )
        )
    return rows
