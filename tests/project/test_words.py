"""Names that say what the thing is, files and functions of a length that can be read.

Both hold in the folders listed here; add a folder once it is swept.
"""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent

EMPTY_WORDS = {"each", "asked", "found", "known", "chosen", "made_for"}
"""They name nothing: a spectrum is a `spectrum`, the model's assumptions are a `model`."""

MOST_LINES, MOST_LINES_OF_A_FUNCTION = 400, 60

WELL_NAMED = (
    "hylios/*.py",
    "hylios/adding",
    "hylios/lab/predecessors",
    "hylios/commands",
    "hylios/lab/*.py",
    "hylios/readers",
    "hylios/skin",
    "hylios/spectra",
    "hylios/sun",
    "hylios/tanning",
    "hylios/table",
    "hylios/tissue",
    "hylios/transport",
    "blender_addon/package.py",
    "examples",
    "tests/docs",
    "tests/examples",
    "lut_builder",
    "tests/hylios/adding",
    "tests/hylios/table",
    "tests/hylios/transport",
    "tests/lut_builder",
    "tests/hylios/*.py",
    "tests/hylios/commands/test_dose_command.py",
    "tests/hylios/skin",
    "tests/hylios/spectra",
    "tests/hylios/sun",
    "tests/hylios/tanning",
    "tests/hylios/tissue",
    "tests/project",
    "tools",
)
"""Folders, or patterns of files, without names that are empty words."""

SHORT = (
    "hylios/*.py",
    "hylios/adding",
    "hylios/lab/predecessors",
    "hylios/commands",
    "hylios/lab/*.py",
    "hylios/readers",
    "hylios/skin",
    "hylios/spectra",
    "hylios/sun",
    "hylios/tanning",
    "hylios/table",
    "hylios/tissue",
    "examples",
    "hylios/transport",
    "lut_builder",
    "tests/examples",
    "tests/hylios/adding",
    "tests/hylios/table",
    "tests/hylios/transport",
    "tests/lut_builder",
    "tests/hylios/*.py",
    "tests/hylios/commands/test_dose_command.py",
    "tests/hylios/skin",
    "tests/hylios/spectra",
    "tests/hylios/sun",
    "tests/hylios/tanning",
    "tests/hylios/tissue",
    "tests/project",
    "tools",
)
"""Folders, or patterns of files, without long files and long functions."""


def sources(place: str) -> list[Path]:
    """The Python files of a folder, or those that a pattern matches."""
    if place.endswith(".py"):
        return sorted(ROOT.glob(place))
    return sorted((ROOT / place).rglob("*.py"))


def names(tree: ast.AST) -> Iterator[tuple[str, int]]:
    """What a file names (variables, parameters, attributes, functions, classes), with the lines."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Name):
            yield node.id, node.lineno
        elif isinstance(node, ast.arg):
            yield node.arg, node.lineno
        elif isinstance(node, ast.Attribute):
            yield node.attr, node.lineno
        elif isinstance(node, ast.keyword):
            yield node.arg or "", node.lineno
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            yield node.name, node.lineno


@pytest.mark.parametrize("place", WELL_NAMED)
def test_names_say_what_the_thing_is(place):
    assert sources(place)
    empty = [
        f"{path.relative_to(ROOT)}:{line}: {name}"
        for path in sources(place)
        for name, line in names(ast.parse(path.read_text(encoding="utf-8")))
        if name in EMPTY_WORDS
    ]
    assert not empty


@pytest.mark.parametrize("place", SHORT)
def test_files_and_functions_are_short(place):
    assert sources(place)
    long = []
    for path in sources(place):
        text, name = path.read_text(encoding="utf-8"), path.relative_to(ROOT)
        lines = len(text.splitlines())
        if lines > MOST_LINES:
            long.append(f"{name}: {lines} lines")
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                lines = node.end_lineno - node.lineno + 1
                if lines > MOST_LINES_OF_A_FUNCTION:
                    long.append(f"{name}:{node.lineno}: {node.name} has {lines} lines")
    assert not long
