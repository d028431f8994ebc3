"""The report: what the thesis prints beside this project's results, a row for every statement."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from examples.figures.light import Curve, farthest
from hylios.files import written_beside


@dataclass(frozen=True)
class Row:
    """One number or statement of the thesis and ours, as text.

    Attributes
    ----------
    where : str
        Figure or table.
    what : str
    printed, ours : str
    noise : str
        Standard error of ours, or the number of rays.
    aim : str
        What is wanted of ours; empty where nothing is.
    met : bool or None
        Whether it is; None without an aim.
    """

    where: str
    what: str
    printed: str
    ours: str
    noise: str = "none"
    aim: str = ""
    met: bool | None = None


def relative(where: str, what: str, printed: float, ours: float, share: float | None = None) -> Row:
    """A row for a printed number, with the aim to come within a share of it where one is given."""
    off = ours / printed - 1.0
    return Row(
        where,
        what,
        f"{printed:g}",
        f"{ours:.4f} ({off:+.0%})",
        aim="" if share is None else f"within {share:.0%}",
        met=None if share is None else abs(off) <= share,
    )


def with_noise(where: str, what: str, printed: float, ours: float, noisy: float, rays: int) -> Row:
    """A row for a printed number, ours without noise and with that of so many rays."""
    return Row(
        where,
        what,
        f"{printed:g}",
        f"{ours:.4f} ({ours / printed - 1.0:+.0%}); with noise {noisy:.4f} "
        f"({noisy / printed - 1.0:+.0%})",
        f"that of {rays:,} rays",
    )


def claim(where: str, what: str, printed: str, ours: str, met: bool) -> Row:
    """A row for something that the thesis says, without noise."""
    return Row(where, what, printed, ours, aim="as printed", met=bool(met))  # numpy's is no bool


def agreement(where: str, name: str, exact: Curve, walked: Curve) -> Row:
    """A row for the random walk beside a curve without noise."""
    apart = farthest(exact, walked)
    return Row(
        where,
        f"{name}: random walk from curve without noise, largest of {walked.wavelengths.size}",
        "",
        f"{apart:.1f} standard errors",
        f"{walked.rays:,} rays, standard error up to {walked.standard_error.max():.4f}",
    )


def markdown(rows: Sequence[Row]) -> str:
    """All rows as a table."""
    lines = [
        "| figure | what | thesis | ours | noise | aim | met |",
        "|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        met = {None: "", True: "yes", False: "**no**"}[row.met]
        cells = (row.where, row.what, row.printed, row.ours, row.noise, row.aim, met)
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def write(path: Path, rows: Sequence[Row], heading: str) -> None:
    """Write the report, under its name only once it is whole."""
    with written_beside(path) as beside:
        beside.write_text(f"{heading}\n\n{markdown(rows)}", encoding="utf-8")
