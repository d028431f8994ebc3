"""An object's doses as CSV, for a table that holds only what they lead to."""

import numpy as np

from . import catalogue, doses
from .settings import TanSettings

HEAD = """\
# sun of {name}, for a table of what it leads to alone; with the same skin:
# lut-builder build --schedule FILE --days {days:g} --mmd {mmd!r} --med {med!r} -o TABLE.exr
# skin: {skin}
# MMD in SED: {mmd!r}
# MED in SED: {med!r}
# days: {days:g}
hour,melanogenesis_sed,thickening_sed
"""


def csv_text(name: str, settings: TanSettings) -> str:
    """The text of the file.

    Parameters
    ----------
    name : str
        Of the object.

    Raises
    ------
    InputError
        If a setting or the table cannot be used.
    """
    provenance = catalogue.provenance(settings.table)
    minimal = settings.minimal_doses(provenance)
    received = doses.received(settings.exposures, minimal.mmd, provenance)
    received.exposures()  # refuses what the tanning model would
    head = HEAD.format(
        name=_line(name),
        skin=_line(provenance.get("specimen", "of the table")),
        days=settings.last_day,
        mmd=minimal.mmd,
        med=minimal.med,
    )
    return head + "".join(map(_row, received.hours, received.melanogenesis, received.thickening))


def _row(hour: np.floating, melanogenesis: np.floating, thickening: np.floating) -> str:
    return f"{int(hour)},{float(melanogenesis)!r},{float(thickening)!r}\n"


def _line(text: object) -> str:
    """A text as one line of what a file can hold."""
    printable = (character if character.isprintable() else " " for character in str(text))
    return " ".join("".join(printable).split())
