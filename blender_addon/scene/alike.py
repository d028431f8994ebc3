"""Whether two node trees, or two materials, are alike in all that shows."""

from collections.abc import Mapping
from typing import Any

import bpy

from .animated import actions
from .ownership import FORMER, MADE

COSMETIC = frozenset(
    """
    rna_type name name_full select show_expanded inputs outputs internal_links active_item
    session_uid is_evaluated original users use_fake_user use_extra_user is_embedded_data is_missing
    is_runtime_data is_editable is_library_indirect library library_weak_reference asset_data tag
    override_library preview animation_data id_type texture_paint_images
    texture_paint_slots lineart grease_pencil bl_system_properties_get use_nodes nodes links
    interface view_center paint_active_slot paint_clone_slot is_linked_packed
    """.split()
)
"""Properties that show in no picture, or are compared apart."""

PLACES = frozenset("location location_absolute width height dimensions parent".split())
"""Where a node lies in its editor."""

OURS = frozenset((FORMER, MADE, "skin_tan_relinked", "skin_tan_waits"))
DEPTH = 8
"""How deep structures lie inside a node's: a curve's mapping, its curves, their points."""


def alike(one: Any, other: Any, stands_for: Mapping[Any, Any]) -> bool:
    """Whether two materials or two node groups are alike.

    Parameters
    ----------
    stands_for : mapping
        Data-blocks of the first that count as others.
    """
    if isinstance(one, bpy.types.Material):
        values = [_values(block, {}, leave=frozenset(["node_tree"])) for block in (one, other)]
        return values[0] == values[1] and _is_same_tree(one.node_tree, other.node_tree, stands_for)
    return _is_same_tree(one, other, stands_for)


def _is_same_tree(one: Any, other: Any, stands_for: Mapping[Any, Any]) -> bool:
    if one is None or other is None:
        return one == other
    return _tree(one, stands_for) == _tree(other, {})


def _tree(tree: Any, stands_for: Mapping[Any, Any]) -> tuple[Any, ...]:
    sockets = [_values(item, stands_for) for item in tree.interface.items_tree]
    nodes = {node.name: _node(node, stands_for) for node in tree.nodes}
    links = {
        (
            link.from_node.name,
            link.from_socket.identifier,
            link.to_node.name,
            link.to_socket.identifier,
            link.is_muted,
        )
        for link in tree.links
    }
    return sockets, nodes, links, _animation(tree), _keys(tree)


def _node(node: Any, stands_for: Mapping[Any, Any]) -> tuple[Any, ...]:
    ends = [
        (end.identifier, _plain(getattr(end, "default_value", None), stands_for, DEPTH))
        for end in (*node.inputs, *node.outputs)
    ]
    return node.bl_idname, _values(node, stands_for, leave=PLACES), ends, _keys(node)


def _values(
    struct: Any,
    stands_for: Mapping[Any, Any],
    depth: int = DEPTH,
    leave: frozenset[str] = frozenset(),
) -> dict[str, Any]:
    """All that can be set on a structure, by name."""
    values = {
        prop.identifier: _plain(getattr(struct, prop.identifier), stands_for, depth)
        for prop in struct.bl_rna.properties
        if prop.identifier not in COSMETIC | leave
    }
    if isinstance(struct, bpy.types.ID):
        values["custom"], values["animation"] = _keys(struct), _animation(struct)
    return values


def _plain(value: Any, stands_for: Mapping[Any, Any], depth: int) -> Any:
    if isinstance(value, bpy.types.ID):
        return stands_for.get(value, value)
    if isinstance(value, bpy.types.bpy_struct):
        return _values(value, stands_for, depth - 1) if depth else None
    if isinstance(value, bpy.types.bpy_prop_collection):
        return [_plain(member, stands_for, depth - 1) for member in value] if depth else None
    return tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value


def _animation(block: Any) -> tuple[Any, ...] | None:
    animation = block.animation_data
    if animation is None:
        return None
    return actions(animation), len(animation.drivers)


def _keys(block: Any) -> dict[str, Any]:
    """Custom properties that are not ours, as plain values."""
    keys = {}
    for key, value in block.items():
        if key not in OURS:
            plain = getattr(value, "to_dict", None) or getattr(value, "to_list", None)
            keys[key] = plain() if plain else value
    return keys
