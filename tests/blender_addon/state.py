"""All of a file that Apply may change and Remove Tan gives back, as plain values."""

import bpy
from bpy_extras.anim_utils import action_get_channelbag_for_slot

COLLECTIONS = ("images", "materials", "node_groups", "actions", "meshes", "objects")


def state() -> dict:
    """By data-block; whatever order Blender keeps is kept too."""
    blocks = [block for name in COLLECTIONS for block in getattr(bpy.data, name)]
    return {
        "blocks": {name: [b.name for b in getattr(bpy.data, name)] for name in COLLECTIONS},
        "fake": [block.name for block in blocks if block.use_fake_user],
        "groups": {group.name: of_tree(group) for group in bpy.data.node_groups},
        "materials": {m.name: (of_tree(m.node_tree), keys(m)) for m in bpy.data.materials},
        "objects": {obj.name: of_object(obj) for obj in bpy.data.objects if obj.type == "MESH"},
        "actions": {action.name: of_action(action) for action in bpy.data.actions},
    }


def of_tree(tree) -> tuple:
    if tree is None:
        return ()
    nodes = [
        (
            node.bl_idname,
            node.name,
            node.label,
            tuple(node.location),
            (node.width, node.height, node.mute, node.hide),
            named(node.parent),
            [named(getattr(node, name, None)) for name in ("image", "node_tree", "operation")],
            [(end.identifier, plain(end), end.hide) for end in (*node.inputs, *node.outputs)],
            keys(node),
        )
        for node in tree.nodes
    ]
    links = [
        (
            link.from_node.name,
            link.from_socket.identifier,
            link.to_node.name,
            link.to_socket.identifier,
            link.is_muted,
        )
        for link in tree.links
    ]
    active = tree.nodes.active and tree.nodes.active.name
    return nodes, links, active, keys(tree)


def named(block):
    """A block by its name, since pointers do not outlive a file."""
    return getattr(block, "name", block)


def plain(end):
    value = getattr(end, "default_value", None)
    return tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value


def keys(block) -> dict:
    """Custom properties; Blender 4.5 keeps what is registered among them."""
    return {key: repr(v) for key, v in block.items() if key not in ("cycles", "skin_tan")}


def of_object(obj) -> tuple:
    animation = obj.animation_data
    return (
        [(slot.link, named(slot.material)) for slot in obj.material_slots],
        [named(material) for material in obj.data.materials],
        [face.material_index for face in obj.data.polygons],
        [(item.name, item.data_type, item.domain) for item in obj.data.attributes],
        animation and (named(animation.action), getattr(animation.action_slot, "identifier", "")),
        keys(obj),
    )


def of_action(action) -> tuple:
    slots = [slot.identifier for slot in action.slots]
    curves = []
    for slot in action.slots:
        bag = action_get_channelbag_for_slot(action, slot) if action.layers else None
        for curve in bag.fcurves if bag else ():
            points = [(*key.co, key.interpolation) for key in curve.keyframe_points]
            curves.append((slot.identifier, curve.data_path, curve.array_index, points))
    return slots, len(action.layers), curves, keys(action)
