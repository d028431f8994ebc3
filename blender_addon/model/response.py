"""How the skin of a table responds to the sun: its melanin, and its redness."""

from dataclasses import dataclass

import hylios
from hylios.errors import InputError
from hylios.table import LookAxes, SkinTable, melanin_kinetics, skin_of
from hylios.tanning import ErythemaDynamics, Kinetics

BLOOD = 3
"""Which axis of a table is that of the blood."""


@dataclass(frozen=True)
class Response:
    """Dynamics of a skin.

    Attributes
    ----------
    melanin : MelaninDynamics or MeasuredDynamics
    erythema : ErythemaDynamics or None
        None where the skin does not redden.
    darkens : bool
        Whether melanin darkens at once in UVA.
    """

    melanin: Kinetics
    erythema: ErythemaDynamics | None
    darkens: bool = False


def response_of(
    table: SkinTable, kinetics: str = "thesis", redness: bool = False, darkens: bool = False
) -> Response:
    """How a table's skin responds; it reddens only where the table holds blood.

    Raises
    ------
    InputError
        If the table does not say how its skin makes melanin by that kinetics.
    """
    reddens = redness and holds_redness(table)
    erythema = hylios.erythema(skin_of(table.provenance)) if reddens else None
    return Response(melanin_of(table, kinetics), erythema, darkens)


def holds_redness(table: SkinTable) -> bool:
    """Whether a table tells how a skin looks with more blood, and what skin that is."""
    has_blood = isinstance(table.axes, LookAxes) and len(table.axes.knots[BLOOD]) > 1
    return has_blood and tells_skin(table)


def tells_skin(table: SkinTable) -> bool:
    """Whether a table says whose skin it is of, and so how it burns."""
    try:
        skin_of(table.provenance)
    except InputError:
        return False
    return True


def melanin_of(table: SkinTable, kinetics: str) -> Kinetics:
    """How a table's skin makes melanin by one of `hylios.tanning.KINETICS`.

    Raises
    ------
    InputError
        If the table does not say it.
    """
    try:
        return melanin_kinetics(table.provenance, kinetics)
    except InputError as error:
        if kinetics == "thesis":
            raise
        why = str(error).rstrip(".")
        raise InputError(f"{why}; set Tan to As in the Thesis for it.") from error
