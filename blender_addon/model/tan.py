"""A tan as arrays that a shader samples: where the skin stands, and what it looks like there."""

from dataclasses import dataclass

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


def tan_of(settings: TanSettings, precision: Precision = FULL) -> Tan:
    """What an object's settings lead to, as closely as a precision has it.

    Raises
    ------
    InputError
        If a setting or the table cannot be used.
    """
    table = catalogue.table(settings.table)
    minimal = settings.minimal_doses(table.provenance)
    return tan(
        table,
        doses.received(settings.exposures, minimal.mmd, table.provenance),
        mmd=minimal.mmd,
        med=minimal.med,
        first_day=settings.first_day,
        last_day=settings.last_day,
        precision=precision,
    )


def tan(
    table: SkinTable,
    received: Doses,
    *,
    mmd: float,
    med: float,
    first_day: float,
    last_day: float,
    precision: Precision = FULL,
) -> Tan:
    """Simulate a skin's doses from day 0, and flatten its table along the states of its kinetics.

    Parameters
    ----------
    received : Doses
        On bare skin.
    mmd, med : float
        Minimal melanogenesis and erythema dose in SED.
    first_day, last_day : float
        Range of days to return, within 0 to LAST_DAY_LIMIT. An exposure after the last has no
        effect.
    precision : Precision
        How closely to simulate.

    Raises
    ------
    InputError
        If a day is out of range, or if the table does not say how its skin makes melanin, has no
        colour for a shader, or was built for a schedule that leads elsewhere.
    """
    check_days(first_day, last_day)
    skin = look(table, MinimalDoses(mmd=mmd, med=med))
    over_time, states = history(
        received,
        melanin_dynamics(table.provenance),
        mmd=mmd,
        med=med,
        first_day=first_day,
        last_day=last_day,
        precision=precision,
    )
    if not table.holds(states).all():
        raise InputError(
            "the table was built for another schedule of sun and lacks tans of this one; build it "
            "with this schedule (Export Schedule) or with none."
        )
    return Tan(over_time, skin)


def darkest_day(history: History) -> float:
    """The day on which bare skin has most melanin."""
    melanin = history.coordinates[:, -1, 0]
    row = int(melanin.argmax())
    place = (row + 0.5) / len(melanin)
    places = history.places[0, :, 1]
    step = int(abs(places - place).argmin())
    return history.first_day + (history.last_day - history.first_day) * step / (len(places) - 1)
