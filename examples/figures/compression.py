"""Figures D.1 to D.9 and table D.1: 144 spectra compressed by their principal components."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from examples.figures.drawing import COLOURS, plot, reflectance_axes, sheet, swatch
from examples.figures.light import RANGE, THESIS_RAYS, Curve, Effort, Task, noise_free, noisy
from examples.figures.principal_components import METHODS, PIECES, errors, pieces, reconstructed
from examples.figures.report import Row, claim, with_noise
from examples.figures.specimen_database import database, subsets
from hylios.lab.colour import difference
from hylios.lab.colour import swatch as visible_colour
from hylios.lab.pictures import write_figure

FIGURES = (*(f"D.{number}" for number in range(1, 10)), "table D.1")

ANGLE = 10.0

COMPONENTS = (1, 2, 3, 4, 8)
PRINTED = {
    "melanotic": (0.0504, 0.0099, 0.0058, 0.0037, 0.0014),
    "amelanotic": (0.0337, 0.0172, 0.0099, 0.0030, 0.0012),
    "all": (0.0738, 0.0245, 0.0171, 0.0069, 0.0023),
}
"""Table D.1: maximum RMSE for each number of components."""

LOW_ERROR = 0.01
"""RMSE that the thesis calls low."""

NOISY_RAYS = (1_000, 10_000, THESIS_RAYS, 1_000_000, 10_000_000, 100_000_000)
NOISE_SHARE = 0.1
"""What noise may add to a maximum RMSE and not be what is measured."""


@dataclass(frozen=True)
class Case:
    """A specimen that the thesis shows, where it shows it, and the RMSE of regions it prints."""

    subset: str
    components: int
    whole: str
    pieces: str
    printed_whole: tuple[float, float, float]
    printed_pieces: tuple[float, float, float]


CASES = (
    Case("melanotic", 2, "D.2", "D.6", (0.0117, 0.0118, 0.0109), (0.0024, 0.0058, 0.0024)),
    Case("amelanotic", 3, "D.4", "D.7", (0.0209, 0.0172, 0.0140), (0.0018, 0.0026, 0.0013)),
    Case("all", 4, "D.5", "D.8", (0.0127, 0.0105, 0.0087), (0.0038, 0.0031, 0.0010)),
)


SWATCHES = (
    ("D.3", CASES[0], (("PCA", 1), ("PCA", 2))),
    ("D.9", CASES[2], (("PCA", 4), ("PPCA", 4))),
)
"""Figures of swatches: of which case, and by which methods and numbers of components."""


def tasks(effort: Effort) -> dict[str, Task]:
    """A curve without noise for each specimen."""
    return {name: noise_free(skin, RANGE, ANGLE) for name, skin in database().items()}


def largest(spectra: np.ndarray, method: str) -> dict[str, list[float]]:
    """Maximum RMSE for each number of components, by subset."""
    return {
        name: [float(errors(part, METHODS[method](part, count)).max()) for count in COMPONENTS]
        for name, part in subsets(spectra).items()
    }


def draw(results: Mapping[str, Curve], folder: Path) -> list[Row]:
    """Draw all figures and compare."""
    spectra = np.array([results[name].reflectance for name in database()])
    printed_noise = noisy(spectra, THESIS_RAYS, seed=1)
    draw_database(spectra, folder / "D.1.png")
    rows = []
    for case in CASES:
        for method, number, printed in (
            ("PCA", case.whole, case.printed_whole),
            ("PPCA", case.pieces, case.printed_pieces),
        ):
            errors_of_pieces = draw_case(spectra, case, method, number, printed, folder)
            as_noisy = piece_errors(printed_noise, case, method, worst(spectra, case)[1])
            rows += [
                with_noise(
                    number,
                    f"{method}, {case.components} components, RMSE in {name}",
                    *numbers,
                    THESIS_RAYS,
                )
                for name, *numbers in zip(PIECES, printed, errors_of_pieces, as_noisy, strict=True)
            ]
    for number, case, ways in SWATCHES:
        rows.append(draw_swatches(spectra, number, case, ways, folder))
    noise = noise_levels(spectra)
    draw_table(spectra, printed_noise, noise, folder / "table D.1.png")
    return [*table_rows(spectra, printed_noise), *rows, *noise_rows(spectra, noise)]


def draw_database(spectra: np.ndarray, path: Path) -> None:
    """Figure D.1: all spectra."""
    figure, axes = sheet(8.5, 4.8)
    for colour, (name, part) in zip(COLOURS, list(subsets(spectra).items())[:2], strict=False):
        lines = axes[0, 0].plot(RANGE, part.T, color=colour, lw=0.5, alpha=0.6)
        lines[0].set_label(f"{len(part)} {name}")
    reflectance_axes(axes[0, 0], RANGE[0], RANGE[-1], "D.1  144 specimens, incidence 10 degrees")
    axes[0, 0].legend()
    write_figure(figure, path)


def worst(spectra: np.ndarray, case: Case) -> tuple[np.ndarray, int, int]:
    """A case's subset, its row that PCA reproduces worst, and that specimen's number."""
    part = subsets(spectra)[case.subset]
    row = int(np.argmax(errors(part, reconstructed(part, case.components))))
    before = len(spectra) - len(part) if case.subset == "amelanotic" else 0
    return part, row, before + row + 1


def draw_case(
    spectra: np.ndarray,
    case: Case,
    method: str,
    number: str,
    printed: tuple[float, float, float],
    folder: Path,
) -> list[float]:
    """One of figures D.2, D.4 to D.8: a spectrum, its reconstruction and their difference.

    Returns the RMSE of each region.
    """
    part, row, specimen = worst(spectra, case)
    rebuilt = METHODS[method](part, case.components)[row]
    errors_of_pieces = piece_errors(spectra, case, method, row)
    figure, axes = sheet(8.5, 4.6)
    panel = axes[0, 0]
    panel.errorbar(
        RANGE[::4],
        part[row][::4],
        10.0 * np.abs(part[row] - rebuilt)[::4],
        fmt="none",
        ecolor="#0072b2",
        elinewidth=0.8,
        label="10 x difference",
    )
    curves = {"modelled": part[row], f"{method}, {case.components} components": rebuilt}
    plot(panel, {name: exact(values) for name, values in curves.items()}, (RANGE[0], RANGE[-1]))
    for _, last in list(PIECES.values())[:2]:
        panel.axvline(last, color="grey", lw=0.6, ls=":")
    regions = "; ".join(
        f"{name} {ours:.4f} (thesis {theirs:.4f})"
        for name, ours, theirs in zip(PIECES, errors_of_pieces, printed, strict=True)
    )
    reflectance_axes(
        panel,
        RANGE[0],
        RANGE[-1],
        f"{number}  Worst of {case.subset}, N{specimen}\nRMSE {regions}",
    )
    panel.title.set_fontsize(9)
    panel.legend()
    write_figure(figure, folder / f"{number}.png")
    return errors_of_pieces


def piece_errors(spectra: np.ndarray, case: Case, method: str, row: int) -> list[float]:
    """RMSE in each region of a row of a case's subset."""
    part = subsets(spectra)[case.subset]
    off = part[row] - METHODS[method](part, case.components)[row]
    return [float(np.sqrt(np.mean(off[piece] ** 2))) for piece in pieces()]


