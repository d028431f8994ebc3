"""Where a node of a tan's group samples its image: coordinates times a scale, plus a start.

The node keeps these numbers itself (in the sidebar, Texture Mapping), so that they take no nodes.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from .changes import Changes
from .plan import LIGHT
from .sampled import Sampled

UNTANNED = (1.0, 0.0)
"""Root of melanin, and logarithm of blood, of skin without sun."""

MAPPING = ("scale", "translation")
"""Attributes of a node's mapping that are set."""


@dataclass(frozen=True)
class Place:
    """How coordinates (x, y) lead to texture coordinates."""

    scale: tuple[float, float]
    start: tuple[float, float]

    def at(self, place: tuple[float, float]) -> tuple[float, float]:
        """Texture coordinates of coordinates."""
        x, y = (s * value + t for s, value, t in zip(self.scale, place, self.start, strict=True))
        return x, y

    def mapping(self) -> dict[str, Any]:
        """The attributes of `MAPPING`."""
        return {"scale": (*self.scale, 1.0), "translation": (*self.start, 0.0)}


def of_roles(sampled: Sampled) -> dict[str, Place]:
    """Where nodes sample the images of a tan, by their roles."""
    steps = sampled.places.size[0]
    shares = _line((0.0, 1.0), *_ends(steps))
    days = _line((sampled.first_day, sampled.last_day), *_ends(steps))
    columns, rows = sampled.look["colours"].size
    half, whole = rows // 2, sampled.look["light"].size[1]
    colour = _of_look(sampled, (0, half - 1), rows)
    angle = _line((0.0, 1.0), *_ends(columns))
    return {
        "columns": Place((shares[0], 0.0), (shares[1], 0.25)),
        "rows": Place((days[0], 0.0), (days[1], 0.75)),
        "colour": colour,
        "untanned": Place((0.0, 0.0), colour.at(UNTANNED)),
        "thick_colour": _of_look(sampled, (rows - 1, half), rows),
        **{
            role: _of_look(sampled, (half * block, half * (block + 1) - 1), whole)
            for block, role in enumerate(LIGHT)
        },
        "peel_image": Place((shares[0], days[0]), (shares[1], days[1])),
        "let_through": Place((angle[0], 0.0), (angle[1], (whole - 0.5) / whole)),
    }


def set_place(node: Any, place: Place, changes: Changes) -> None:
    """Have a node sample its image at a place."""
    _set(node, place.mapping(), changes)


def copy_place(source: Any, node: Any, changes: Changes) -> None:
    """Have a node sample its image where another samples its own."""
    _set(node, {name: getattr(source.texture_mapping, name) for name in MAPPING}, changes)


def _set(node: Any, mapping: dict[str, Any], changes: Changes) -> None:
    for name, value in mapping.items():
        changes.set(node.texture_mapping, name, value)


def _of_look(sampled: Sampled, ends: tuple[int, int], rows: int) -> Place:
    """Over square roots of melanin and logarithms of blood, which mean two rows of some."""
    x = _line(sampled.melanin, *_ends(sampled.look["colours"].size[0]))
    y = _line(sampled.blood, *((row + 0.5) / rows for row in ends))
    return Place((x[0], y[0]), (x[1], y[1]))


def _ends(texels: int) -> Iterator[float]:
    """Middles of the first and of the last texel."""
    return iter((0.5 / texels, 1.0 - 0.5 / texels))


def _line(ends: tuple[float, float], low: float, high: float) -> tuple[float, float]:
    """Slope and start of what leads from two ends to two places; the first where both are one."""
    slope = (high - low) / (ends[1] - ends[0]) if ends[1] > ends[0] else 0.0
    return slope, low - slope * ends[0]
