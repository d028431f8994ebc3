"""Short lines in which a panel describes a skin and an exposure.

Panels are drawn many times a second. So whatever takes longer than reading a file's date is kept
from one drawing to the next.
"""

import functools
from pathlib import Path

from hylios.errors import InputError
from hylios.sun.doses import Doses, joined
from hylios.table.provenance import MinimalDoses, minimal_doses
from hylios.tanning import first_blistering_day

from . import catalogue, doses
from .lines import Line
from .settings import Exposure, TanSettings

SED_PER_HOUR_OF_SUMMER_SUN = 7.2
"""Erythemal dose of an hour at UV index 8: 8 x 25 mW/m^2 for an hour is 720 J/m^2."""

LINE = 40
"""Characters that fit into a panel of usual width."""


def of_table(path: Path) -> tuple[str, ...]:
    """Lines on the doses from which the skin of a table tans and burns.

    Raises
    ------
    InputError
        If it is no usable table.
    """
    minimal = minimal_doses(catalogue.provenance(path))
    return (
        Line("Tans from {mmd:.1f} SED of sun,", mmd=minimal.mmd),
        Line("burns from {med:.1f} SED (estimates)", med=minimal.med),
    )


def of_exposure(exposure: Exposure) -> str:
    """An exposure in a few characters."""
    return {
        "SED": Line("{dose:g} SED", dose=exposure.dose),
        "MMD": Line("{multiple:g} tanning doses", multiple=exposure.multiple),
        "UV_INDEX": Line(
            "UV {index:g}, {hours:g} h", index=exposure.uv_index, hours=exposure.duration
        ),
        "SUN": Line("Sun {start:g}-{end:g} h", start=exposure.from_hour, end=exposure.to_hour),
    }.get(exposure.unit, "Unknown unit")


def of_dose(exposure: Exposure, path: Path, own_doses: MinimalDoses | None) -> tuple[str, ...]:
    """Lines on the dose that reaches skin in an exposure.

    Parameters
    ----------
    path : Path
        Of the skin's table.
    own_doses : MinimalDoses or None
        Those set by hand, if any.

    Raises
    ------
    InputError
        If a value is out of range or the table cannot be used.
    """
    result = _of_dose(exposure, path, catalogue.stamp(path), own_doses)
    if isinstance(result, str):
        raise InputError(result)
    return result


@functools.lru_cache(maxsize=256)
def _of_dose(
    exposure: Exposure, path: Path, stamp: tuple[int, int], own_doses: MinimalDoses | None
) -> tuple[str, ...] | str:
    """The lines, or why there are none: an exception would not be remembered."""
    received = _received(exposure, path, stamp, own_doses)
    if isinstance(received, str):
        return received
    meter, tanning = received.erythemal.sum(), received.melanogenesis.sum()
    hours = meter / SED_PER_HOUR_OF_SUMMER_SUN
    if hours < 1.0:
        minutes = 60.0 * hours
        line = Line(
            "{meter:.3g} SED: {minutes:.0f} min of strong sun", meter=meter, minutes=minutes
        )
    else:
        line = Line("{meter:.3g} SED: {hours:.1f} h of strong sun", meter=meter, hours=hours)
    lines = [line]
    if exposure.unit == "SUN":
        lines.append(Line("tans like {tanning:.3g} SED", tanning=tanning))
    return tuple(lines)


def of_blisters(settings: TanSettings) -> tuple[str, ...]:
    """Lines on the first day whose doses blister in life; none where no day's do.

    Raises
    ------
    InputError
        If a setting is out of range or the table cannot be used.
    """
    result = _of_blisters(settings, catalogue.stamp(settings.table))
    if isinstance(result, str):
        raise InputError(result)
    return result


@functools.lru_cache(maxsize=16)
def _of_blisters(settings: TanSettings, stamp: tuple[int, int]) -> tuple[str, ...] | str:
    """The lines, or why there are none, as in `_of_dose`."""
    path = settings.table
    minimal = settings.minimal_doses(catalogue.provenance(path))
    parts = []
    for exposure in settings.exposures:
        received = _received(exposure, path, stamp, settings.own_doses)
        if isinstance(received, str):
            return received
        parts.append(received)
    together = joined(parts)
    day = first_blistering_day(together.hours, together.thickening / minimal.med)
    if day is None:
        return ()
    return (Line("Above 4 burn doses on day {day:.0f}:", day=day), "blisters in life; not shown")


@functools.lru_cache(maxsize=512)  # a year of days, all asked for at a change of one
def _received(
    exposure: Exposure, path: Path, stamp: tuple[int, int], own_doses: MinimalDoses | None
) -> Doses | str:
    """Doses of an exposure, or why there are none: an exception would not be remembered."""
    del stamp  # of the table's file, so that another one counts
    try:
        provenance = catalogue.provenance(path)
        minimal = own_doses or minimal_doses(provenance)
        return doses.of_exposure(exposure, minimal.mmd, provenance)
    except InputError as error:
        return str(error)
