"""The folder of unfinished work beside a target: who may use it, and what in it is ours.

Only what this module or `written_beside` made is ever removed: files whose names begin with `OURS`
or `HALF_WRITTEN`, in a folder that holds `MARKER`. A link, or a folder of someone else's that
happens to have the name, is refused.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from hylios.errors import InputError
from hylios.files import HALF_WRITTEN, require_target

OURS = "skin-tan-"
"""Beginning of the names of all files in the folder."""

UNITS = OURS + "*.unit"
MARKER = OURS + "unfinished.txt"
"""Name of the file that marks the folder as ours."""

MEANING = "Results of unfinished work, by skin-tan. They are removed once the work is done.\n"


class UnfinishedWorkError(InputError):
    """There is unfinished work, and it is neither to be resumed nor to be thrown away."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C came after units were done; `folder` keeps them."""

    def __init__(self, folder: Path):
        super().__init__(f"cancelled; what is done is kept in {folder}")
        self.folder = folder


@dataclass(frozen=True)
class Work:
    """Where work is kept while it is unfinished.

    Attributes
    ----------
    folder : Path
        For the units.
    result : Path
        For the file that is moved to the target in the end.
    """

    folder: Path
    result: Path


def unit_file(folder: Path, name: str) -> Path:
    """The file of a unit that is done."""
    return folder / f"{OURS}{name}.unit"


@contextmanager
def unfinished(
    target: Path, suffixes: tuple[str, ...], *, resume: bool, replace: bool
) -> Iterator[Work]:
    """Folder beside a target for its units, and for the file that becomes the target.

    Write the latter in the end: it is moved to the target, and the folder goes. After an exception
    the folder stays if a unit is in it.

    Parameters
    ----------
    suffixes : tuple of str
        One of which the target's name must end in.
    resume : bool
        Whether to go on with unfinished work, if there is any.
    replace : bool
        Whether an existing target is replaced, and unfinished work thrown away unless `resume`.

    Raises
    ------
    UnfinishedWorkError
        If there is unfinished work, and neither `resume` nor `replace`.
    InputError
        If the target exists or cannot be written; something else has the folder's name; another
        process is at work there.
    Interrupted
        On KeyboardInterrupt when a unit is done.
    """
    folder = target.parent / f"{target.name}.unfinished"
    # A run may have been killed after its target was written and before its folder was gone.
    require_target(target, suffixes, replace or (resume and folder.is_dir()))
    _require_ours(folder)
    if not resume and not replace and _has_units(folder):
        raise UnfinishedWorkError(f"there is unfinished work in {folder}.")
    work = Work(folder, folder / f"{OURS}result{target.suffix}")
    _make(folder)
    with _only_one(folder):
        try:
            _remove(folder, HALF_WRITTEN + "*", *([] if resume else [UNITS]))
            yield work
            _move(work.result, target)
            _remove(folder, UNITS)
        except KeyboardInterrupt:
            if not _has_units(folder):
                raise
            raise Interrupted(folder) from None
        finally:
            _remove(folder, HALF_WRITTEN + "*", work.result.name)
            _remove_empty(folder)


def _require_ours(folder: Path) -> None:
    """Raise InputError if a link, or a folder with files but without our marker, has the name."""
    if folder.is_symlink():
        raise InputError(f"{folder} is a link; expected is a folder that skin-tan made, or none.")
    if folder.is_dir() and not (folder / MARKER).exists() and any(folder.iterdir()):
        raise InputError(
            f"{folder} holds files but no {MARKER}, so skin-tan did not make it; "
            "move it away or choose another name for the output."
        )


def _make(folder: Path) -> None:
    try:
        folder.mkdir(exist_ok=True)
        (folder / MARKER).write_text(MEANING, encoding="utf-8")
    except OSError as error:
        raise InputError(f"{folder} cannot be made: {error.strerror}.") from error


def _has_units(folder: Path) -> bool:
    return any(folder.glob(UNITS))


def _remove(folder: Path, *patterns: str) -> None:
    for path in [path for pattern in patterns for path in folder.glob(pattern)]:
        path.unlink(missing_ok=True)


def _remove_empty(folder: Path) -> None:
    """Remove the folder if nothing but the marker is left in it."""
    with suppress(OSError):
        if [path.name for path in folder.iterdir()] == [MARKER]:
            (folder / MARKER).unlink()
        folder.rmdir()


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
    try:
        handle = os.open(folder, os.O_RDONLY | os.O_NOFOLLOW)
    except OSError as error:
        raise InputError(f"{folder} cannot be used: {error.strerror}.") from error
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
