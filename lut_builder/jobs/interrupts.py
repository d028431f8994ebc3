"""Holding back Ctrl-C for a moment.

Neither `concurrent.futures` nor joblib can start processes that ignore a terminal's Ctrl-C: all
that are still importing print a traceback. So a few lines of our own stay here.
"""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Let Ctrl-C wait for the end of the block; processes started inside never see it."""
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
