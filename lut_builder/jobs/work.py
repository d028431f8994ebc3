"""Long work in units: each is done once, kept as soon as it is done, wherever it was done.

A unit is a function, its arguments and a name; its results depend on nothing else, so a table made
of them is the same bytes whoever did the units, in whatever order, and however often the work was
interrupted. Only the process that asked for the work writes files: what a unit found comes to it
as bytes, it keeps them in the folder of the unfinished work, and a later run goes on from there.

    with unfinished(target, (".exr",), resume=True, force=False) as folder:
        found = done(units, folder, software_digest(), in_processes(2), "table")
        write_table(folder / target.name, table_of(found))

A kept unit is trusted only if its checksum holds and its digest is that of the unit asked for:
function, arguments, the sources of this project and the versions of the libraries below it.
Linear algebra runs in one thread: its last digits depend on the number of threads.
"""

import hashlib
import importlib.metadata
import json
import math
import os
import platform
import re
import signal
import sys
import threading
import traceback
from collections import deque
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import ExitStack, closing, contextmanager, suppress
from dataclasses import dataclass, fields, is_dataclass
from functools import cache
from multiprocessing import get_context, parent_process, resource_tracker
from multiprocessing.connection import Connection, wait
from pathlib import Path
from types import FunctionType
from typing import Any, cast

import numpy as np
from threadpoolctl import threadpool_limits
from tqdm import tqdm

import hylios
from hylios.errors import InputError
from hylios.files import require_target, written_beside

SUFFIX = ".unit"
"""Of the file of a unit that is done."""

LIBRARIES = ("colour-science", "numba", "numpy", "scipy")
"""Whose versions may move the last digits of a result."""

KEPT, HALF_WRITTEN = "[!.]*" + SUFFIX, ".*"
"""Patterns of the files in a folder of unfinished work; `written_beside` makes the latter."""

Arrays = dict[str, np.ndarray]


@dataclass(frozen=True)
class Unit:
    """A piece of work that depends on nothing but what is in it.

    Attributes
    ----------
    name : str
        Unlike every other's in the same work, and fit for the name of a file: letters, digits,
        `-`, `_` and `.`, at most 100.
    function : function
        Of a module's top level, which imports at its own top what it needs. It gives a mapping of
        names to arrays of numbers or truth values; randomness comes from a seed in the arguments.
    arguments : tuple
        Numbers, texts, arrays, functions, None, and tuples, lists, sets, dictionaries and data
        classes of them: what `pickle` carries and `unit_digest` describes.
    size : float
        How long it takes relative to the others; for the time left. A unit of less than a tenth of
        a second had better be joined with others: keeping one takes about a millisecond.
    """

    name: str
    function: Callable[..., Mapping[str, np.ndarray]]
    arguments: tuple
    size: float = 1.0

    def __post_init__(self):
        if not re.fullmatch(r"[A-Za-z0-9_-][A-Za-z0-9_.-]{0,99}", self.name):
            raise ValueError(f"{self.name!r} cannot be a unit's name")
        if not 0.0 < self.size < math.inf:
            raise ValueError(f"the size of unit {self.name} is {self.size}")


Runner = Callable[[Sequence[Unit], str], Generator[tuple[Unit, bytes], None, None]]
"""Does units for software of a digest; gives each with the bytes of `performed` as it ends."""


def done(
    units: Sequence[Unit],
    folder: Path | None,
    software: str,
    runner: Runner,
    what: str | None = None,
) -> dict[str, Arrays]:
    """Results of all units by name, in the order of the units.

    Parameters
    ----------
    folder : Path or None
        Where units are kept as soon as they are done, and found again; None keeps nothing.
    software : str
        `software_digest()`.
    what : str or None
        What the units make: the name of a bar on standard error that shows how many are done and
        the time left by their sizes. None shows nothing.

    Raises
    ------
    InputError
        If a unit cannot be kept, a unit raises it, or the runner loses what it runs on; units that
        were done by then stay.
    """
    if len({unit.name.lower() for unit in units}) < len(units):
        raise ValueError("two units have the same name, for a file system that ignores case")
    found: dict[str, Arrays] = {}
    for unit in units if folder else ():
        kept = _kept(_file(folder, unit), unit_digest(unit, software))
        if kept is not None:
            found[unit.name] = kept
    # The largest first, lest one process is left with it when all others have ended.
    missing = sorted((each for each in units if each.name not in found), key=lambda u: -u.size)
    if missing:
        with _bar(units, found, what) as tell, closing(runner(missing, software)) as performing:
            for unit, content in performing:
                if folder:
                    with written_beside(_file(folder, unit)) as beside:
                        beside.write_bytes(content)
                found[unit.name] = unpacked(content)
                tell(unit)
    return {unit.name: found[unit.name] for unit in units}


