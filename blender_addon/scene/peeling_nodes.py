"""The group of nodes that peels: a pattern in mm, what of the tan it takes, and loose edges.

A smooth noise makes patches, pieces of skin their ragged borders: a piece has come off as a whole
or not at all. It works on any mesh, with or without UV maps. One group serves all objects of a
file.
"""

from typing import Any

import bpy

from . import nodes
from .ownership import is_local
from .plan import Link, Role, math_role, vector_role

PEELING_KEY = "skin_tan_peeling"
"""Custom property of the group."""

EULER = 2.718281828

PATCH_MILLIMETRES, PIECE_MILLIMETRES = 60.0, 2.8
"""Size of patches and of the pieces of skin at their borders, by eye."""

BENT_MILLIMETRES = 3.0
"""By how much pieces are bent, by eye."""

RAGGED = 0.06
"""How far a piece comes off sooner or later than the skin around it, in values of the pattern."""

MIDDLE, BY_ODDS = 0.5345, 0.049
"""The pattern's value on the border where half of the skin has peeled; by how much it rises with
the logarithm of what has not peeled over what has. Measured on 0.8 m^2 of skin: 1 % more or less.
"""

FEW = 0.0005
"""Less of the skin than this has no patches, and none of it is without."""

EDGE, LOOSE_EDGE = 0.003, 0.022
"""Beyond a patch's border: where all has come off; how far skin is loose that has not."""

OPAQUE = 0.85
"""How much of what is below a loose edge hides at most, by eye."""

STEP_MILLIMETRES, CURL_MILLIMETRES = 0.06, 0.22
"""Height of the skin over a patch, and how much higher its loose edge stands, by eye."""


def _noise(label: str, location: tuple[int, int], millimetres: float, detail: float) -> Role:
    inputs = {"Scale": 1.0 / millimetres, "Detail": detail, "Roughness": 0.5}
    return Role("ShaderNodeTexNoise", label, location, {}, inputs)


ROLES = {
    "input": Role("NodeGroupInput", "", (-1200, 0)),
    "rest": Role("ShaderNodeTexCoord", "Place on the mesh at rest", (-1200, 500)),
    "place": vector_role("MULTIPLY", "Place in mm", (-1000, 500)),
    "bend": _noise("Pieces are not straight", (-800, 700), 4.0, 0.0),
    "bent": vector_role("MULTIPLY_ADD", "Bent place", (-600, 600), at_1=(BENT_MILLIMETRES,) * 3),
    "patches": _noise("Patches", (-400, 700), PATCH_MILLIMETRES, 2.5),
    "pieces": Role(
        "ShaderNodeTexVoronoi", "Pieces", (-400, 400), {}, {"Scale": 1.0 / PIECE_MILLIMETRES}
    ),
    "piece": Role("ShaderNodeSeparateXYZ", "Of a piece", (-200, 400)),
    "value": math_role("MULTIPLY_ADD", "Sooner or later", (0, 600), at_1=RAGGED),
    "peeling": Role("ShaderNodeSeparateXYZ", "Patches, what they take, loose", (-1000, -200)),
    "cover": math_role("MAXIMUM", "Some patches", (-800, 200), at_1=FEW),
    "whole": math_role("SUBTRACT", "What has not peeled", (-650, 200), at_0=1.0 + FEW),
    "odds": math_role("DIVIDE", "Over what has", (-500, 200)),
    "log_odds": math_role("LOGARITHM", "Logarithm", (-350, 200), at_1=EULER),
    "border": math_role("MULTIPLY_ADD", "Border", (0, 300), at_1=BY_ODDS, at_2=MIDDLE),
    "left": math_role("DIVIDE", "What a patch takes", (-350, -200)),
    "beyond": math_role("SUBTRACT", "Beyond the border", (200, 500)),
    "off": math_role("MULTIPLY", "Has come off", (400, 600), at_1=1.0 / EDGE),
    "on": math_role("SUBTRACT", "Has not", (550, 600), at_0=1.0),
    "near": math_role("MULTIPLY_ADD", "Near the border", (400, 400), at_1=1.0 / LOOSE_EDGE, at_2=1),
    "edge": math_role("MULTIPLY", "Edge that has not come off", (700, 500)),
    "loose": math_role("MULTIPLY", "Whiter at the very edge", (1000, 400)),
    "flake": math_role("MULTIPLY", "Flakes", (1150, 400), at_1=OPAQUE),
    "curl": math_role("MULTIPLY", "Higher at the very edge", (850, 600)),
    "raised": math_role("MULTIPLY", "Height of edges", (1000, 600), at_1=CURL_MILLIMETRES),
    "relief": math_role("MULTIPLY_ADD", "Height of skin", (1150, 600), at_1=STEP_MILLIMETRES),
    "height": math_role("MULTIPLY", "Height in mm", (1300, 600)),
    "state": Role("ShaderNodeSeparateXYZ", "Melanin, thickness, blood", (-800, 0)),
    "melanin": math_role("EXPONENT", "Melanin", (-600, 0)),
    "new": math_role("SUBTRACT", "New melanin", (-400, 0), at_1=1.0),
    "some": math_role("MAXIMUM", "If there is any", (-200, 0), at_1=0.0),
    "lost": math_role("MULTIPLY", "Lost where it has peeled", (0, 0)),
    "here": math_role("MULTIPLY", "Lost here", (700, 0)),
    "rest_of": math_role("SUBTRACT", "Melanin that is left", (850, 0)),
    "logarithm": math_role("LOGARITHM", "Its logarithm", (1000, 0), at_1=EULER),
    "peeled": Role("ShaderNodeCombineXYZ", "State that has peeled", (1200, 0)),
    "output": Role("NodeGroupOutput", "", (1500, 200)),
}
for _role in ("off", "near", "left"):
    ROLES[_role].values["use_clamp"] = True

