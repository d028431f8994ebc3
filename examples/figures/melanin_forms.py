"""Figures 5.3 and C.1 to C.5: melanin in melanosomes or colloidal, basal or dispersed."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from examples.figures.drawing import COLOURS, bars, plot, points, reflectance_axes, sheet
from examples.figures.light import Curve, Effort, Task, noise_free, walked
from examples.figures.report import Row, agreement, claim
from hylios.lab.pictures import write_figure
from hylios.skin.specimen import EPIDERMIS, SPECIMENS, Specimen, with_values

FIGURES = ("5.3", "C.1", "C.2", "C.3", "C.4", "C.5")

ANGLE = 10.0
"""Angle of incidence in degrees (C.1)."""

WAVELENGTHS = np.arange(250.0, 1401.0, 5.0)
CHECKED = np.arange(250.0, 1401.0, 50.0)
"""Wavelengths in nm at which rays walk too."""

MELANOSOMES = {
    "S3": {"baseline": (0.0, 0.0, 3.0), "dispersion": (1.0, 1.0, 1.0)},
    "S4": {"baseline": (0.0, 0.0, 30.0), "dispersion": (10.0, 10.0, 10.0)},
}
"""Percent of granulosum, spinosum and basale in each case (C.1)."""

REGIONS = {
    "UV": (250.0, 400.0),
    "Visible": (400.0, 700.0),
    "NIR": (700.0, 1400.0),
    "VNIR": (400.0, 1400.0),
}
"""Regions of figures C.2 and C.4 in nm, both ends included."""

CONSIDERED = (600.0, 900.0)
"""nm where the thesis describes the differences."""


OTHER_READINGS = {"melanosome_entry": "refracted", "melanosome_scattering": "exponential"}
"""Readings of section 4.2.1 with which all that appendix C says comes out."""


def specimen(name: str, case: str, colloidal: bool = False) -> Specimen:
    """S3 or S4 with its melanosomes as in a case, or all their melanin colloidal instead."""
    start = SPECIMENS[name]
    values = {}
    for layer, percent in zip(EPIDERMIS, MELANOSOMES[name][case], strict=True):
        already = getattr(start, f"{layer}_colloidal_melanin")
        values[f"{layer}_melanosomes"] = 0.0 if colloidal else percent
        values[f"{layer}_colloidal_melanin"] = already + (percent if colloidal else 0.0)
    return with_values(start, values)


def shown() -> dict[str, Specimen]:
    """All eight specimens: S3 and S4, basal and dispersed, and the colloidal one of each."""
    return {
        f"{name} {case}{' colloidal' if colloidal else ''}": specimen(name, case, colloidal)
        for name in MELANOSOMES
        for case in MELANOSOMES[name]
        for colloidal in (False, True)
    }


def tasks(effort: Effort) -> dict[str, Task]:
    """Each curve without noise, some of it by random walk, and with other readings."""
    work = {}
    for name, skin in shown().items():
        work[name] = noise_free(skin, WAVELENGTHS, ANGLE)
        work[f"{name} walked"] = walked(skin, CHECKED, ANGLE, effort)
        work[f"{name} other"] = noise_free(skin, WAVELENGTHS, ANGLE, OTHER_READINGS)
    return work


def draw(results: Mapping[str, Curve], folder: Path) -> list[Row]:
    """Draw all figures and compare what the thesis says of them."""
    draw_distributions(results, folder / "5.3.png")
    draw_cases(results, "baseline", "C.1", folder)
    draw_errors(results, "baseline", "C.2", folder)
    draw_cases(results, "dispersion", "C.3", folder)
    draw_errors(results, "dispersion", "C.4", folder)
    draw_variation(results, folder / "C.5.png")
    other = {name: results[f"{name} other"] for name in shown()}
    return [
        *distribution_rows(results),
        *case_rows(results),
        *case_rows(other, "; melanosomes entered refracted, scattering exponential"),
        *check_rows(results),
    ]


def draw_distributions(results: Mapping[str, Curve], path: Path) -> None:
    """Figure 5.3: what is where in S4, and the visible reflectance."""
    figure, axes = sheet(12.0, 4.4, columns=2)
    bottom, labels = 0, []
    for case, word in (("dispersion", "dispersed"), ("baseline", "basal")):
        skin = specimen("S4", case)
        for layer, short in zip(reversed(EPIDERMIS), ("sb", "ss", "sg"), strict=True):
            held = getattr(skin, f"{layer}_colloidal_melanin")
            inside = getattr(skin, f"{layer}_melanosomes")
            axes[0, 0].barh(bottom, held, color="#d9a066")
            axes[0, 0].barh(bottom, inside, left=held, color="#5b3a1e")
            labels.append(f"{word} {short}")
            bottom += 1
    axes[0, 0].set_yticks(range(bottom), labels)
    axes[0, 0].set(xlabel="melanin content (%)", title="colloidal (light), melanosomes (dark)")
    visible = (400.0, 700.0)
    curves = {"basal": results["S4 baseline"], "dispersed": results["S4 dispersion"]}
    plot(axes[0, 1], curves, visible)
    points(axes[0, 1], [results[f"S4 {case} walked"] for case in MELANOSOMES["S4"]], visible)
    reflectance_axes(axes[0, 1], *visible, "same melanin content, incidence 10 degrees")
    axes[0, 1].legend()
    figure.suptitle("5.3  Melanin distributions in darkly pigmented skin (S4)")
    write_figure(figure, path)


def draw_cases(results: Mapping[str, Curve], case: str, number: str, folder: Path) -> None:
    """Figures C.1 and C.3: a case against its colloidal one, S3 and S4."""
    figure, axes = sheet(12.0, 4.4, columns=2)
    domain = (WAVELENGTHS[0], WAVELENGTHS[-1])
    for panel, name in zip(axes.flat, MELANOSOMES, strict=True):
        test, reference = f"{name} {case}", f"{name} {case} colloidal"
        plot(panel, {case: results[test], "colloidal": results[reference]}, domain)
        points(panel, [results[f"{test} walked"], results[f"{reference} walked"]], domain)
        panel.axvspan(*CONSIDERED, color="grey", alpha=0.12)
        reflectance_axes(panel, *domain, f"{name} (grey: 600 to 900 nm)")
        panel.legend()
    figure.suptitle(f"{number}  {case.capitalize()} and colloidal case, incidence 10 degrees")
    write_figure(figure, folder / f"{number}.png")


def draw_errors(results: Mapping[str, Curve], case: str, number: str, folder: Path) -> None:
    """Figures C.2 and C.4: RMSE (C.1) by region."""
    figure, axes = sheet(6.5, 4.0)
    series = {
        name: [rmse(results, name, case, region) for region in REGIONS] for name in MELANOSOMES
    }
    bars(axes[0, 0], list(REGIONS), series, "RMSE")
    axes[0, 0].set_title(f"{number}  {case.capitalize()} case against colloidal case")
    write_figure(figure, folder / f"{number}.png")


def draw_variation(results: Mapping[str, Curve], path: Path) -> None:
    """Figure C.5: what lies between basal and dispersed melanosomes in S4."""
    figure, axes = sheet(8.0, 4.4)
    panel, domain = axes[0, 0], (WAVELENGTHS[0], WAVELENGTHS[-1])
    basal, dispersed = results["S4 baseline"], results["S4 dispersion"]
    panel.vlines(
        WAVELENGTHS,
        dispersed.reflectance,
        basal.reflectance,
        color=COLOURS[1],
        lw=2.0,
        label="from dispersed to basal melanosomes",
    )
    plot(panel, {"colloidal, as dispersed": results["S4 dispersion colloidal"]}, domain)
    panel.plot(
        WAVELENGTHS,
        results["S4 baseline colloidal"].reflectance,
        color="grey",
        ls=":",
        label="colloidal, as basal",
    )
    reflectance_axes(panel, *domain, "C.5  Melanosomes' place in S4, incidence 10 degrees")
    panel.legend()
    write_figure(figure, path)


def rmse(results: Mapping[str, Curve], name: str, case: str, region: str) -> float:
    """RMSE (C.1) of a case with respect to its colloidal one."""
    test = results[f"{name} {case}"].within(*REGIONS[region])
    reference = results[f"{name} {case} colloidal"].within(*REGIONS[region])
    return float(np.sqrt(np.mean((test - reference) ** 2)))


def distribution_rows(results: Mapping[str, Curve]) -> list[Row]:
    """Figures 5.3 and C.5: dispersed melanosomes darken."""
    basal, dispersed = results["S4 baseline"], results["S4 dispersion"]
    change = dispersed.within(400.0, 700.0) - basal.within(400.0, 700.0)
    moved = float(np.mean(dispersed.reflectance - basal.reflectance))
    apart = float(
        np.mean(
            results["S4 dispersion colloidal"].reflectance
            - results["S4 baseline colloidal"].reflectance
        )
    )
    return [
        claim(
            "5.3",
            "dispersed minus basal, S4, mean of 400 to 700 nm",
            "darker when dispersed",
            f"{change.mean():+.4f} (from {change.min():+.4f} to {change.max():+.4f})",
            bool(change.mean() < 0.0),
        ),
        claim(
            "C.5",
            "dispersed minus basal, S4, mean of 250 to 1400 nm; the same melanin all colloidal",
            "darker; colloidal melanin does not show it",
            f"{moved:+.4f}; colloidal {apart:+.4f}",
            moved < 0.0 and abs(apart) < 0.1 * abs(moved),
        ),
    ]


def case_rows(results: Mapping[str, Curve], readings: str = "") -> list[Row]:
    """Figures C.1 to C.4: signs from 600 to 900 nm, and who is moved more where."""
    rows = []
    for number, case in (("C.1", "baseline"), ("C.3", "dispersion")):
        for name in MELANOSOMES:
            printed = "lower" if (name, case) == ("S4", "dispersion") else "higher"
            change = difference(results, name, case)
            rows.append(
                claim(
                    number,
                    f"{name} {case} minus colloidal, mean of 600 to 900 nm{readings}",
                    "slightly lower" if printed == "lower" else printed,
                    f"{change:+.4f}",
                    (change < 0.0) == (printed == "lower"),
                )
            )
    for number, case, larger in (
        ("C.2", "baseline", {"Visible": "S3", "NIR": "S4"}),
        ("C.4", "dispersion", {"UV": "S3", "Visible": "S3", "NIR": "S3", "VNIR": "S3"}),
    ):
        for region, name in larger.items():
            errors = {skin: rmse(results, skin, case, region) for skin in MELANOSOMES}
            rows.append(
                claim(
                    number,
                    f"larger RMSE in {region}{readings}",
                    name,
                    ", ".join(f"{skin} {value:.4f}" for skin, value in errors.items()),
                    max(errors, key=lambda skin: errors[skin]) == name,
                )
            )
    return rows


def difference(results: Mapping[str, Curve], name: str, case: str) -> float:
    """Mean difference of a case from its colloidal one where the thesis describes it."""
    test, reference = results[f"{name} {case}"], results[f"{name} {case} colloidal"]
    return float(np.mean(test.within(*CONSIDERED) - reference.within(*CONSIDERED)))


def check_rows(results: Mapping[str, Curve]) -> list[Row]:
    """How far the random walk is from the curves without noise."""
    return [agreement("C", name, results[name], results[f"{name} walked"]) for name in shown()]
