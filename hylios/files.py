"""Files: read up to a limit, replaced only when that is asked for, and never left half written."""

import os
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from hylios.errors import InputError, shown

HALF_WRITTEN = ".skin-tan-"
"""Beginning of a file's name while it is being written."""


def as_path(path: str | os.PathLike[str]) -> Path:
    """A path from what names a file.

    Raises
    ------
    InputError
        If it is no path, or an empty text.
    """
    if not isinstance(path, str | os.PathLike) or not os.fspath(path):
        raise InputError(f"a file is named {str(path)[:60]!r}; expected a path, as text or Path.")
    return Path(path)


def regular_bytes(path: str | os.PathLike[str], most: int) -> bytes:
    """What a regular file holds; a pipe or a device, which may never end, is refused.

    Raises
    ------
    InputError
        If it is no path or no regular file, has more bytes than `most`, or cannot be read.
    """
    path = as_path(path)
    name = shown(path)
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise InputError(f"{name} cannot be read: it is no regular file.")
        with path.open("rb") as file:
            # All of `most` would be reserved, were it asked for at once.
            data = file.read(min(os.fstat(file.fileno()).st_size, most) + 1)
            while len(data) <= most and (more := file.read(2**16)):
                data += more
    except InputError:
        raise
    except (OSError, ValueError) as error:  # a name with a zero byte is a ValueError
        reason = error.strerror if isinstance(error, OSError) else error
        raise InputError(f"{name} cannot be read: {reason}.") from error
    if len(data) > most:
        raise InputError(f"{name} cannot be read: it has more than {most} bytes.")
    return data


def require_target(target: Path, suffixes: tuple[str, ...], replacing: bool) -> None:
    """Raise InputError where a file could not be written in the end; call it before the work.

    Parameters
    ----------
    suffixes : tuple of str
        One of which its name must end in.
    replacing : bool
        Whether it may exist already.
    """
    if target.suffix.lower() not in suffixes:
        endings = _listed(suffixes)
        raise InputError(f"the file is to be {shown(target)}; its name must end in {endings}.")
    if target.is_dir() or (target.exists() and not replacing):
        hint = "it is a folder" if target.is_dir() else "replacing=True replaces it"
        raise InputError(f"{target} exists already; {hint}.")
    try:
        with tempfile.TemporaryFile(dir=target.parent):
            pass
    except OSError as error:
        raise InputError(f"{target} cannot be written: {error.strerror}.") from error


@contextmanager
def written_beside(target: Path) -> Iterator[Path]:
    """A file beside the target to write into; it is moved there if no exception comes.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    beside = None
    try:
        handle, name = tempfile.mkstemp(target.suffix, HALF_WRITTEN, target.parent)
        os.close(handle)
        beside = Path(name)
        yield beside
        beside.chmod(0o666 & ~_umask())
        os.replace(beside, target)
    except OSError as error:
        raise InputError(f"{target} cannot be written: {error.strerror or error}.") from error
    finally:
        if beside is not None:
            beside.unlink(missing_ok=True)


def _listed(suffixes: tuple[str, ...]) -> str:
    return " or ".join(suffixes)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