LINKS: tuple[Link, ...] = (
    ("rest", "Generated", "place", 0),
    ("input", "Size", "place", 1),
    ("place", "Vector", "bend", "Vector"),
    ("bend", "Color", "bent", 0),
    ("place", "Vector", "bent", 2),
    ("bent", "Vector", "patches", "Vector"),
    ("bent", "Vector", "pieces", "Vector"),
    ("pieces", "Color", "piece", 0),
    ("piece", "X", "value", 0),
    ("patches", "Fac", "value", 2),
    ("input", "Peeling", "peeling", 0),
    ("value", "Value", "beyond", 0),
    ("peeling", "X", "cover", 0),
    ("cover", "Value", "whole", 1),
    ("whole", "Value", "odds", 0),
    ("cover", "Value", "odds", 1),
    ("odds", "Value", "log_odds", 0),
    ("log_odds", "Value", "border", 0),
    ("border", "Value", "beyond", 1),
    ("peeling", "Y", "left", 0),
    ("cover", "Value", "left", 1),
    ("beyond", "Value", "off", 0),
    ("off", "Value", "on", 1),
    ("beyond", "Value", "near", 0),
    ("near", "Value", "edge", 0),
    ("on", "Value", "edge", 1),
    ("curl", "Value", "loose", 0),
    ("peeling", "Z", "loose", 1),
    ("loose", "Value", "flake", 0),
    ("flake", "Value", "output", "Flakes"),
    ("edge", "Value", "curl", 0),
    ("edge", "Value", "curl", 1),
    ("curl", "Value", "raised", 0),
    ("on", "Value", "relief", 0),
    ("raised", "Value", "relief", 2),
    ("relief", "Value", "height", 0),
    ("peeling", "Z", "height", 1),
    ("height", "Value", "output", "Height"),
    ("input", "State", "state", 0),
    ("state", "X", "melanin", 0),
    ("melanin", "Value", "new", 0),
    ("new", "Value", "some", 0),
    ("some", "Value", "lost", 0),
    ("left", "Value", "lost", 1),
    ("lost", "Value", "here", 0),
    ("off", "Value", "here", 1),
    ("melanin", "Value", "rest_of", 0),
    ("here", "Value", "rest_of", 1),
    ("rest_of", "Value", "logarithm", 0),
    ("logarithm", "Value", "peeled", "X"),
    ("state", "Y", "peeled", "Y"),
    ("state", "Z", "peeled", "Z"),
    ("peeled", "Vector", "output", "State"),
)

INPUTS = {
    "State": "State of the skin, as if it did not peel",
    "Peeling": "Share of the skin in patches, part of its new melanin that they take, loose edges",
    "Size": "Size of the mesh at rest in mm",
}
OUTPUTS = {
    "State": ("NodeSocketVector", "State of the skin"),
    "Flakes": ("NodeSocketFloat", "How much dry, loose skin covers what is below"),
    "Height": ("NodeSocketFloat", "Relief in mm"),
}


def shared_group() -> bpy.types.NodeTree:
    """The group of this file."""
    for group in bpy.data.node_groups:
        if PEELING_KEY in group and is_local(group):
            return group
    group: Any = bpy.data.node_groups.new("Skin Peeling", "ShaderNodeTree")
    for name, says in INPUTS.items():
        group.interface.new_socket(
            name, description=says, in_out="INPUT", socket_type="NodeSocketVector"
        )
    nodes.add_outputs(group, OUTPUTS)
    nodes.complete(group, ROLES, ROLES, LINKS)
    group[PEELING_KEY] = True
    return group


def remove_unused_group() -> None:
    """Remove the group of this file where nothing shows it."""
    for group in list(bpy.data.node_groups):
        if PEELING_KEY in group and is_local(group) and group.users == 0:
            bpy.data.node_groups.remove(group)
