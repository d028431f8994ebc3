"""Writes docs/simplifications.md from the measurements."""

import datetime
import platform
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from examples.simplifications import text
from examples.simplifications.edge import DARKEST_DAY, JUST_VISIBLE, Edge
from examples.simplifications.measures import RAYS, Row
from examples.simplifications.skins import DAYS, DOSE
from hylios.burley import burley_width
from hylios.lab import colour
from hylios.quadrature import Quadrature
from hylios.skin.specimen import SPECIMENS
from hylios.transport.simulate import DISTANCE_EDGES, Spectrum
from lut_builder.settings import BANDS_NM


@dataclass(frozen=True)
class Findings:
    """Everything that the document reports.

    Attributes
    ----------
    wavelengths, gauss, rays, model : lists of Row
    choices : list of (str, Quadrature)
        Those of `wavelengths`, the full model's first.
    lines : list of Edge
        Of S1 to S4.
    profiles : list of Spectrum
        Of S1 to S4 at `EVEN`.
    walked : float
        CIEDE2000 between the two solvers on S1 to S4.
    chance : float
        What that would be if only chance made it.
    solver : float
        Time of the solver without noise relative to a walk with `RAYS` rays per wavelength.
    bands : (3,) array
        Time of a ray at `BANDS_NM`, relative to the visible.
    render : float, optional
        Time of rendering with subsurface relative to that without.
    """

    wavelengths: Sequence[Row]
    gauss: Sequence[Row]
    rays: Sequence[Row]
    model: Sequence[Row]
    choices: Sequence[tuple[str, Quadrature]]
    lines: Sequence[Edge]
    profiles: Sequence[Spectrum]
    walked: float
    chance: float
    solver: float
    bands: np.ndarray
    render: float | None


def markdown(findings: Findings, today: datetime.date, seconds: float) -> str:
    """The document as Markdown; `seconds` of processor time were spent on it."""
    parts = [
        text.INTRODUCTION.format(dose=DOSE, days=_listed([f"{day}" for day in DAYS])),
        "## The table",
        rows_table([*findings.wavelengths, *findings.gauss, *findings.rays, *findings.model]),
        text.HEADS.format(rays=RAYS),
        text.HOW.format(
            date=today.isoformat(),
            minutes=seconds / 60.0,
            machine=f"{platform.machine()}, Python {platform.python_version()}",
            rays=findings.profiles[0].rays,
            walked=findings.walked,
            chance=findings.chance,
            solver=1.0 / findings.solver,
            rays_full=RAYS,
        ),
        "## Which wavelengths",
        text.CHOOSING,
        "### Width of the profile",
        text.WIDTHS.format(rays=findings.profiles[0].rays, signed=_moved_widths(findings)),
        widths_table(findings),
        "## A tan line without a profile",
        text.LINES.format(day=DARKEST_DAY, visible=JUST_VISIBLE),
        lines_table(findings.lines),
        _renders(findings.render),
        "## Ultraviolet and infrared",
        _bands(findings.bands),
        "## What a scene needs",
        text.NEEDS,
    ]
    return "\n\n".join(_wrapped(part.strip()) for part in parts) + "\n"


def _wrapped(part: str) -> str:
    """Text with its paragraphs broken anew, as numbers have been put in; no tables, no lists."""
    return "\n\n".join(
        paragraph
        if paragraph.startswith(("|", "#", "- "))
        else textwrap.fill(" ".join(paragraph.split()), 100)
        for paragraph in part.split("\n\n")
    )


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table, the first column to the left, the others to the right."""
    lines = [heads, ["---", *["---:"] * (len(heads) - 1)], *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def rows_table(rows: Sequence[Row]) -> str:
    """Rows as a Markdown table."""
    heads = ("", "S1 to S4", "tans", "noise", "walk", "same noise", "solver")
    return _table(
        heads,
        [
            [
                row.what,
                _cost(row.specimens),
                _cost(row.tans),
                _number(row.noise),
                _number(row.walk),
                _number(row.walk_same_noise),
                _number(row.solver),
            ]
            for row in rows
        ],
    )


def _cost(differences: np.ndarray) -> str:
    """Mean and largest CIEDE2000."""
    return f"{_number(differences.mean())}, {_number(differences.max())}"


def _number(value: float | None) -> str:
    """Two significant digits, at most three places."""
    if value is None:
        return ""
    return (
        "0" if value < 0.0005 else f"{value:.{min(max(1 - int(np.floor(np.log10(value))), 0), 3)}f}"
    )


def profile_widths(light: Spectrum, choice: Quadrature, *, signed: bool) -> np.ndarray:
    """Burley's d in mm of the red, green and blue channel (3,) from some of the wavelengths.

    With `signed`, wavelengths that lower a channel take their light away from its profile, where
    that leaves any; else they are left out.
    """
    weights = choice.weights if signed else np.maximum(choice.weights, 0.0)
    exits = weights @ light.exit_counts[np.searchsorted(light.wavelengths, choice.wavelengths)]
    return np.array([burley_width(DISTANCE_EDGES, row) for row in np.maximum(exits, 0.0)])


def widths_table(findings: Findings) -> str:
    """How far widths from fewer wavelengths are from those of all, mean over S1 to S4."""
    (_, full), *others = findings.choices
    rows = []
    for what, choice in others:
        row = [what]
        for signed in (True, False):
            missed = [
                profile_widths(spectrum, choice, signed=signed)
                / profile_widths(spectrum, full, signed=signed)
                - 1.0
                for spectrum in findings.profiles
            ]
            row += [f"{100.0 * mean:.1f} %" for mean in np.abs(missed).mean(axis=0)]
        rows.append(row)
    channels = ("red", "green", "blue")
    return _table(("", *channels, *(f"{channel}, above 0 only" for channel in channels)), rows)


def lines_table(lines: Sequence[Edge]) -> str:
    """One row for each of S1 to S4."""
    rows = [
        [
            name,
            _number(float(colour.difference(line.sharp[0], line.sharp[-1]))),
            _number(line.mean_within(1.0)),
            _number(line.mean_within(3.0)),
            f"{line.visible_to:.1f} mm",
        ]
        for name, line in zip(SPECIMENS, lines, strict=True)
    ]
    return _table(("", "tan", "within 1 mm", "within 3 mm", "visible to"), rows)


def _moved_widths(findings: Findings) -> str:
    """How leaving out negative weights moves each channel's width, in words."""
    (_, full), *_ = findings.choices
    ratios = [
        profile_widths(spectrum, full, signed=False) / profile_widths(spectrum, full, signed=True)
        for spectrum in findings.profiles
    ]
    moved = 100.0 * (np.mean(ratios, axis=0) - 1.0)
    names = ("red", "green", "blue")
    return _listed([f"{part:+.0f} % in {name}" for part, name in zip(moved, names, strict=True)])


def _renders(ratio: float | None) -> str:
    return text.RENDERS_UNKNOWN if ratio is None else text.RENDERS.format(render=_number(ratio))


def _bands(ratios: np.ndarray) -> str:
    parts = [
        f"{_number(float(ratio))} at {band:g} nm"
        for ratio, band in zip(ratios, BANDS_NM, strict=True)
    ]
    saved = 100.0 * ratios.sum() / (ratios.sum() + 8.0)
    return text.BANDS.format(bands=_listed(parts), saved=saved)


def _listed(parts: Sequence[str]) -> str:
    return f"{', '.join(parts[:-1])} and {parts[-1]}"
