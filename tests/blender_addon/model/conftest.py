"""The tests of the model need no scene, and pass where nothing of Blender can be imported."""

import sys

import pytest


@pytest.fixture(autouse=True)
def empty_scene(monkeypatch):
    """In place of the one that needs Blender."""
    for name in ("bpy", "bpy_extras", "mathutils"):
        monkeypatch.setitem(sys.modules, name, None)  # an import of it fails
