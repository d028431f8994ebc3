"""The thesis's figures and tables again, drawn from this project's own results."""

import os

# The deterministic solver's matrices are small: threads of BLAS waste ten times its own time, and
# BLAS reads this once, when numpy is first imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
