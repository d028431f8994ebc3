"""Standard streams as commands need them, even where a shell has closed or changed them."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from hylios.errors import InputError

SHORT = 2.0
"""Seconds of work that needs no bar."""


def prepare_streams() -> None:
    """Make standard streams safe to use; call it before a command runs.

    Where a shell closed one (`2>&-`), what is opened next would get its number, and Python would
    print to standard output what is meant for standard error. A name that a stream cannot encode
    is escaped.

    Raises
    ------
    InputError
        If standard output is closed: there is nowhere to print to.
    """
    for number in (0, 1, 2):
        _occupy(number)
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]
    if not isinstance(sys.stderr, _Forgiving):
        sys.stderr = _Forgiving(sys.stderr)
    if sys.stdout is None:
        sys.stdout = open(os.devnull, "w", encoding="utf-8")
        raise InputError("standard output is closed; there is nowhere to print to.")


class _Forgiving:
    """Standard error where what cannot be written, as on a full disk, is lost and stops nothing."""

    def __init__(self, stream):
        self._stream = stream

    def __getattr__(self, name: str):
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        try:
            return self._stream.write(text)
        except OSError:
            return len(text)

    def flush(self) -> None:
        try:
            self._stream.flush()
        except OSError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), self._stream.fileno())


@contextmanager
def progress(what: str, total: int | None, unit: str) -> Iterator[Callable[[int], object]]:
    """A bar on standard error for work that takes longer than `SHORT` seconds.

    Parameters
    ----------
    total : int or None
        Of its steps; None where that is not known.
    unit : str
        What is counted.

    Returns
    -------
    function of int
        To be told how many steps more are done.
    """
    from tqdm import tqdm  # the start of every command would wait for it

    seconds = 0.5 if sys.stderr.isatty() else 10.0  # in a log each is a line
    with tqdm(total=total, desc=what, unit=unit, delay=SHORT, mininterval=seconds) as bar:
        yield bar.update


def discard_output() -> None:
    """Keep the interpreter from failing once more on output that has nowhere to go."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _occupy(number: int) -> None:
    """Open a descriptor that is closed; those below it are open, so it is the next."""
    try:
        os.fstat(number)
    except OSError:
        os.open(os.devnull, os.O_RDWR)
