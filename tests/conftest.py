"""Before all tests: compiled kernels that are older than any of their sources go.

numba notices a change in the file of the compiled function only, not in those that it calls.
"""

from pathlib import Path

KERNELS = Path(__file__).parent.parent / "hylios" / "transport"


def pytest_configure():
    newest = max(path.stat().st_mtime for path in KERNELS.glob("*.py"))
    for path in KERNELS.glob("__pycache__/*.nb[ic]"):
        if path.stat().st_mtime < newest:
            path.unlink(missing_ok=True)
