"""Tanning states of a scene, by shares of its doses and by days; and the scene's schedule file.

A place on a body receives a share of the scene's doses, from none under cloth to all on bare skin.
The add-on makes images of these histories, and the builder a table of the states that they reach.
Both use the same shares and days, so the table holds what the add-on looks up. No Blender; numpy
only.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from hylios.errors import InputError, require_range
from hylios.readers.quantities import Quantity
from hylios.readers.table import read_table
from hylios.tanning import (
    LARGEST_DOSE,
    LONGEST_HOURS,
    ErythemaDynamics,
    Exposures,
    Kinetics,
    states_at,
)

SHARES = 512
"""Shares of the dose, from none to all. The response jumps where the dose passes the MMD and then
climbs in steps; with so many a jump is spread over 0.2 % of the share, and 99 % of all places are
within 0.6 % of the melanin."""

LAST_DAY_LIMIT = 366.0
"""The last day that a scene may have."""

COLUMNS = ("hour", "melanogenesis_sed", "thickening_sed")
"""Columns of a schedule file."""

HEAD = """\
# sun of {scene}, for a table of what it leads to alone; with the same skin:
# lut-builder build --schedule FILE --days {days:g} --mmd {mmd!r} --med {med!r} -o TABLE.exr
# skin: {skin}
# MMD in SED: {mmd!r}
# MED in SED: {med!r}
# days: {days:g}
"""


@dataclass(frozen=True, eq=False)
class ShareHistory:
    """Tanning states over the share of the dose and over time.

    Attributes
    ----------
    shares : (S,) array
        0 to 1.
    hours : (T,) array
    states : (S, T, 4) array, or (S, T, 5) with erythema
        Melanin of basale, spinosum, granulosum relative to the total without sun, thickness
        relative to that without sun, and blood relative to the skin's own.
    """

    shares: np.ndarray
    hours: np.ndarray
    states: np.ndarray

    @property
    def image(self) -> np.ndarray:
        """The states as an image with a row for each hour and a column for each share (T, S, .)."""
        return np.moveaxis(self.states, 1, 0)


def history_of_shares(
    exposures: Exposures,
    melanin: Kinetics,
    *,
    hours: ArrayLike,
    mmd: float,
    med: float,
    shares: ArrayLike | None = None,
    erythema: ErythemaDynamics | None = None,
) -> ShareHistory:
    """Tanning states after all shares of some doses.

    Parameters
    ----------
    exposures : Exposures
        With doses (E,), as they fall on bare skin.
    melanin, mmd, med, erythema
        Of the skin, as in `hylios.tanning.states_at`.
    hours : (T,) array
        Times to tell the states of, 0 to a century.
    shares : (S,) array, optional
        0 to 1; `SHARES` of them in equal steps by default.

    Raises
    ------
    InputError
        If a minimal dose or a time is out of range.
    """
    parts = np.linspace(0.0, 1.0, SHARES) if shares is None else np.asarray(shares, dtype=float)
    times = np.asarray(hours, dtype=float)
    received = Exposures(
        exposures.hours,
        parts[:, None] * exposures.doses,
        parts[:, None] * exposures.thickening_doses,
    )
    states = states_at(received, melanin, times=times, mmd=mmd, med=med, erythema=erythema)
    return ShareHistory(parts, times, states)


def require_last_day(days: float) -> float:
    """The last day of a scene, if it is 0 to `LAST_DAY_LIMIT`.

    Raises
    ------
    InputError
        If it is not.
    """
    return require_range("days of the scene", days, 0.0, LAST_DAY_LIMIT)


def read_schedule(path: Path) -> Exposures:
    """Doses of a scene from a table with the columns hour, melanogenesis_sed, thickening_sed.

    `hylios dose` prints such a file, and the add-on exports one (`schedule_text`). Other columns
    and lines that start with # are passed over; the path `-` is standard input.

    Raises
    ------
    InputError
        If the file cannot be read (`hylios.readers.table.read_table`), or has an hour or dose out
        of range.
    """
    table = read_table(path, [Quantity(name) for name in COLUMNS])
    hours = table.require_range("hour", 0.0, LONGEST_HOURS)
    parts = np.flatnonzero(hours != np.floor(hours))
    if parts.size:
        line, hour = table.lines[parts[0]], hours[parts[0]]
        raise InputError(
            f"{table.name} has an hour of {hour:g} in line {line}; allowed are whole hours."
        )
    for name in COLUMNS[1:]:
        table.require_range(name, 0.0, LARGEST_DOSE)
    return Exposures(*(table.numbers[name] for name in COLUMNS))


def schedule_text(
    exposures: Exposures, *, scene: str, skin: str, days: float, mmd: float, med: float
) -> str:
    """The text of a schedule file, which `read_schedule` reads to the last bit.

    Parameters
    ----------
    exposures : Exposures
        With doses (E,) on bare skin.
    scene, skin : str
        What the exposures belong to, for people to read; what cannot be printed is left out.
    days : float
        Last day of the scene.
    mmd, med : float
        Minimal melanogenesis and erythema dose of the skin in SED.

    Raises
    ------
    InputError
        If the last day is out of range.
    """
    days = require_last_day(days)
    head = HEAD.format(scene=_line(scene), skin=_line(skin), days=days, mmd=mmd, med=med)
    columns = exposures.hours, exposures.doses, exposures.thickening_doses
    rows = (
        f"{int(hour)},{float(melanogenesis)!r},{float(thickening)!r}"
        for hour, melanogenesis, thickening in zip(*columns, strict=True)
    )
    return head + "\n".join([",".join(COLUMNS), *rows]) + "\n"


def _line(text: str) -> str:
    """A text as one line of what a file can hold."""
    printable = (character if character.isprintable() else " " for character in text)
    return " ".join("".join(printable).split())
