"""Names that say what the thing is, files and functions of a length that can be read."""

import ast
import subprocess
from functools import cache
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


def name_of(node: ast.AST) -> str:
    """What a node names: a variable, parameter, attribute, function or class."""
    for kinds, attribute in NAMING:
        if isinstance(node, kinds):
            return getattr(node, attribute) or ""
    return ""


FUNCTIONS = ast.FunctionDef, ast.AsyncFunctionDef
NAMING = (
    ((ast.Name,), "id"),
    ((ast.arg, ast.keyword), "arg"),
    ((ast.Attribute,), "attr"),
    ((*FUNCTIONS, ast.ClassDef), "name"),
)


@cache
def faults() -> tuple[list[str], list[str]]:
    """Names that say nothing, and what is too long."""
    empty, long = [], []
    for source in sources():
        text = (ROOT / source).read_text(encoding="utf-8")
        lines = len(text.splitlines())
        if lines > MOST_LINES:
            long.append(f"{source}: {lines} lines")
        for node in ast.walk(ast.parse(text)):
            if (name := name_of(node)) in EMPTY_WORDS:
                empty.append(f"{source}:{node.lineno}: {name}")
            if isinstance(node, FUNCTIONS):
                lines = node.end_lineno - node.lineno + 1
                if lines > MOST_LINES_OF_A_FUNCTION:
                    long.append(f"{source}:{node.lineno}: {name} has {lines} lines")
    return empty, long


def test_git_lists_the_files():
    assert {"hylios/errors.py", "tests/project/test_words.py"} <= set(sources())


def test_names_say_what_the_thing_is():
    assert not faults()[0]


def test_files_and_functions_are_short():
    assert not faults()[1]
