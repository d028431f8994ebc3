"""Before numpy is imported: threads of BLAS cost small matrices ten times their own time."""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
