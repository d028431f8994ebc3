"""The arrows between the packages point one way, as the README draws them."""

import ast
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
STANDARD = set(sys.stdlib_module_names)

ALLOWED = {
    "hylios": {"numpy"},
    "hylios/adding": {"numpy"},
    "hylios/colour.py": {"numpy", "colour"},
    "hylios/predecessors": {"numpy", "numba", "scipy"},
    "hylios/pictures.py": {"numpy", "matplotlib"},
    "hylios/fit.py": {"numpy", "scipy", "threadpoolctl"},
    "hylios/table": {"numpy"},
    "hylios/transport": {"numpy", "numba"},
    "hylios/ultraviolet": {"numpy"},
    "lut_builder": {"numpy", "OpenImageIO", "threadpoolctl", "tqdm", "hylios"},
    "lut_builder/cluster.py": {"distributed", "hylios"},
    "lut_builder/scene.py": {"numpy", "scipy", "hylios"},
    "lut_builder/trade_figure.py": {"numpy", "matplotlib", "hylios"},
    "blender_addon": {"numpy", "bpy", "bpy_extras", "mathutils", "hylios"},
    "blender_addon/package.py": {"bpy", "wheel", "hylios"},
}
"""What each room may import besides the standard library and itself; the longest match counts."""

LIGHT_ROOMS = (
    "hylios/transport",
    "hylios/commands",
    "hylios/predecessors",
    "hylios/fit.py",
    "hylios/phototypes/fitting.py",
)
"""Rooms of `hylios` that may lead to numba or colour-science."""

NUMPY_ONLY = (
    "adding",
    "errors",
    "files",
    "physiology",
    "quadrature",
    "skin",
    "specimen",
    "spectra",
    "table",
    "tanning",
    "tissue",
    "ultraviolet",
)
"""What of `hylios` the add-on may use: what its wheel carries."""


def imported(path):
    """Names of modules that a file imports, anywhere in it, with the level of relative ones."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, 0) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or "", node.level


def room(path):
    name = path.relative_to(ROOT).as_posix()
    return max((each for each in ALLOWED if name.startswith(each)), key=len)


SOURCES = [
    path
    for package in ("hylios", "lut_builder", "blender_addon")
    for path in sorted((ROOT / package).rglob("*.py"))
]


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_imports_follow_the_arrows(path):
    allowed = ALLOWED[room(path)] | STANDARD | {path.relative_to(ROOT).parts[0]}
    for name, level in imported(path):
        if level == 0:
            assert name.split(".")[0] in allowed, f"{path.name} imports {name}"


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_numba_and_colour_stay_in_their_rooms(path):
    """Importing specimens, tanning or tables never leads to numba or colour-science."""
    inside = path.relative_to(ROOT).as_posix()
    if inside.startswith("hylios/") and not inside.startswith(LIGHT_ROOMS):
        for name, _ in imported(path):
            assert not name.startswith(("hylios.transport", "hylios.colour")), f"{inside}: {name}"


@pytest.mark.parametrize(
    "path",
    [each for each in SOURCES if each.relative_to(ROOT).parts[1].removesuffix(".py") in NUMPY_ONLY],
    ids=lambda path: path.name,
)
def test_what_the_add_on_carries_needs_nothing_else_of_hylios(path):
    for name, _ in imported(path):
        if name.startswith("hylios."):
            assert name.split(".")[1] in NUMPY_ONLY, f"{path.name} imports {name}"


@pytest.mark.parametrize(
    "path",
    [each for each in SOURCES if "blender_addon" in each.parts],
    ids=lambda path: path.name,
)
def test_the_add_on_uses_the_numpy_only_part_of_hylios(path):
    for name, _ in imported(path):
        if name.startswith("hylios."):
            assert name.split(".")[1] in NUMPY_ONLY, f"{path.name} imports {name}"


def test_no_file_needs_the_workplace():
    """No registry, no path of one machine."""
    forbidden = ("/work/" + "shared", "/work/" + "main", "index" + "-url", "/root" + "/")
    for path in ROOT.rglob("*"):
        made = path.relative_to(ROOT).parts[0] in {"out", "dist"}
        hidden = any(part.startswith(".") for part in path.relative_to(ROOT).parts)
        kept = not made and not hidden
        if kept and path.suffix in {".py", ".toml", ".md", ".sh", ".csv", ""} and path.is_file():
            text = path.read_text(encoding="utf-8", errors="ignore")
            assert not any(word in text for word in forbidden), path
