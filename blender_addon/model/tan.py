"""A tan as arrays that a shader samples: where the skin stands, and what it looks like there."""

import functools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import hylios
from hylios.errors import InputError
from hylios.skin.biology import Biology
from hylios.sun.doses import Doses
from hylios.table import MinimalDoses, SkinTable, skin_of
from hylios.tanning import MeasuredDynamics
from hylios.threads import one_thread

from . import catalogue, doses
from .basis import DRAG as DRAG_BASIS
from .basis import FULL as FULL_BASIS
from .basis import Basis, basis
from .biology import table_with
from .day_basis import day_basis
from .history import FULL, History, Precision, history
from .look import Look, look
from .peeling import peeling_image
from .response import Response, melanin_of, response_of, tells_skin
from .room import Room
from .settings import Exposure, TanSettings, check_days


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


def tan_of(settings: TanSettings, *, rough: bool = False) -> Tan:
    """What an object's settings lead to.

    Parameters
    ----------
    rough : bool
        As in `look_of`.

    Raises
    ------
    InputError
        If a setting or the table cannot be used.
    """
    return Tan(history_of(settings), look_of(settings, rough=rough))


def look_of(settings: TanSettings, *, rough: bool = False) -> Look:
    """The look of an object's skin; made again only when its table, biology or sensitivity changes.

    Parameters
    ----------
    rough : bool
        Whether it is for a moment only; as in `hylios.changed_table.changed_table`.

    Raises
    ------
    InputError
        If the table cannot be used.
    """
    minimal = settings.minimal_doses(catalogue.provenance(settings.table))
    stamp, kinetics = catalogue.stamp(settings.table), settings.kinetics
    return _look(settings.table, stamp, minimal, settings.biology, kinetics, rough)


@functools.lru_cache(maxsize=16)
def _look(
    path: Path,
    stamp: tuple[int, int],
    minimal: MinimalDoses,
    biology: Biology,
    kinetics: str,
    rough: bool,
) -> Look:
    table = table_with(path, biology, kinetics=kinetics, rough=rough)
    with one_thread():
        return look(table, minimal, kinetics)


def history_of(settings: TanSettings, precision: Precision = FULL) -> History:
    """The history of an object's skin, from day 0 on, as closely as a precision has it.

    Raises
    ------
    InputError
        If a setting or the table cannot be used, or the table was built for a schedule that leads
        elsewhere.
    """
    minimal = settings.minimal_doses(catalogue.provenance(settings.table))
    days = settings.first_day, settings.last_day
    stamp = catalogue.stamp(settings.table)
    how = settings.kinetics, settings.redness, settings.darkening
    return _history(settings.table, stamp, settings.exposures, minimal, days, how, precision)


@functools.lru_cache(maxsize=16)
def _history(
    path: Path,
    stamp: tuple[int, int],
    exposures: tuple[Exposure, ...],
    minimal: MinimalDoses,
    days: tuple[float, float],
    how: tuple[str, bool, bool],
    precision: Precision,
) -> History:
    """The history, kept: what changes only the look needs it again."""
    table = catalogue.table(path)
    received = doses.received(exposures, minimal.mmd, table.provenance)
    return history_within(table, received, minimal, days, precision, response_of(table, *how))


def peeling_of(
    settings: TanSettings, which: Sequence[int] | None = None
) -> NDArray[np.float32] | None:
    """What peels of an object's skin (`peeling_image`); None where nothing does.

    Parameters
    ----------
    which : sequence of int, optional
        Mask of every exposure of the settings, where there are several; the image has one above
        the other then.

    Raises
    ------
    InputError
        If a setting or the table cannot be used.
    """
    if not (settings.peeling and tells_skin(catalogue.table(settings.table))):
        return None
    which = which or [0] * len(settings.exposures)
    told = list(zip(settings.exposures, which, strict=True))
    return np.concatenate(
        [
            _peeling_of(settings, tuple(own for own, mask in told if mask == number))
            for number in range(max(which, default=0) + 1)
        ]
    )


def _peeling_of(settings: TanSettings, exposures: tuple[Exposure, ...]) -> NDArray[np.float32]:
    minimal = settings.minimal_doses(catalogue.provenance(settings.table))
    days = settings.first_day, settings.last_day
    stamp = catalogue.stamp(settings.table)
    return _peeling(settings.table, stamp, exposures, minimal, days, settings.kinetics)


@functools.lru_cache(maxsize=16)
def _peeling(
    path: Path,
    stamp: tuple[int, int],
    exposures: tuple[Exposure, ...],
    minimal: MinimalDoses,
    days: tuple[float, float],
    kinetics: str,
) -> NDArray[np.float32]:
    """The image, kept."""
    del stamp  # of the table's file, so that another one counts
    table = catalogue.table(path)
    return peeling_image(
        doses.received(exposures, minimal.mmd, table.provenance),
        melanin_of(table, kinetics),
        hylios.erythema(skin_of(table.provenance)),
        mmd=minimal.mmd,
        med=minimal.med,
        days=days,
    )


