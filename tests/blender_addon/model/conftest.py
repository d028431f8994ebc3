"""The tests of the model need no scene."""

import pytest


@pytest.fixture(autouse=True)
def empty_scene():
    """In place of the one that needs Blender."""
