"""The doses of a scene, from a file, and the tanning states that they lead through."""

import csv
from pathlib import Path

import numpy as np

from hylios.commands.shell import number
from hylios.errors import InputError, require_range
from hylios.skin import Skin
from hylios.tanning import Exposures, states_at

COLUMNS = ("hour", "melanogenesis_sed", "thickening_sed")
SHARES = 512
"""Of the dose, from none to all, that reach places of a body: as finely as the add-on's images."""

HOURS = 2.0
"""Between two looks at the skin."""

MOST_DAYS = 366.0
"""As in the add-on."""


def read_schedule(path: Path) -> Exposures:
    """Doses from CSV with the columns hour, melanogenesis_sed and thickening_sed.

    `hylios dose` prints such a file, and the add-on exports one. Other columns and lines that start
    with # are ignored.

    Raises
    ------
    InputError
        If the file cannot be read, lacks a column, or has an hour or dose out of range.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise InputError(f"the schedule {path} cannot be read: {error.strerror}.") from error
    except UnicodeDecodeError as error:
        raise InputError(f"the schedule {path} cannot be read: it is not text.") from error
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    missing = [name for name in COLUMNS if name not in (rows.fieldnames or ())]
    if missing:
        raise InputError(
            f"the schedule {path} has no column {missing[0]}; it needs {', '.join(COLUMNS)}."
        )
    found = [[number(row[name] or "", name) for name in COLUMNS] for row in rows]
    return Exposures(*np.array(found).reshape(-1, len(COLUMNS)).T)


def reached_states(skin: Skin, exposures: Exposures, days: float) -> np.ndarray:
    """States (N, 4) of a skin anywhere on a body, from day 0 to a last one.

    Raises
    ------
    InputError
        If the last day is out of range.
    """
    require_range("days of the scene", days, 0.0, MOST_DAYS)
    shares = np.linspace(0.0, 1.0, SHARES)[:, None]
    thickening = exposures.thickening_doses
    states = states_at(
        Exposures(
            exposures.hours,
            shares * exposures.doses,
            None if thickening is None else shares * thickening,
        ),
        skin.dynamics,
        times=np.append(np.arange(0.0, 24.0 * days, HOURS), 24.0 * days),
        mmd=skin.mmd,
        med=skin.med,
    )
    return states.reshape(-1, 4)
