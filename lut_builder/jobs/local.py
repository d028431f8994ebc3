"""Running units on this machine: in threads of this process, or in processes of their own."""

import os
import signal
import threading
from collections.abc import Generator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from typing import Protocol

from hylios.errors import InputError
from lut_builder.jobs.interrupts import interrupts_held
from lut_builder.jobs.run import Runner
from lut_builder.jobs.units import Unit, perform


class Pipe(Protocol):
    """The reading end of a pipe, on any system."""

    def poll(self, timeout: float | None) -> bool:
        """Wait until something can be read, or the writing end is closed."""
        ...


def in_threads(count: int) -> Runner:
    """Runner of up to so many threads of this process, which spares the start of others.

    They share the interpreter, and a kernel that is running delays Ctrl-C to its end: for work
    of seconds.
    """

    def run(units: Sequence[Unit], software: str) -> Generator[tuple[Unit, bytes], None, None]:
        pool = ThreadPoolExecutor(count)
        try:
            yield from _as_they_end(pool, units, software)
        finally:
            pool.shutdown(cancel_futures=True)

    return run


def in_processes(count: int) -> Runner:
    """Runner of up to so many processes of this machine.

    Its exceptions are those of the units; InputError if a process is ended from outside.
    """

    def run(units: Sequence[Unit], software: str) -> Generator[tuple[Unit, bytes], None, None]:
        context = get_context("spawn")
        # This process alone holds the writing end. Closed, by us or by our end, it ends the others:
        # a pool cannot end what its processes are at (before Python 3.14), nor does it when it is
        # killed itself.
        reader, writer = context.Pipe(duplex=False)
        pool = ProcessPoolExecutor(
            min(count, len(units)), context, initializer=_prepare, initargs=(reader,)
        )
        try:
            yield from _as_they_end(pool, units, software)
            pool.shutdown()
        except BrokenProcessPool as error:
            raise InputError(
                "a process at work was ended from outside; was there too little memory for as many?"
            ) from error
        finally:
            writer.close()
            pool.shutdown(cancel_futures=True)
            reader.close()

    return run


def _as_they_end(
    pool: Executor, units: Sequence[Unit], software: str
) -> Generator[tuple[Unit, bytes], None, None]:
    with interrupts_held():
        unit_of = {pool.submit(perform, unit, software): unit for unit in units}
    broken = None
    for future in as_completed(list(unit_of)):
        unit = unit_of.pop(future)
        try:
            content = future.result()
        except BrokenProcessPool as error:
            broken = error  # others may have ended before it broke
        else:
            yield unit, content
    if broken:
        raise broken


def _prepare(reader: Pipe) -> None:
    """What a process does before its first unit."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, args=(reader,), daemon=True).start()


def _end_with_parent(reader: Pipe) -> None:
    """Wait until the writing end of a pipe is closed, and end this process then."""
    reader.poll(None)
    os._exit(1)
