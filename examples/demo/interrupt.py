"""Ctrl-C while Blender renders."""

import os
import shutil
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def removing(folder: Path) -> Iterator[None]:
    """On Ctrl-C, remove a folder and end the process with status 130 at once.

    Python's own KeyboardInterrupt would wait for the end of a render, and then be lost: it would
    be raised in the scripts of Cycles, where Blender swallows it.
    """
    reading, writing = os.pipe()
    os.set_blocking(writing, False)

    def watch() -> None:
        if os.read(reading, 1):
            shutil.rmtree(folder, ignore_errors=True)
            print("\ncancelled", file=sys.stderr)
            os._exit(130)

    threading.Thread(target=watch, daemon=True).start()
    former_handler = signal.signal(signal.SIGINT, lambda *_: None)
    former_fd = signal.set_wakeup_fd(writing)
    try:
        yield
    finally:
        signal.set_wakeup_fd(former_fd)
        signal.signal(signal.SIGINT, former_handler)
        os.close(writing)
