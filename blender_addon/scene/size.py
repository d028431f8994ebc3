"""How large a body is, and what follows from that in its materials: light and relief."""

from typing import Any

import bpy
import numpy as np

from hylios.errors import require_range

from . import detail, nodes, peeling, regions, slots
from .changes import Changes
from .ownership import is_local, remembered


def body_unit(obj: bpy.types.Object, scene: bpy.types.Scene) -> float:
    """Length in metres that a scene unit is on a body, were it life-size.

    Blender ignores the scale of units where they are off.

    Raises
    ------
    InputError
        If the unit scale is out of range.
    """
    units, scale = scene.unit_settings, remembered(obj).model_scale
    if units.system == "NONE":
        return 1.0 / scale
    return require_range("unit scale of the scene", units.scale_length, 1e-9, 1e9) / scale


def length(obj: bpy.types.Object, scene: bpy.types.Scene) -> float:
    """The longest side of a body in metres, were it life-size."""
    corners = np.array([tuple(corner) for corner in obj.bound_box])
    sides = np.ptp(corners, axis=0) * np.abs(np.array(obj.matrix_world.to_scale()))
    return body_unit(obj, scene) * float(sides.max())


def shows_our_light(obj: bpy.types.Object) -> bool:
    """Whether an object shows our shader: an artist's own scatters light as he has set it."""
    group = remembered(obj).group
    if group is None:
        return False
    nodes_of_materials = (node for tree in slots.shown_trees(obj, group) for node in tree.nodes)
    return any(
        getattr(node, "node_tree", None) == group and node.outputs["Surface"].is_linked
        for node in nodes_of_materials
        if "Surface" in node.outputs
    )


def light_goes(obj: bpy.types.Object, scene: bpy.types.Scene) -> float:
    """How many times too far light goes in an object's skin; 1 where it has none."""
    right = nodes.radius_of_millimetre(body_unit(obj, scene))
    group = remembered(obj).group
    return next((node.outputs[0].default_value / right for node in _radii(group)), 1.0)


def is_right(times: float) -> bool:
    """Whether light goes as far as it should, within what one might see."""
    return abs(np.log(max(times, 1e-30))) < 0.01


def misfits(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Objects of a scene in whose skin light goes too far or too short, less linked ones."""
    return [
        obj
        for obj in scene.objects
        if is_local(obj)
        and remembered(obj).group is not None
        and is_local(remembered(obj).group)
        and not is_right(light_goes(obj, scene))
    ]


def fit(obj: bpy.types.Object, scene: bpy.types.Scene, changes: Changes) -> None:
    """Have light and relief of an object's skin fit its size and the scene's units."""
    unit = body_unit(obj, scene)
    group = remembered(obj).group
    for node in _radii(group):
        changes.set(node.outputs[0], "default_value", nodes.radius_of_millimetre(unit))
    if group is not None:
        detail.set_size(list(slots.shown_trees(obj, group)), obj, unit, changes)
        regions.set_size(group, obj, unit, changes)
        peeling.set_size(group, obj, unit, changes)


def _radii(group: Any) -> list[Any]:
    return list(nodes.of_role(group, "radius")) if group is not None else []