def exact(reflectance: np.ndarray) -> Curve:
    """A curve over the whole range without noise."""
    return Curve(RANGE, reflectance, np.zeros(RANGE.size), 0)


def draw_swatches(
    spectra: np.ndarray,
    number: str,
    case: Case,
    ways: tuple[tuple[str, int], tuple[str, int]],
    folder: Path,
) -> Row:
    """Figures D.3 and D.9: reconstructions and the original, in UV, visible and IR.

    Returns how far the visible swatches are from the original's.
    """
    part, row, specimen = worst(spectra, case)
    shown = {
        f"{method}, {count}": exact(METHODS[method](part, count)[row]) for method, count in ways
    }
    shown["modelled"] = exact(part[row])
    figure, axes = sheet(6.0, 5.6, columns=3, rows=3)
    for line, (name, curve) in zip(axes, shown.items(), strict=True):
        for place, domain in zip(line, ("UV", "visible", "IR"), strict=True):
            swatch(place, curve, domain, f"{domain}: {name}")
    figure.suptitle(f"{number}  Worst of {case.subset}, N{specimen}; UV and IR in pseudo colour")
    write_figure(figure, folder / f"{number}.png")
    first, second, original = (
        visible_colour(curve.wavelengths, curve.reflectance, "visible") for curve in shown.values()
    )
    apart = [float(difference(rebuilt, original)) for rebuilt in (first, second)]
    names = " and ".join(list(shown)[:2])
    return claim(
        number,
        f"CIEDE2000 of the visible swatches of {names} from the modelled",
        "the second is closer",
        f"{apart[0]:.2f}, {apart[1]:.2f}",
        apart[1] < apart[0],
    )


def noise_levels(spectra: np.ndarray) -> dict[str, list[float]]:
    """Maximum RMSE at 8 components with so many rays, by subset."""
    largest_errors: dict[str, list[float]] = {name: [] for name in PRINTED}
    for rays in NOISY_RAYS:
        for name, values in largest(noisy(spectra, rays, seed=rays), "PCA").items():
            largest_errors[name].append(values[-1])
    return largest_errors


