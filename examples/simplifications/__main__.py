"""Measures what each simplification costs and buys: `make simplifications`.

Writes docs/simplifications.md; minutes of work.
"""

import argparse
import datetime
import sys
import time
from pathlib import Path

import numpy as np
from tqdm import tqdm

from examples.simplifications import measures, report, variants
from examples.simplifications.edge import Edge, tan_line
from examples.simplifications.light import stacks, walk_seconds
from examples.simplifications.measures import Case, Effort, Row
from examples.simplifications.quadrature import gauss
from hylios.commands.shell import run
from hylios.files import written_beside
from hylios.quadrature import skin_quadrature
from hylios.skin.specimen import SPECIMENS
from hylios.transport.simulate import Spectrum, spectrum
from lut_builder.settings import BANDS_NM

DOCUMENT = Path("docs/simplifications.md")

CHOICES = [
    *(
        (f"{measures.EVEN[::step].size} wavelengths, every {5 * step} nm", measures.even(step))
        for step in (1, 2, 4, 5, 10)
    ),
    *(
        (f"{count} wavelengths, chosen", skin_quadrature(count))
        for count in (16, 12, 8, 7, 6, 5, 4)
    ),
]

GAUSS = [(f"{count} wavelengths, Gauss", gauss(count)) for count in (16, 8)]

CASES = [
    Case("melanosomes as plain absorber", variants.plain_absorber),
    Case("no Rayleigh scattering", variants.no_rayleigh),
    Case("one epidermis", variants.one_epidermis),
    Case("three epidermal layers, melanin spread evenly", variants.spread_evenly),
    Case("no dysfunctional haemoglobins, no carotene", variants.no_rare_pigments),
    Case("all of these in one epidermis", variants.all_of_it),
    Case("light at 0 instead of 8 degrees", variants.whole, angle=0.0),
]

RAY_COUNTS = (10_000, 1_000)

LINE_RAYS, PROFILE_RAYS = 20_000, 30_000
"""Per wavelength: for a tan line, and for the widths of profiles."""

LINE_WAVELENGTHS = 8


def measure(_: argparse.Namespace) -> None:
    """Measure and write the document."""
    started, worked = time.monotonic(), time.process_time()
    effort = Effort()
    steps = 2 * effort.rounds + len(CASES) + 2 * len(SPECIMENS) + 3
    with tqdm(total=steps, desc="simplifications", file=sys.stderr) as bar:

        def told() -> None:
            bar.update()

        walk_seconds(stacks([SPECIMENS["S3"]], measures.COARSE[:1], variants.whole), 1)  # compiles
        truth = measures.truth()
        told()
        wavelengths = measures.wavelength_rows(truth, CHOICES, effort, told)
        profiles = profiles_of_specimens(told)
        findings = report.Findings(
            wavelengths=wavelengths,
            gauss=measures.gauss_rows(truth, GAUSS),
            rays=measures.ray_rows(truth, RAY_COUNTS),
            model=[
                *measures.variant_rows(truth, CASES, effort, told),
                Row("no profile, away from edges", *no_difference(truth), None, None, None, 1.0),
            ],
            choices=CHOICES,
            lines=tan_lines(told),
            profiles=profiles,
            walked=measures.walked_difference(
                truth, np.array([profile.total for profile in profiles])
            ),
            chance=float(measures.ray_rows(truth, [PROFILE_RAYS])[0].specimens.mean()),
            solver=measures.solver_over_walk(effort),
            bands=bands(effort),
            render=render(),
        )
        bar.update(steps - bar.n)
    text = report.markdown(findings, datetime.date.today(), time.process_time() - worked)
    DOCUMENT.parent.mkdir(exist_ok=True)
    with written_beside(DOCUMENT) as beside:
        beside.write_text(text, encoding="utf-8")
    print(f"wrote {DOCUMENT} in {time.monotonic() - started:.0f} s")


def no_difference(truth: measures.Truth) -> tuple[np.ndarray, np.ndarray]:
    """What costs nothing, as two fields of a `Row`."""
    return truth.differences(truth.colours)


def tan_lines(told: measures.Progress) -> list[Edge]:
    """A tan line on each of S1 to S4."""
    lines = []
    for specimen in SPECIMENS.values():
        lines.append(tan_line(specimen, skin_quadrature(LINE_WAVELENGTHS), LINE_RAYS))
        told()
    return lines


def profiles_of_specimens(told: measures.Progress) -> list[Spectrum]:
    """S1 to S4 walked at the full model's wavelengths, with exit distances."""
    spectra = []
    for specimen in SPECIMENS.values():
        spectra.append(spectrum(specimen, measures.EVEN, rays=PROFILE_RAYS))
        told()
    return spectra


def bands(effort: Effort) -> np.ndarray:
    """Time of a ray at each of the tables' bands, relative to the mean over the visible."""
    skins = list(SPECIMENS.values())
    wavelengths = np.concatenate([measures.COARSE, BANDS_NM])
    layers = stacks(skins, wavelengths, variants.whole)
    rounds = [walk_seconds(layers, effort.rays) for _ in range(effort.rounds)]
    times = np.min(rounds, axis=0).reshape(len(skins), -1)
    visible = times[:, : measures.COARSE.size].mean(axis=1, keepdims=True)
    return (times[:, measures.COARSE.size :] / visible).mean(axis=0)


def render() -> float | None:
    """Relative time of rendering with subsurface; None where Blender is not installed."""
    try:
        from examples.simplifications.render import time_with_subsurface
    except ImportError:
        return None
    return time_with_subsurface()


if __name__ == "__main__":
    sys.exit(
        run(
            measure,
            argparse.ArgumentParser(
                "python -m examples.simplifications", description=__doc__
            ).parse_args(),
        )
    )
