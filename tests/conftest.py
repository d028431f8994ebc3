"""Before numpy is imported: threads of BLAS cost small matrices ten times their own time."""

import os
import signal

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# A shell's job in the background ignores Ctrl-C, and so would every command that a test starts.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