def draw_table(
    spectra: np.ndarray, printed_noise: np.ndarray, noise: Mapping[str, list[float]], path: Path
) -> None:
    """Table D.1 as a picture: maximum RMSE by components, and at 8 by rays."""
    figure, axes = sheet(12.0, 4.8, columns=2)
    ways = {method: largest(spectra, method) for method in METHODS}
    as_noisy = largest(printed_noise, "PCA")
    left, right = axes[0]
    for colour, name in zip(COLOURS, PRINTED, strict=False):
        left.plot(COMPONENTS, PRINTED[name], "o", mfc="none", color=colour, label=f"{name}, thesis")
        left.plot(COMPONENTS, ways["PCA"][name], "-", color=colour, label=f"{name}, PCA")
        left.plot(COMPONENTS, as_noisy[name], "x", color=colour, label=f"{name}, PCA with noise")
        left.plot(COMPONENTS, ways["PPCA"][name], ":", color=colour, label=f"{name}, PPCA")
        right.plot(NOISY_RAYS, noise[name], "-x", color=colour, label=name)
        right.axhline(ways["PCA"][name][-1], color=colour, ls="--", lw=0.7)
        right.plot(THESIS_RAYS, PRINTED[name][-1], "o", mfc="none", color=colour)
    left.axhline(LOW_ERROR, color="grey", lw=0.6)
    left.set(
        yscale="log",
        xlabel="components",
        ylabel="maximum RMSE",
        title=f"noise: that of {THESIS_RAYS:,} rays",
    )
    right.set(
        xscale="log",
        yscale="log",
        xlabel="rays per wavelength",
        ylabel="maximum RMSE",
        title="8 components, with noise (dashed: without; circles: thesis)",
    )
    for panel in (left, right):
        panel.grid(alpha=0.25)
        panel.legend(fontsize=7)
    figure.suptitle("Table D.1")
    write_figure(figure, path)


def table_rows(spectra: np.ndarray, printed_noise: np.ndarray) -> list[Row]:
    """Table D.1 and what the text says of it."""
    whole, apart = largest(spectra, "PCA"), largest(spectra, "PPCA")
    as_noisy = largest(printed_noise, "PCA")
    rows = [
        with_noise("table D.1", f"{name}, {count} components, maximum RMSE", *numbers, THESIS_RAYS)
        for name, printed in PRINTED.items()
        for count, *numbers in zip(COMPONENTS, printed, whole[name], as_noisy[name], strict=True)
    ]
    for name, printed in PRINTED.items():
        enough = needed(printed)
        rows.append(
            claim(
                "table D.1",
                f"{name}: components for a maximum RMSE below {LOW_ERROR:g}",
                f"{enough}",
                f"{needed(whole[name]) or 'more than 8'}",
                needed(whole[name]) == enough,
            )
        )
        pairs = list(zip(whole[name], apart[name], strict=True))
        rows.append(
            claim(
                "D.6 to D.8",
                f"{name}: maximum RMSE of PPCA at {', '.join(map(str, COMPONENTS))} components",
                "below that of PCA",
                ", ".join(f"{second:.4f}" for _, second in pairs),
                all(second < first for first, second in pairs),
            )
        )
    return rows


def needed(values: list[float] | tuple[float, ...]) -> int | None:
    """The first number of components whose maximum RMSE is low; None if none is."""
    return next((n for n, value in zip(COMPONENTS, values, strict=True) if value < LOW_ERROR), None)


def noise_rows(spectra: np.ndarray, noise: Mapping[str, list[float]]) -> list[Row]:
    """How many rays it takes for the noise not to be what is measured at 8 components."""
    without = {name: values[-1] for name, values in largest(spectra, "PCA").items()}
    rows = []
    for name, values in noise.items():
        enough = [
            rays
            for rays, value in zip(NOISY_RAYS, values, strict=True)
            if value < (1.0 + NOISE_SHARE) * without[name]
        ]
        by_rays = ", ".join(
            f"{value:.5f} ({rays:.0e})" for rays, value in zip(NOISY_RAYS, values, strict=True)
        )
        needed = f"{enough[0]:.0e} rays" if enough else f"more than {NOISY_RAYS[-1]:.0e} rays"
        rows.append(
            Row(
                "table D.1",
                f"{name}, 8 components: rays for noise to add less than {NOISE_SHARE:.0%}",
                "",
                f"{needed}: without noise {without[name]:.5f}; with {by_rays}",
                "drawn, one ray returns or not",
            )
        )
    return rows
