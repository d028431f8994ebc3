"""The group that tells how regions of the skin differ: spots, masks, and what they add up to.

Spots are balls around places that a Voronoi diagram spreads in the space of the mesh at rest, in
millimetres; the skin cuts discs of them. So they need no UV map, and lie alike over seams.
"""

import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import bpy

from . import mask_nodes, nodes
from .changes import Changes
from .mask_nodes import ShownMask
from .plan import ROLE_PREFIX, Role, math_role, vector_role

SHOWN_KEY = "skin_tan_regions"
"""Custom property of the group: the regions for which it was made."""

LIGHT = "Light"
OUTPUTS = {
    "Melanin": "Melanin over that of the skin around it, without sun",
    "Blood": "Logarithm of blood over that of the skin around it",
    "Tan": "Logarithm of the melanin that sun adds, over that around it",
    LIGHT: "Colour over that of skin with so much melanin and blood",
}

PLACE, BENT = "region_place", "region_bent"
SPREAD = 1.0
"""Places of spots lie as by chance. With less, a flat skin along the axes would cut more of them or
fewer, by where it lies (.052 to .089 of the area for .076 at .8). Spots that cut each other cost 4
to 7 % of the area.
"""

UNLIKE = (0.5, 1.5)
"""Strength of the weakest and of the strongest spots over that of the region, by eye."""

BENT_PER_MILLIMETRE, BENT_MILLIMETRES = 0.7, 1.2
"""Frequency and size of the noise that bends spots, by eye."""


@dataclass(frozen=True)
class Spots:
    """Spots that come by themselves, as `model.regions.Spots` has them, in mm."""

    least: float
    largest: float
    edge: float
    apart: float
    held: float


@dataclass(frozen=True)
class Region:
    """A region for the nodes.

    Attributes
    ----------
    label : str
    melanin, blood, tan : float
        As `hylios.skin.regions.Region` has them.
    strength : float
    spots : Spots or None
        Without them the mask alone says where it is.
    colour : 3 floats
        As `model.regions.Shown` has it.
    """

    label: str
    melanin: float
    blood: float
    tan: float
    strength: float
    spots: Spots | None = None
    colour: tuple[float, float, float] = (1.0, 1.0, 1.0)


Shown = Sequence[tuple[Region, ShownMask | None]]
"""Regions, and what nodes read of where they lie; None for everywhere."""


def told(shown: Shown) -> str:
    """The regions as text, to see whether they have changed."""
    return json.dumps([(asdict(region), mask and _told(mask)) for region, mask in shown])


def _told(mask: ShownMask) -> dict[str, Any]:
    told = {**vars(mask), "image": mask.image.name_full if mask.image else ""}
    del told["by_channel"]  # follows from the rest, and earlier versions did not tell it
    return told


def new_tree(name: str, shown: Shown, changes: Changes) -> Any:
    """A new group of nodes for some regions."""
    tree: Any = bpy.data.node_groups.new(name, "ShaderNodeTree")
    tree[SHOWN_KEY] = told(shown)
    for title, says in OUTPUTS.items():
        tree.interface.new_socket(
            title,
            description=says,
            in_out="OUTPUT",
            socket_type="NodeSocketVector" if title == LIGHT else "NodeSocketFloat",
        )
    made = _Sums(tree)
    for number, (region, mask) in enumerate(shown):
        made.add(region, _weight(tree, number, region, mask, changes), -700 * number)
    made.finish()
    return tree


def _weight(
    tree: Any, number: int, region: Region, mask: ShownMask | None, changes: Changes
) -> Any:
    """What gives the strength of a region at a point: a socket."""
    y = -700 * number
    if mask is None:
        amount = _node(tree, Role("ShaderNodeValue", f"Strength, {region.label}", (-800, y)))
        amount.outputs[0].default_value = region.strength
    else:
        amount = _masked(tree, f"region_{number}_", region, mask, changes)
    if region.spots is None:
        return amount.outputs[0]
    return _spots(tree, region, amount.outputs[0], y)


def _masked(tree: Any, prefix: str, region: Region, mask: ShownMask, changes: Changes) -> Any:
    share = mask_nodes.added(tree, mask, changes, prefix)
    amount = _node(
        tree,
        math_role("MULTIPLY", f"Strength, {region.label}", (-800, 0), at_1=region.strength),
    )
    tree.links.new(share.outputs[0], amount.inputs[0])
    return amount


