"""The group of nodes that computes the state of a skin from the shares of several masks.

`blender_addon.model.basis` says what it adds up, and `blender_addon.model.grid` how it finds
coefficients by shares.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import bpy

from . import mask_nodes
from .changes import Changes
from .mask_nodes import ShownMask
from .plan import ROLE_PREFIX

ATTRIBUTES_KEY = "skin_tan_basis"
"""Custom property of our groups of nodes, and in earlier versions of a mesh: the attributes that
Apply made for several masks, as JSON."""

MASKS_KEY = "skin_tan_masks"
"""Custom property of a group that reads masks: which, in words."""

DAYS = "basis_days"
"""Role of the node that shows where days lie among the rows."""


@dataclass(frozen=True, eq=False)
class Basis:
    """Images of a time basis.

    Attributes
    ----------
    rank : int
        Number of shapes.
    parts, step : int
        Number of parts of the days; rows from the first one of a part to that of the next.
    rows, days : Image
        Mean and shapes by day; where a day lies among the rows.
    """

    rank: int
    parts: int
    step: int
    rows: bpy.types.Image
    days: bpy.types.Image


@dataclass(frozen=True, eq=False)
class Grid:
    """Coefficients over shares.

    Attributes
    ----------
    images : sequence of Image
        Of three coefficients each.
    places : Image
        Of shares among the knots of masks, and the masks' weights in the share of all doses.
    """

    images: Sequence[bpy.types.Image]
    places: bpy.types.Image


def over_shares(
    name: str, basis: Basis, grid: Grid, masks: Sequence[ShownMask], changes: Changes
) -> bpy.types.NodeTree:
    """Nodes that read masks, and coefficients by their shares."""
    made = _Tree(name)
    shares = []
    for number, mask in enumerate(masks):
        share = mask_nodes.added(made.tree, mask, changes, f"mask_{number}_")
        shares.append(share.outputs[0])
    whole = _share_of_all(made, grid.places, shares)
    day, part = made.day(basis)
    points = _points(made, grid, shares, part, basis.parts)
    coefficients: list[Any] = []
    for number, image in enumerate(grid.images):
        total = None
        for place, weight in points:
            label = f"Coefficients {3 * number + 1} to {3 * number + 3}"
            total = made.sum(made.image(image, label, place, closest=True), weight, total)
        coefficients += made.parts(total, made.at)
    return made.finished(basis, day, coefficients, whole)


def peeling_of_masks(
    name: str, image: bpy.types.Image, masks: Sequence[ShownMask], changes: Changes
) -> bpy.types.NodeTree:
    """Nodes that read what peels under several masks: the most of all.

    Parameters
    ----------
    image : Image
        By days and shares of every mask, one mask above the other.
    """
    made = _Tree(name)
    sockets = made.tree.interface
    sockets.new_socket("Day", in_out="INPUT", socket_type="NodeSocketFloat")
    sockets.new_socket("Peeling", in_out="OUTPUT", socket_type="NodeSocketVector")
    given, end = made.node("NodeGroupInput", ""), made.node("NodeGroupOutput", "")
    half = 0.5 * len(masks) / image.size[1]
    some = made.math("MAXIMUM", "First row or later", given.outputs["Day"], half)
    row = made.math("MINIMUM", "Last row or before", some, 1.0 - half)
    most = None
    for number, mask in enumerate(masks):
        share = mask_nodes.added(made.tree, mask, changes, f"mask_{number}_")
        y = made.math("MULTIPLY_ADD", "Row", row, 1.0 / len(masks), number / len(masks))
        told = made.image(image, "Peeling", made.place(share.outputs[0], y))
        most = told if most is None else made.vector("MAXIMUM", "Most", most, told)
    made.tree.links.new(most, end.inputs["Peeling"])
    return made.tree


def _share_of_all(made: "_Tree", places: bpy.types.Image, shares: Sequence[Any]) -> Any:
    """The share of all doses: one of the shares, each with its weight."""
    rows = places.size[1]
    weights: list[Any] = []
    while len(weights) < len(shares):
        y = (len(shares) + len(weights) // 3 + 0.5) / rows
        told = made.image(places, "Weights", made.place(0.5, y), closest=True)
        weights += made.parts(told, made.at)
    whole = 0.0
    for share, weight in zip(shares, weights, strict=False):
        whole = made.math("MULTIPLY_ADD", "Share of all doses", share, weight, whole)
    return whole


def _points(
    made: "_Tree", grid: Grid, shares: Sequence[Any], part: Any, parts: int
) -> list[tuple[Any, Any]]:
    """Places in an image of the points around some shares, in a part of the days; their weights."""
    columns, rows = grid.places.size
    first: Any = 0.0
    last: Any = 0.0
    along, apart = [], []
    for mask, share in enumerate(shares):
        x = made.math("MULTIPLY_ADD", "Step", share, (columns - 1) / columns, 0.5 / columns)
        place = made.place(x, (mask + 0.5) / rows)
        told = made.parts(made.image(grid.places, "Knot", place, closest=True), made.at)
        first = made.math("ADD", "First point", told[0], first)
        last = made.math("SUBTRACT", "Last point", last, told[2])
        along.append(told[1])
        apart.append(told[2])
    last = made.math("ADD", "Last point", last, first)
    ordered = _descending(made, along)
    size = tuple(grid.images[0].size)
    start = made.math("MULTIPLY_ADD", "Row of the part", part, 1.0 / parts, 0.5 / size[1])
    points = []
    for k, (before, after) in enumerate(zip([1.0, *ordered], [*ordered, 0.0], strict=True)):
        number = last if k else first
        # With the last one every mask is at its next knot.
        for own, stride in zip(along, apart, strict=True) if 0 < k < len(along) else ():
            is_less = made.math("LESS_THAN", "Whether it goes later", own, before)
            number = made.math("MULTIPLY_ADD", "Point", is_less, stride, number)
        weight = made.math("SUBTRACT", "Weight of the point", before, after)
        points.append((_texel(made, number, size, start), weight))
    return points


def _descending(made: "_Tree", values: Sequence[Any]) -> list[Any]:
    """Values in descending order."""
    ordered: list[Any] = []
    for value in values:
        smaller = value
        for place, other in enumerate(ordered):
            ordered[place] = made.math("MAXIMUM", "Order", other, smaller)
            smaller = made.math("MINIMUM", "Order", other, smaller)
        ordered.append(smaller)
    return ordered


def _texel(made: "_Tree", number: Any, size: Sequence[int], start: Any) -> Any:
    """The middle of a texel that has a number, row by row from a start."""
    columns, rows = size
    place = made.math("MULTIPLY_ADD", "Place", number, 1.0 / columns, 0.5 / columns)
    row = made.math("FLOOR", "Row", place)
    y = made.math("MULTIPLY_ADD", "Row", row, 1.0 / rows, start)
    return made.place(made.math("SUBTRACT", "Column", place, row), y)


class _Tree:
    """A group of nodes that is being made."""

    def __init__(self, name: str) -> None:
        self.tree: Any = bpy.data.node_groups.new(name, "ShaderNodeTree")
        self.tree[ATTRIBUTES_KEY] = "[]"
        self.at = (0, 0)

    def day(self, basis: Basis) -> tuple[Any, Any]:
        """The row of the day that shows among those of all parts, from 0 to 1; and the part."""
        socket = self.tree.interface.new_socket
        socket("Day", in_out="INPUT", socket_type="NodeSocketFloat")
        given = self.node("NodeGroupInput", "")
        days = self.image(basis.days, "Rows of days", given.outputs[0])
        days.node.name = ROLE_PREFIX + DAYS
        place = self.parts(days, self.at)[1]
        rows, step = basis.rows.size[1], float(basis.step)
        count = rows - basis.parts + 1
        passed = self.math("MULTIPLY_ADD", "Parts passed", place, count / step, -0.5 / step)
        whole = self.math("FLOOR", "Part of the day", passed)
        part = self.math("MINIMUM", "Part", whole, basis.parts - 1.0)
        own = self.math("MULTIPLY_ADD", "Row", place, count / rows, 0.0)
        return self.math("MULTIPLY_ADD", "Row among all", part, 1.0 / rows, own), part

    def finished(self, basis: Basis, row: Any, coefficients: Sequence[Any], share: Any) -> Any:
        """The tree, which adds up mean and shapes by the coefficients."""
        tree, sockets = self.tree, self.tree.interface
        sockets.new_socket("State", in_out="OUTPUT", socket_type="NodeSocketVector")
        sockets.new_socket("Share", in_out="OUTPUT", socket_type="NodeSocketFloat")
        end = self.node("NodeGroupOutput", "")
        total = None
        for k, coefficient in enumerate((None, *coefficients)):
            x = (k + 0.5) / (basis.rank + 1)
            shape = self.image(basis.rows, f"Shape {k}" if k else "Mean", self.place(x, row))
            total = shape if total is None else self.sum(shape, coefficient, total)
        tree.links.new(total, end.inputs["State"])
        tree.links.new(share, end.inputs["Share"])
        return tree

    def node(self, kind: str, label: str, at: tuple[int, int] | None = None) -> Any:
        node = self.tree.nodes.new(kind)
        self.at = at or (self.at[0] + 200, self.at[1] - 40)
        node.label, node.location = label, self.at
        return node

    def image(
        self, image: bpy.types.Image, label: str, place: Any, *, closest: bool = False
    ) -> Any:
        """The colour of an image at a place."""
        node = self.node("ShaderNodeTexImage", label)
        node.image, node.extension = image, "EXTEND"
        node.interpolation = "Closest" if closest else "Linear"
        self.tree.links.new(place, node.inputs["Vector"])
        return node.outputs["Color"]

    def place(self, x: Any, y: Any) -> Any:
        """A place in an image."""
        node = self.node("ShaderNodeCombineXYZ", "Place")
        for end, value in zip(node.inputs, (x, y), strict=False):
            self._give(end, value)
        return node.outputs[0]

    def parts(self, vector: Any, at: tuple[int, int]) -> Sequence[Any]:
        node = self.node("ShaderNodeSeparateXYZ", "Parts", at)
        self.tree.links.new(vector, node.inputs[0])
        return list(node.outputs)

    def math(self, operation: str, label: str, *values: Any) -> Any:
        """A number from numbers and sockets."""
        node = self.node("ShaderNodeMath", label)
        node.operation = operation
        for end, value in zip(node.inputs, values, strict=False):
            self._give(end, value)
        return node.outputs[0]

    def vector(self, operation: str, label: str, *values: Any) -> Any:
        """A vector from vectors."""
        node = self.node("ShaderNodeVectorMath", label)
        node.operation = operation
        for end, value in zip(node.inputs, values, strict=False):
            self._give(end, value)
        return node.outputs[0]

    def sum(self, vector: Any, weight: Any, former: Any) -> Any:
        """A weighted vector, and what is there before."""
        node = self.node("ShaderNodeVectorMath", "Add")
        node.operation = "MULTIPLY_ADD"
        self.tree.links.new(vector, node.inputs[0])
        self.tree.links.new(weight, node.inputs[1])
        if former is not None:
            self.tree.links.new(former, node.inputs[2])
        return node.outputs[0]

    def _give(self, end: Any, value: Any) -> None:
        if isinstance(value, float):
            end.default_value = value
        else:
            self.tree.links.new(value, end)