@contextmanager
def _bar(
    units: Sequence[Unit], found: Mapping[str, Arrays], what: str | None
) -> Iterator[Callable[[Unit], None]]:
    if what is None:
        yield lambda unit: None
        return
    before = sum(unit.size for unit in units if unit.name in found)
    with ExitStack() as stack:
        # Ctrl-C between the bar's first sign and its `with` would leave its line without an end.
        with _interrupts_held():
            bar = stack.enter_context(
                tqdm(
                    total=sum(unit.size for unit in units),
                    initial=before,
                    desc=f"{what}, {len(found)} of {len(units)}",
                    bar_format="{desc} {percentage:3.0f}%|{bar}| [{elapsed}<{remaining}]",
                    smoothing=0.0,
                    mininterval=0.5,
                )
            )

        def tell(unit: Unit) -> None:
            bar.set_description_str(f"{what}, {len(found)} of {len(units)}", refresh=False)
            bar.update(min(unit.size, bar.total - bar.n))  # no rounding beyond the end

        yield tell


# What a unit is known by


def unit_digest(unit: Unit, software: str) -> str:
    """Digest of what decides a unit's results: software, function and arguments.

    Raises
    ------
    TypeError
        If an argument is of a kind that is not described.
    """
    described = _described((software, unit.name, unit.function, unit.arguments))
    return hashlib.sha256(described.encode()).hexdigest()


def _described(value: Any) -> str:
    """A text that is the same in every process for equal values, and for no others."""
    kind = f"{type(value).__module__}.{type(value).__qualname__}"
    if value is None or isinstance(value, bool | int | str | bytes):
        return f"{kind} {value!r}"
    if isinstance(value, float):
        return f"{kind} {value.hex()}"
    if isinstance(value, np.ndarray | np.generic) and not value.dtype.hasobject:
        content = hashlib.sha256(value.tobytes()).hexdigest()
        return f"array {value.dtype.str} {value.shape} {content}"
    if isinstance(value, FunctionType) and "<" not in value.__qualname__:
        return f"function {value.__module__}.{value.__qualname__}"
    if isinstance(value, Mapping):
        return f"{kind} {_described(tuple(value.items()))}"
    if isinstance(value, set | frozenset):
        return f"{kind} {sorted(map(_described, value))}"
    if isinstance(value, tuple | list):
        return f"{kind} ({','.join(map(_described, value))})"
    if is_dataclass(value) and not isinstance(value, type):
        return f"{kind} {_described(tuple(getattr(value, each.name) for each in fields(value)))}"
    raise TypeError(f"a unit's argument is {value!r}, which has no digest")


@cache
def software_digest() -> str:
    """Digest of this project's sources and figures, of Python, the libraries and the processor.

    Two machines on which it is the same give the same results, but for a processor of another
    generation, where a library may choose other instructions for its last digit.
    """
    digest = hashlib.sha256()
    for package in (Path(hylios.__file__).parent, Path(__file__).parent.parent):
        for path in sorted(package.rglob("*")):
            if path.suffix in {".py", ".csv", ".toml"}:
                digest.update(path.relative_to(package.parent).as_posix().encode())
                digest.update(hashlib.sha256(path.read_bytes()).digest())
    versions = [importlib.metadata.version(each) for each in LIBRARIES]
    digest.update(repr((versions, sys.version_info[:2], platform.machine())).encode())
    return digest.hexdigest()


# What a unit found, as bytes


