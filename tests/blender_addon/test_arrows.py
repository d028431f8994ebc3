"""Imports between the rooms of the add-on go one way, as its first docstring says."""

import ast
from pathlib import Path

import pytest

ADDON = Path(__file__).parents[2] / "blender_addon"
SUBJECTS = {
    "__init__.py": {"registration"},
    "registration.py": {"live", "ops", "painting", "props", "renaming", "translations", "ui"},
    "translations.py": {"model"},
    "timers.py": set(),
    "painting.py": {"timers", "scene"},
    "renaming.py": {"props"},
    "masking.py": {"scene", "props", "hylios.errors"},
    "timing.py": {"applied", "model", "scene", "props", "hylios.errors"},
    "applied.py": {"model", "scene", "props"},
    "live.py": {
        "applied",
        "timers",
        "apply",
        "several",
        "tannable",
        "model",
        "scene",
        "props",
        "hylios.errors",
    },
    "apply.py": {
        *("applied", "own_colour", "peeling", "remarks", "several", "tannable", "timing"),
        *("views", "model", "scene", "props"),
        "hylios.errors",
    },
    "tannable.py": {"scene", "hylios.errors"},
    "remarks.py": {"timing", "model", "scene", "props"},
    "own_colour.py": {"model", "scene", "props"},
    "several.py": {"model", "scene", "props"},
    "peeling.py": {"several", "model", "scene"},
    "matching.py": {"tannable", "own_colour", "model", "props", "hylios.errors"},
    "removal.py": {"apply", "tannable", "scene", "props", "hylios.errors"},
    "views.py": {"model", "scene", "props", "hylios.errors", "hylios.table"},
    "size.py": {"applied", "tannable", "model", "scene", "props", "hylios.errors"},
    "package.py": {"hylios.errors", "hylios.files"},
    "model": {"model", "hylios"},
    "scene": {"scene", "hylios.errors"},
    "props": {"props", "model", "scene", "hylios.errors"},
    "ops": {
        *("ops", "apply", "removal", "masking", "matching", "own_colour", "timing", "views"),
        *("size", "tannable", "props", "model"),
        *("hylios.errors", "hylios.files"),
    },
    "ui": {
        *("ui", "applied", "ops", "props", "model", "scene", "translations", "hylios.errors"),
    },
}
"""What each room may import of the add-on and of hylios."""

WITHOUT_BLENDER = {"__init__.py", "model"}
SOURCES = sorted(ADDON.rglob("*.py"))


def room(path):
    return path.relative_to(ADDON).parts[0]


def imports(path):
    """Dotted names of what a file imports: from the add-on's root, or of other packages."""
    package = path.relative_to(ADDON).parts[:-1]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module
        elif isinstance(node, ast.ImportFrom):
            root = package[: len(package) + 1 - node.level]
            if node.module:
                yield ".".join((*root, node.module))
            else:
                yield from (".".join((*root, alias.name)) for alias in node.names)


def is_in(name, rooms):
    return any(name == other or name.startswith(f"{other}.") for other in rooms)


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.relative_to(ADDON).as_posix())
def test_a_room_imports_only_what_it_may(path):
    own = {part.removesuffix(".py") for part in SUBJECTS} | {"hylios", "blender_addon"}
    for name in imports(path):
        if is_in(name, own):
            assert is_in(name, SUBJECTS[room(path)]), f"{path.name} imports {name}"
        if room(path) in WITHOUT_BLENDER:
            assert not is_in(name, {"bpy", "bpy_extras", "mathutils"})
