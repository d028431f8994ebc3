"""What the mask's nodes in a tan's group read, and setting it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, cast

import bpy

from hylios.errors import InputError

from .changes import Changes
from .masks import COLOURS, Mask, require_usable
from .nodes import complete, find_input, of_role
from .ownership import Users, is_local, remembered
from .plan import IMAGE_LINKS, IMAGE_ROLES, LAYOUT, LAYOUT_KEY, LINKS, ROLES, Link, Role
from .vertex_groups import copied

WEIGHTS = {
    "MEAN": (1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0),
    "RED": (1.0, 0.0, 0.0),
    "GREEN": (0.0, 1.0, 0.0),
    "BLUE": (0.0, 0.0, 1.0),
    "ALPHA": (0.0, 0.0, 0.0),
}
"""Of red, green and blue in the number that a channel gives."""

SHARE_ROLES = ("mask", "mask_channel", "mask_alpha", "mask_value", "mask_share", "share")
"""Roles of the nodes that read a mask which is no image."""

NUMBER, NOTHING = (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class ShownMask:
    """What the nodes read: an attribute or an image, or neither where the whole body is bare.

    Attributes
    ----------
    attribute : str
    image : Image or None
    uv_map : str
    weights : 3 floats
        Of red, green and blue.
    alpha : float
        Weight of alpha.
    slope, offset : float
        From the number to the share of the dose.
    """

    attribute: str = ""
    image: bpy.types.Image | None = None
    uv_map: str = ""
    weights: tuple[float, float, float] = NOTHING
    alpha: float = 0.0
    slope: float = 1.0
    offset: float = 0.0

    def values(self) -> Mapping[str, Mapping[int, Any]]:
        """By roles and numbers of inputs."""
        of_image, bare = self.image is not None, self.image is None and not self.attribute
        return {
            "mask_channel": {1: NOTHING if of_image else self.weights},
            "mask_alpha": {1: 0.0 if of_image else self.alpha},
            "image_channel": {1: self.weights if of_image else NOTHING},
            "image_alpha": {1: self.alpha if of_image else 0.0},
            "mask_share": {1: self.slope, 2: self.offset},
            "share": {1: 1.0 if bare else 0.0},
        }


def slope_and_offset(mask: Mask) -> tuple[float, float]:
    """How the share of the dose follows from a mask's number: a factor, and what is added."""
    return (-mask.strength, 1.0) if mask.invert else (mask.strength, 1.0 - mask.strength)


def shown_mask(obj: bpy.types.Object, mask: Mask, changes: Changes) -> ShownMask:
    """What the nodes read for a mask; a vertex group is copied for them.

    Raises
    ------
    InputError
        If the mask cannot be used.
    """
    source = require_usable(obj, mask)
    if source is None:
        return ShownMask()
    slope, offset = slope_and_offset(mask)
    weights = WEIGHTS.get(mask.channel, WEIGHTS["MEAN"])
    alpha = 1.0 if mask.channel == "ALPHA" else 0.0
    if source.kind == "IMAGE":
        return ShownMask("", mask.image, mask.uv_map, weights, alpha, slope, offset)
    if source.data_type not in COLOURS:
        weights, alpha = NUMBER, 0.0
    name = source.name
    if source.kind == "GROUP":
        name = copied(obj, name, changes)
    return ShownMask(name, None, "", weights, alpha, slope, offset)


def where_it_lies(obj: bpy.types.Object, mask: Mask, changes: Changes) -> ShownMask:
    """What nodes read of a mask of what lies on the skin: its number times its strength.

    Raises
    ------
    InputError
        If the mask cannot be used.
    """
    slope, offset = (-mask.strength, mask.strength) if mask.invert else (mask.strength, 0.0)
    return replace(shown_mask(obj, mask, changes), slope=slope, offset=offset)


def show(group: bpy.types.NodeTree, shown: ShownMask, changes: Changes, prefix: str = "") -> None:
    """Have the nodes of a mask read something else; those of another mask by their prefix."""
    if shown.image is not None and any(of_role(group, prefix + "mask_value")):
        roles, links = prefixed(IMAGE_ROLES, IMAGE_LINKS, prefix)
        made = [role for role in roles if not any(of_role(group, role))]
        changes.may_add_to(group.nodes)
        changes.may_relink(group)
        complete(group, made, roles, links)
    for role, values in shown.values().items():
        for node in of_role(group, prefix + role):
            for socket, value in values.items():
                changes.set(find_input(node, socket), "default_value", value)
    for role, name, value in (
        ("mask", "attribute_name", shown.attribute),
        ("mask_uv", "uv_map", shown.uv_map),
        ("mask_image", "image", shown.image),
    ):
        for node in of_role(group, prefix + role):
            changes.set(node, name, value)


def added(tree: bpy.types.NodeTree, shown: ShownMask, changes: Changes, prefix: str) -> Any:
    """Add the nodes of another mask to a tree; the last of them, which gives the share."""
    roles, links = prefixed(
        {role: ROLES[role] for role in SHARE_ROLES},
        [link for link in LINKS if {link[0], link[2]} <= set(SHARE_ROLES)],
        prefix,
    )
    complete(tree, roles, roles, links)
    show(tree, shown, changes, prefix)
    return next(of_role(tree, prefix + "share"))


def prefixed(
    roles: Mapping[str, Role], links: Iterable[Link], prefix: str
) -> tuple[dict[str, Role], list[Link]]:
    """Roles and the links between them for another mask, higher up in the tree."""
    height = 1500 if prefix else 0
    moved = {
        prefix + name: replace(role, location=(role.location[0], role.location[1] + height))
        for name, role in roles.items()
    }
    inner = [
        (prefix + source, output, prefix + target, socket)
        for source, output, target, socket in links
    ]
    return moved, inner


def show_at_once(obj: bpy.types.Object, mask: Mask) -> bool:
    """Have a tan that is there show another mask, without Apply; whether it does.

    It does not where other objects show the tan's nodes too, where the mask cannot be used, where
    the tan shows several, or while Blender renders.
    """
    group = remembered(obj).group
    if group is None or group.get(LAYOUT_KEY) != LAYOUT or bpy.app.is_job_running("RENDER"):
        return False
    if not (is_local(group) and is_local(cast(bpy.types.ID, obj.data))):
        return False
    if Users().others(group, obj) or any(of_role(group, "basis")):
        return False
    try:
        with Changes() as changes:
            show(group, shown_mask(obj, mask, changes), changes)
    except InputError:
        return False
    return True
