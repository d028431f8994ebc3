"""A tan by day and by share of the dose, as arrays that a shader samples."""

from dataclasses import dataclass

import numpy as np

from hylios.errors import InputError
from hylios.history import history_of_shares
from hylios.sun.doses import Doses
from hylios.table import SkinTable, melanin_dynamics

from . import catalogue, doses
from .settings import TanSettings, check_days

HOURS_PER_ROW = 6.0
ROWS_LIMIT = 1024

COLOUR, WIDTH = "subsurface_colour", "profile_width"


@dataclass(frozen=True)
class Tan:
    """Appearance of skin over time and over the share of the dose that reached it.

    Attributes
    ----------
    colour : (rows, columns, 3) float32 array
        Linear Rec.709 albedo of the light that has been inside the skin.
    profile_width : (rows, columns, 3) float32 array or None
        Width d in mm of Burley's diffusion profile in red, green and blue, if the table has it.
    first_day, last_day : float
        Times of the first and last row; the rows between are evenly spaced. Columns are evenly
        spaced over shares from 0 to 1.
    """

    colour: np.ndarray
    profile_width: np.ndarray | None
    first_day: float
    last_day: float


def tan_of(settings: TanSettings) -> Tan:
    """What an object's settings lead to.

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
    )


def tan(
    table: SkinTable,
    received: Doses,
    *,
    mmd: float,
    med: float,
    first_day: float,
    last_day: float,
) -> Tan:
    """Simulate a skin's doses from day 0 and look its appearance up.

    Parameters
    ----------
    received : Doses
        On bare skin.
    mmd, med : float
        Minimal melanogenesis and erythema dose in SED.
    first_day, last_day : float
        Range of days to return, within 0 to LAST_DAY_LIMIT. An exposure after the last has no
        effect.

    Raises
    ------
    InputError
        If a day is out of range, or if the table does not say how its skin makes melanin, has no
        colour for a shader, or was built for a schedule that leads elsewhere.
    """
    _check_planes(table)
    check_days(first_day, last_day)
    rows = min(ROWS_LIMIT, int(np.ceil(24.0 * (last_day - first_day) / HOURS_PER_ROW)) + 1)
    states = history_of_shares(
        received.exposures(),
        melanin_dynamics(table.provenance),
        hours=24.0 * np.linspace(first_day, last_day, rows),
        mmd=mmd,
        med=med,
    ).image
    if not table.holds(states).all():
        raise InputError(
            "the table was built for another schedule of sun and lacks tans of this one; build it "
            "with this schedule (Export Schedule) or with none."
        )
    planes = [name for name in (COLOUR, WIDTH) if name in table.planes]
    appearance = table.lookup(states, planes)
    width = appearance.get(WIDTH)
    return Tan(
        colour=appearance[COLOUR].astype(np.float32),
        profile_width=None if width is None else width.astype(np.float32),
        first_day=first_day,
        last_day=last_day,
    )


def _check_planes(table: SkinTable) -> None:
    if COLOUR not in table.planes:
        raise InputError(
            f"the table has no plane {COLOUR}, which the skin's material needs; it has "
            f"{', '.join(table.planes)}."
        )
