"""An object's doses as CSV, from which lut-builder makes a smaller table for this scene only."""

from hylios.history import schedule_text

from . import catalogue, doses
from .settings import TanSettings


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
    return schedule_text(
        received.exposures(),
        scene=name,
        skin=str(provenance.get("specimen", "of the table")),
        days=settings.last_day,
        mmd=minimal.mmd,
        med=minimal.med,
    )