def performed(unit: Unit, software: str) -> bytes:
    """Do a unit; what it found as the bytes of its file.

    The file is a line with the SHA-256 of the rest, a line of JSON with the unit's digest and
    [name, type, shape] of each array, and the arrays' elements, row by row.

    Raises
    ------
    TypeError
        If it found anything but arrays of numbers or truth values.
    """
    found = {name: np.asarray(each) for name, each in unit.function(*unit.arguments).items()}
    for name, each in found.items():
        if each.dtype.kind not in "biufc":
            raise TypeError(f"{name} of unit {unit.name} is an array of {each.dtype}")
    arrays = [[name, each.dtype.str, each.shape] for name, each in found.items()]
    header = json.dumps({"digest": unit_digest(unit, software), "arrays": arrays})
    body = b"\n".join([header.encode(), b"".join(each.tobytes() for each in found.values())])
    return hashlib.sha256(body).hexdigest().encode() + b"\n" + body


def unpacked(content: bytes) -> Arrays:
    """The arrays in the bytes of `performed`."""
    _, header, data = content.split(b"\n", 2)
    found, start = {}, 0
    for name, kind, shape in json.loads(header)["arrays"]:
        count = math.prod(shape)
        # A copy is aligned and may be written to, whatever the length of the header.
        array = np.frombuffer(data, kind, count, start).reshape(shape).copy()
        found[name], start = array, start + array.nbytes
    return found


def _kept(path: Path, digest: str) -> Arrays | None:
    """The arrays of a file; None if there is none, or it is damaged or another unit's."""
    try:
        checksum, _, body = path.read_bytes().partition(b"\n")
    except OSError:
        return None
    if checksum != hashlib.sha256(body).hexdigest().encode():
        return None
    content = checksum + b"\n" + body
    return unpacked(content) if json.loads(body.split(b"\n", 1)[0])["digest"] == digest else None


# The folder of unfinished work


@contextmanager
def unfinished(
    target: Path, suffixes: tuple[str, ...], *, resume: bool, force: bool
) -> Iterator[Path]:
    """Folder beside a target for its units, and for a file of the target's name.

    Write that file in the end: it is moved to the target, and the folder goes. After an exception
    the folder stays if a unit is in it. KeyboardInterrupt then says how to go on.

    Parameters
    ----------
    suffixes : tuple of str
        One of which the target's name must end in.
    resume : bool
        Whether to go on with unfinished work, if there is any.
    force : bool
        Whether an existing target is replaced, and unfinished work thrown away unless `resume`.

    Raises
    ------
    InputError
        If the target exists or cannot be written; there is unfinished work, and neither `resume`
        nor `force`; another process is at it.
    """
    folder = target.with_name(target.name + ".unfinished")
    # A run may have been killed after its target was written and before its folder was gone.
    require_target(target, suffixes, force or (resume and folder.is_dir()))
    if not resume and not force and _count(folder):
        raise InputError(
            f"there is unfinished work in {folder}; "
            "give --resume to go on with it, or --force to begin anew."
        )
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise InputError(f"{folder} cannot be made: {error.strerror}.") from error
    with _only_one(folder):
        try:
            _remove(folder, HALF_WRITTEN, *([] if resume else [KEPT]))
            yield folder
            _move(folder / target.name, target)
            _remove(folder, KEPT)
        except KeyboardInterrupt:
            if not _count(folder):
                raise
            raise KeyboardInterrupt(
                f"cancelled; what is done is kept in {folder}: give --resume to go on with it."
            ) from None
        finally:
            _remove(folder, HALF_WRITTEN, target.name)
            with suppress(OSError):
                folder.rmdir()


def _file(folder: Path | None, unit: Unit) -> Path:
    return Path(folder or "", unit.name + SUFFIX)


def _count(folder: Path) -> int:
    """Number of units in a folder."""
    return sum(1 for _ in folder.glob(KEPT))


def _remove(folder: Path, *patterns: str) -> None:
    for path in [each for pattern in patterns for each in folder.glob(pattern)]:
        path.unlink(missing_ok=True)


def _move(source: Path, target: Path) -> None:
    try:
        os.replace(source, target)
    except OSError as error:
        raise InputError(f"{target} cannot be written: {error.strerror}.") from error


