"""The group of nodes that computes the state of a skin from the shares of several masks.

`blender_addon.model.basis` says what it adds up, and `blender_addon.model.grid` how it finds
coefficients by shares.
"""

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import bpy

from . import mask_nodes
from .changes import Changes
from .mask_nodes import ShownMask
from .plan import ROLE_KEY

ATTRIBUTES_KEY = "skin_tan_basis"
"""Custom property of a mesh: names of the attributes that Apply made for several masks, as JSON.
Of a group of nodes: those that it reads."""

VALUES_OF_ATTRIBUTE = 4

SLICED = 2
"""With more masks images have slices."""


@dataclass(frozen=True, eq=False)
class Basis:
    """Images of a time basis.

    Attributes
    ----------
    rank : int
        Number of shapes.
    rows, days : Image
        Mean and shapes by day; where a day lies among the rows.
    """

    rank: int
    rows: bpy.types.Image
    days: bpy.types.Image


@dataclass(frozen=True, eq=False)
class Grid:
    """Coefficients over shares.

    Attributes
    ----------
    images : sequence of Image
        Of three coefficients each.
    steps : int
        Of a share.
    weights : sequence of float
        Of the masks' shares in the share of all doses.
    """

    images: Sequence[bpy.types.Image]
    steps: int
    weights: Sequence[float]


@dataclass(frozen=True, eq=False)
class Palette:
    """Coefficients by texels, as `blender_addon.model.palette` has them.

    Attributes
    ----------
    index : Image
        Which of the palette each texel has.
    images : sequence of Image
        The palette: of three values each, the last of which is the share of all doses.
    uv_map : str
        Where the texels lie; empty for the map that renders.
    """

    index: bpy.types.Image
    images: Sequence[bpy.types.Image]
    uv_map: str


def on_mesh(name: str, basis: Basis, names: Sequence[str]) -> bpy.types.NodeTree:
    """Nodes that read coefficients, and last the share of all doses, from attributes."""
    made = _Tree(name, names)
    coefficients: list[Any] = []
    for number, attribute in enumerate(names[:-1]):
        read = made.attribute(attribute, f"Coefficients {number + 1}", (200, -400 - 400 * number))
        parts = made.parts(read.outputs["Color"], (400, -400 - 400 * number))
        coefficients += [*parts, read.outputs["Alpha"]]
    share = made.attribute(names[-1], "Share of all doses", (200, -800 - 400 * len(names)))
    return made.finished(basis, coefficients, share.outputs["Fac"])


def over_shares(
    name: str, basis: Basis, grid: Grid, masks: Sequence[ShownMask], changes: Changes
) -> bpy.types.NodeTree:
    """Nodes that read masks, and coefficients by their shares."""
    made = _Tree(name, ())
    shares = []
    for number, mask in enumerate(masks):
        share = mask_nodes.added(made.tree, mask, changes, f"mask_{number}_")
        shares.append(share.outputs[0])
    whole = None
    for share, weight in zip(shares, grid.weights, strict=True):
        whole = made.math("MULTIPLY_ADD", "Share of all doses", share, weight, whole or 0.0)
    coefficients = [part for texel in _texels(made, grid, shares) for part in texel]
    return made.finished(basis, coefficients, whole)


def over_texels(name: str, basis: Basis, palette: Palette) -> bpy.types.NodeTree:
    """Nodes that read which tan the four nearest texels have, and the coefficients of those."""
    made = _Tree(name, ())
    uv = made.node("ShaderNodeUVMap", "UV map of the texels")
    uv.uv_map = palette.uv_map
    columns, rows = palette.index.size
    place = made.scaled(uv.outputs["UV"], (columns, rows, 0.0), (-0.5, -0.5, 0.0), "In texels")
    low = made.vector("FLOOR", "Texel", place)
    part = made.parts(made.vector("SUBTRACT", "Part of the next texel", place, low), made.at)
    parts = [
        (made.math("SUBTRACT", "Part of the texel", 1.0, part[axis]), part[axis]) for axis in (0, 1)
    ]
    size = palette.images[0].size
    across, up = 1.0 / columns, 1.0 / rows
    totals: list[Any] = [None] * len(palette.images)
    for right, above in ((0, 0), (1, 0), (0, 1), (1, 1)):
        offset = ((right + 0.5) * across, (above + 0.5) * up, 0.0)
        texel = made.scaled(low, (across, up, 0.0), offset, "Middle of a texel")
        index = made.image(palette.index, "Which tan", texel, closest=True)
        scale, start = (255.0 / size[0], 255.0 / size[1], 0.0), (0.5 / size[0], 0.5 / size[1], 0.0)
        colour = made.scaled(index, scale, start, "Place in the palette")
        weight = made.math("MULTIPLY", "Part", parts[0][right], parts[1][above])
        for number, image in enumerate(palette.images):
            value = made.image(image, f"Palette {number + 1}", colour, closest=True)
            totals[number] = made.sum(value, weight, totals[number])
    *coefficients, share = [value for total in totals for value in made.parts(total, made.at)]
    return made.finished(basis, coefficients, share)


