"""How skin responds to the sun, as an artist chooses it: kinetics and redness.

Tans of versions that had no choice keep what they show, the thesis's kinetics without redness,
until somebody chooses. So what is chosen is kept beside the properties, and Apply keeps what it
shows; what nobody has chosen or applied goes by whether the object has a tan.
"""

from typing import Any

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
    kept = settings.kinetics_kept
    return kept if kept != NOT_KEPT else NAMES.index("THESIS" if _is_former(settings) else NAMES[0])


def redness_of(settings: Any) -> bool:
    """Whether skin reddens."""
    kept = settings.redness_kept
    return bool(kept) if kept != NOT_KEPT else not _is_former(settings)


def keep_kinetics(settings: Any, number: int) -> None:
    settings.kinetics_kept = number


def keep_redness(settings: Any, is_on: bool) -> None:
    settings.redness_kept = int(is_on)


def _is_former(settings: Any) -> bool:
    """Whether an object without a choice has a tan, so that it is from before there was one."""
    return has_tan(settings.id_data)
