"""Relief and unevenness of skin: a node group that brings pores, fine lines and blotches.

It works on any mesh, with or without UV maps, in millimetres of the mesh at rest. One smooth noise
makes the relief: fine lines run where it is at its mean, others across the mesh and bent by it, so
that they cross as those of skin do; pores lie where it is highest. (Lines that never cross look
like worms, cells of a Voronoi diagram like leather; a second noise takes longer.) Unevenness goes
into melanin and blood, never into a colour: so it tans.
"""

from typing import Any

import bpy
import numpy as np

from . import first_version, nodes
from .changes import Changes
from .ownership import is_local
from .plan import Link, Role, math_role

DETAIL_KEY = "skin_tan_detail"
"""Custom property of the group, and of a node in a material that shows it."""

INPUTS = {
    "Relief": (1.0, 4.0, "Depth of pores and fine lines over that of usual skin; 0 is smooth"),
    "Variation": (1.0, 4.0, "Unevenness of melanin and blood over that of usual skin; 0 is even"),
    "Melanin": (1.0, 100.0, "Melanin over that of the tan: 1 leaves it, 0 is skin without any"),
    "Blood": (1.0, 100.0, "Blood over that of the skin: 1 leaves it, 2 is a flush"),
    "Millimetre": (0.001, 1e6, "Length of a millimetre in scene units"),
}
SIZE = "Size"
OUTPUTS = {
    "Normal": ("NodeSocketVector", "For the input Normal of the tan"),
    "Melanin": ("NodeSocketFloat", "For the input Melanin of the tan"),
    "Blood": ("NodeSocketFloat", "For the input Blood of the tan"),
}

LINES_PER_MILLIMETRE = 1.1
"""Frequency of the noise, which has lines less than a millimetre apart."""

ACROSS, BENT = (0.62, 0.48, 0.62), 1.0
"""Lines across the mesh: their number in a millimetre along the axes, and by how many the noise
moves them."""

LINE, PORE = 0.09, (0.62, 0.8)
"""How far from its mean the noise is where a line begins; the noise at a pore's edge and in it."""

LINE_MILLIMETRES, PORE_MILLIMETRES = 0.04, 0.045
"""Depth of a line and of a pore, by eye."""

BLOTCHES_PER_MILLIMETRE = 0.08

MELANIN_RANGE, BLOOD_RANGE = (0.94, 1.07), (0.7, 1.42)
"""Factors from the palest to the darkest and from the palest to the most flushed blotch."""


def _noise(label: str, location: tuple[int, int], per_millimetre: float, detail: float) -> Role:
    inputs = {"Scale": per_millimetre, "Detail": detail}
    return Role("ShaderNodeTexNoise", label, location, {}, inputs)


def _variation(ends: tuple[float, float], place: str, row: int) -> dict[str, Role]:
    """Nodes that make a factor of a blotch: noise of one octave is .25 to .75 nearly everywhere.

    The first two have sliders alone as inputs, so that Cycles computes them beforehand.
    """
    slope = (ends[1] - ends[0]) / 0.5
    start = ends[0] - 1.0 - 0.25 * slope
    return {
        f"{place}_slope": math_role("MULTIPLY", f"Contrast of {place}", (-300, row), at_1=slope),
        f"{place}_start": math_role(
            "MULTIPLY_ADD",
            f"{place.capitalize()} at no noise",
            (-100, row - 180),
            at_1=start,
            at_2=1.0,
        ),
        place: math_role("MULTIPLY_ADD", f"More or less {place}", (250, row)),
        f"more_{place}": math_role("MULTIPLY", f"{place.capitalize()} in all", (450, row)),
    }


def _variation_links(place: str, name: str) -> tuple[Link, ...]:
    return (
        ("input", "Variation", f"{place}_slope", 0),
        ("input", "Variation", f"{place}_start", 0),
        ("blotches", "Fac", place, 0),
        (f"{place}_slope", "Value", place, 1),
        (f"{place}_start", "Value", place, 2),
        (place, "Value", f"more_{place}", 0),
        ("input", name, f"more_{place}", 1),
        (f"more_{place}", "Value", "output", name),
    )


# The skin is so many mm deeper for each unit of noise beyond the edge of a line or a pore.
LINE_SLOPE, PORE_SLOPE = LINE_MILLIMETRES / LINE, PORE_MILLIMETRES / (PORE[1] - PORE[0])
LINE_EDGE = 0.5 - LINE


ROLES = {
    "input": Role("NodeGroupInput", "", (-1000, 0)),
    "rest": Role("ShaderNodeTexCoord", "Place on the mesh at rest", (-1000, 300)),
    "millimetres": Role(
        "ShaderNodeVectorMath", "Place in mm", (-800, 200), {"operation": "MULTIPLY"}
    ),
    "texture": _noise("Pores and lines", (-800, 400), LINES_PER_MILLIMETRE, 0.0),
    "across": Role(
        "ShaderNodeVectorMath",
        "Lines across the mesh",
        (-800, 650),
        {"operation": "DOT_PRODUCT"},
        {1: ACROSS},
    ),
    "bent": math_role("MULTIPLY_ADD", "Bent by the noise", (-600, 550), at_1=BENT),
    "lines": math_role("PINGPONG", "Highest at lines", (-400, 600), at_1=0.5),
    "other_lines": math_role("PINGPONG", "Highest at other lines", (-400, 400), at_1=0.5),
    "all_lines": math_role("SMOOTH_MAX", "Lines that cross", (-200, 500), at_2=0.04),
    "in_line": math_role(
        "SMOOTH_MAX", "Beyond a line's edge", (0, 500), at_1=LINE_EDGE, at_2=0.01 / LINE_SLOPE
    ),
    "in_pore": math_role("MAXIMUM", "Beyond a pore's edge", (0, 250), at_1=PORE[0]),
    "depth": math_role(
        "MULTIPLY_ADD", "Depth in units of the noise", (150, 400), at_1=LINE_SLOPE / PORE_SLOPE
    ),
    "unit_mm": math_role("MULTIPLY", "A unit of depth in mm", (50, 50), at_1=PORE_SLOPE),
    "unit": math_role("MULTIPLY", "A unit of depth in scene units", (250, 50)),
    "bump": Role(
        "ShaderNodeBump", "Relief as normals", (450, 250), {"invert": True}, {"Strength": 1.0}
    ),
    "blotches": _noise("Blotches", (-550, -250), BLOTCHES_PER_MILLIMETRE, 0.0),
    **_variation(MELANIN_RANGE, "melanin", -200),
    **_variation(BLOOD_RANGE, "blood", -550),
    "output": Role("NodeGroupOutput", "", (700, 0)),
}

