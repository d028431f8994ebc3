"""Results that are computed in a thread before they are needed."""

from collections import deque
from collections.abc import Callable
from contextlib import suppress
from threading import Thread
from typing import Any

from hylios.errors import InputError

THREAD = "Skin Tan ahead"
"""Name of the thread."""

REFUSED = 64
"""So many of the last calls without a result are remembered."""


class Ahead:
    """A function that keeps its results, called ahead in a thread, one call after the other.

    Parameters
    ----------
    function : callable
        Of arguments that can be compared. Where it raises InputError it does so again when called.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function = function
        self._thread: Thread | None = None
        self._arguments: tuple[Any, ...] | None = None
        self._result: Any = None
        self._refused: deque[tuple[Any, ...]] = deque(maxlen=REFUSED)

    def is_at_hand(self, *arguments: Any) -> bool:
        """Whether the last call was with these arguments, and is done; else it begins soon.

        So is a call that was refused, though others came later.
        """
        if self.is_refused(*arguments):
            return True
        if self._thread is not None and self._thread.is_alive():
            return False
        if arguments == self._arguments:
            return True
        self._arguments = arguments
        self._thread = Thread(target=self._call, args=arguments, name=THREAD, daemon=True)
        self._thread.start()
        return False

    def taken(self, first: object) -> tuple[tuple[Any, ...], Any] | None:
        """Arguments and result of the last call, once it is done, if its first argument was this.

        It is forgotten then. A call that was refused gives None.
        """
        is_busy = self._thread is None or self._thread.is_alive()
        if is_busy or self._arguments is None or self._arguments[0] != first:
            return None
        taken, self._arguments = (self._arguments, self._result), None
        return taken

    def is_refused(self, *arguments: Any) -> bool:
        """Whether a call with these arguments has lately had no result, so that none begins again.

        Else two callers, one of them refused, would take turns for ever.
        """
        return arguments in tuple(self._refused)  # the thread may add to it meanwhile

    def _call(self, *arguments: Any) -> None:
        self._result = None
        try:
            with suppress(InputError):
                self._result = self.function(*arguments)
        finally:
            if self._result is None:
                self._refused.append(arguments)