@contextmanager
def _only_one(folder: Path) -> Iterator[None]:
    """Keep other processes out of a folder, where the system has locks; they end with us."""
    try:
        import fcntl
    except ImportError:
        yield
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        os.close(handle)
        raise InputError(f"another process is at work in {folder}.") from error
    except OSError:
        pass  # Not every file system locks folders.
    try:
        yield
    finally:
        os.close(handle)


# Threads and processes


def in_threads(count: int) -> Runner:
    """Runner of up to so many threads of this process, which spares the start of others.

    They share the interpreter, and a kernel that is running delays Ctrl-C to its end: for work
    of seconds.
    """

    def run(units: Sequence[Unit], software: str) -> Generator[tuple[Unit, bytes], None, None]:
        pool = ThreadPoolExecutor(count)
        try:
            with threadpool_limits(1):
                doing = {pool.submit(performed, each, software): each for each in units}
                for future in as_completed(doing):
                    yield doing[future], future.result()
        finally:
            pool.shutdown(cancel_futures=True)

    return run


def in_processes(count: int) -> Runner:
    """Runner of up to so many processes of this machine."""

    def run(units: Sequence[Unit], software: str) -> Generator[tuple[Unit, bytes], None, None]:
        yield from _spread(units, software, min(count, len(units)))

    return run


def _spread(
    units: Sequence[Unit], software: str, count: int
) -> Generator[tuple[Unit, bytes], None, None]:
    waiting = deque(units)
    context = get_context("spawn")
    processes, working = [], {}
    # It lets Ctrl-C through when it starts, and so has to start before they are held.
    resource_tracker.ensure_running()
    try:
        with _interrupts_held():
            for _ in range(count):
                connection, far_end = context.Pipe()
                process = context.Process(target=_serve, args=(far_end, software), daemon=True)
                process.start()
                far_end.close()
                processes.append(process)
                working[connection] = None
        for connection in working:
            working[connection] = _given(connection, waiting)
        while working:
            for connection in wait(list(working)):
                connection = cast(Connection, connection)
                unit, content = working.pop(connection), _answer(connection)
                if isinstance(content, BaseException):
                    raise content
                if waiting:
                    working[connection] = _given(connection, waiting)
                yield unit, content
    finally:
        for process in processes:
            process.kill()
        for process in processes:
            process.join()


def _given(connection: Connection, waiting: deque[Unit]) -> Unit:
    """Give the next unit to a process; whether that has died is noticed when it answers."""
    unit = waiting.popleft()
    with suppress(OSError):
        connection.send(unit)
    return unit


def _answer(connection: Connection) -> bytes | BaseException:
    try:
        return connection.recv()
    except (EOFError, OSError):
        return InputError(
            "a process at work was ended from outside; was there too little memory for as many?"
        )


def _serve(connection: Connection, software: str) -> None:
    """Do units as they come, until the process that sends them is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    while True:
        try:
            unit = connection.recv()
        except EOFError:
            return
        connection.send(_tried(unit, software))


def _tried(unit: Unit, software: str) -> bytes | Exception:
    """`performed_alone`, or the exception that it raised, with a note of where it came from."""
    try:
        return performed_alone(unit, software)
    except InputError as error:
        return error
    except Exception as error:
        error.add_note(traceback.format_exc())
        return error


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def performed_alone(unit: Unit, software: str) -> bytes:
    """`performed`, in a process whose linear algebra stays in one thread from then on."""
    threadpool_limits(1)
    return performed(unit, software)


@contextmanager
def _interrupts_held() -> Iterator[None]:
    """Let Ctrl-C wait for the end of the block; processes started inside never see it.

    A child that is still importing would say so with a traceback of its own.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came = []
    former = signal.signal(signal.SIGINT, lambda *_: came.append(True))
    block = getattr(signal, "pthread_sigmask", None)
    mask = block(signal.SIG_BLOCK, {signal.SIGINT}) if block else None
    try:
        yield
    finally:
        if block:
            block(signal.SIG_SETMASK, mask)
        signal.signal(signal.SIGINT, former)
        if came:
            raise KeyboardInterrupt