def _spots(tree: Any, region: Region, amount: Any, y: int) -> Any:
    """The region's strength within spots, a socket; there are more of them where there is more."""
    spots = region.spots
    assert spots is not None
    cells = _node(tree, Role("ShaderNodeTexVoronoi", "Places of spots", (-800, y - 200)))
    nodes.find_input(cells, "Scale").default_value = 1.0 / spots.apart
    nodes.find_input(cells, "Randomness").default_value = SPREAD
    tree.links.new(_place(tree).outputs[0], nodes.find_input(cells, "Vector"))
    chance = _node(tree, Role("ShaderNodeSeparateXYZ", "Chance", (-600, y - 300)))
    tree.links.new(cells.outputs["Color"], chance.inputs[0])
    square = _math(tree, "MULTIPLY", "Most are small", (-400, y - 300), chance.outputs[0])
    tree.links.new(chance.outputs[0], square.inputs[1])
    # Distances are in units of `apart`.
    least, largest = (0.5 * end / spots.apart for end in (spots.least, spots.largest))
    radius = _math(tree, "MULTIPLY_ADD", "Radius", (-200, y - 300), square.outputs[0])
    radius.inputs[1].default_value, radius.inputs[2].default_value = largest - least, least
    inside = _math(tree, "SUBTRACT", "From the edge", (0, y - 200), radius.outputs[0])
    tree.links.new(cells.outputs["Distance"], inside.inputs[1])
    edge = _node(tree, Role("ShaderNodeMapRange", "Soft edge", (150, y - 200)))
    edge.interpolation_type = "SMOOTHSTEP"
    nodes.find_input(edge, "From Max").default_value = spots.edge / spots.apart
    tree.links.new(inside.outputs[0], nodes.find_input(edge, "Value"))
    few = _math(tree, "MULTIPLY", "Share of places", (-400, y - 100), amount)
    few.inputs[1].default_value = spots.held
    held = _math(tree, "LESS_THAN", "Whether there is one", (-200, y - 100), chance.outputs[1])
    tree.links.new(few.outputs[0], held.inputs[1])
    spot = _math(tree, "MULTIPLY", "Spot", (300, y - 100), held.outputs[0])
    tree.links.new(nodes.find_output(edge, "Result"), spot.inputs[1])
    unlike = _math(tree, "MULTIPLY_ADD", "Some are stronger", (300, y - 300), chance.outputs[2])
    low, high = (region.strength * end for end in UNLIKE)
    unlike.inputs[1].default_value, unlike.inputs[2].default_value = high - low, low
    weight = _math(tree, "MULTIPLY", "Strength in spots", (450, y), spot.outputs[0])
    tree.links.new(unlike.outputs[0], weight.inputs[1])
    return weight.outputs[0]


def _place(tree: Any) -> Any:
    """The node that tells the place on the mesh at rest in mm, bent; one serves all spots."""
    place = next(nodes.of_role(tree, PLACE), None)
    if place is None:
        rest = _node(tree, Role("ShaderNodeTexCoord", "Place on the mesh at rest", (-1200, 300)))
        place = _node(
            tree,
            Role("ShaderNodeVectorMath", "Place in mm", (-1000, 300), {"operation": "MULTIPLY"}),
        )
        place.name = ROLE_PREFIX + PLACE
        tree.links.new(rest.outputs["Generated"], place.inputs[0])
        noise = _node(tree, Role("ShaderNodeTexNoise", "Spots are not round", (-1000, 600)))
        nodes.find_input(noise, "Scale").default_value = BENT_PER_MILLIMETRE
        nodes.find_input(noise, "Detail").default_value = 0.0
        tree.links.new(place.outputs[0], nodes.find_input(noise, "Vector"))
        bent = _node(
            tree,
            Role(
                "ShaderNodeVectorMath",
                "Bent place",
                (-800, 450),
                {"operation": "MULTIPLY_ADD"},
                {1: (BENT_MILLIMETRES,) * 3},
            ),
        )
        bent.name = ROLE_PREFIX + BENT
        tree.links.new(noise.outputs["Color"], bent.inputs[0])
        tree.links.new(place.outputs[0], bent.inputs[2])
    return next(nodes.of_role(tree, BENT))


