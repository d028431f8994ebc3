"""Names that say what the thing is, files and functions of a length that can be read."""

import ast
import subprocess
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent

EMPTY_WORDS = {"each", "asked", "found", "known", "chosen", "made_for"}
"""They name nothing: a spectrum is a `spectrum`, the model's assumptions are a `model`."""

MOST_LINES, MOST_LINES_OF_A_FUNCTION = 400, 60


def sources() -> list[str]:
    """The Python files that git tracks, from the repository's root."""
    command = ["git", "-C", str(ROOT), "ls-files", "-z", "*.py"]
    listed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return [name for name in listed.split("\0") if name and (ROOT / name).exists()]


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


def test_git_lists_the_files():
    assert {"hylios/errors.py", "tests/project/test_words.py"} <= set(sources())


def test_names_say_what_the_thing_is():
    empty = [
        f"{source}:{line}: {name}"
        for source in sources()
        for name, line in names(ast.parse((ROOT / source).read_text(encoding="utf-8")))
        if name in EMPTY_WORDS
    ]
    assert not empty


def test_files_and_functions_are_short():
    long = []
    for source in sources():
        text = (ROOT / source).read_text(encoding="utf-8")
        lines = len(text.splitlines())
        if lines > MOST_LINES:
            long.append(f"{source}: {lines} lines")
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                lines = node.end_lineno - node.lineno + 1
                if lines > MOST_LINES_OF_A_FUNCTION:
                    long.append(f"{source}:{node.lineno}: {node.name} has {lines} lines")
    assert not long
