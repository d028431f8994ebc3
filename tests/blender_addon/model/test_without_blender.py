"""The model and its tests run where there is no Blender."""

import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
SCRIPT = """
import sys

for name in ("bpy", "bpy_extras", "mathutils"):
    sys.modules[name] = None  # an import of it fails

import pytest

sys.exit(pytest.main(["-q", "-m", "not slow", "-p", "no:cacheprovider", *sys.argv[1:]]))
"""


def test_all_tests_of_the_model_pass_where_bpy_cannot_be_imported():
    tests = [str(path) for path in HERE.glob("test_*.py") if path != Path(__file__)]
    done = subprocess.run([sys.executable, "-c", SCRIPT, *tests], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert " passed" in done.stdout