LINKS: tuple[Link, ...] = (
    ("rest", "Generated", "millimetres", 0),
    ("input", SIZE, "millimetres", 1),
    ("millimetres", "Vector", "texture", "Vector"),
    ("millimetres", "Vector", "blotches", "Vector"),
    ("millimetres", "Vector", "across", 0),
    ("texture", "Fac", "bent", 0),
    ("across", "Value", "bent", 2),
    ("texture", "Fac", "lines", 0),
    ("bent", "Value", "other_lines", 0),
    ("lines", "Value", "all_lines", 0),
    ("other_lines", "Value", "all_lines", 1),
    ("all_lines", "Value", "in_line", 0),
    ("texture", "Fac", "in_pore", 0),
    ("in_line", "Value", "depth", 0),
    ("in_pore", "Value", "depth", 2),
    ("depth", "Value", "bump", "Height"),
    ("input", "Relief", "unit_mm", 0),
    ("unit_mm", "Value", "unit", 0),
    ("input", "Millimetre", "unit", 1),
    ("unit", "Value", "bump", "Distance"),
    ("bump", "Normal", "output", "Normal"),
    *_variation_links("melanin", "Melanin"),
    *_variation_links("blood", "Blood"),
)


def add_detail(tree: Any, skin: Any) -> None:
    """Put the group into a material's tree, before the node that shows the tan."""
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree, node.width, node[DETAIL_KEY] = _shared_group(), 200, True
    node.location = (skin.location[0] - 300, skin.location[1])
    for name in OUTPUTS:
        tree.links.new(node.outputs[name], skin.inputs[name])


def set_size(trees: list[Any], obj: bpy.types.Object, scene_unit: float, changes: Changes) -> None:
    """Tell the detail in an object's materials how large the object is.

    Parameters
    ----------
    trees
        Of the object alone.
    scene_unit : float
        Length of a scene unit in metres.
    """
    size = millimetres(obj, scene_unit)
    for tree in trees:
        for node in tree.nodes:
            if node.get(DETAIL_KEY) and node.node_tree is None:
                _mend(tree, node, changes)
            if node.get(DETAIL_KEY) and node.inputs.get(SIZE) is not None:
                changes.set(node.inputs[SIZE], "default_value", size)
                changes.set(node.inputs["Millimetre"], "default_value", 0.001 / scene_unit)


def _mend(tree: Any, node: Any, changes: Changes) -> None:
    """Give a node its group and links again where the group was deleted by hand."""
    changes.may_relink(tree)
    changes.set(node, "node_tree", _shared_group())
    for skin in tree.nodes:
        shown = getattr(skin, "node_tree", None)
        if shown is not None and first_version.is_tan_group(shown):
            for name in OUTPUTS:
                if not skin.inputs[name].is_linked:
                    tree.links.new(node.outputs[name], skin.inputs[name])


def millimetres(obj: bpy.types.Object, scene_unit: float) -> tuple[float, float, float]:
    """Size in mm of the box in which Blender's generated coordinates of an object go from 0 to 1.

    Parameters
    ----------
    scene_unit : float
        Length of a scene unit in metres.
    """
    mesh: Any = obj.data
    scale = np.abs(np.array(obj.matrix_world.to_scale()))
    x, y, z = (2000.0 * scene_unit * np.array(mesh.texspace_size) * scale).tolist()
    return x, y, z


def remove_unused_group() -> None:
    """Remove the group of this file where nothing shows it."""
    for group in list(bpy.data.node_groups):
        if DETAIL_KEY in group and is_local(group) and group.users == 0:
            bpy.data.node_groups.remove(group)


def _shared_group() -> bpy.types.NodeTree:
    """The group of this file, which serves all objects: their sizes are inputs."""
    for group in bpy.data.node_groups:
        if DETAIL_KEY in group and is_local(group):
            return group
    return _new_group()


def _new_group() -> bpy.types.NodeTree:
    group: Any = bpy.data.node_groups.new("Skin Detail", "ShaderNodeTree")
    nodes.add_inputs(group, INPUTS)
    size = group.interface.new_socket(
        SIZE,
        description="Size of the mesh at rest in mm",
        in_out="INPUT",
        socket_type="NodeSocketVector",
    )
    size.default_value = (1000.0, 1000.0, 1000.0)
    nodes.add_outputs(group, OUTPUTS)
    nodes.complete(group, ROLES, ROLES, LINKS)
    group[DETAIL_KEY] = True
    return group
