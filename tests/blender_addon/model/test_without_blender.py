"""The model and its tests are imported where there is no Blender; `conftest` sees to the rest."""

import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
SCRIPT = """
import sys

for name in ("bpy", "bpy_extras", "mathutils"):
    sys.modules[name] = None  # an import of it fails

import pytest

sys.exit(pytest.main(["-q", "--collect-only", "-p", "no:cacheprovider", *sys.argv[1:]]))
"""


def test_the_tests_of_the_model_can_be_imported_where_bpy_cannot():
    tests = [str(path) for path in HERE.glob("test_*.py") if path != Path(__file__)]
    done = subprocess.run([sys.executable, "-c", SCRIPT, *tests], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert " tests collected" in done.stdout


def test_here_they_run_without_it():
    with pytest.raises(ImportError):
        import bpy  # noqa: F401
