"""numba's folder of compiled kernels, treated as a convenience: everything works without it.

An empty or damaged file there stops numba (its issue 10434), and so does a disk that is full.
Here a file that can't be read is compiled and written anew, and one that can't be written is left
out. A checksum ends every file of code, so that damaged code is never run.
"""

import hashlib
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from numba.core.caching import FunctionCache, IndexDataCacheFile

CHECKSUM_BYTES = hashlib.sha256().digest_size


class KernelCache(FunctionCache):
    """numba's cache of one kernel; whatever is wrong with it, there is something to run.

    Raises
    ------
    RuntimeError
        If no folder can be written (numba).
    """

    def __init__(self, function: Callable) -> None:
        super().__init__(function)
        self._cache_file = _CheckedFiles(
            cache_path=self._cache_path,
            filename_base=self._impl.filename_base,
            source_stamp=self._impl.locator.get_source_stamp(),
        )

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The compiled kernel, None where it has to be compiled; damaged files are forgotten."""
        try:
            return super().load_overload(sig, target_context)
        except OSError:  # if it can't be written either, that is said then
            return None
        except Exception:  # whatever pickle makes of a damaged file
            _note_once(self._cache_path, "is damaged")
            self._cache_file.remove_index()
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Write the compiled kernel for the next process, where that can be done."""
        try:
            super().save_overload(sig, data)
        except OSError as error:
            _note_once(self._cache_path, f"can't be kept ({error.strerror})")
        except Exception as error:  # a damaged index, which could not be removed
            _note_once(self._cache_path, f"can't be kept ({error})")


class _CheckedFiles(IndexDataCacheFile):
    """A kernel's files, each file of code with its checksum after it (pickle ignores that)."""

    def _save_data(self, name: str, data: Any) -> None:
        code = self._dump(data)
        with self._open_for_write(self._data_path(name)) as file:
            file.write(code + hashlib.sha256(code).digest())

    def _load_data(self, name: str) -> Any:
        content = Path(self._data_path(name)).read_bytes()
        code, checksum = content[:-CHECKSUM_BYTES], content[-CHECKSUM_BYTES:]
        if hashlib.sha256(code).digest() != checksum:
            raise ValueError("a file of compiled code is damaged")
        return super()._load_data(name)

    def remove_index(self) -> None:
        """Forget what was kept; a new index follows with the next kernel written."""
        try:
            Path(self._index_path).unlink(missing_ok=True)
        except OSError:
            pass


@cache
def _note_once(folder: str, trouble: str) -> None:
    """Say on standard error, once in a process, why kernels are compiled anew."""
    if sys.stderr is not None:
        print(
            f"note: compiled code in {folder} {trouble}; it is compiled anew",
            file=sys.stderr,
        )