class _Sums:
    """The outputs of the group, as regions are added."""

    def __init__(self, tree: Any) -> None:
        self._tree = tree
        self._more: Any = None
        self._less: Any = None
        self._blood: Any = None
        self._tan: Any = None
        self._light: Any = None

    def add(self, region: Region, weight: Any, y: int) -> None:
        """Add a region with the socket that gives its weight."""
        tree = self._tree
        if region.melanin not in (0.0, 1.0):
            self._more = self._sum(self._more, weight, region.melanin, "Melanin", (700, y))
        if region.blood != 1.0:
            self._blood = self._sum(self._blood, weight, region.blood, "Blood", (700, y - 200))
        if region.colour != (1.0, 1.0, 1.0):
            self._add_light(weight, region.colour, (700, y + 200))
        if region.melanin == 0.0:
            left = _math(tree, "MULTIPLY_ADD", "Melanin that is left", (700, y - 400), weight)
            left.inputs[1].default_value, left.inputs[2].default_value = -1.0, 1.0
            left.use_clamp = True
            self._less = self._product(self._less, left.outputs[0], (900, y - 400))
        elif region.tan != 1.0:
            part = _math(tree, "MINIMUM", "At most all", (700, y - 400), weight)
            part.inputs[1].default_value = 1.0
            tans = _math(tree, "MULTIPLY_ADD", "How it tans", (850, y - 400), part.outputs[0])
            tans.inputs[1].default_value, tans.inputs[2].default_value = region.tan - 1.0, 1.0
            self._tan = self._product(self._tan, tans.outputs[0], (1000, y - 400))

    def finish(self) -> None:
        """Link the outputs."""
        tree = self._tree
        output = _node(tree, Role("NodeGroupOutput", "", (1700, 0)))
        melanin = self._less
        if self._more is not None:
            melanin = _math(tree, "EXPONENT", "Melanin", (1300, 0), self._more).outputs[0]
            melanin = self._product(self._less, melanin, (1500, 0))
        for name, start, nothing in (
            ("Melanin", melanin, 1.0),
            ("Blood", self._blood, 0.0),
            ("Tan", self._tan, 1.0),
        ):
            if start is None:
                value = _node(tree, Role("ShaderNodeValue", f"No change: {name}", (1300, -300)))
                value.outputs[0].default_value, start = nothing, value.outputs[0]
            tree.links.new(start, output.inputs[name])
        tree.links.new(self._light_of_all(), output.inputs[LIGHT])

    def _add_light(self, weight: Any, colour: tuple[float, ...], at: tuple[int, int]) -> None:
        role = vector_role("MULTIPLY_ADD", "Light, logarithm", at, at_2=(0.0,) * 3)
        node = _node(self._tree, role)
        node.inputs[1].default_value = tuple(map(math.log, colour))
        self._tree.links.new(weight, node.inputs[0])
        if self._light is not None:
            self._tree.links.new(self._light, node.inputs[2])
        self._light = node.outputs[0]

    def _light_of_all(self) -> Any:
        """The socket of the colour's factor."""
        tree = self._tree
        joined = _node(tree, Role("ShaderNodeCombineXYZ", "Light", (1500, 300)))
        for end in joined.inputs:
            end.default_value = 1.0
        if self._light is not None:
            parts = _node(tree, Role("ShaderNodeSeparateXYZ", "By channel", (1150, 300)))
            tree.links.new(self._light, parts.inputs[0])
            for part, end in zip(parts.outputs, joined.inputs, strict=True):
                factor = _math(tree, "EXPONENT", "Light of a channel", (1300, 300), part)
                tree.links.new(factor.outputs[0], end)
        return joined.outputs[0]

    def _sum(self, former: Any, weight: Any, factor: float, label: str, at: tuple) -> Any:
        node = _math(self._tree, "MULTIPLY_ADD", f"{label}, logarithm", at, weight)
        node.inputs[1].default_value = math.log(factor)
        node.inputs[2].default_value = 0.0
        if former is not None:
            self._tree.links.new(former, node.inputs[2])
        return node.outputs[0]

    def _product(self, former: Any, factor: Any, at: tuple[int, int]) -> Any:
        if former is None:
            return factor
        node = _math(self._tree, "MULTIPLY", "All together", at, former)
        self._tree.links.new(factor, node.inputs[1])
        return node.outputs[0]


def _math(tree: Any, operation: str, label: str, at: tuple[int, int], first: Any) -> Any:
    node = _node(tree, math_role(operation, label, at))
    tree.links.new(first, node.inputs[0])
    return node


def _node(tree: Any, role: Role) -> Any:
    """A node as a role describes it."""
    node = tree.nodes.new(role.kind)
    node.label, node.location = role.label, role.location
    for name, value in role.values.items():
        setattr(node, name, value)
    for socket, value in role.inputs.items():
        nodes.find_input(node, socket).default_value = value
    return node
