"""How skin responds to the sun, as an artist chooses it: kinetics and redness.

Tans of versions that had no choice keep what they show, the thesis's kinetics without redness,
until somebody chooses. So what is chosen is kept beside the properties, and Apply keeps what it
shows; what nobody has chosen or applied goes by whether the object has a tan.
"""

from typing import Any

from bpy.props import IntProperty

from ..scene.slots import has_tan

KINETICS = (
    (
        "MEASURED",
        "As Measured in People",
        "It comes over days and goes over months, as measured in people; between what was "
        "measured it is an estimate",
    ),
    (
        "THESIS",
        "As in the Thesis",
        "It comes and goes as in the doctoral thesis that the light model is from: a sudden tan "
        "that has gone after some weeks",
    ),
)
"""The first is that of a new tan."""

NAMES = tuple(name for name, *_ in KINETICS)
NOT_KEPT = -1


def kinetics_of(settings: Any) -> int:
    """Number of the kinetics that count."""
    return _told(settings, settings.kinetics_kept, of_new=0, of_former=NAMES.index("THESIS"))


def redness_of(settings: Any) -> bool:
    """Whether skin reddens."""
    return bool(_told(settings, settings.redness_kept, of_new=1, of_former=0))


def keep_kinetics(settings: Any, number: int) -> None:
    settings.kinetics_kept = number


def keep_redness(settings: Any, is_on: bool) -> None:
    settings.redness_kept = int(is_on)


def kept_property(name: str, most: int) -> Any:
    """Declare what is kept of a choice: its number, up to the largest."""
    return IntProperty(
        name=name,
        description="Number of what was chosen or applied",
        default=NOT_KEPT,
        min=NOT_KEPT,
        max=most,
        options={"HIDDEN"},
    )


def _told(settings: Any, kept: int, *, of_new: int, of_former: int) -> int:
    """What is kept; without, a tan that is there is from before there was a choice."""
    if kept != NOT_KEPT:
        return kept
    return of_former if has_tan(settings.id_data) else of_new