def peeling_of_masks(
    name: str, image: bpy.types.Image, masks: Sequence[ShownMask], changes: Changes
) -> bpy.types.NodeTree:
    """Nodes that read what peels under several masks: the most of all.

    Parameters
    ----------
    image : Image
        By days and shares of every mask, one mask above the other.
    """
    made = _Tree(name, ())
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


def _texels(made: "_Tree", grid: Grid, shares: Sequence[Any]) -> Iterator[Sequence[Any]]:
    """Three coefficients at a time."""
    steps = grid.steps
    x = made.math(
        "MULTIPLY_ADD", "Column of the share", shares[0], (steps - 1.0) / steps, 0.5 / steps
    )
    sliced = len(shares) > SLICED
    taps = _slices(made, steps, shares[1], shares[2]) if sliced else [(shares[1], 0.0, None)]
    slices = steps if sliced else 1
    step = (steps - 1.0) / (steps * slices)
    places = []
    for share, number, weight in taps:
        start = 0.5 / (steps * slices)
        if sliced:
            start = made.math("MULTIPLY_ADD", "Row of the slice", number, 1.0 / slices, start)
        y = made.math("MULTIPLY_ADD", "Row of the share", share, step, start)
        places.append((made.place(x, y), weight))
    for number, image in enumerate(grid.images):
        total = None
        for place, weight in places:
            texel = made.image(image, f"Coefficients {3 * number + 1} to {3 * number + 3}", place)
            total = texel if weight is None else made.sum(texel, weight, total)
        yield made.parts(total, made.at)


def _slices(made: "_Tree", steps: int, share: Any, across: Any) -> list[tuple[Any, Any, Any]]:
    """Of the slices below and above: the share in it, its number, its weight."""
    place = made.math("MULTIPLY", "Slice of the share", across, steps - 1.0)
    whole = made.math("FLOOR", "Slice", place)
    below = made.math("MINIMUM", "Slice below", whole, steps - 2.0)
    part = made.math("SUBTRACT", "Part of the slice above", place, below)
    rest = made.math("SUBTRACT", "Part of the slice below", 1.0, part)
    odd = made.math("MODULO", "Whether it is upside down", below, 2.0)
    other = made.math("SUBTRACT", "Whether the one above is", 1.0, odd)
    above = made.math("ADD", "Slice above", below, 1.0)
    return [
        (_turned(made, odd, share), below, rest),
        (_turned(made, other, share), above, part),
    ]


def _turned(made: "_Tree", odd: Any, share: Any) -> Any:
    """The share, or what it lacks of 1 where a slice is upside down."""
    less = made.math("SUBTRACT", "Upside down", odd, share)
    return made.math("ABSOLUTE", "Share in the slice", less)


class _Tree:
    """A group of nodes that is being made."""

    def __init__(self, name: str, attributes: Sequence[str]) -> None:
        self.tree: Any = bpy.data.node_groups.new(name, "ShaderNodeTree")
        self.tree[ATTRIBUTES_KEY] = json.dumps(list(attributes))
        self.at = (0, 0)

    def finished(self, basis: Basis, coefficients: Sequence[Any], share: Any) -> Any:
        """The tree, which adds up mean and shapes by the coefficients."""
        tree, sockets = self.tree, self.tree.interface
        sockets.new_socket("Day", in_out="INPUT", socket_type="NodeSocketFloat")
        sockets.new_socket("State", in_out="OUTPUT", socket_type="NodeSocketVector")
        sockets.new_socket("Share", in_out="OUTPUT", socket_type="NodeSocketFloat")
        given, end = self.node("NodeGroupInput", ""), self.node("NodeGroupOutput", "")
        day = self.image(basis.days, "Rows of days", given.outputs["Day"])
        row = self.parts(day, (-500, 0))[1]
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
        node.label, node.location, node[ROLE_KEY] = label, self.at, "basis"
        return node

    def attribute(self, name: str, label: str, at: tuple[int, int]) -> Any:
        node = self.node("ShaderNodeAttribute", label, at)
        node.attribute_type, node.attribute_name = "GEOMETRY", name
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

    def scaled(self, vector: Any, scale: tuple, offset: tuple, label: str) -> Any:
        """A vector times numbers, and others added."""
        return self.vector("MULTIPLY_ADD", label, vector, scale, offset)

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
        if isinstance(value, float | int | tuple):
            end.default_value = value
        else:
            self.tree.links.new(value, end)
