"""Export of an object's sun, for a table that holds only what it leads to."""

from pathlib import Path

import bpy

from hylios.files import require_target, written_beside
from hylios.sun.doses import Doses
from hylios.table import read_table

from . import doses, tables
from .apply import check_object, minimal_doses
from .tan import check_days

HEAD = """\
# sun of {name}, for a table of what it leads to alone; with the same skin:
# lut-builder build --schedule FILE --days {days:g} --mmd {mmd!r} --med {med!r} -o TABLE.exr
# skin: {skin}
# MMD in SED: {mmd!r}
# MED in SED: {med!r}
# days: {days:g}
hour,melanogenesis_sed,thickening_sed
"""


def export_schedule(obj: bpy.types.Object | None, filepath: str) -> str:
    """Write an object's doses as CSV, and return a sentence on what was done.

    Raises
    ------
    InputError
        If the object cannot carry a tan, a setting or the table cannot be used, or the file cannot
        be written.
    """
    check_object(obj)
    path = Path(bpy.path.abspath(filepath))
    require_target(path, (".csv",), replacing=True)
    settings = obj.skin_tan
    check_days(settings.first_day, settings.last_day)
    provenance = read_table(tables.table_path(settings.skin, settings.table_path)).provenance
    minimal = minimal_doses(settings, provenance)
    received = doses.received(settings.exposures, minimal.mmd, provenance)
    received.exposures()  # refuses what the tanning model would
    head = HEAD.format(
        name=_line(obj.name),
        skin=_line(provenance.get("specimen", "of the table")),
        days=settings.last_day,
        mmd=minimal.mmd,
        med=minimal.med,
    )
    with written_beside(path) as beside:
        beside.write_text(head + _rows(received), encoding="utf-8")
    return f"Wrote {path}."


def _rows(received: Doses) -> str:
    columns = received.hours, received.melanogenesis, received.thickening
    return "".join(
        f"{int(hour)},{float(melanogenesis)!r},{float(thickening)!r}\n"
        for hour, melanogenesis, thickening in zip(*columns, strict=True)
    )


def _line(text: str) -> str:
    return " ".join(str(text).split())