def history_within(
    table: SkinTable,
    received: Doses,
    minimal: MinimalDoses,
    days: tuple[float, float],
    precision: Precision = FULL,
    response: Response | None = None,
) -> History:
    """Simulate a skin's doses from day 0; what a table of the skin holds of it.

    Parameters
    ----------
    received : Doses
        On bare skin.
    days : pair of float
        First and last day to return, within 0 to LAST_DAY_LIMIT. An exposure after the last has
        no effect.
    response : Response, optional
        Of the skin to the doses; by the thesis alone, if not given.

    Raises
    ------
    InputError
        If a day is out of range, or if the table does not say how its skin makes melanin or was
        built for a schedule that leads elsewhere.
    """
    check_days(*days)
    response = response or response_of(table)
    over_time, states = history(
        received,
        response.melanin,
        mmd=minimal.mmd,
        med=minimal.med,
        first_day=days[0],
        last_day=days[1],
        precision=precision,
        erythema=response.erythema,
        darkens=response.darkens,
    )
    _require_held(table, states, response)
    return over_time


def basis_of(settings: TanSettings, which: Sequence[int], *, rough: bool = False) -> Basis:
    """The coordinates over the shares of several masks; made anew only for another history.

    Parameters
    ----------
    which : sequence of int
        Mask of every exposure of the settings.
    rough : bool
        Whether it is for a picture while somebody changes a setting.

    Raises
    ------
    InputError
        As `history_of`, or if there are too many masks.
    """
    stamp = catalogue.stamp(settings.table)
    history_only = replace(settings, biology=Biology())
    made = _basis(history_only, stamp, tuple(which), rough)
    if isinstance(made, InputError):
        raise InputError(str(made))
    return made


@functools.lru_cache(maxsize=8)
def _basis(
    settings: TanSettings, stamp: tuple[int, int], which: tuple[int, ...], rough: bool
) -> Basis | InputError:
    """The basis, or why the table lacks its tans: both take seconds, and are kept."""
    made, states = basis(
        _received_by_masks(settings, which),
        _response(settings).melanin,
        precision=DRAG_BASIS if rough else FULL_BASIS,
        **_how(settings),
    )
    try:
        _require_held(catalogue.table(settings.table), states, _response(settings))
    except InputError as error:
        return error.with_traceback(None)
    return made


def day_basis_of(settings: TanSettings, which: Sequence[int], day: float, room: Room) -> Basis:
    """The coordinates over the shares of several masks, exactly on one day and roughly on others.

    Parameters
    ----------
    which, errors
        As of `basis_of`.
    room : Room
        Of the images that are to show it.
    """
    received = _received_by_masks(settings, which)
    melanin = _response(settings).melanin
    made, states = day_basis(received, melanin, day, room, **_how(settings))
    _require_held(catalogue.table(settings.table), states, _response(settings))
    return made


def _received_by_masks(settings: TanSettings, which: Sequence[int]) -> list[Doses]:
    """Doses on bare skin, by mask."""
    header = catalogue.table(settings.table).provenance
    mmd = settings.minimal_doses(header).mmd
    told = list(zip(settings.exposures, which, strict=True))
    return [
        doses.received([exposure for exposure, own in told if own == mask], mmd, header)
        for mask in range(len(set(which)))
    ]


def _response(settings: TanSettings) -> Response:
    """Of an object's skin to the doses."""
    table = catalogue.table(settings.table)
    return response_of(table, settings.kinetics, settings.redness, settings.darkening)


def _how(settings: TanSettings) -> dict[str, Any]:
    """What both kinds of basis take by name."""
    response = _response(settings)
    minimal = settings.minimal_doses(catalogue.provenance(settings.table))
    return {
        "mmd": minimal.mmd,
        "med": minimal.med,
        "first_day": settings.first_day,
        "last_day": settings.last_day,
        "erythema": response.erythema,
        "darkens": response.darkens,
    }


def _require_held(table: SkinTable, states: NDArray, response: Response) -> None:
    if not table.holds(states).all():
        measured = isinstance(response.melanin, MeasuredDynamics)
        raise InputError(
            f"the table was built for another schedule of sun{' or other kinetics' * measured} and "
            "lacks tans of this one; build it with this schedule (Export for lut-builder) or with "
            f"none{', or set Tan to As in the Thesis' * measured}."
        )


def darkest_day(history: History) -> float:
    """The day on which bare skin has most melanin."""
    melanin = history.coordinates[:, -1, 0]
    row = int(melanin.argmax())
    place = (row + 0.5) / len(melanin)
    places = history.places[0, :, 1]
    step = int(abs(places - place).argmin())
    return history.first_day + (history.last_day - history.first_day) * step / (len(places) - 1)
