"""The arrows between the packages point one way, as the README draws them."""

import ast
import re
import sys
from pathlib import Path

import pytest

from blender_addon.package import NOT_CARRIED, tracked

ROOT = Path(__file__).parent.parent.parent
STANDARD = set(sys.stdlib_module_names)

ALLOWED = {
    "hylios": {"numpy"},
    "hylios/commands": {"numpy", "tqdm"},
    "hylios/lab/colour.py": {"numpy", "colour"},
    "hylios/lab/illuminants.py": {"numpy", "colour"},
    "hylios/lab/predecessors": {"numpy", "numba", "scipy"},
    "hylios/lab/pictures.py": {"numpy", "matplotlib"},
    "hylios/lab/fit.py": {"numpy", "scipy"},
    "hylios/lab/kinetics_fit.py": {"numpy", "scipy"},
    "hylios/lab/site_fits.py": {"numpy", "scipy"},
    "hylios/transport": {"numpy", "numba"},
    "lut_builder": {"numpy", "OpenImageIO", "tqdm", "hylios"},
    "lut_builder/jobs/cluster.py": {"distributed", "hylios"},
    "lut_builder/near_far_fit.py": {"numpy", "scipy", "hylios"},
    "lut_builder/trade/figure.py": {"numpy", "matplotlib", "hylios"},
    "blender_addon": {"numpy", "bpy", "bmesh", "bpy_extras", "mathutils", "hylios"},
    "blender_addon/ops/presets.py": {"bpy", "bl_operators", "hylios"},
    "blender_addon/ui/presets.py": {"bpy", "bl_ui"},
    "blender_addon/package.py": {"bpy", "hylios"},
}
"""What each room may import besides the standard library and itself; the longest match counts."""


def imported(path):
    """Dotted names of what a file imports from other packages or by full name, anywhere in it."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def room(path):
    name = path.relative_to(ROOT).as_posix()
    return max((place for place in ALLOWED if name.startswith(place)), key=len)


SOURCES = [
    path
    for package in ("hylios", "lut_builder", "blender_addon")
    for path in sorted((ROOT / package).rglob("*.py"))
]


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_imports_follow_the_arrows(path):
    allowed = ALLOWED[room(path)] | STANDARD | {path.relative_to(ROOT).parts[0]}
    for name in imported(path):
        assert name.split(".")[0] in allowed, f"{path.name} imports {name}"


FRONT_DOOR = ROOT / "hylios" / "__init__.py"
"""Names everything, and loads what is used: `tests/hylios/test_front_door.py` holds it."""


def is_carried(path):
    parts = path.relative_to(ROOT).parts
    return parts[0] == "hylios" and parts[1] not in NOT_CARRIED


@pytest.mark.parametrize(
    "path",
    [path for path in SOURCES if is_carried(path) or "blender_addon" in path.parts],
    ids=lambda path: str(path.relative_to(ROOT)),
)
def test_what_a_scene_needs_leads_to_no_laboratory(path):
    """No numba, no colour-science: what the add-on's wheel holds imports nothing else of hylios."""
    if path == FRONT_DOOR:
        return
    for name in imported(path):
        if name.startswith("hylios."):
            assert name.split(".")[1] not in NOT_CARRIED, f"{path.name} imports {name}"


APART = {
    "adding": {"transport"},
    "transport": {"adding"},
    "tissue": {"adding", "transport"},
}
"""Two ways through one model, which neither knows the other; what they share lies in `tissue`."""


@pytest.mark.parametrize(
    "path",
    [path for path in SOURCES if path.relative_to(ROOT).parts[1] in APART],
    ids=lambda path: str(path.relative_to(ROOT)),
)
def test_the_two_ways_to_a_reflectance_stay_apart(path):
    for name in imported(path):
        if name.startswith("hylios."):
            forbidden = APART[path.relative_to(ROOT).parts[1]]
            assert name.split(".")[1] not in forbidden, f"{path.name} imports {name}"


def test_the_tests_mirror_the_tree():
    """A folder of tests is named after the folder that it tests."""
    own = {"docs", "examples", "project"}
    folders = {path.parent.relative_to(ROOT / "tests") for path in ROOT.glob("tests/*/**/*.py")}
    for folder in folders:
        assert folder.parts[0] in own or (ROOT / folder).is_dir(), f"tests/{folder} tests nothing"


def test_no_file_needs_the_workplace():
    """No registry, no path of one machine."""
    forbidden = ("/work/" + "shared", "/work/" + "main", "index" + "-url", "/root" + "/")
    for name in tracked(ROOT, "."):
        text = (ROOT / name).read_bytes().decode("utf-8", errors="ignore")
        assert not any(word in text for word in forbidden), name


def test_nodes_are_switched_on_only_where_there_are_none():
    """From Blender 5.0 on there always are, and 6.0 is to lack the property."""
    for name in tracked(ROOT, "."):
        if name.endswith(".py"):
            text = (ROOT / name).read_text(encoding="utf-8")
            for before in re.findall(r"(.*)\n *[\w.]+\.use_nodes = True", text):
                assert "node_tree is None:" in before, name


def test_what_runs_reads_its_arguments():
    """So that --help says what it does, in place of doing it."""
    for folder in ("blender_addon", "examples", "hylios", "lut_builder", "tools"):
        for path in (ROOT / folder).rglob("*.py"):
            text = path.read_text(encoding="utf-8")
            if 'if __name__ == "__main__":' in text:
                assert ".parse_args(" in text, path.relative_to(ROOT)
