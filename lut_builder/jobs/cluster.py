"""Running units on the machines of a Dask cluster.

Only a unit's results come back, as bytes; keeping them is the caller's, as with local processes.
The workers need this project and its libraries in the same versions, or their results would not
be the same bytes: each has to give the digest of its software. The scheduler needs Dask alone.

Dask trusts whoever it talks to: this process unpickles what the scheduler sends, and the workers
whatever comes to them. Give the address of none but a scheduler of your own, in a network of your
own or with TLS.
"""

import logging
import pickle
import re
import socket
import warnings
from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager
from queue import Empty, Queue
from threading import Thread
from urllib.parse import urlsplit

from hylios.errors import InputError
from lut_builder.jobs.run import Runner
from lut_builder.jobs.software import software_digest
from lut_builder.jobs.units import Unit, perform

PATIENCE = 10.0
"""How long to wait for the scheduler's answer and for a first worker, in seconds."""


def on_cluster(address: str) -> Runner:
    """Runner of the units on a Dask cluster; those of a worker that is lost are done again.

    When all workers are lost it waits for others to come. Ctrl-C takes the units back; one that a
    worker is at goes on to its end there.

    Parameters
    ----------
    address : str
        Of the scheduler, such as tcp://127.0.0.1:8786.

    Returns
    -------
    Runner
        It raises InputError if the package `distributed` is missing; if the scheduler cannot be
        reached, is lost, or has no worker within `PATIENCE`; if a worker lacks this project or
        has another version of it or of a library; if a unit brings down one worker after another.
    Raises
    ------
    InputError
        If the address is none.
    """
    if not re.fullmatch(r"(tcp|tls)://[^/@]+:\d{1,5}", address):
        raise InputError(f"the Dask scheduler is {address!r}; expected is tcp://HOST:PORT.")

    def run(units: Sequence[Unit], software: str) -> Generator[tuple[Unit, bytes], None, None]:
        with _connected(address) as client:
            _require_same_software(client, software)
            yield from _perform(client, address, units, software)

    return run


@contextmanager
def _connected(address: str) -> Iterator:
    try:
        import distributed  # noqa: F401
    except ImportError as error:
        raise InputError(
            "a Dask cluster needs the package distributed: pip install '.[cluster]' in a checkout."
        ) from error
    _quieten()
    _require_reachable(address)
    client = _client(address)
    try:
        _require_workers(client, address)
        yield client
    finally:
        client.close(timeout=2)


def _client(address: str):
    """A client of a scheduler that listens.

    It is made in a thread that can be left alone: a Client's own time limit does not end its wait
    for something that listens and never answers, and one that Ctrl-C ends half made is waited for
    at the end of the process, for 20 seconds.
    """
    from distributed import Client
    from distributed.versions import VersionMismatchWarning

    made: Queue = Queue()

    def make() -> None:
        try:
            made.put(Client(address, timeout=PATIENCE, set_as_default=False))
        except OSError:
            made.put(None)

    with warnings.catch_warnings():
        # What matters of versions is in the digest.
        warnings.simplefilter("ignore", VersionMismatchWarning)
        Thread(target=make, daemon=True).start()
        try:
            client = made.get(timeout=PATIENCE + 1.0)
        except Empty:
            client = None
    if client is None:
        raise InputError(f"the Dask scheduler {address} does not answer.")
    return client


def _quieten() -> None:
    """Silence Dask's loggers, one by one: our exceptions say what goes wrong."""
    for name in [*logging.root.manager.loggerDict]:
        if name.split(".")[0] in {"asyncio", "distributed"}:
            logging.getLogger(name).setLevel(logging.CRITICAL)


def _require_reachable(address: str) -> None:
    """Raise InputError where nothing listens: Dask would try for as long as it is let."""
    try:
        place = urlsplit(address)
        socket.create_connection((place.hostname, place.port), PATIENCE).close()
    except (OSError, ValueError) as error:
        raise InputError(f"the Dask scheduler {address} cannot be reached: {error}.") from error


def _require_workers(client, address: str) -> None:
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
    except TimeoutError as error:
        raise InputError(f"the Dask scheduler {address} has no workers.") from error


def _require_same_software(client, software: str) -> None:
    for worker, digest in client.run(software_digest, on_error="return").items():
        if digest != software:
            raise _other_software(worker)


def _other_software(worker: str) -> InputError:
    return InputError(
        f"the Dask worker {worker} lacks this project or has another version of it, of Python or "
        "of a library; allowed are workers with the same as here."
    )


def _perform(
    client, address: str, units: Sequence[Unit], software: str
) -> Generator[tuple[Unit, bytes], None, None]:
    from distributed import CancelledError, KilledWorker, as_completed

    # The scheduler looks into what it passes on; of `pickle.loads` and bytes it understands all.
    calls = [pickle.dumps(_Call(unit, software)) for unit in units]
    futures = client.map(pickle.loads, calls, pure=False)
    # Nothing else may hold a future that has ended: its result would be made again for nobody
    # when its worker is lost.
    unit_of = {future.key: unit for future, unit in zip(futures, units, strict=True)}
    ending = as_completed(futures, loop=client.loop, with_results=True)
    del futures
    try:
        for future, content in ending:
            unit = unit_of.pop(future.key)
            if future.cancelled():
                raise CancelledError
            del future
            yield unit, content
    except KilledWorker as error:
        raise InputError(
            f"a unit of work brought down one Dask worker of {address} after another; "
            "was there too little memory?"
        ) from error
    except ModuleNotFoundError as error:
        raise _other_software("that came last") from error
    except CancelledError as error:
        raise InputError(f"the Dask scheduler {address} was lost.") from error


class _Call:
    """Becomes, when it is unpickled, what `_perform_here` gives for its arguments."""

    def __init__(self, *arguments):
        self.arguments = arguments

    def __reduce__(self):
        return _perform_here, self.arguments


def _perform_here(unit: Unit, software: str) -> bytes:
    """`perform` on a worker, which may have come after the others were asked."""
    if software_digest() != software:
        from distributed import get_worker

        raise _other_software(get_worker().address)
    return perform(unit, software)
