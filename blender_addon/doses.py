"""Doses of ultraviolet from the exposures that an artist sets, by the hour of the tanning model."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from datetime import date

import numpy as np

from hylios.errors import InputError, require_range
from hylios.sun.action_spectra import Absorptance
from hylios.sun.doses import Doses, joined, of_sed, of_sun, of_uv_index
from hylios.sun.protection import BARE, sunscreen

LAST_DAY_LIMIT = 366.0
ANY_YEAR = 2025  # the sun stands nearly alike in all


def received(exposures: Iterable, mmd: float, provenance: Mapping) -> Doses:
    """Doses on bare skin of all exposures, `SkinTanExposure` or the like.

    Parameters
    ----------
    mmd : float
        Minimal melanogenesis dose of the skin in SED.
    provenance : mapping
        Of the skin's table; only exposures to the sun need it.

    Raises
    ------
    InputError
        If an exposure has a value out of range or a day that no month has, or is to the sun and
        the table does not know what the skin absorbs.
    """
    return joined([of_exposure(each, mmd, provenance) for each in exposures])


def of_exposure(exposure, mmd: float, provenance: Mapping) -> Doses:
    """Doses of one exposure; parameters and errors as in `received`."""
    over = sunscreen(exposure.spf, exposure.sunscreen_amount) if exposure.sunscreen else BARE
    hour = begin(exposure)
    if exposure.unit == "MMD":
        return of_sed(hour, exposure.multiple * mmd, over)
    if exposure.unit == "UV_INDEX":
        return of_uv_index(hour, exposure.uv_index, exposure.duration, over)
    if exposure.unit == "SUN":
        from_midnight = of_sun(
            _date(exposure.month, exposure.day_of_month),
            exposure.from_hour,
            exposure.to_hour,
            exposure.latitude,
            absorptance(provenance),
            protection=over,
        )
        return replace(from_midnight, hours=from_midnight.hours + 24.0 * np.floor(exposure.day))
    return of_sed(hour, exposure.dose, over)


def begin(exposure) -> int:
    """The hour of the tanning model in which an exposure begins.

    Raises
    ------
    InputError
        If its day is out of range.
    """
    require_range("day of an exposure", exposure.day, 0.0, LAST_DAY_LIMIT)
    if exposure.unit == "SUN":
        return 24 * int(exposure.day) + int(exposure.from_hour)
    return int(np.floor(24.0 * exposure.day + 0.5))


def absorptance(provenance: Mapping) -> Absorptance:
    """What the skin of a table absorbs in the ultraviolet.

    Raises
    ------
    InputError
        If the table does not say it.
    """
    try:
        told = provenance["absorptance"]
        return Absorptance(np.array(told["wavelengths_nm"]), np.array(told["values"]))
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(
            "the table does not say what its skin absorbs in the ultraviolet, as sun by date needs "
            "it; give that exposure in SED, or build the table anew."
        ) from error


def _date(month: int, day: int) -> date:
    try:
        return date(ANY_YEAR, month, day)
    except ValueError as error:
        raise InputError(
            f"day of the month is {day}, which month {month} lacks; allowed is a date."
        ) from error
