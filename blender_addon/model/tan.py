"""A tan as arrays that a shader samples: where the skin stands, and what it looks like there."""

import functools
from dataclasses import dataclass
from pathlib import Path

from hylios.errors import InputError
from hylios.sun.doses import Doses
from hylios.table import MinimalDoses, SkinTable, melanin_dynamics

from . import catalogue, doses
from .history import FULL, History, Precision, history
from .look import Look, look
from .settings import TanSettings, check_days


@dataclass(frozen=True, eq=False)
class Tan:
    """History and look of an object's skin.

    Attributes
    ----------
    history : History
        Over time and over the share of the dose; knows no optics.
    look : Look
        Over the states of the skin; knows no time.
    """

    history: History
    look: Look


def tan_of(settings: TanSettings) -> Tan:
    """What an object's settings lead to.

    Raises
    ------
    InputError
        If a setting or the table cannot be used.
    """
    return Tan(history_of(settings), look_of(settings))


def look_of(settings: TanSettings) -> Look:
    """The look of an object's skin; made again only when its table or its sensitivity changes.

    Raises
    ------
    InputError
        If the table cannot be used.
    """
    minimal = settings.minimal_doses(catalogue.provenance(settings.table))
    return _look(settings.table, catalogue.stamp(settings.table), minimal)


@functools.lru_cache(maxsize=8)
def _look(path: Path, stamp: tuple[int, int], minimal: MinimalDoses) -> Look:
    return look(catalogue.table(path), minimal)


def history_of(settings: TanSettings, precision: Precision = FULL) -> History:
    """The history of an object's skin, from day 0 on, as closely as a precision has it.

    Raises
    ------
    InputError
        If a setting or the table cannot be used, or the table was built for a schedule that leads
        elsewhere.
    """
    table = catalogue.table(settings.table)
    minimal = settings.minimal_doses(table.provenance)
    return history_within(
        table,
        doses.received(settings.exposures, minimal.mmd, table.provenance),
        minimal,
        (settings.first_day, settings.last_day),
        precision,
    )


def history_within(
    table: SkinTable,
    received: Doses,
    minimal: MinimalDoses,
    days: tuple[float, float],
    precision: Precision = FULL,
) -> History:
    """Simulate a skin's doses from day 0; what a table of the skin holds of it.

    Parameters
    ----------
    received : Doses
        On bare skin.
    days : pair of float
        First and last day to return, within 0 to LAST_DAY_LIMIT. An exposure after the last has
        no effect.

    Raises
    ------
    InputError
        If a day is out of range, or if the table does not say how its skin makes melanin or was
        built for a schedule that leads elsewhere.
    """
    check_days(*days)
    over_time, states = history(
        received,
        melanin_dynamics(table.provenance),
        mmd=minimal.mmd,
        med=minimal.med,
        first_day=days[0],
        last_day=days[1],
        precision=precision,
    )
    if not table.holds(states).all():
        raise InputError(
            "the table was built for another schedule of sun and lacks tans of this one; build it "
            "with this schedule (Export Schedule) or with none."
        )
    return over_time


def darkest_day(history: History) -> float:
    """The day on which bare skin has most melanin."""
    melanin = history.coordinates[:, -1, 0]
    row = int(melanin.argmax())
    place = (row + 0.5) / len(melanin)
    places = history.places[0, :, 1]
    step = int(abs(places - place).argmin())
    return history.first_day + (history.last_day - history.first_day) * step / (len(places) - 1)
