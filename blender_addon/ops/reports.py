"""What an operator tells the artist in the end."""

from collections.abc import Callable
from typing import Any

from hylios.errors import InputError


def finished(operator: Any, act: Callable[[], str]) -> set[str]:
    """Report the sentence that a call returns, or why it refuses; what Blender is told."""
    try:
        said = act()
    except InputError as error:
        operator.report({"ERROR"}, str(error))
        return {"CANCELLED"}
    operator.report({"INFO"}, said)
    return {"FINISHED"}
